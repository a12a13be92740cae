"""What a grader can demand: each is a function that raises a typed fault when it is not met."""

from __future__ import annotations

import difflib
from collections import Counter, defaultdict
from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import replace
from typing import Literal

from ros2_on_pip.rates import LONGEST_STALL_S
from roslings.course import NodeContract, TopicContract
from roslings.course.files import written
from roslings.evidence import Ending, ExperimentSeen, LogLine, ProcessSeen, Spoken
from roslings.judge import faults
from roslings.judge.faults import EndpointKind, reasons
from roslings.judge.faults.sentences import Text
from roslings.judge.lines import times
from roslings.judge.remarks import remark
from roslings.judge.views import (
    Demand,
    EndpointView,
    ExperimentView,
    NodeView,
    PackageView,
    PictureView,
    ProcessView,
)
from roslings.judge.words import end_of
from roslings.seen.exits import is_late, is_unclean, is_whole, tracebacks, without_interrupt
from roslings.seen.matching import own_endpoints

FEWEST_MESSAGES = 5
SIMILAR_LINE = 0.5


def require_steady(stall_s: float) -> None:
    """Before a time is held against the student: this computer kept up. Raises Inconclusive."""
    if stall_s > LONGEST_STALL_S:
        raise reasons.StoodStill(stall_s)


def require_processors(executable: str, ending: Ending, limit_s: float) -> None:
    """Before its ending is held against the student: it had its time. Raises Inconclusive."""
    if ending.least_own_s <= limit_s:
        raise reasons.NoProcessor(executable, ending.waited_s + ending.others_waited_s)


def require_its_time(
    seen: ExperimentSeen, part: str | None, late_s: float | None, what: Text
) -> None:
    """Before something late is held against the student: this computer did not make it so late.

    `part` is the timed stretch; None: the worst of all. `late_s` is None for what did not come
    while whoever measured had patience. Raises Inconclusive.
    """
    stretches = [held for name, held in seen.held_up.items() if part in (name, None)]
    held_s = max((held.longest_s for held in stretches), default=0.0)
    if (seen.patience_s if late_s is None else late_s) <= held_s:
        raise reasons.HeldUp(what, held_s)


# --- the package -------------------------------------------------------------------------------


def be_well_formed(build_type: str) -> Demand[PackageView]:
    """package.xml is valid and of the right kind, no file is missing, Python can read the code.

    >>> package.must(be_well_formed(CARD.build_type))
    """

    def demand(package: PackageView) -> None:
        files = package.files
        if files.xml_problems:
            raise faults.InvalidPackageXml(files.xml_problems[0])
        if files.build_type != build_type:
            raise faults.WrongBuildType(build_type, files.build_type)
        if files.missing_files:
            raise faults.MissingFile(files.missing_files[0])
        if files.syntax_errors:
            raise faults.SyntaxErrorInCode(files.syntax_errors[0])

    return demand


def list_what_it_imports(package: PackageView) -> None:
    """package.xml names every ROS package that the code imports."""
    for name, place in sorted(package.files.imported.items()):
        if name not in package.files.declared:
            raise faults.UnlistedDependency(name, place)


def be_built_as(build_type: str) -> Demand[PackageView]:
    """colcon builds it, as the kind of package that it is meant to be."""

    def demand(package: PackageView) -> None:
        built = package.built
        if built is None:
            raise reasons.NotBuilt
        if not built.succeeded:
            raise faults.BuildFailed(built.seconds, log=tuple(built.output[-10:]))
        if built.recognised_as != f"ros.{build_type}":
            raise faults.NotAnAmentPackage(built.recognised_as)

    return demand


def install(executables: Iterable[str]) -> Demand[PackageView]:
    """`ros2 run` finds each executable."""

    def demand(package: PackageView) -> None:
        there = tuple(package.built.executables) if package.built else ()
        for name in executables:
            if name not in there:
                raise faults.NoExecutable(name, there, package.files.name)

    return demand


# --- processes ---------------------------------------------------------------------------------


def come_up(process: ProcessView) -> None:
    """It makes a node, and does not end before that node has done anything."""
    seen = process.seen
    if seen.ended_by_itself and not (process.shown and process.acted):
        raise faults.DidNotComeUp(
            seen.executable, process.ran_s, end_of(seen), log=process.last_lines()
        )
    if not process.shown:
        require_steady(process.experiment.stall_s)
        require_believable(process.experiment)
        raise faults.DidNotComeUp(seen.executable, log=process.last_lines())


def during(when: Text, *demands: Demand[ProcessView]) -> Demand[ProcessView]:
    """The same demands, of `come_up` and `stay_up`; their faults say when it was."""

    def demand(process: ProcessView) -> None:
        try:
            process.must(*demands)
        except (faults.DidNotComeUp, faults.StoppedByItself) as fault:
            fault.when = when
            raise

    return demand


def stay_up(process: ProcessView) -> None:
    """It runs until it is asked to end, in each run of the experiment."""
    for run in process.runs:
        if run.seen.ended_by_itself:
            raise faults.StoppedByItself(
                run.seen.executable,
                run.ran_s,
                end_of(run.seen),
                simulated=run.is_simulated,
                log=run.last_lines(),
            )
    remark(how_long(process))


def outlast_the_soak(process: ProcessView) -> None:
    """It also runs on where nodes are left running for as long as the card promises.

    Nothing is demanded where no soak was made: a student's own check makes none.
    """
    soaked = process.soaked
    if soaked is None:
        remark(how_long(process))
        return
    if soaked.ended_by_itself:
        raise faults.EndedInTheSoak(
            soaked.executable,
            lifetime_s(soaked),
            end_of(soaked),
            log=tuple(line.text for line in without_interrupt(soaked)),
        )
    remark(reasons.Ran(lifetime_s(soaked), "alone"))


def how_long(process: ProcessView) -> reasons.Ran:
    """How long it ran in this experiment, and by which clock: `ran 12 s simulated`."""
    if process.is_simulated:
        return reasons.Ran(process.ran_s, "simulated")
    return reasons.Ran(lifetime_s(process.seen))


def lifetime_s(seen: ProcessSeen) -> float:
    """Seconds of real time from its start until it was asked to end, or ended."""
    ended_ns = seen.asked_to_end_ns or seen.ended_ns or seen.started_ns
    return (ended_ns - seen.started_ns) / 1e9


def end_within(limit_s: float) -> Demand[ProcessView]:
    """Ctrl-C ends it in time, and all that it started."""

    def demand(process: ProcessView) -> None:
        seen = process.seen
        if seen.ending is None:
            raise reasons.NothingSeen("end")
        if is_late(seen, limit_s):
            require_steady(process.experiment.stall_s)
            require_processors(seen.executable, seen.ending, limit_s)
        if agreed(process, lambda each: is_late(each, limit_s), "late"):
            raise faults.DoesNotEnd(seen.executable, limit_s, seen.ending.own_s)
        if seen.left_behind:
            raise faults.LeavesProcesses(seen.executable, seen.left_behind)

    return demand


def exit_cleanly(process: ProcessView) -> None:
    """After Ctrl-C: exit code 0 and no traceback. Raises Inconclusive where no end was whole."""
    if not process.seen.ended_after_ctrl_c:
        raise reasons.NothingSeen("clean_end")
    process = _with_whole_ends(process)
    seen = process.seen
    if agreed(process, is_unclean, "with_error"):
        raise faults.UncleanExit(
            seen.executable, end_of(seen), bool(tracebacks(seen)), log=process.lines_of_its_end
        )
    if seen.ending_cut:
        raise reasons.EndNotKept(seen.executable, seen.output_dropped_bytes)


def _with_whole_ends(process: ProcessView) -> ProcessView:
    """It as it ended where all was seen: in this experiment, else in another one."""
    here = [*process.before, process.seen]
    ends = list(filter(is_whole, here)) or list(filter(is_whole, process.elsewhere))
    if not ends:
        raise reasons.EndNotSeen(process.seen.executable)
    return replace(process, seen=ends[-1], before=tuple(ends[:-1]))


def agreed(
    process: ProcessView,
    bad: Callable[[ProcessSeen], bool],
    ended: Literal["late", "with_error"],
) -> bool:
    """Whether it ended badly each time that it was run. Raises Inconclusive where only once."""
    now = bad(process.seen)
    if any(bad(each) is not now for each in process.before):
        raise reasons.RunsDiffer(process.seen.executable, ended)
    return now


def log_each(node: NodeContract, texts: Sequence[str]) -> Demand[ProcessView]:
    """It writes the card's line for each of `texts`, once. The last may come after its end."""
    template = written(node.log, node.node)

    def demand(process: ProcessView) -> None:
        wanted = [spellings(template, text) for text in texts]
        if not wanted:
            raise reasons.NothingSeen("messages")
        for spelled in wanted[:-1] or wanted:
            if not any(map(process.wrote, spelled)):
                near = most_similar(spelled[0], process.texts)
                raise faults.NotLogged(process.seen.executable, spelled[0], near)
        _insist_on_once(process, wanted)

    return demand


def _insist_on_once(process: ProcessView, wanted: Sequence[tuple[str, ...]]) -> None:
    """Of messages that differ; who publishes one text again and again may write it as often."""
    lines = _by_text(process)
    for spelled, allowed in Counter(wanted).items():
        found = times(line for text in spelled for line in lines[text])
        if allowed < found:
            raise faults.LoggedAgain(process.seen.executable, spelled[0], found)


def insist_on_at_most(process: ProcessView, wanted: Collection[str], allowed: int) -> None:
    """All of these lines together stand there at most so often. Raises LoggedAgain."""
    lines = _by_text(process)
    if times(line for text in set(wanted) for line in lines[text]) > allowed:
        example = max(wanted, key=lambda text: times(lines[text]))
        raise faults.LoggedAgain(process.seen.executable, example, times(lines[example]))


def _by_text(process: ProcessView) -> Mapping[str, list[LogLine]]:
    lines = defaultdict[str, list[LogLine]](list)
    for line in process.lines:
        lines[line.plain].append(line)
    return lines


def spellings(template: str, text: str) -> tuple[str, ...]:
    """The card's line for `text`; a text in quotes may be in single or double ones."""
    written = (template, template.replace("'{text}'", '"{text}"'))
    return tuple(each.format(text=text) for each in dict.fromkeys(written))


def repeat(node: NodeContract, spoken: Sequence[Spoken]) -> Demand[ProcessView]:
    """It writes the card's line for every sentence that was said to it, once."""
    template = written(node.log, node.node)

    def demand(process: ProcessView) -> None:
        if not spoken:
            raise reasons.NothingSeen("spoken")
        said = [str(each.content["data"]) for each in spoken]
        wanted = [spellings(template, text) for text in said]
        for text, spelled in zip(said, wanted, strict=True):
            if not any(map(process.wrote, spelled)):
                raise _echo_fault(template, text, process.texts)
        _insist_on_once(process, wanted)

    return demand


def _echo_fault(template: str, said: str, texts: list[str]) -> faults.DoesNotRepeat:
    with_it = [line for line in texts if said in line]
    if with_it:
        return faults.AlmostRepeats(template, said, with_it[0])
    before = template.partition("{text}")[0]
    similar = [line for line in texts if before and line.startswith(before)]
    if similar:
        return faults.FixedText(template, said, similar[-1])
    return faults.DoesNotRepeat(template, said, texts[-1] if texts else None)


def most_similar(wanted: str, lines: list[str]) -> str | None:
    """The line most like the wanted one, else the last one; None where there is none."""
    near = difflib.get_close_matches(wanted, lines, n=1, cutoff=SIMILAR_LINE)
    return near[0] if near else (lines[-1] if lines else None)


# --- the graph ---------------------------------------------------------------------------------


def be_named(node: NodeView) -> None:
    """The node has the contract's full name, and no other node has it."""
    if not node.near.exact:
        raise faults.WrongNodeName(node.near)
    if node.count > 1:
        raise faults.NodeTwice(node.near.found, node.count)


def be_there(endpoint: EndpointView) -> None:
    """The topic has the contract's name, and one endpoint of the kind is there."""
    if endpoint.endpoint is None:
        raise faults.NoTopic(endpoint.contract.topic, endpoint.kind)
    if not endpoint.near.exact:
        raise faults.WrongTopic(endpoint.near, endpoint.kind, endpoint.found.type)


def be_the_only_one(endpoint: EndpointView) -> None:
    """There is one endpoint of this kind on the topic."""
    same = [e for e in endpoint.siblings if e.topic == endpoint.found.topic]
    if len(same) > 1:
        raise faults.TwoPublishers(endpoint.found.topic, tuple(e.node for e in same))


def carry_its_type(endpoint: EndpointView) -> None:
    """The topic carries the contract's type."""
    found, contract = endpoint.found, endpoint.contract
    if found.type != contract.type:
        raise faults.WrongType(found.topic, contract.type, found.type)


def match_qos(endpoint: EndpointView) -> None:
    """It can be joined with the other side that the contract describes."""
    wanted, found = _wanted_and_found(endpoint)
    if faults.qos_conflicts(endpoint.kind, found, wanted):
        raise faults.QosCannotMatch(endpoint.found.topic, endpoint.kind, wanted, found)


def have_just_this_qos(endpoint: EndpointView) -> None:
    """The quality of service is the contract's, not only one that matches it."""
    wanted, found = _wanted_and_found(endpoint)
    if found != wanted:
        raise faults.NotThisQos(endpoint.found.topic, endpoint.kind, wanted, found)


def _wanted_and_found(
    endpoint: EndpointView,
) -> tuple[faults.MatchedPolicies, faults.MatchedPolicies]:
    asked = endpoint.contract.qos
    return faults.MatchedPolicies(asked.reliability, asked.durability), faults.matched(endpoint.qos)


def hold_just(nodes: Sequence[NodeContract], topic: TopicContract) -> Demand[ExperimentView]:
    """The graph holds these nodes, joined by this topic, and nothing else.

    Two nodes of one name are the fault of another check, `be_named`.
    """

    def demand(experiment: ExperimentView) -> None:
        graph = experiment.seen.graph
        wanted = tuple(sorted(node.node for node in nodes))
        there = tuple(sorted(set(graph.nodes)))
        if set(wanted) - set(there):
            require_steady(experiment.seen.stall_s)
        if there != wanted:
            raise faults.NotTheAskedGraph(wanted, there)
        ends = {(e.node, e.kind) for e in own_endpoints(graph) if e.topic == topic.topic}
        edges = tuple(faults.EndOfTopic(*each) for each in sorted(ends))
        asked = tuple(faults.EndOfTopic(*each) for each in sorted(_asked_ends(nodes, topic)))
        if edges != asked:
            raise faults.NotTheAskedGraph(asked, edges, topic.topic)

    return demand


def _asked_ends(
    nodes: Sequence[NodeContract], topic: TopicContract
) -> Iterable[tuple[str, EndpointKind]]:
    for node in nodes:
        if any(t.topic == topic.topic for t in node.publishes):
            yield node.node, "publisher"
        if any(t.topic == topic.topic for t in node.subscribes):
            yield node.node, "subscription"


def require_believable(seen: ExperimentSeen) -> None:
    """Before a time is held against the student, or for them. Raises Inconclusive."""
    if seen.machine_fault:
        raise reasons.TimesNotBelieved(seen.machine_fault)
    if seen.not_believed:
        raise reasons.TimesNotBelieved(seen.not_believed, simulated=True)


# --- pictures ----------------------------------------------------------------------------------


def be_a_picture(picture: PictureView) -> None:
    """The file is an image of the asked kind and size, and shows something."""
    contract, seen = picture.contract, picture.seen
    least_px = (contract.min_width_px, contract.min_height_px)
    wanted = (contract.path, contract.format, least_px, picture.lab)
    if seen is None:
        raise faults.NoPicture(*wanted)
    if seen.format != contract.format:
        raise faults.NotAPicture(*wanted, seen.format or None)
    if seen.width < contract.min_width_px or seen.height < contract.min_height_px:
        raise faults.PictureTooSmall(*wanted, (seen.width, seen.height))
    if seen.colours < 2:
        raise faults.OneColour(*wanted)
