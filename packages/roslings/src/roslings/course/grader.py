"""How a grader declares an experiment, and how a grader's file is read."""

from __future__ import annotations

import importlib.util
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from types import ModuleType
from typing import Any, Literal, overload

from roslings.folders.lab_folders import take_beside

Clock = Literal["auto", "sim", "wall"]
"""Which clock rules: the simulated one, the wall's, or the simulated one where it is believed."""


@dataclass(frozen=True)
class Experiment:
    """A function that runs nodes and watches them.

    Its first parameter is the scene; the others name earlier experiments, whose evidence it gets.
    """

    name: str
    function: Callable[..., None]
    clock: Literal["auto", "wall"] = "wall"
    """`auto` where it makes sense in simulated time as well; most experiments do not."""
    unobserved: bool = False
    """Nothing of ours joins its domain; made only where the result is for others."""

    @property
    def about(self) -> str:
        """The first line of its docstring, for the student to read while it runs."""
        return (self.function.__doc__ or self.name).strip().splitlines()[0]

    @property
    def needs(self) -> tuple[str, ...]:
        """The earlier experiments whose evidence it asks for."""
        code = self.function.__code__
        return code.co_varnames[1 : code.co_argcount]


@overload
def experiment(function: Callable[..., None]) -> Experiment: ...
@overload
def experiment(
    *, clock: Literal["auto", "wall"] = "wall", unobserved: bool = False
) -> Callable[[Callable[..., None]], Experiment]: ...
def experiment(
    function: Callable[..., None] | None = None,
    *,
    clock: Literal["auto", "wall"] = "wall",
    unobserved: bool = False,
) -> Experiment | Callable[[Callable[..., None]], Experiment]:
    """Make a function of a grader's file an experiment.

    >>> @experiment(clock="auto")
    ... def talking(scene):
    ...     with scene.run(TALKER):
    ...         scene.watch(CHATTER)
    """

    def declare(function: Callable[..., None]) -> Experiment:
        return Experiment(function.__name__, function, clock, unobserved)

    return declare(function) if function else declare


def load_grader(path: Path) -> ModuleType:
    """Import a grader's file, once: the course's own code, never the student's.

    What it imports from `graders` is the folder that lies beside it.
    """
    take_beside(path)
    return _loaded(path, path.stat().st_mtime_ns)


@cache
def _loaded(path: Path, changed_ns: int) -> ModuleType:
    spec = importlib.util.spec_from_file_location(path.stem, path)
    if spec is None or spec.loader is None:
        raise FileNotFoundError(path)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def experiments_of(grader: Any) -> list[Experiment]:
    """The experiments of a grader, in the order of its file."""
    return [thing for thing in vars(grader).values() if isinstance(thing, Experiment)]
