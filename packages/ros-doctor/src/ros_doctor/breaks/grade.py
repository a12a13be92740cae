"""Grades a mend: with what the doctor's JSON says, and by looking that nothing was thrown away."""

from __future__ import annotations

import json
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from ros_doctor.breaks.exercises import Exercise
from ros_doctor.document import document
from ros_doctor.examine import examine
from ros_doctor.machine import ExaminedMachine
from ros_doctor.packages import WorkspacePackage, imported_packages, parse
from ros_doctor.registry import all_checks

MARK = "ROSLINGS_BREAK"  # set by the file that a student sources, so that we know the terminal
WELL = ("ok", "not applicable", "advice")


@dataclass(frozen=True)
class ExerciseGrade:
    """Is it mended? `reason` says in a sentence what is still wrong."""

    mended: bool
    reason: str = ""


def grade(exercise: Exercise, folder: Path, machine: ExaminedMachine) -> ExerciseGrade:
    """Grade the mend of one exercise."""
    if exercise.in_terminal:
        return _terminal(exercise, machine)
    lost = what_is_lost(folder)
    if lost:
        return ExerciseGrade(False, lost)
    theme = tuple(check.id for check in all_checks() if check.theme == "workspace")
    seen = doctor_json(replace(machine, workspace=folder), theme)
    return _judge(seen, exercise.checks, theme)


def _terminal(exercise: Exercise, machine: ExaminedMachine) -> ExerciseGrade:
    if machine.env.get(MARK) != str(exercise.number):
        return ExerciseGrade(
            False,
            "This terminal is not the injured one. Type the source command first,"
            " find the symptom, mend it, and check in the same terminal.",
        )
    return _judge(doctor_json(machine, exercise.checks), exercise.checks, ())


def doctor_json(machine: ExaminedMachine, ids: tuple[str, ...]) -> dict[str, Any]:
    """Return what `./roslings doctor --json --only ...` prints, read back."""
    checks = [check for check in all_checks() if check.id in ids]
    read: dict[str, Any] = json.loads(json.dumps(document(examine(machine, checks))))
    return read


def _judge(seen: dict[str, Any], wanted: tuple[str, ...], others: tuple[str, ...]) -> ExerciseGrade:
    for check in seen["checks"]:
        healed = check["status"] == "ok" if check["id"] in wanted else check["status"] in WELL
        if not healed and (check["id"] in wanted or check["id"] in others):
            return ExerciseGrade(False, check["found"])
    return ExerciseGrade(True)


def what_is_lost(folder: Path) -> str:
    """Return what the student threw away instead of mending it, or ""."""
    package = WorkspacePackage(folder / "src" / "greeter")
    for name in ("package.xml", "setup.py", "greeter/hello.py", "launch/greet.launch.xml"):
        if not (package.folder / name).exists():
            return f"The file src/greeter/{name} is gone. Mend it; do not delete it."
    points = (package.setup.entry_points if package.setup else None) or ()
    if "hello" not in {point.name for point in points}:
        return "setup.py has no program called hello any more."
    tree = parse(package.folder / "greeter/hello.py")
    if isinstance(tree, SyntaxError):
        return f"hello.py has an error in line {tree.lineno}: {tree.msg}."
    if not {"rclpy", "std_msgs"} <= imported_packages(tree):
        return "hello.py imports less than before. The mend is in another file."
    return ""
