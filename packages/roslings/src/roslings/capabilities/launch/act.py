"""Experiments with a launch file: start it with our own `ros2 launch`, as the student would."""

from __future__ import annotations

import sys
import time
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager
from pathlib import Path

import ros2_on_pip
from ros2_on_pip.near_names import nearest
from roslings.arena import Process
from roslings.capabilities.launch.contract import LaunchContract
from roslings.capabilities.launch.graph import are_alike
from roslings.capabilities.launch.record import LABEL, UP, LaunchSeen, ProgramKilled
from roslings.capabilities.parameters.answering import RepeatedRequest, repeated_request
from roslings.course import NodeContract
from roslings.course.contract import Plain, as_typed
from roslings.experiment.running import COMES_UP_WITHIN_S
from roslings.experiment.scene import Scene
from roslings.experiment.timing import accounting

ROS2 = Path(ros2_on_pip.__file__).parent
NEXT_NODE_S = 4.0
"""A launch starts its nodes at once; so much later than the one before, none comes any more."""

CREW_ENDS_WITHIN_S = 8.0
"""The launch waits 5 s for its nodes before it becomes stern with them."""

BACK_WITHIN_S = 10.0
"""A node that was killed is not waited for any longer."""

TELLS_WITHIN_S = 20.0
LOOK_AGAIN_S = 0.2


@contextmanager
def launched(
    scene: Scene,
    package: str,
    contract: LaunchContract,
    given: Mapping[str, str] | None = None,
    namespaces: Sequence[str] | None = None,
) -> Iterator[Process]:
    """Launch the file, wait for its nodes; press Ctrl-C when the block ends.

    `given` are arguments of the file; nodes are waited for in `namespaces`, which are those of the
    card where nobody says so.
    """
    seen = scene.seen.recording(LaunchSeen)
    seen.given, seen.patience_s = dict(given or {}), NEXT_NODE_S
    spaces = [each.namespace for each in contract.namespaces] if namespaces is None else namespaces
    words = [f"{name}:={value}" for name, value in seen.given.items()]
    with ExitStack() as running:
        with scene.starting():
            process = running.enter_context(_started(scene, [package, contract.name, *words]))
            _wait_up(scene, process, package, len(contract.starts) * max(1, len(spaces)))
            with accounting(scene, UP):
                _wait_alike(scene, spaces)
        seen.running = dict(Counter(_programs(process, package).values()))
        yield process
        with scene.ending():
            process.interrupt(CREW_ENDS_WITHIN_S, and_children=True)


@contextmanager
def _started(scene: Scene, words: Sequence[str]) -> Iterator[Process]:
    """`ros2 launch` and these words, as one of the scene's processes."""
    command = [str(ROS2 / "start.py"), "launch", *words]
    with scene.arena.run(sys.executable, command, [ROS2]) as process:
        process.seen.executable = " ".join([LABEL, *words])
        scene.seen.processes[LABEL] = process.seen
        yield process


def _wait_up(scene: Scene, process: Process, package: str, count: int) -> None:
    """Until so many nodes are there, and as many as there are programs."""

    def all_there() -> bool:
        nodes = len(scene.seen.graph.nodes)
        return nodes >= count and nodes >= len(_programs(process, package))

    scene.until(lambda: bool(scene.seen.graph.nodes), COMES_UP_WITHIN_S)
    scene.appears(all_there, f"{count} nodes", NEXT_NODE_S)


def _wait_alike(scene: Scene, spaces: Sequence[str]) -> None:
    """Until the topics are there: as many in each namespace."""
    scene.appears(
        lambda: are_alike(scene.seen.graph, spaces), "one graph in each namespace", NEXT_NODE_S
    )


def ask_for_arguments(scene: Scene, package: str, contract: LaunchContract) -> None:
    """`ros2 launch --show-args`: what the file says of its arguments."""
    with _started(scene, ["--show-args", package, contract.name]) as process:
        scene.until_own(lambda: not process.alive, TELLS_WITHIN_S)


def values_file(
    scene: Scene, values: Mapping[str, Plain], by_name: Mapping[str, Mapping[str, Plain]]
) -> Path:
    """A parameter file that gives these values to every node, where the nodes can read it.

    `values` have names of the form EXECUTABLE.PARAMETER. After the section for every node comes one
    for each full name in `by_name`.
    """
    seen = scene.seen.recording(LaunchSeen)
    seen.values = dict(values)
    seen.by_name = {name: dict(each) for name, each in by_name.items()}
    for_all = {name.partition(".")[2]: value for name, value in values.items()}
    file = scene.arena.devices / "values.yaml"
    sections = [_section("/**", for_all), *(_section(*each) for each in by_name.items())]
    file.write_text("".join(sections), "utf-8")
    file.chmod(0o644)
    return file


def _section(nodes: str, values: Mapping[str, Plain]) -> str:
    lines = [f"    {name}: {as_typed(value)}\n" for name, value in values.items()]
    return "".join([f"{nodes}:\n  ros__parameters:\n", *lines])


def kill_and_await(
    scene: Scene, process: Process, package: str, nodes: Sequence[NodeContract]
) -> None:
    """Kill these nodes' programs, as a crash would, and wait until their nodes answer again."""
    executables = [node.executable for node in nodes]
    killed = [
        ProgramKilled(executable=node.executable, node=name, killed_ns=time.monotonic_ns())
        for node in nodes
        for name in _called_like(node, scene.seen.graph.nodes)
    ]
    for pid, program in _programs(process, package).items():
        if program in executables:
            process.kill(pid)
    scene.seen.recording(LaunchSeen).killed = killed
    with accounting(scene, "respawn"):
        _await_return(scene, killed)


def _called_like(node: NodeContract, names: Sequence[str]) -> list[str]:
    """The full names of a node in all namespaces, or of the one nearest to it."""
    near = nearest(node.node, names)
    plain = near.found.rpartition("/")[2] if near else ""
    return sorted({name for name in names if name.rpartition("/")[2] == plain})


def _await_return(scene: Scene, killed: Sequence[ProgramKilled]) -> None:
    """Ask each node again and again until it answers: who is dead stays in the graph for long."""
    with ExitStack() as stack:
        asked: list[RepeatedRequest] = [
            stack.enter_context(repeated_request(scene.probe, each.node)) for each in killed
        ]

        def all_back() -> bool:
            for each, answers in zip(killed, asked, strict=True):
                each.back_ns = each.back_ns or answers.first_ns(LOOK_AGAIN_S)
            return all(each.back_ns for each in killed)

        scene.until_own(all_back, BACK_WITHIN_S)


def _programs(process: Process, package: str) -> dict[int, str]:
    """Pid to the executable of the package that runs there."""
    found = {}
    for pid, words in process.commands().items():
        for word in words[:2]:  # itself, or behind its Python
            place = Path(word)
            if place.parent.name == package and place.parent.parent.name == "lib":
                found[pid] = place.name
    return found
