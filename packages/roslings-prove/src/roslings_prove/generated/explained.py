"""`labs/LAB/generated.yaml`: the generated packages that nothing catches, and why that is right.

    - package: topics-number-talker.py:14-1b1ecb9f
      diff: |
        -        self.publisher = self.create_publisher(String, 'chatter', 10)
        +        self.publisher = self.create_publisher(String, 'chatter', 11)
      equivalent: The queue is never full.

What `--boundary` makes stands here, too: the name says so, and what goes wrong is told in place of
the diff. Instead of `equivalent`, `not_judged` names a line of the card's `not_judged`, word for
word.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from pathlib import Path

from pydantic import Field, RootModel, model_validator

from roslings.course import Lab
from roslings.course.contract import Contract
from roslings.course.files import BadCourseFile, read_yaml
from roslings_prove.generated.wrongness import Wrongness

FILE = "generated.yaml"
BOUNDARY = "boundary"
"""The word in the name of a package that is made at the boundary to ROS."""


class Explanation(Contract):
    """Why one generated package may get every point."""

    package: str
    diff: str = Field(description="The lines that are changed, each with - or +")
    equivalent: str = Field(default="", description="Why it does what the solution does")
    not_judged: str = Field(default="", description="A line of the card's `not_judged`")

    @model_validator(mode="after")
    def _one_reason(self) -> Explanation:
        """Raises ValueError, which is told with file and line."""
        if bool(self.equivalent) == bool(self.not_judged):
            raise ValueError("give one reason: `equivalent: ...` or `not_judged: ...`")
        return self

    @property
    def why(self) -> str:
        """The reason, in words."""
        return self.equivalent or f"not judged: {self.not_judged}"


class Explanations(RootModel[tuple[Explanation, ...]]):
    """All of a lab; a file with comments alone has none."""

    @model_validator(mode="before")
    @classmethod
    def _none_is_an_empty_list(cls, read: object) -> object:
        return () if read is None else read


def explained(
    lab: Lab, packages: Collection[Wrongness], *, at_the_boundary: bool = False
) -> dict[str, Explanation]:
    """Package's name to why it may survive. Raises BadCourseFile."""
    file = lab.folder / FILE
    if not file.is_file():
        return {}
    known = {each.name: each for each in packages}
    own: dict[str, Explanation] = {}
    for number, entry in enumerate(read_yaml(file, Explanations).root):
        if entry.package.startswith(f"{lab.name}-{BOUNDARY}-") is not at_the_boundary:
            continue
        if problem := _problem(entry, known, lab.card.not_judged):
            raise BadCourseFile(file, _line(file, number), problem)
        own[entry.package] = entry
    return own


def _problem(
    entry: Explanation, known: Mapping[str, Wrongness], not_judged: Collection[str]
) -> str:
    package = known.get(entry.package)
    if package is None:
        return f"no generated package has the name {entry.package!r}: take the entry out"
    if _plain(entry.diff) != _plain(package.changed):
        return f"the diff of {entry.package} is another one:\n{package.changed}"
    if entry.not_judged and entry.not_judged not in not_judged:
        return f"the card has no such line under not_judged: {entry.not_judged!r}"
    return ""


def _plain(diff: str) -> list[str]:
    return [line.rstrip() for line in diff.strip("\n").splitlines()]


def _line(file: Path, number: int) -> int:
    """Where the entry begins, from 1."""
    from roslings.course.files import line_in

    return line_in(file, (number,))
