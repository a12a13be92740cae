"""What was seen, on the page: topics with their intervals, the graph, what the nodes wrote."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ros2_on_pip.graph.drawing import graph_pictures
from ros2_on_pip.graph.words import describe_graph
from ros2_on_pip.markup import Markup, joined, tag
from ros2_on_pip.rates import Rate
from roslings.evidence import Evidence, ExperimentSeen, GraphSeen, ProcessSeen, Spoken
from roslings.matching import own_endpoints
from roslings.report.html.interval_plot import describe, interval_plot, legend
from roslings.report.html.intervals import Watched, unheard
from roslings.report.html.scale import rate_text, time_text
from roslings.report.node_logs import NodeLog, logs_of
from roslings.verdict import CheckResult, Verdict

WIDE, NARROW = (720.0, 270.0), (340.0, 230.0)
CLOCKS = {"sim": "in simulated time", "wall": "in real time"}
SECOND_END = "how a node ends was in doubt, so it was made once more, to be sure"
MOST_LOG_LINES = 400
JITTER = "jitter: how far the periods are from each other"
ABOUT_JITTER = (
    "The jitter is the standard deviation of the periods: most periods are nearer to their mean"
    " than twice this time. A little jitter is normal, for the computer has other work, too."
)
ABOUT_SILENCE = (
    "No message came on these topics in that time. That may be as it should be: where one was"
    " missing, a check above says so."
)
ABOUT_AGAIN = "To be sure of what was seen, these runs were made once more. That costs no points."


def rate_plots(verdict: Verdict, heard: Sequence[Watched]) -> dict[str, Watched]:
    """For each check that failed for a rate, by its id, the topic of which it asks that rate."""
    found: dict[str, Watched] = {}
    for check in verdict.failed():
        for each in heard:
            of_another = any(each is other for other in found.values())
            if each.intervals and not of_another and _asks(check, each):
                found.setdefault(check.id, each)
    return found


def _asks(check: CheckResult, each: Watched) -> bool:
    return bool(each.asked and f"{each.asked.hz:g} Hz" in (check.expected or ""))


def topics(evidence: Evidence, heard: Sequence[Watched]) -> Iterator[Markup]:
    """Each topic that was heard, but for those that stand beside a check already."""
    figures = [topic(each) for each in heard]
    silent = [
        tag(
            "li",
            tag("code", topic),
            f" ({kind}) in {experiment}",
        )
        for experiment, topic, kind in unheard(evidence)
    ]
    if figures or silent:
        rest = [tag("p", ABOUT_SILENCE, class_="about"), tag("ul", *silent)] if silent else []
        yield tag("section", tag("h2", "What came on the topics"), *figures, *rest)


def topic(each: Watched) -> Markup:
    """Its periods as a plot, and its figures as a table."""
    heading = tag("h3", tag("code", each.seen.name), f" in {each.experiment.name}")
    return tag("figure", heading, *_plots(each), _measures(each))


def _plots(each: Watched) -> Iterator[Markup]:
    if doubt := each.experiment.doubt:
        yield tag("p", f"These times are not believed: {doubt}.", class_="about")
    if not each.intervals:
        return
    if each.asked and each.asked.topic != each.seen.name:
        yield tag("p", f"The lab asks for {each.asked.topic}: this is the nearest.", class_="about")
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
        words = tag("h2", "Runs that were made again"), tag("p", ABOUT_AGAIN, class_="about")
        yield tag("section", *words, tag("ul", *runs))


def _measures(each: Watched) -> Markup:
    rows = [
        tag("tr", tag("th", name, scope="row"), tag("td", value)) for name, value in _figures(each)
    ]
    table = tag("table", tag("tbody", *rows), class_="measures")
    return joined(table, tag("p", ABOUT_JITTER, class_="about")) if each.rate else table


def _figures(each: Watched) -> Iterator[tuple[str, str]]:
    heard = len(each.seen.messages) + each.seen.not_kept
    yield "type", each.seen.type
    yield "messages", f"{heard}"
    if each.rate is None:
        yield "rate", "too few messages to tell"
        return
    rate = each.rate
    yield "rate", rate_text(rate.hz, rate.uncertainty_hz)
    if each.asked:
        low, high = each.asked.low_hz, each.asked.high_hz
        yield "asked rate", f"{each.asked.hz:g} Hz ({low:g} to {high:g} Hz)"
    yield from _periods(each, rate)
    yield JITTER, _jitter(each, rate)
    yield "lost messages", f"{rate.lost}"
    yield "times from", _clock(each, rate)


def _periods(each: Watched, rate: Rate) -> Iterator[tuple[str, str]]:
    """Where the clock's steps hide how the periods differ, only what all of them share is known."""
    if each.within_steps:
        about_s = rate.period_s * rate.uncertainty_hz / rate.hz
        yield "period", f"{time_text(rate.median_s)}, give or take {time_text(about_s)}"
        return
    yield "half of the periods (p50)", f"at most {time_text(rate.median_s)}"
    yield "95 % of the periods (p95)", f"at most {time_text(rate.p95_s)}"


def _jitter(each: Watched, rate: Rate) -> str:
    """Nothing shorter than a step of the simulated clock was measured."""
    if each.step_s is None:
        return time_text(rate.jitter_s)
    step = f"one step of the simulated clock ({time_text(each.step_s)})"
    if each.within_steps:
        return f"less than {step}"
    return f"{time_text(rate.jitter_s)}, each time known to {step}"


def _clock(each: Watched, rate: Rate) -> str:
    if each.experiment.clock == "sim":
        return "the simulated clock"
    return "the publisher's stamps" if rate.from_stamps else "the moments of arrival"


def said(evidence: Evidence) -> Iterator[Markup]:
    """What the grader said to the nodes, in the order in which it did."""
    lines = [
        tag("li", f"in {seen.name}, on ", tag("code", spoken.topic), f": {_words_of(spoken)}")
        for seen in evidence.experiments.values()
        for spoken in seen.spoken
    ]
    if lines:
        yield tag("section", tag("h2", "What was said to the nodes"), tag("ul", *lines))


def _words_of(spoken: Spoken) -> str:
    content = spoken.content
    only_text = isinstance(content, dict) and content.keys() == {"data"}
    alone = "" if spoken.matched else " (nobody was listening)"
    return f"{content['data'] if only_text else content!r}{alone}"


def graphs(evidence: Evidence) -> Iterator[Markup]:
    """The graph of each experiment."""
    figures = [_graph(each) for each in evidence.experiments.values()]
    if figures:
        words = "An ellipse is a node, a rectangle is a topic. Messages go along the arrows."
        note = tag("p", words, class_="about")
        yield tag("section", tag("h2", "The graph"), note, *figures)


def _graph(seen: ExperimentSeen) -> Markup:
    heading = tag("h3", f"in {seen.name}")
    if not seen.graph.nodes:
        return tag("figure", heading, tag("p", "No node was seen."))
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
        yield tag("section", tag("h2", "What they wrote"), *folded)


def _whose(log: NodeLog, seen: ExperimentSeen) -> str:
    process = seen.processes.get(log.origin)
    return f"the terminal of {log.origin}" if process else "the topic /rosout"


def _folded(title: str, text: str, count: int) -> Markup:
    """A long log shows its two ends; the whole of it stands in the evidence."""
    lines = text.splitlines()
    if len(lines) > MOST_LOG_LINES:
        half = MOST_LOG_LINES // 2
        missing = f"... {len(lines) - 2 * half} lines more ..."
        lines = [*lines[:half], missing, *lines[-half:]]
    summary = tag("summary", f"{title} ({count} {'line' if count == 1 else 'lines'})")
    return tag("details", summary, tag("pre", "\n".join(lines), tabindex="0"))


def processes(evidence: Evidence) -> Iterator[Markup]:
    """Each process: how it ended, what it used."""
    rows = [
        _process(seen.name, process)
        for seen in evidence.experiments.values()
        for process in seen.processes.values()
    ]
    if rows:
        names = ("program", "in", "ran", "ended", "processor", "memory")
        header = tag("tr", *(tag("th", name, scope="col") for name in names))
        table = tag("table", tag("thead", header), tag("tbody", *rows))
        yield tag("section", tag("h2", "The programs"), _scrolled(table, "the programs"))


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
    status = "" if process.status is None else f", exit code {process.status}"
    if process.status is not None and process.status < 0:
        status = f", signal {-process.status}"
    if process.ended_by_itself:
        return f"by itself{status}"
    if process.ending is None or process.ending.after_s is None:
        return f"killed{status}"
    return f"{process.ending.after_s:.2f} s after {process.ending.signal}{status}"


def surroundings(verdict: Verdict) -> Markup:
    """The machine and the versions, so that an appeal can measure again."""
    place, seconds = verdict.environment, verdict.seconds
    rows = {
        "roslings": place.roslings,
        "ROS": f"{place.ros_distro}, {place.rmw or 'its own choice of middleware'}",
        "Python": place.python,
        "system": place.platform,
        "kept apart by": place.isolation,
        "clock": place.clock,
        "seed": str(place.seed),
        "seconds": f"build {seconds.build:.1f}, discovery {seconds.discovery:.1f},"
        f" watching {seconds.watching:.1f}, ending {seconds.ending:.1f}",
    }
    cells = [
        tag("tr", tag("th", name, scope="row"), tag("td", text)) for name, text in rows.items()
    ]
    table = tag("table", tag("tbody", *cells), class_="measures")
    return tag("section", tag("h2", "Where it was measured"), joined(table))
