"""When a package is handed in, its nodes run for as long as they will where it is graded.

A student's own check is quick, and so it watches them for some seconds only.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

from ros2_on_pip.language import said
from ros2_on_pip.safe_text import harmless
from roslings.arena import CannotStart, NoFreeDomain, NoFreeUser
from roslings.course import Lab
from roslings.evidence import Evidence, ProcessSeen
from roslings.experiment import MeasuringFailed, MeasuringOptions, measure
from roslings.experiment.soaking import SOAKING
from roslings.grading.checking import any_seed, mistakes_told
from roslings.judge.demands import lifetime_s
from roslings.judge.grader_mistakes import GraderBroke
from roslings.judge.words import end_of
from roslings.workspace.errors import WorkspaceError
from roslings.workspace.inspect import inspect_package

TROUBLE = (CannotStart, GraderBroke, MeasuringFailed, NoFreeDomain, NoFreeUser, WorkspaceError)


def left_running(
    lab: Lab, package: Path, for_s: float, on_step: Callable[[str], None]
) -> list[str]:
    """Build a package, let its nodes run for `for_s` seconds, and say in lines what came of it."""

    def tell(step: str) -> None:
        text = (
            "Your nodes run for {seconds:g} s, as they do where they are graded (Ctrl-C skips it)"
        )
        long = said("pack.running", text, seconds=for_s)
        on_step(long if step == SOAKING else step)

    try:
        files = inspect_package(package, lab.card)
        choices = MeasuringOptions(any_seed(), soak_s=for_s, only_soak=True)
        with mistakes_told(lab):
            evidence = measure(lab.name, package, files, choices, tell)
    except TROUBLE as trouble:
        return [
            said(
                "pack.not_run",
                "Your nodes could not be run here, so nobody has seen that they stay:",
            ),
            *str(trouble).splitlines(),
        ]
    return [*_told(lab, evidence)]


def _told(lab: Lab, evidence: Evidence) -> Iterator[str]:
    """What a student reads of it."""
    check = f"./roslings check {lab.name}"
    if evidence.soak is None or evidence.build is None:
        text = "Your nodes were not run: colcon does not build them. See: {command}"
        yield said("pack.not_built", text, command=check)
        return
    there, processes = evidence.build.executables, evidence.soak.processes
    for name, seen in processes.items():
        missing = said("pack.not_there", "{name} was not run: it is not there yet.", name=name)
        yield from _ended(seen) if name in there else [missing]
    if not all(name in there and _stayed(seen) for name, seen in processes.items()):
        mend = "Mend it, check it ({command}), and make the file again."
        yield said("pack.mend", mend, command=check)


def _stayed(seen: ProcessSeen) -> bool:
    return not seen.ended_by_itself


def _ended(seen: ProcessSeen) -> Iterator[str]:
    """How long it ran; of one that does not stay, its last words."""
    if _stayed(seen):
        ran = "{name} ran for {seconds:.0f} s, until Ctrl-C. So it must be."
        yield said("pack.ran", ran, name=seen.executable, seconds=lifetime_s(seen))
        return
    ended = (
        "{name} ended by itself after {seconds:.1f} s ({end})."
        " A robot's node runs until somebody stops it: that costs points."
    )
    name, end = seen.executable, end_of(seen)
    yield said("pack.ended", ended, name=name, seconds=lifetime_s(seen), end=end)
    if words := [line.plain for line in seen.lines if line.text.strip()]:
        last = said("pack.last_line", "Its last line: {line}", line=harmless(words[-1]))
        yield f"  {last}"
