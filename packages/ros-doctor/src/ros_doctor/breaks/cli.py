"""`./roslings break N`; `ros-doctor break N` without the course.

Exit codes: 0 done or mended, 1 not mended, 2 wrong use.
"""

from __future__ import annotations

import argparse
import os
import shutil
import sys
import textwrap
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import NoReturn

from ros_doctor import usage
from ros_doctor.breaks.exercises import EXERCISES, Exercise
from ros_doctor.breaks.grade import MARK, grade
from ros_doctor.breaks.injuries import (
    HEALTHY,
    CopyBuildFailed,
    NoColcon,
    change_after_build,
)
from ros_doctor.machine import ExaminedMachine, this_machine
from ros_doctor.mends import quoted

DONE, NOT_MENDED, WRONG_USE = 0, 1, 2
WIDTH = 79


class WrongUseOfBreak(Exception):
    """The command was typed wrongly, or cannot work here; the message says what to type."""


def main(argv: Sequence[str] | None = None) -> int:
    """Break a copy, or grade a mend; return the exit code."""
    try:
        return _run(_parser().parse_args(argv), this_machine())
    except WrongUseOfBreak as problem:
        print(f"{_program()}: {problem}", file=sys.stderr)
        return WRONG_USE
    except KeyboardInterrupt:
        return 130


class _Parser(argparse.ArgumentParser):
    def error(self, message: str) -> NoReturn:
        raise WrongUseOfBreak(f"{message}. Type {_exercises()} --list to see the exercises.")


def _parser() -> argparse.ArgumentParser:
    parser = _Parser(
        prog=_program(),
        description="Breaks a copy of a small workspace, or one terminal. You find out why and"
        " mend it. Your own workspace is never touched.",
        allow_abbrev=False,
    )
    parser.add_argument("number", type=int, nargs="?", help="the exercise, 1 to 10")
    parser.add_argument("--check", action="store_true", help="is it mended?")
    parser.add_argument("--list", action="store_true", help="list the exercises")
    return parser


def _run(words: argparse.Namespace, machine: ExaminedMachine) -> int:
    if words.list or words.number is None:
        for exercise in EXERCISES:
            print(f"{exercise.number:>3}  {exercise.title}")
        print(f"\nBegin with:  {_exercises()} 1")
        return DONE
    exercise = _numbered(words.number)
    folder = home_of_breaks(machine) / f"{exercise.number}-{exercise.name}"
    return _check(exercise, folder, machine) if words.check else _begin(exercise, folder, machine)


def _numbered(number: int) -> Exercise:
    if not 1 <= number <= len(EXERCISES):
        raise WrongUseOfBreak(f"there is no exercise {number}. They go from 1 to {len(EXERCISES)}.")
    return EXERCISES[number - 1]


def home_of_breaks(machine: ExaminedMachine) -> Path:
    """Return the folder of all exercises: ROSLINGS_BREAKS, or `~/roslings_breaks`."""
    named = machine.env.get("ROSLINGS_BREAKS", "")
    return Path(os.path.abspath(named)) if named else machine.home / "roslings_breaks"  # noqa: PTH100


def _program() -> str:
    return _exercises().removeprefix("./")


def _exercises() -> str:
    return usage.exercises(this_machine())


def _doctor() -> str:
    return usage.doctor(this_machine())


def _begin(exercise: Exercise, folder: Path, machine: ExaminedMachine) -> int:
    if folder.exists():
        print(f"Exercise {exercise.number} is there already. Nothing was changed.")
        print(f"To begin it anew, remove it first:  rm -r {quoted(folder)}\n")
    else:
        _injure(exercise, folder, machine)
    print("\n".join(task_lines(exercise, folder, machine)))
    return DONE


def _injure(exercise: Exercise, folder: Path, machine: ExaminedMachine) -> None:
    """Make the broken copy beside its place, and move it there when it is whole."""
    draft = folder.with_name(f".{folder.name}.{os.getpid()}")
    try:
        if exercise.in_terminal:
            draft.mkdir(parents=True)
            (draft / "injure.sh").write_text(_script(exercise), encoding="utf-8")
        else:
            shutil.copytree(HEALTHY, draft, ignore=shutil.ignore_patterns("__pycache__"))
            if exercise.injure:
                exercise.injure(draft)
        draft.rename(folder)
        if exercise.builds:  # a build keeps the paths it was made with
            change_after_build(folder, machine)
    except (NoColcon, CopyBuildFailed, OSError) as problem:
        shutil.rmtree(folder if exercise.builds else draft, ignore_errors=True)
        raise WrongUseOfBreak(_why_not(problem, folder)) from problem
    finally:
        shutil.rmtree(draft, ignore_errors=True)


def _why_not(problem: Exception, folder: Path) -> str:
    if isinstance(problem, NoColcon):
        return f"this exercise needs colcon. See {_doctor()} --explain colcon"
    if isinstance(problem, CopyBuildFailed):
        return f"colcon could not build the copy. See {_doctor()}. It said:\n{problem}"
    reason = problem.strerror if isinstance(problem, OSError) else problem
    return f"{folder} cannot be written ({reason}). Set ROSLINGS_BREAKS to another folder."


def _script(exercise: Exercise) -> str:
    lines = ["# Source this file: it breaks only the terminal in which you do.", ""]
    lines += [f"export {name}={value}" for name, value in exercise.variables]
    return "\n".join([*lines, f"export {MARK}={exercise.number}", ""])


def task_lines(exercise: Exercise, folder: Path, machine: ExaminedMachine) -> Iterator[str]:
    """Yield the task as the student reads it."""
    course = quoted(machine.clone / "roslings")
    here = f"{course} doctor" if machine.has_course else "ros-doctor"
    again = f"{course} break" if machine.has_course else "ros-doctor break"
    yield f"Exercise {exercise.number}: {exercise.title}"
    yield ""
    if exercise.in_terminal:
        yield "One terminal will be broken. Close it when you have finished."
        commands = (f"source {quoted(folder / 'injure.sh')}", *exercise.commands)
    else:
        yield "A copy of a small workspace is broken. Your own workspace is untouched."
        commands = (f"cd {quoted(folder)}", *exercise.commands)
    yield ""
    yield "  1. Type this in a new terminal where ROS is ready:"
    yield from (f"       {command}" for command in commands)
    yield from textwrap.wrap(
        f"  2. {exercise.look_for}", WIDTH, subsequent_indent="     ", break_on_hyphens=False
    )
    yield "  3. Mend it. The doctor helps:"
    doctor = f"       {here} --only {' '.join(exercise.checks)}"
    if exercise.in_terminal:
        yield doctor
    else:
        yield f"{doctor} \\"
        yield f"         --workspace {quoted(folder)}"
    same = ", in the same terminal" if exercise.in_terminal else ""
    yield f"  4. Check your mend{same}:"
    yield f"       {again} {exercise.number} --check"


def _check(exercise: Exercise, folder: Path, machine: ExaminedMachine) -> int:
    if not folder.exists():
        raise WrongUseOfBreak(
            f"exercise {exercise.number} has not begun. Type {_exercises()} {exercise.number}"
        )
    result = grade(exercise, folder, machine)
    if result.mended:
        said = f"Exercise {exercise.number} is mended. {exercise.learned}"
    else:
        said = f"Not mended yet. {result.reason}"
    print(textwrap.fill(said, WIDTH, break_on_hyphens=False, break_long_words=False))
    return DONE if result.mended else NOT_MENDED
