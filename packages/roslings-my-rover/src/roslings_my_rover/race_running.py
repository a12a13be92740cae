"""Run the race: the student's launch file starts the limiters and beacons of both rovers."""

from __future__ import annotations

import sys
import threading
from collections.abc import Iterator, Mapping
from contextlib import ExitStack, contextmanager
from pathlib import Path

from ros2_on_pip.errors import RoslingsError
from roslings.arena import Launch, Process
from roslings.commands.invocation import program
from roslings.experiment.run_folder import run_folder
from roslings.report.progress import ProgressLine
from roslings_my_rover.assembled import environment
from roslings_my_rover.chosen import ChosenPart, ChosenParts
from roslings_my_rover.crew import EndedPart
from roslings_my_rover.installing import BuiltPart, build_all
from roslings_my_rover.parts import LIMITER
from roslings_my_rover.race import Race
from roslings_my_rover.race_nodes import RaceNode
from roslings_my_rover.race_view import opened, where
from roslings_rover.rover.map_display import Display, View, shown_until
from roslings_rover.stop_signal import listening

LAUNCH_FILE = "bring_up.launch.py"
"""As the card of day 8 calls it."""
ALL_END_WITHIN_S = 8.0
"""A launch waits 5 s for its nodes before it becomes stern with them."""


class NoLaunchFile(RoslingsError):
    """Nothing starts two rovers."""

    def __init__(self) -> None:
        super().__init__(
            "The race needs your launch file of day 8, and your package is not there yet.\n"
            f"Begin with its lab: {program()} start {LIMITER.lab}"
        )


class CannotRace(RoslingsError):
    """The package of day 8 is there, and cannot be started."""

    def __init__(self, because: str) -> None:
        super().__init__(f"{because}\nAsk the check: {program()} check {LIMITER.lab}")


def run(choice: ChosenParts, view: View, seed: int = 0) -> Race:
    """Run the race until Ctrl-C; returns it as it then is.

    Raises NoLaunchFile, CannotRace and NoWindow.
    """
    chosen = _chosen(choice)
    with ExitStack() as stack:
        home = stack.enter_context(run_folder())
        built = _built(chosen, home)
        node = stack.enter_context(RaceNode(Race(seed)))
        asked = stack.enter_context(listening())
        process = stack.enter_context(_launched(built, environment(home), home))
        display = stack.enter_context(opened(view, node))
        _go_on(node, process, display, asked)
    _tell(node)
    return node.race


def _chosen(choice: ChosenParts) -> ChosenPart:
    found = next((each for each in choice.there if each.part is LIMITER), None)
    if found is None:
        raise NoLaunchFile
    return found


def _built(chosen: ChosenPart, home: Path) -> BuiltPart:
    with ProgressLine() as progress:
        built, broken = build_all([chosen], home, progress.step)
    if broken:
        raise CannotRace(broken[0].line)
    return built[0]


@contextmanager
def _launched(built: BuiltPart, about_ros: Mapping[str, str], home: Path) -> Iterator[Process]:
    """The student's launch file, until the block ends; then Ctrl-C for it and its nodes."""
    words = ["launch", built.chosen.lab.outline.package, LAUNCH_FILE]
    command = [sys.executable, "-m", "ros2_on_pip", *words]
    everything = {**built.installed.environment, **about_ros}
    with Process("launch", Launch(command, everything, home, namespaces=False)) as process:
        yield process
        process.interrupt(ALL_END_WITHIN_S, and_children=True)


def _go_on(
    node: RaceNode, process: Process, display: Display[RaceNode], asked: threading.Event
) -> None:
    def turn() -> None:
        node.turn()
        if not (process.alive or node.ended):
            node.ended = _ended(process)

    shown_until(asked, display, node, turn)


def _ended(process: Process) -> str:
    lines = [line.text for line in process.lines() if line.text.strip()]
    return EndedPart(LIMITER, LAUNCH_FILE, lines[-1] if lines else "").line


def _tell(node: RaceNode) -> None:
    """What one reads when the map is gone."""
    print(f"\n{node.told}")
    for rover in node.rovers:
        print(f"{where(rover)}. It went {rover.rover.way_m:.2f} m.")
