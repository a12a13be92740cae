"""What the doctor says, in the language that is asked for.

English stands in the code, beside the id that a text keeps. This package knows no other language.
Whoever brings translations offers them by an entry point of the group `ros_doctor.translations`.
It is not even looked for where `ROSLINGS_LANGUAGE` is not set.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any, Protocol

VARIABLE = "ROSLINGS_LANGUAGE"
GROUP = "ros_doctor.translations"
FOLDER = "languages"


class Translations(Protocol):
    """What an entry point of the group leads to."""

    def template(self, id: str, english: str, /) -> str:
        """What stands in the place of this English, its fields still in braces."""

    def form(self, id: str, number: float, /, *, one: str, other: str) -> str:
        """The same of what is counted: the form that fits the number."""


@dataclass(frozen=True)
class DoctorText:
    """One text, said when it is read."""

    id: str
    english: str

    def __str__(self) -> str:
        return template(self.id, self.english)


def said(id: str, english: str, /, **fields: Any) -> str:
    """The text of this id, its fields filled in."""
    return template(id, english).format(**fields)


def counted(id: str, number: int, /, *, one: str, other: str, **fields: Any) -> str:
    """The form of a text that fits a number, which is the field `count` in it."""
    brought = _brought()
    english = one if number == 1 else other
    text = brought.form(id, number, one=one, other=other) if brought else english
    return text.format(count=number, **fields)


def template(id: str, english: str, /) -> str:
    """A text with its fields still in braces."""
    brought = _brought()
    return brought.template(id, english) if brought else english


def listed(names: Sequence[str]) -> str:
    """`a`, `a and b`, `a, b and c`."""
    if len(names) < 2:
        return "".join(names)
    return said("doctor.and", "{some} and {last}", some=", ".join(names[:-1]), last=names[-1])


def either(names: Sequence[str]) -> str:
    """`a`, `a or b`, `a, b or c`."""
    if len(names) < 2:
        return "".join(names)
    return said("doctor.or", "{some} or {last}", some=", ".join(names[:-1]), last=names[-1])


def language_folders() -> Iterator[Path]:
    """Where translations of this package lie: an entry point of `ros2_on_pip.languages`."""
    yield Path(__file__).with_name(FOLDER)


def _brought() -> Translations | None:
    return _found() if os.environ.get(VARIABLE) else None


@cache
def _found() -> Translations | None:
    from importlib.metadata import entry_points  # takes long to load, and English needs none

    found: Iterator[Translations] = (point.load() for point in entry_points(group=GROUP))
    return next(found, None)
