"""`promises.yaml`: what holds a package to each sentence of the task, and to each text of the card.

A sentence that nobody accounts for is a promise that perhaps nothing judges. The file stays with
the authors: it names the mutants.
"""

from __future__ import annotations

from pathlib import Path

from pydantic import Field, model_validator

from roslings.course.contract import Contract
from roslings.course.files import read_yaml

NAME = "promises.yaml"


class Promise(Contract):
    """Some words, and one thing that accounts for them."""

    says: str = Field(default="", description="The exact words; empty for the whole text `at`")
    at: str = Field(
        default="",
        description="A text of the card, e.g. `nodes.0.log_about`; else task.md",
    )
    checks: tuple[str, ...] = Field(default=(), description="The checks that judge it")
    broken_by: tuple[str, ...] = Field(
        default=(), description="Mutants that do not do it, and fail in these checks for that"
    )
    repeats: tuple[str, ...] = Field(
        default=(), description="Places of the card that say the same: their proof is its proof"
    )
    not_judged: str = Field(default="", description="A line of the card's `not_judged`")
    explains: str = Field(default="", description="What it tells; it asks nothing of the package")

    @model_validator(mode="after")
    def _accounts_in_one_way(self) -> Promise:
        ways = [self.checks, self.repeats, self.not_judged, self.explains]
        if sum(map(bool, ways)) != 1:
            raise ValueError("give one of checks, repeats, not_judged, explains")
        if bool(self.checks) != bool(self.broken_by):
            raise ValueError("checks and broken_by belong together: which mutant shows them?")
        if not self.says and not self.at:
            raise ValueError("give the words of task.md: says")
        return self


class Promises(Contract):
    """The whole file."""

    sentences: tuple[Promise, ...] = ()
    words: dict[str, str] = Field(
        default_factory=dict,
        description="Place of a word of the card that is not judged, to a line of `not_judged`",
    )


def promises_in(folder: Path) -> Promises:
    """What a lab's folder has; nothing where there is no such file. Raises BadCourseFile."""
    file = folder / NAME
    return read_yaml(file, Promises) if file.is_file() else Promises()
