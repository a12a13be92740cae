"""Names that a grader's functions use and that nothing defines, told before any of them runs.

Python looks for such a name only when its line runs. In an experiment that is after a build. In a
check it may be never, until a student's package leads there.
"""

from __future__ import annotations

import builtins
import dis
from collections.abc import Iterator
from pathlib import Path
from types import CodeType, FunctionType, ModuleType

from roslings.course.grader import Experiment
from roslings.judge.grader_mistakes import GraderMistake

LOOKS_UP = ("LOAD_GLOBAL", "LOAD_NAME")


def undefined_names(grader: ModuleType) -> Iterator[GraderMistake]:
    """Each, with the line where it is used."""
    for function in _functions(grader):
        known = {*vars(grader), *vars(builtins)}
        yield from _in(function.__code__, known, Path(function.__code__.co_filename))


def _functions(grader: ModuleType) -> Iterator[FunctionType]:
    """Those that are written in its own file."""
    for thing in vars(grader).values():
        function = thing.function if isinstance(thing, Experiment) else thing
        if isinstance(function, FunctionType) and function.__globals__ is vars(grader):
            yield function


def _in(code: CodeType, known: set[str], file: Path) -> Iterator[GraderMistake]:
    """In a function, and in those inside of it."""
    for line, name in _looked_up(code):
        if name not in known:
            words = f"NameError: name {name!r} is not defined"
            yield GraderMistake(file, line, words, code.co_name)
    for each in code.co_consts:
        if isinstance(each, CodeType):
            yield from _in(each, known, file)


def _looked_up(code: CodeType) -> Iterator[tuple[int, str]]:
    """Line and name of what is looked for outside of the function; each once a line."""
    starts = dict(dis.findlinestarts(code))
    line, seen = code.co_firstlineno, set[tuple[int, str]]()
    for each in dis.get_instructions(code):
        line = starts.get(each.offset) or line
        found = (line, str(each.argval))
        if each.opname in LOOKS_UP and found not in seen:
            seen.add(found)
            yield found
