"""A grader as a sheet of paper: its checks in order, without running one."""

from __future__ import annotations

import inspect
from dataclasses import dataclass
from typing import Any

from roslings.course import Lab
from roslings.experiment.declare import load_grader
from roslings.judge.check import check_of

PREFIX = "test_"


@dataclass(frozen=True)
class CheckLine:
    """One check: its name, the sentence that the student reads, and what it needs."""

    id: str
    title: str
    needs: tuple[str, ...]


def sheet(lab: Lab) -> list[CheckLine]:
    """The lab's checks, in the grader's order."""
    functions = vars(load_grader(lab.grader)).items()
    return [
        CheckLine(name.removeprefix(PREFIX), title_of(function), check_of(function).needs)
        for name, function in functions
        if name.startswith(PREFIX) and inspect.isfunction(function)
    ]


def title_of(function: Any) -> str:
    """The docstring's first line, with the grader's own names put in."""
    first: str = (function.__doc__ or function.__name__).strip().splitlines()[0]
    return first.format_map(function.__globals__)


def dependants(lab: Lab, failed: set[str]) -> set[str]:
    """The checks that cannot be judged when those in `failed` fail: their needs, and so on."""
    lines, found = sheet(lab), set[str]()
    while fresh := {line.id for line in lines if set(line.needs) & (failed | found)} - found:
        found |= fresh
    return found - failed
