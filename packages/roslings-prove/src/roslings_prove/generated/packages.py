"""A generated change as a package to grade, and what came of it."""

from __future__ import annotations

import hashlib
import shutil
from dataclasses import dataclass
from enum import Enum
from functools import cache, cached_property
from pathlib import Path
from typing import Generic

from roslings.course import Lab
from roslings.course.grader import Clock
from roslings.course.labs import MUTANTS
from roslings_class.result import GradingResult
from roslings_class.version import ENGINE, engine_in
from roslings_prove.generated.explained import FILE
from roslings_prove.generated.wrongness import W

NOT_GRADING = frozenset({"cli", "commands"})
"""What no grading comes to: a change there leaves results as they are."""
NOT_JUDGING = frozenset({"solution", "starter", MUTANTS, "hints.yaml", FILE})
"""The same in a lab's folder; the package itself is known by its content."""


class Fate(Enum):
    """What came of a generated package."""

    KILLED = "killed"
    SURVIVED = "survived"
    UNCLEAR = "unclear"
    """The machine could not tell, or the grading broke off: that caught nothing."""


@dataclass(frozen=True)
class GeneratedPackage(Generic[W]):
    """The solution with one change."""

    change: W
    clock: Clock = "auto"
    course: None = None

    @property
    def lab(self) -> Lab:
        """Whose it is."""
        return self.change.lab

    @cached_property
    def name(self) -> str:
        """With the version of all that judges it: what another one found is no result.

        It is asked for again and again, and all files of the lab make it.
        """
        return f"{self.change.name} by {judged_by(self.lab)}"

    @property
    def about(self) -> str:
        """Something must catch it."""
        return f"{self.change.name} loses a point"

    def make(self, folder: Path) -> Path:
        """The solution, changed."""
        package = folder / self.change.name / self.lab.card.package
        shutil.copytree(self.lab.solution, package)
        self.change.put_into(package)
        return package.parent

    def problem(self, result: GradingResult) -> str:
        """That it is as good as the solution."""
        return "" if fate_of(result) is Fate.KILLED else "it passes every check"


def fate_of(result: GradingResult | None) -> Fate:
    """Killed by a check that fails, and by nothing else; others may have told nothing."""
    if result is None or result.state != "graded":
        return Fate.UNCLEAR
    checks = result.verdict.checks if result.verdict else ()
    if result.word == "fail" or any(check.outcome == "fail" for check in checks):
        return Fate.KILLED
    return Fate.SURVIVED if result.word == "pass" else Fate.UNCLEAR


@cache
def _engine() -> bytes:
    return engine_in(*ENGINE, but=NOT_GRADING)


def judged_by(lab: Lab) -> str:
    """Changes with whatever of the engine or the lab a verdict depends on."""
    content = hashlib.sha256(_engine() + lab.grader.read_bytes())
    content.update(engine_in(lab.folder, but=NOT_JUDGING))
    return content.hexdigest()[:12]
