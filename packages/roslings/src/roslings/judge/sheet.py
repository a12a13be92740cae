"""A grader as a sheet of paper: its checks in order, without running one."""

from __future__ import annotations

import inspect
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from ros2_on_pip.language import template
from roslings.course import Lab
from roslings.course.grader import load_grader
from roslings.folders.lab_folders import GRADER
from roslings.judge.check import check_of

PREFIX = "test_"


@dataclass(frozen=True)
class CheckLine:
    """One check: its name, the sentence that the student reads, and what it needs."""

    id: str
    title: str
    needs: tuple[str, ...]
    explained_by: Mapping[str, tuple[str, ...]]
    """Earlier checks to the faults there that are the same mistake."""


def sheet(lab: Lab) -> list[CheckLine]:
    """The lab's checks, in the grader's order."""
    functions = vars(load_grader(lab.grader)).items()
    return [
        _line(name.removeprefix(PREFIX), function)
        for name, function in functions
        if name.startswith(PREFIX) and inspect.isfunction(function)
    ]


def _line(name: str, function: Any) -> CheckLine:
    said = check_of(function)
    return CheckLine(name, title_of(function), said.needs, said.explained_by)


def title_of(function: Any) -> str:
    """The docstring's first line, with the grader's own names put in."""
    found = template(title_id(function), english_title(function))
    return found.format_map(function.__globals__)


def title_id(function: Any) -> str:
    """The id of a check's title: `graders.e_stop.runs`, of `test_runs` in `grade_e_stop.py`.

    One that several graders share is `checks.depends`.
    """
    module, name = function.__module__.rpartition(".")[2], function.__name__.removeprefix(PREFIX)
    if module.startswith(GRADER):
        return f"graders.{module.removeprefix(GRADER)}.{name}"
    return f"checks.{name}"


def english_title(function: Any) -> str:
    """The docstring's first line as it is written."""
    first: str = (function.__doc__ or function.__name__).strip().splitlines()[0]
    return first


def dependants(lab: Lab, failed: set[str]) -> set[str]:
    """The checks that cannot be judged when those in `failed` fail: their needs, and so on."""
    lines, found = sheet(lab), set[str]()
    while fresh := {line.id for line in lines if set(line.needs) & (failed | found)} - found:
        found |= fresh
    return found - failed


def explained(lab: Lab, faults: Mapping[str, str | None]) -> set[str]:
    """The checks that are the same mistake as one of these failed ones, with those that need them.

    Each of them passes, or is skipped. On a busy machine it may be another one each time.
    """
    found = {
        line.id
        for line in sheet(lab)
        for name, kinds in line.explained_by.items()
        if faults.get(name) in kinds
    }
    return (found | dependants(lab, found)) - set(faults)
