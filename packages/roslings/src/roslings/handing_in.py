"""When a package is handed in, its nodes run for as long as they will where it is graded.

A student's own check is quick, and so it watches them for some seconds only.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

from ros2_on_pip.safe_text import harmless
from roslings.arena import CannotStart, NoFreeDomain, NoFreeUser
from roslings.checking import any_seed, mistakes_told
from roslings.course import Lab
from roslings.evidence import Evidence, ProcessSeen
from roslings.experiment import Choices, MeasuringFailed, measure
from roslings.experiment.soaking import SOAKING
from roslings.judge.demands import lifetime_s
from roslings.judge.grader_mistakes import GraderBroke
from roslings.judge.words import describe_end
from roslings.workspace.errors import WorkspaceError
from roslings.workspace.inspect import inspect_package

TROUBLE = (CannotStart, GraderBroke, MeasuringFailed, NoFreeDomain, NoFreeUser, WorkspaceError)


def left_running(
    lab: Lab, package: Path, for_s: float, on_step: Callable[[str], None]
) -> list[str]:
    """Build a package, let its nodes run for `for_s` seconds, and say in lines what came of it."""

    def tell(step: str) -> None:
        long = f"Your nodes run for {for_s:g} s, as they do where they are graded (Ctrl-C skips it)"
        on_step(long if step == SOAKING else step)

    try:
        files = inspect_package(package, lab.card)
        choices = Choices(any_seed(), soak_s=for_s, only_soak=True)
        with mistakes_told(lab):
            evidence = measure(lab.name, package, files, choices, tell)
    except TROUBLE as trouble:
        return [
            "Your nodes could not be run here, so nobody has seen that they stay:",
            *str(trouble).splitlines(),
        ]
    return [*_told(lab, evidence)]


def _told(lab: Lab, evidence: Evidence) -> Iterator[str]:
    """What a student reads of it."""
    check = f"./roslings check {lab.name}"
    if evidence.soak is None or evidence.build is None:
        yield f"Your nodes were not run: colcon does not build them. See: {check}"
        return
    there, processes = evidence.build.executables, evidence.soak.processes
    for name, seen in processes.items():
        yield from _ended(seen) if name in there else [f"{name} was not run: it is not there yet."]
    if not all(name in there and _stayed(seen) for name, seen in processes.items()):
        yield f"Mend it, check it ({check}), and make the file again."


def _stayed(seen: ProcessSeen) -> bool:
    return not seen.ended_by_itself


def _ended(seen: ProcessSeen) -> Iterator[str]:
    """How long it ran; of one that does not stay, its last words."""
    if _stayed(seen):
        yield f"{seen.executable} ran for {lifetime_s(seen):.0f} s, until Ctrl-C. So it must be."
        return
    yield (
        f"{seen.executable} ended by itself after {lifetime_s(seen):.1f} s ({describe_end(seen)})."
        " A robot's node runs until somebody stops it: that costs points."
    )
    if words := [line.plain for line in seen.lines if line.text.strip()]:
        yield f"  Its last line: {harmless(words[-1])}"
