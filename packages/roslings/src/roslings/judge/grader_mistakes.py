"""Where a grader itself is wrong: file, line, Python's words, and the next step of who reads it.

A grader is a program, and its author makes mistakes in it as students do in theirs. What breaks off
in an experiment is told by another process, as text. What cannot be loaded, and what breaks off in
a check, is an exception of this one.
"""

from __future__ import annotations

import inspect
import linecache
import re
import traceback
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType
from typing import Any

from ros2_on_pip.errors import INCONCLUSIVE
from roslings.course import Lab, root
from roslings.course.files import CourseError
from roslings.course.grader import Experiment, experiments_of, load_grader
from roslings.folders.lab_folders import folder_beside

FRAME = re.compile(r'\s*File "(?P<file>.+)", line (?P<line>\d+)(?:, in (?P<within>.+))?')
"""A line of a traceback, as Python writes it; a syntax error is within nothing."""
OF_A_CHECK = ("package",)
"""What a check may ask for besides its experiments."""
NEXT_STEP = (
    "Nothing is said of the package. Who writes the lab mends this line, and types the same\n"
    "command again. Who does the lab tells the instructor."
)


class BadGrader(CourseError):
    """A grader's file cannot be used; the course's fault."""


class GraderBroke(BadGrader):
    """A grader broke off by a mistake of its own."""

    exit_status = INCONCLUSIVE

    def __init__(self, told: str, in_short: str = "") -> None:
        """`in_short` says on one line where it is, and what Python says."""
        self.in_short = in_short
        super().__init__(told)


@dataclass(frozen=True)
class GraderMistake:
    """The line of a grader at which it broke off, and why."""

    file: Path
    line: int
    words: str
    """Python's, e.g. `NameError: name 'GREAT' is not defined`."""
    within: str = ""
    """The function; empty outside of one."""
    raised: str = ""
    """Where it was raised, where that is not this line but what this line called."""

    @property
    def place(self) -> str:
        """File and line, as an editor opens them."""
        here = root()
        inside = self.file.is_relative_to(here)
        return f"{self.file.relative_to(here) if inside else self.file.name}:{self.line}"

    @property
    def in_short(self) -> str:
        """On one line."""
        return f"{self.place}: {self.words}{f' (raised in {self.raised})' if self.raised else ''}"

    @property
    def told(self) -> str:
        """Whole: the line itself, Python's words, and the next step."""
        within = f", in {self.within}" if self.within else ""
        what = "The grader broke off" if self.raised else "The grader has a mistake"
        code = linecache.getline(str(self.file), self.line).strip()
        raised = f"  (raised in {self.raised})" if self.raised else ""
        lines = [
            f"{what}: {self.place}{within}",
            f"    {code}" if code else "",
            f"{self.words}{raised}",
            NEXT_STEP,
        ]
        return "\n".join(filter(None, lines))

    @property
    def error(self) -> GraderBroke:
        """To be raised."""
        return GraderBroke(self.told, self.in_short)


# --- what an exception tells, and what a text tells --------------------------------------------


def mistake_of(error: BaseException, graders: Sequence[Path]) -> GraderMistake | None:
    """The innermost line of these graders that it came through; None where it came through none."""
    words = "".join(traceback.format_exception_only(error)).strip()
    if isinstance(error, SyntaxError) and error.filename:
        *_, words = words.splitlines()
        file = Path(error.filename)
        return GraderMistake(file, error.lineno or 1, words) if _is_of(file, graders) else None
    frames = [
        _Frame(Path(each.filename), each.lineno or 1, each.name)
        for each in traceback.extract_tb(error.__traceback__)
    ]
    return _innermost(frames, words, graders)


def mistake_in(text: str, graders: Sequence[Path]) -> GraderMistake | None:
    """The same of a traceback that another process wrote."""
    lines = text.splitlines()
    found = [
        (number, match) for number, line in enumerate(lines) if (match := FRAME.fullmatch(line))
    ]
    if not found:
        return None
    last, _ = found[-1]
    words = next((line for line in lines[last + 1 :] if line and not line.startswith(" ")), "")
    frames = [
        _Frame(Path(match["file"]), int(match["line"]), match["within"] or "<module>")
        for _, match in found
    ]
    return _innermost(frames, words, graders)


@dataclass(frozen=True)
class _Frame:
    file: Path
    line: int
    within: str


def _innermost(
    frames: Sequence[_Frame], words: str, graders: Sequence[Path]
) -> GraderMistake | None:
    own = next((each for each in reversed(frames) if _is_of(each.file, graders)), None)
    if own is None:
        return None
    within = "" if own.within == "<module>" else own.within
    deepest = frames[-1]
    raised = "" if deepest is own or _is_pythons(deepest.file) else _raised_in(deepest)
    return GraderMistake(own.file, own.line, words, within, raised)


def _is_of(file: Path, graders: Sequence[Path]) -> bool:
    """One of them, or what a lab has beside its own: `graders/e_stop/` of `grade_e_stop.py`."""
    folders = (folder_beside(each).resolve() for each in graders)
    return file in graders or any(file.resolve().is_relative_to(folder) for folder in folders)


def _is_pythons(file: Path) -> bool:
    """Python's own importing, through which each module comes that is not there."""
    return str(file).startswith("<frozen ")


def _raised_in(frame: _Frame) -> str:
    """Short: folder, file and line, whatever machine this is."""
    return f"{'/'.join(frame.file.parts[-2:])}:{frame.line}"


# --- what can be told without running it -------------------------------------------------------


def load_or_tell(grader: Path) -> ModuleType:
    """Import a grader's file. Raises GraderBroke where Python cannot."""
    try:
        return load_grader(grader)
    except Exception as error:
        found = mistake_of(error, [grader])
        raise (found.error if found else error) from error


def why_it_broke_off(lab: Lab, words: str) -> GraderBroke | None:
    """What a lab's grader did wrong where a measuring process ended with these words.

    None where it was not the grader.
    """
    if found := mistake_in(words, lab.graders):
        return found.error
    try:
        asked = [each for file in lab.graders for each in asked_for_nothing(load_or_tell(file))]
    except GraderBroke as error:
        return error
    return asked[0].error if asked else None


def asked_for_nothing(grader: Any) -> Iterator[GraderMistake]:
    """Each experiment and check that asks for an experiment which is not there, or not yet."""
    known: list[str] = []
    for each in experiments_of(grader):
        yield from (_asks(each, name, known) for name in each.needs if name not in known)
        known.append(each.name)
    there = [*OF_A_CHECK, *known]
    for name, function in vars(grader).items():
        if name.startswith("test_") and inspect.isfunction(function):
            asked = inspect.signature(function).parameters
            yield from (
                nothing_called(word, function, there) for word in asked if word not in there
            )


def _asks(each: Experiment, name: str, known: Sequence[str]) -> GraderMistake:
    return nothing_called(name, each.function, known, "no experiment before it")


def nothing_called(
    name: str, function: Any, there: Sequence[str], nothing: str = "no experiment"
) -> GraderMistake:
    """A function that asks for `name`, where only those of `there` can be asked for."""
    code = function.__code__
    words = f"it asks for {name!r}, and {nothing} is called so. There are: "
    names = ", ".join(there) or "none"
    return GraderMistake(Path(code.co_filename), _head_of(code), words + names, code.co_name)


def _head_of(code: Any) -> int:
    """The line of `def`; Python counts a function from its first decorator on."""
    lines = linecache.getlines(code.co_filename)[code.co_firstlineno - 1 :]
    heads = (number for number, line in enumerate(lines) if line.lstrip().startswith("def "))
    return int(code.co_firstlineno + next(heads, 0))
