"""A diagnosis as a student writes it, held against the truth about the rover of that name."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import yaml

from roslings.course.written_yaml import load
from roslings_rover.models.drives.faults import FAULTS
from roslings_rover.models.drives.sick_rover import Planted

MOST_ENTRIES = 50


class Unreadable(ValueError):
    """The text is no diagnosis; the message says why."""


@dataclass(frozen=True)
class Entry:
    """One fault that somebody has found."""

    fault: str
    topic: str
    number: float

    def __str__(self) -> str:
        return f"{self.fault} of {self.topic}"


@dataclass(frozen=True)
class Diagnosis:
    """All that the file says."""

    name: str
    entries: tuple[Entry, ...]


@dataclass(frozen=True)
class Tally:
    """The entries, counted."""

    right: tuple[Entry, ...]
    near: tuple[Entry, ...]
    """Fault and topic are right, the number is not."""
    wrong: tuple[Entry, ...]
    """The topic does not have this fault."""
    again: tuple[Entry, ...]
    """An earlier entry is about the same fault of the same topic."""

    @property
    def net(self) -> int:
        """A wrong one takes away what a right one gives; so does one that is made again."""
        return len(self.right) - len(self.wrong) - len(self.again)


def read(text: str) -> Diagnosis:
    """What the file says. Raises Unreadable."""
    try:
        said = load(text)
    except yaml.MarkedYAMLError as error:
        line = error.problem_mark.line + 1 if error.problem_mark else 1
        raise Unreadable(f"line {line} is no YAML: {error.problem}") from None
    except (yaml.YAMLError, ValueError, RecursionError):
        raise Unreadable("it is no YAML") from None
    if not isinstance(said, dict):
        raise Unreadable("it has no keys `name` and `faults`")
    return Diagnosis(_name(said.get("name")), tuple(_entries(said.get("faults"))))


def _name(said: Any) -> str:
    if isinstance(said, bool) or not isinstance(said, str | int) or not str(said).strip():
        raise Unreadable("`name` is empty; write the name that you made your rover with")
    return str(said).strip()


def _entries(said: Any) -> Iterator[Entry]:
    if not isinstance(said, list):
        raise Unreadable("`faults` is no list; each entry begins with a dash")
    if len(said) > MOST_ENTRIES:
        raise Unreadable(f"`faults` has {len(said)} entries")
    for number, each in enumerate(said, 1):
        yield _entry(f"entry {number}", each)


def _entry(which: str, said: Any) -> Entry:
    if not isinstance(said, dict) or not {"fault", "topic", "number"} <= set(said):
        raise Unreadable(f"{which} does not have the keys `fault`, `topic` and `number`")
    fault, topic, number = said["fault"], said["topic"], said["number"]
    if not isinstance(fault, str) or fault not in FAULTS:
        raise Unreadable(f"{which}: {str(fault)[:40]!r} is none of the ten faults")
    if not isinstance(topic, str) or not topic.startswith("/"):
        raise Unreadable(f"{which}: a topic begins with a slash, and {str(topic)[:40]!r} does not")
    if isinstance(number, bool) or not isinstance(number, int | float):
        raise Unreadable(f"{which}: {str(number)[:40]!r} is no number; write no unit behind it")
    return Entry(fault, topic, float(number))


def tally(entries: tuple[Entry, ...], planted: tuple[Planted, ...], within: float) -> Tally:
    """Hold entries against the truth. Of two about one fault, the first counts."""
    found: dict[str, list[Entry]] = {"right": [], "near": [], "wrong": [], "again": []}
    truths = {(each.fault, each.topic): each for each in planted}
    met: set[tuple[str, str]] = set()
    for entry in entries:
        about = entry.fault, entry.topic
        how = "again" if about in met else _outcome(entry, truths.get(about), within)
        found[how].append(entry)
        met.add(about)
    return Tally(**{name: tuple(made) for name, made in found.items()})


def _outcome(entry: Entry, truth: Planted | None, within: float) -> str:
    if truth is None:
        return "wrong"
    signed = FAULTS[entry.fault].signed
    number, wanted = (value if signed else abs(value) for value in (entry.number, truth.number))
    return "right" if abs(number - wanted) <= within * abs(wanted) else "near"
