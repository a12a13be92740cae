"""The columns of class lists in many languages: each heading is read as its English one.

`headings.yaml` is the table; a language is added there, and nowhere else.
"""

from __future__ import annotations

import unicodedata
from collections.abc import Iterator, Sequence
from functools import cache
from pathlib import Path

from pydantic import TypeAdapter

from ros2_on_pip.typed_paths import from_here

FILE = Path(__file__).with_name("headings.yaml")
COLUMNS = (
    "full name",
    "name",
    "first name",
    "last name",
    "id number",
    "email address",
    "username",
    "github username",
    "group",
    "identifier",
    "grade",
    "maximum grade",
    "scale",
    "last modified (submission)",
    "last modified (grade)",
    "feedback comments",
)
"""English headings that the table may translate."""
ID, IDENTIFIER, CHANGED = "id", "identifier", "last modified (grade)"
PARTICIPANT = "participant"
IN_ENGLISH = "Participant"
Table = dict[str, dict[str, list[str]]]


@cache
def table() -> Table:
    """Language to English heading to the headings in that language."""
    import yaml  # 20 ms, which only a class list is worth

    return TypeAdapter(Table).validate_python(yaml.safe_load(FILE.read_text("utf-8")))


def plain(heading: str) -> str:
    """As headings are compared: small, one space between words, one way to write an accent."""
    return " ".join(unicodedata.normalize("NFC", heading).casefold().split())


def english(head: Sequence[str]) -> list[str]:
    """The headings of a list, in English and small letters; one that nobody knows as it is.

    Of two that mean the same the second stays as it is. `ID` of a grading worksheet in German is
    Moodle's identifier, and no number that a person gave.
    """
    names: list[str] = []
    for heading in map(plain, head):
        meant = _meanings().get(heading, heading)
        names.append(heading if meant in names else meant)
    if CHANGED in names and IDENTIFIER not in names and ID in names:
        names[names.index(ID)] = IDENTIFIER
    return names


def other_language() -> str:
    """What to do with a list in a language that is not in the table."""
    known = ", ".join(["en", *table()])
    return (
        f"Columns are known in these languages: {known}. Take the list in one of these, or add\n"
        f"the headings of another one here: {from_here(FILE)}"
    )


@cache
def participants() -> frozenset[str]:
    """The words before the number in a grading worksheet."""
    words = (word for own in table().values() for word in own.get(PARTICIPANT, ()))
    return frozenset((IN_ENGLISH, *words))


@cache
def _meanings() -> dict[str, str]:
    return dict(_pairs())


def _pairs() -> Iterator[tuple[str, str]]:
    for own in table().values():
        for meant, headings in own.items():
            yield from ((plain(heading), meant) for heading in headings if meant != PARTICIPANT)
