"""What was seen, on the page: topics with their intervals, the graph, what the nodes wrote."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ros2_on_pip.graph.drawing import graph_pictures
from ros2_on_pip.graph.words import describe_graph
from ros2_on_pip.language import Text, counted, said
from ros2_on_pip.markup import Markup, joined, tag, told
from ros2_on_pip.rates import Rate
from roslings.evidence import Evidence, ExperimentSeen, GraphSeen, ProcessSeen, Spoken
from roslings.report.html.interval_plot import describe, interval_plot, legend
from roslings.report.html.intervals import RequiredRate, TopicIntervals, unheard
from roslings.report.html.scale import rate_text, time_text
from roslings.report.html.timeline_svg import in_experiment
from roslings.report.node_logs import NodeLog, logs_of
from roslings.seen.matching import own_endpoints
from roslings.verdict import CheckResult, Verdict

WIDE, NARROW = (720.0, 270.0), (340.0, 230.0)
CLOCKS = {
    "sim": Text("page.clock.simulated", "in simulated time"),
    "wall": Text("page.clock.real", "in real time"),
}
SECOND_END = Text(
    "page.second_end", "how a node ends was in doubt, so it was made once more, to be sure"
)
MOST_LOG_LINES = 400
JITTER = Text("page.jitter", "jitter: how far the periods are from each other")
ABOUT_JITTER = Text(
    "page.about_jitter",
    "The jitter is the standard deviation of the periods: most periods are nearer to their mean"
    " than twice this time. A little jitter is normal, for the computer has other work, too.",
)
ABOUT_SILENCE = Text(
    "page.about_silence",
    "No message came on these topics in that time. That may be as it should be: where one was"
    " missing, a check above says so.",
)
ABOUT_AGAIN = Text(
    "page.about_again",
    "To be sure of what was seen, these runs were made once more. That costs no points.",
)


OWN_RMW = "its own choice of middleware"
OF_A_PROGRAM = (
    Text("page.program", "program"),
    Text("page.program.in", "in"),
    Text("page.program.ran", "ran"),
    Text("page.program.ended", "ended"),
    Text("page.program.processor", "processor"),
    Text("page.program.memory", "memory"),
)


def rate_plots(verdict: Verdict, heard: Sequence[TopicIntervals]) -> dict[str, TopicIntervals]:
    """For each check that failed for a rate, by its id, the topic of which it asks that rate."""
    found: dict[str, TopicIntervals] = {}
    for check in verdict.failed():
        for each in heard:
            of_another = any(each is other for other in found.values())
            if each.intervals and not of_another and _asks(check, each):
                found.setdefault(check.id, each)
    return found


def _asks(check: CheckResult, each: TopicIntervals) -> bool:
    if not each.asked or not check.asked_rate:
        return False
    topic, hz = check.asked_rate
    return hz == each.asked.hz and topic in (None, each.seen.name, each.asked.topic)


def topics(evidence: Evidence, heard: Sequence[TopicIntervals]) -> Iterator[Markup]:
    """Each topic that was heard, but for those that stand beside a check already."""
    figures = [topic(each) for each in heard]
    silent = [
        tag(
            "li",
            told(
                "page.silent",
                "{topic} ({type}) in {experiment}",
                topic=tag("code", topic),
                type=kind,
                experiment=experiment,
            ),
        )
        for experiment, topic, kind in unheard(evidence)
    ]
    if figures or silent:
        rest = [tag("p", str(ABOUT_SILENCE), class_="about"), tag("ul", *silent)] if silent else []
        title = said("page.topics", "What came on the topics")
        yield tag("section", tag("h2", title), *figures, *rest)


def topic(each: TopicIntervals) -> Markup:
    """Its periods as a plot, and its figures as a table."""
    name = tag("code", each.seen.name)
    title = told(
        "page.topic", "{topic} in {experiment}", topic=name, experiment=each.experiment.name
    )
    return tag("figure", tag("h3", title), *_plots(each), _measures(each))


def _plots(each: TopicIntervals) -> Iterator[Markup]:
    if doubt := each.experiment.doubt:
        not_believed = "These times are not believed: {doubt}."
        yield tag("p", said("page.not_believed", not_believed, doubt=doubt), class_="about")
    if not each.intervals:
        return
    if each.asked and each.asked.topic != each.seen.name:
        nearest = "The lab asks for {topic}: this is the nearest."
        yield tag("p", said("page.nearest", nearest, topic=each.asked.topic), class_="about")
    for screen, (width, height) in {"wide": WIDE, "narrow": NARROW}.items():
        yield tag("div", interval_plot(each, width, height), class_=screen)
    yield legend(each)
    yield tag("figcaption", describe(each))


def set_aside(evidence: Evidence) -> Iterator[Markup]:
    """The runs that were made again, and why."""
    runs = [
        tag("li", f"{seen.name}, {CLOCKS[seen.clock]}: {seen.doubt or SECOND_END}")
        for seen in evidence.attempts
    ]
    if runs:
        title = tag("h2", said("page.made_again", "Runs that were made again"))
        yield tag("section", title, tag("p", str(ABOUT_AGAIN), class_="about"), tag("ul", *runs))


def _measures(each: TopicIntervals) -> Markup:
    rows = [
        tag("tr", tag("th", name, scope="row"), tag("td", value)) for name, value in _figures(each)
    ]
    table = tag("table", tag("tbody", *rows), class_="measures")
    return joined(table, tag("p", str(ABOUT_JITTER), class_="about")) if each.rate else table


def _figures(each: TopicIntervals) -> Iterator[tuple[str, str]]:
    heard = len(each.seen.messages) + each.seen.not_kept
    yield said("page.type", "type"), each.seen.type
    yield said("page.messages", "messages"), f"{heard}"
    if each.rate is None:
        yield said("page.rate", "rate"), said("page.too_few", "too few messages to tell")
        return
    rate = each.rate
    yield said("page.rate", "rate"), rate_text(rate.hz, rate.uncertainty_hz)
    if each.asked:
        yield said("page.asked_rate", "asked rate"), _asked_rate(each.asked)
    yield from _periods(each, rate)
    yield str(JITTER), _jitter(each, rate)
    yield said("page.lost", "lost messages"), f"{rate.lost}"
    yield said("page.times_from", "times from"), _clock(each, rate)


def _asked_rate(asked: RequiredRate) -> str:
    return said(
        "page.asked_hz",
        "{hz:g} Hz ({low:g} to {high:g} Hz)",
        hz=asked.hz,
        low=asked.low_hz,
        high=asked.high_hz,
    )


def _periods(each: TopicIntervals, rate: Rate) -> Iterator[tuple[str, str]]:
    """Where the clock's steps hide how the periods differ, only what all of them share is known."""
    if each.within_steps:
        about_s = rate.period_s * rate.uncertainty_hz / rate.hz
        yield (
            said("page.period", "period"),
            said(
                "page.give_or_take",
                "{period}, give or take {about}",
                period=time_text(rate.median_s),
                about=time_text(about_s),
            ),
        )
        return
    yield said("page.half", "half of the periods (p50)"), _at_most(rate.median_s)
    yield said("page.most", "95 % of the periods (p95)"), _at_most(rate.p95_s)


def _at_most(time_s: float) -> str:
    return said("page.at_most", "at most {time}", time=time_text(time_s))


def _jitter(each: TopicIntervals, rate: Rate) -> str:
    """Nothing shorter than a step of the simulated clock was measured."""
    if each.step_s is None:
        return time_text(rate.jitter_s)
    step = time_text(each.step_s)
    if each.within_steps:
        less = "less than one step of the simulated clock ({step})"
        return said("page.less_than_a_step", less, step=step)
    return said(
        "page.known_to_a_step",
        "{jitter}, each time known to one step of the simulated clock ({step})",
        jitter=time_text(rate.jitter_s),
        step=step,
    )


def _clock(each: TopicIntervals, rate: Rate) -> str:
    if each.experiment.clock == "sim":
        return said("page.from.simulated", "the simulated clock")
    if rate.from_stamps:
        return said("page.from.stamps", "the publisher's stamps")
    return said("page.from.arrival", "the moments of arrival")


def spoken(evidence: Evidence) -> Iterator[Markup]:
    """What the grader said to the nodes, in the order in which it did."""
    lines = [
        tag("li", _spoken(seen.name, spoken))
        for seen in evidence.experiments.values()
        for spoken in seen.spoken
    ]
    if lines:
        title = said("page.said_to_nodes", "What was said to the nodes")
        yield tag("section", tag("h2", title), tag("ul", *lines))


def _spoken(experiment: str, spoken: Spoken) -> Markup:
    parts = {"topic": tag("code", spoken.topic), "words": _words_of(spoken)}
    return told(
        "page.spoken", "in {experiment}, on {topic}: {words}", experiment=experiment, **parts
    )


def _words_of(spoken: Spoken) -> str:
    content = spoken.content
    only_text = isinstance(content, dict) and content.keys() == {"data"}
    alone = "" if spoken.matched else said("page.nobody_listened", " (nobody was listening)")
    return f"{content['data'] if only_text else content!r}{alone}"


def graphs(evidence: Evidence) -> Iterator[Markup]:
    """The graph of each experiment."""
    figures = [_graph(each) for each in evidence.experiments.values()]
    if figures:
        words = "An ellipse is a node, a rectangle is a topic. Messages go along the arrows."
        note = tag("p", said("page.about_graph", words), class_="about")
        yield tag("section", tag("h2", said("page.graph", "The graph")), note, *figures)


def _graph(seen: ExperimentSeen) -> Markup:
    heading = tag("h3", in_experiment(seen.name))
    if not seen.graph.nodes:
        return tag("figure", heading, tag("p", said("page.no_node", "No node was seen.")))
    graph = _own_graph(seen)
    caption = tag("figcaption", describe_graph(graph))
    return tag("figure", heading, graph_pictures(graph), caption)


def _own_graph(seen: ExperimentSeen) -> GraphSeen:
    """The graph without the simulated clock, which is the grader's."""
    if seen.clock == "wall":
        return seen.graph
    return seen.graph.model_copy(update={"endpoints": own_endpoints(seen.graph)})


def logs(evidence: Evidence) -> Iterator[Markup]:
    """What the nodes wrote, and what colcon did; folded."""
    folded = [
        _folded(f"{seen.name}: {_whose(log, seen)}", log.text, log.lines)
        for seen in evidence.experiments.values()
        for log in logs_of(seen)
    ]
    built = evidence.build
    if built and built.output:
        text = "\n".join(built.output)
        folded.append(_folded("colcon build", text, len(built.output)))
    if folded:
        yield tag("section", tag("h2", said("page.wrote", "What they wrote")), *folded)


def _whose(log: NodeLog, seen: ExperimentSeen) -> str:
    process = seen.processes.get(log.origin)
    if process:
        return said("page.terminal_of", "the terminal of {program}", program=log.origin)
    return said("page.rosout", "the topic /rosout")


def _folded(title: str, text: str, count: int) -> Markup:
    """A long log shows its two ends; the whole of it stands in the evidence."""
    lines = text.splitlines()
    if len(lines) > MOST_LOG_LINES:
        half = MOST_LOG_LINES // 2
        more = "... {count} lines more ..."
        missing = said("page.lines_more", more, count=len(lines) - 2 * half)
        lines = [*lines[:half], missing, *lines[-half:]]
    words = counted(
        "page.lines",
        count,
        one="{title} ({count} line)",
        other="{title} ({count} lines)",
        title=title,
    )
    return tag("details", tag("summary", words), tag("pre", "\n".join(lines), tabindex="0"))


def processes(evidence: Evidence) -> Iterator[Markup]:
    """Each process: how it ended, what it used."""
    rows = [
        _process(seen.name, process)
        for seen in evidence.experiments.values()
        for process in seen.processes.values()
    ]
    if rows:
        header = tag("tr", *(tag("th", str(name), scope="col") for name in OF_A_PROGRAM))
        table = tag("table", tag("thead", header), tag("tbody", *rows))
        title = tag("h2", said("page.programs", "The programs"))
        yield tag("section", title, _scrolled(table, said("page.the_programs", "the programs")))


def _scrolled(table: Markup, name: str) -> Markup:
    return tag("div", table, class_="scroll", tabindex="0", role="group", aria_label=name)


def _process(experiment: str, process: ProcessSeen) -> Markup:
    ran_s = ((process.ended_ns or process.started_ns) - process.started_ns) / 1e9
    cells = (
        process.executable,
        experiment,
        f"{ran_s:.1f} s",
        _end_of(process),
        f"{process.cpu_s:.2f} s",
        f"{process.peak_memory_bytes / 1e6:.0f} MB",
    )
    return tag("tr", *(tag("td", cell) for cell in cells))


def _end_of(process: ProcessSeen) -> str:
    status = _status_of(process)
    if process.ended_by_itself:
        return said("page.ended.alone", "by itself{status}", status=status)
    if process.ending is None or process.ending.after_s is None:
        return said("page.ended.killed", "killed{status}", status=status)
    return said(
        "page.ended.after",
        "{after_s:.2f} s after {signal}{status}",
        after_s=process.ending.after_s,
        signal=process.ending.signal,
        status=status,
    )


def _status_of(process: ProcessSeen) -> str:
    if process.status is None:
        return ""
    if process.status < 0:
        return said("page.ended.signal", ", signal {number}", number=-process.status)
    return said("page.ended.code", ", exit code {number}", number=process.status)


def surroundings(verdict: Verdict) -> Markup:
    """The machine and the versions, so that an appeal can measure again."""
    place, seconds = verdict.environment, verdict.seconds
    rows = {
        "roslings": place.roslings,
        "ROS": f"{place.ros_distro}, {place.rmw or said('page.own_rmw', OWN_RMW)}",
        "Python": place.python,
        said("page.system", "system"): place.platform,
        said("page.apart", "kept apart by"): place.isolation,
        said("page.clock", "clock"): place.clock,
        said("page.seed", "seed"): str(place.seed),
        said("page.seconds", "seconds"): said(
            "page.seconds.of",
            "build {build:.1f}, discovery {discovery:.1f}, watching {watching:.1f},"
            " ending {ending:.1f}",
            build=seconds.build,
            discovery=seconds.discovery,
            watching=seconds.watching,
            ending=seconds.ending,
        ),
    }
    cells = [
        tag("tr", tag("th", name, scope="row"), tag("td", text)) for name, text in rows.items()
    ]
    table = tag("table", tag("tbody", *cells), class_="measures")
    title = said("page.where", "Where it was measured")
    return tag("section", tag("h2", title), joined(table))
