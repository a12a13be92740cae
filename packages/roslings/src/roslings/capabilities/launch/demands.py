"""Demands on a launch file."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from itertools import pairwise

from ros2_on_pip.near_names import nearest
from ros2_on_pip.words import NOT_READ_HERE
from roslings.capabilities.launch import faults
from roslings.capabilities.launch.contract import (
    ArgumentContract,
    LaunchContract,
    NamespaceContract,
)
from roslings.capabilities.launch.graph import are_alike, graph_in, topics_outside
from roslings.capabilities.launch.reasons import (
    NothingLaunched,
    OnlyTheFullRos,
    SilentAboutParameters,
)
from roslings.capabilities.launch.record import LABEL, UP, LaunchSeen, ProgramKilled
from roslings.capabilities.parameters.record import ParametersSeen
from roslings.course import NodeContract
from roslings.course.contract import Plain, as_typed
from roslings.judge.demands import require_its_time, require_processors, require_steady
from roslings.judge.faults.moments import Awaited
from roslings.judge.faults.reasons import NothingSeen
from roslings.judge.faults.sentences import Text
from roslings.judge.views import Demand, ExperimentView, ProcessView
from roslings.judge.words import end_of
from roslings.seen.exits import is_late

SHOWN = re.compile(r"^ {4}'(?P<name>[^']+)':")
DEFAULT = re.compile(r"^\s+\(default: (?P<default>.*)\)\s*$")
Node = Callable[[str], NodeContract]
"""From the name of an executable to the card's node: `CARD.node`."""


def launch_of(experiment: ExperimentView) -> ProcessView:
    """The process of the launch. Raises NothingToJudge where there was none."""
    if LABEL not in experiment.seen.processes:
        raise NothingLaunched("nothing")
    return experiment.labelled(LABEL)


def start_all(names: Sequence[str]) -> Demand[ExperimentView]:
    """The launch runs on, and these nodes are in the graph."""

    def demand(experiment: ExperimentView) -> None:
        process = launch_of(experiment)
        there = tuple(experiment.seen.graph.nodes)
        run_on(experiment)
        for name in names:
            if name not in there:
                raise _missing(process, name, there)

    return demand


def _require_time_to_come(experiment: ExperimentView, what: Text) -> None:
    """Before it is held against the student that something is missing. Raises Inconclusive.

    On a busy computer, what is there shows in the graph as late as what is waited for.
    """
    require_steady(experiment.seen.stall_s)
    require_its_time(experiment.seen, UP, experiment.seen.part(LaunchSeen).patience_s, what)


def run_on(experiment: ExperimentView) -> None:
    """The launch did not end by itself before there was any node. Raises Inconclusive.

    So where the file asks for what only the full ROS has.

    >>> brought_up.must(run_on)
    """
    process = launch_of(experiment)
    log = process.last_lines()
    if process.seen.status == NOT_READ_HERE:
        raise _not_read(log)
    if process.seen.ended_by_itself and not experiment.seen.graph.nodes:
        raise faults.LaunchFailed(process.seen.executable, end_of(process.seen), log=log)


def _missing(process: ProcessView, name: str, there: tuple[str, ...]) -> faults.LaunchMissesNode:
    """Its namespace is wrong where another node of this name is there, and no such namespace."""
    space, _, plain = name.rpartition("/")
    elsewhere = any(each.rpartition("/")[2] == plain for each in there)
    in_it = any(each.startswith(f"{space}/") for each in there)
    kind = faults.NodeElsewhere if space and elsewhere and not in_it else faults.LaunchMissesNode
    end, log = end_of(process.seen), process.last_lines()
    return kind(process.seen.executable, end, name, there, log=log)


def _not_read(log: Sequence[str]) -> OnlyTheFullRos:
    said = [line.rpartition("[launch]: ")[2] for line in log if "needs the full ros2" in line]
    return OnlyTheFullRos(said[0] if said else "")


# --- the graph, namespace by namespace ---------------------------------------------------------


def start_in_each_namespace(
    contract: LaunchContract, *nodes: Sequence[str]
) -> Demand[ExperimentView]:
    """In each namespace of the card there is each node.

    Of each node come the names that it may have there. A launch file may name it as the card does,
    else it keeps the name of its code. The last one is missed where none is there.
    """

    def demand(experiment: ExperimentView) -> None:
        for space in contract.namespaces:
            for names in nodes:
                full = [f"{space.namespace}/{name.rpartition('/')[2]}" for name in names]
                there = [name for name in full if name in experiment.seen.graph.nodes]
                experiment.must(start_all(there or full[-1:]))

    return demand


def be_alike(contract: LaunchContract, *again: ExperimentView) -> Demand[ExperimentView]:
    """Each namespace holds the same nodes with the same topics, and each topic lies in it.

    `again` are other launches of the same file: who was seen to be alike once, is so.
    """
    spaces = [each.namespace for each in contract.namespaces]

    def demand(experiment: ExperimentView) -> None:
        graph = experiment.seen.graph
        if any(_hold_the_same(each, spaces) for each in again):
            return
        for space in spaces:
            for node, topic in topics_outside(graph, space):
                raise faults.TopicOutside(node, space, topic)
        for first, second in pairwise(spaces):
            one, other = graph_in(graph, first), graph_in(graph, second)
            if one != other:
                _require_time_to_come(experiment, Awaited("launch_topic"))
                alone = [
                    tuple(map(faults.PartOfGraph, sorted(each)))
                    for each in (one - other, other - one)
                ]
                raise faults.NamespacesDiffer(first, second, *alone)

    return demand


def _hold_the_same(experiment: ExperimentView, spaces: Sequence[str]) -> bool:
    """The nodes and topics of each namespace were seen, and nothing differs or lies outside."""
    graph = experiment.seen.graph
    outside = any(topics_outside(graph, space) for space in spaces)
    there = all(graph_in(graph, space) for space in spaces)
    return there and not outside and are_alike(graph, spaces)


def leave_out(contract: LaunchContract, argument: str) -> Demand[ExperimentView]:
    """The launch got `false` for this argument: what it belongs to is not there, all else is."""

    def demand(experiment: ExperimentView) -> None:
        run_on(experiment)
        process = launch_of(experiment)
        there = tuple(sorted(set(experiment.seen.graph.nodes)))
        for space in contract.namespaces:
            inside = tuple(name for name in there if name.startswith(f"{space.namespace}/"))
            if space.only_with == argument and inside:
                raise faults.StartedAllTheSame(process.seen.executable, inside)
            if space.only_with != argument and not inside:
                raise _missing(process, f"{space.namespace}/...", there)
        _insist_on_no_more(experiment, process, contract, argument)

    return demand


def _insist_on_no_more(
    experiment: ExperimentView, process: ProcessView, contract: LaunchContract, argument: str
) -> None:
    """Of each program as many run as there are namespaces left, whatever shows in the graph."""
    most = sum(each.only_with != argument for each in contract.namespaces)
    running = experiment.seen.part(LaunchSeen).running
    more = tuple(faults.Times(name, n) for name, n in sorted(running.items()) if n > most)
    if more:
        raise faults.StartedAllTheSame(process.seen.executable, more)


# --- values ------------------------------------------------------------------------------------


def give_its_values(contract: LaunchContract, node: Node) -> Demand[ExperimentView]:
    """In each namespace, the parameters are what the card says."""

    def demand(experiment: ExperimentView) -> None:
        for space in contract.namespaces:
            for name, value in space.values.items():
                _insist_on_value(experiment, space, name, value, node, faults.WrongValueAfterLaunch)

    return demand


def follow_the_file(contract: LaunchContract, node: Node) -> Demand[ExperimentView]:
    """In each namespace, the parameters are what the file says that the launch was given.

    Those are left out that an argument sets as well: the argument wins.
    """
    won = {each.sets for each in contract.arguments}

    def demand(experiment: ExperimentView) -> None:
        values = experiment.seen.part(LaunchSeen).values
        if not values:
            raise NothingLaunched("no_file")
        for space in contract.namespaces:
            for name in (each for each in values if each not in won):
                _insist_on_value(experiment, space, name, values[name], node, faults.FileIgnored)

    return demand


def follow_the_argument(
    contract: LaunchContract, argument: ArgumentContract, node: Node
) -> Demand[ExperimentView]:
    """In each namespace, the parameter that the argument sets has the value that it was given.

    Left out are namespaces for whose nodes the file has sections of their own.

    >>> otherwise.must(follow_the_argument(LAUNCH, CAREFUL, CARD.node))
    """
    return _obeyed(contract, argument, node, False, faults.ArgumentIgnored)


def win_over_its_section(
    contract: LaunchContract, argument: ArgumentContract, node: Node
) -> Demand[ExperimentView]:
    """The same of the namespaces that `follow_the_argument` leaves out.

    To be asked after it: where only these are wrong, it is the section that has won.

    >>> otherwise.must(win_over_its_section(LAUNCH, CAREFUL, CARD.node))
    """
    return _obeyed(contract, argument, node, True, faults.SectionOfTheNodeWins)


def _obeyed(
    contract: LaunchContract,
    argument: ArgumentContract,
    node: Node,
    has_section: bool,
    kind: type[faults.ArgumentIgnored],
) -> Demand[ExperimentView]:
    def demand(experiment: ExperimentView) -> None:
        seen = experiment.seen.part(LaunchSeen)
        value = seen.given.get(argument.name, argument.default)
        for space in contract.namespaces:
            named = any(full.startswith(f"{space.namespace}/") for full in seen.by_name)
            if named is has_section:
                _insist_on_value(experiment, space, argument.sets or "", value, node, kind)

    return demand


def _insist_on_value(
    experiment: ExperimentView,
    space: NamespaceContract,
    name: str,
    wanted: Plain,
    node: Node,
    kind: type[faults.WrongValueAfterLaunch],
) -> None:
    executable, _, parameter = name.partition(".")
    where, values = _values_of(experiment, space.namespace, node(executable))
    found = values.get(parameter)
    if as_said(found) != as_said(wanted):
        command = launch_of(experiment).seen.executable
        there = None if found is None else as_said(found)
        raise kind(command, where, parameter, as_said(wanted), there)


def _values_of(
    experiment: ExperimentView, namespace: str, node: NodeContract
) -> tuple[str, Mapping[str, Plain | None]]:
    """The node of this kind in the namespace, and its parameters.

    Raises NothingToJudge where no node is there, Inconclusive where it gave no answer.
    """
    read = {each.node: each.values for each in experiment.seen.part(ParametersSeen).read}
    plain = node.node.rpartition("/")[2]
    there = [each for each in experiment.seen.graph.nodes if each.startswith(f"{namespace}/")]
    near = nearest(f"{namespace}/{plain}", there)
    if near is None:
        raise NothingLaunched("no_node", namespace)
    if near.found not in read:
        raise SilentAboutParameters(near.found)
    return near.found, read[near.found]


def as_said(value: Plain | None) -> str:
    """A value as people write it, whatever its type: 10 and 10.0 are one."""
    if value is None:
        return "not there"
    if isinstance(value, float):
        return f"{value:.6g}"
    return as_typed(value)


# --- arguments ---------------------------------------------------------------------------------


def show_its_arguments(contract: LaunchContract) -> Demand[ExperimentView]:
    """`--show-args` tells each argument of the card, with its default."""

    def demand(experiment: ExperimentView) -> None:
        process = launch_of(experiment)
        if process.seen.status == NOT_READ_HERE:
            raise _not_read(process.last_lines())
        if process.seen.status != 0:
            end, log = end_of(process.seen), process.last_lines()
            raise faults.ArgumentsNotShown(process.seen.executable, end, log=log)
        there = dict(shown_arguments([line.text for line in process.lines]))
        for argument in contract.arguments:
            if not _is_default(argument.default, there.get(argument.name)):
                wanted = f"{argument.name} (default: {argument.default})"
                found = tuple(f"{name} (default: {value})" for name, value in there.items())
                raise faults.WrongArguments(process.seen.executable, wanted, found)

    return demand


def shown_arguments(lines: Sequence[str]) -> Iterator[tuple[str, str]]:
    """Name and default of each argument that `--show-args` tells; `none` where it has none."""
    name, default = "", "none"
    for line in lines:
        if found := SHOWN.match(line):
            if name:
                yield name, default
            name, default = found["name"], "none"
        elif found := DEFAULT.match(line):
            default = found["default"]
    if name:
        yield name, default


def _is_default(wanted: str, shown: str | None) -> bool:
    """The very text; of a path, its parts in their order, however they are put together."""
    if shown is None:
        return False
    if "/" in wanted:
        parts = [re.escape(part) for part in wanted.split("/")]
        return re.search(r"\b" + r"\b.*\b".join(parts) + r"\b", shown) is not None
    return shown.strip("'\"").lower() == wanted.lower()


# --- what comes back, and what ends ------------------------------------------------------------


def come_back(contract: LaunchContract) -> Demand[ExperimentView]:
    """Each program of the card that was killed answers again in time."""

    def demand(experiment: ExperimentView) -> None:
        run_on(experiment)
        seen = experiment.seen.part(LaunchSeen)
        for executable in contract.respawns:
            killed = [each for each in seen.killed if each.executable == executable]
            if not killed or executable not in seen.running:
                raise faults.NothingToKill(executable, tuple(sorted(seen.running)))
            for each in killed:
                _insist_on_return(experiment, each, contract.respawns_within_s)

    return demand


def _insist_on_return(experiment: ExperimentView, each: ProgramKilled, within_s: float) -> None:
    after_s = each.back_after_s
    if after_s is not None and after_s <= within_s:
        return
    late_s = None if after_s is None else after_s - within_s
    require_steady(experiment.seen.stall_s)
    require_its_time(experiment.seen, "respawn", late_s, each.node)
    raise faults.NotBack(each.node, within_s, after_s)


def end_as_a_whole(limit_s: float) -> Demand[ExperimentView]:
    """After Ctrl-C the launch ends in time, and nothing that it has started outlives it."""

    def demand(experiment: ExperimentView) -> None:
        run_on(experiment)
        process = launch_of(experiment)
        seen = process.seen
        if seen.ending is None:
            raise NothingSeen("end")
        if is_late(seen, limit_s):
            require_steady(experiment.seen.stall_s)
            require_processors(seen.executable, seen.ending, limit_s)
            raise faults.LaunchDoesNotEnd(seen.executable, 0, limit_s, seen.ending.own_s)
        if seen.left_behind:
            raise faults.LeftByTheLaunch(seen.executable, seen.left_behind)

    return demand
