"""A diagnosis as a student writes it, held against the truth about the rover of that name."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

import yaml

from roslings.course.written_yaml import load
from roslings.judge.faults.sentences import SentencePart, one_of, plural
from roslings_rover.models.drives.faults import FAULTS
from roslings_rover.models.drives.sick_rover import Planted

MOST_ENTRIES = 50
MOST_CHARACTERS = 40


Kind = Literal[
    "no_yaml_line",
    "no_yaml",
    "no_keys",
    "no_name",
    "no_rover",
    "no_list",
    "many",
    "entry",
    "fault",
    "topic",
    "no_number",
]
"""Why nobody can judge a diagnosis."""


@dataclass(frozen=True)
class Problem(SentencePart):
    """Why nobody can judge a diagnosis."""

    kind: Kind
    number: int = 0
    """Of the line, or of the entry; of many, how many."""
    said: str = ""
    """What stands there, or what the YAML reader says of it."""
    text = one_of(
        no_yaml_line="line {number} is no YAML: {said}",
        no_yaml="it is no YAML",
        no_keys="it has no keys `name` and `faults`",
        no_name="`name` is empty; write the name that you made your rover with",
        no_rover="no rover has the name {said!r}",
        no_list="`faults` is no list; each entry begins with a dash",
        many=plural(
            "number", one="`faults` has {number} entry", other="`faults` has {number} entries"
        ),
        entry="entry {number} does not have the keys `fault`, `topic` and `number`",
        fault="entry {number}: {said!r} is none of the ten faults",
        topic="entry {number}: a topic begins with a slash, and {said!r} does not",
        no_number="entry {number}: {said!r} is no number; write no unit behind it",
    )

    @property
    def which_text(self) -> str:
        """What it is."""
        return self.kind


class Unreadable(ValueError):
    """The text is no diagnosis."""

    def __init__(self, kind: Kind, number: int = 0, said: object = "") -> None:
        """Of what a student wrote, as much is kept as a line can show."""
        cut = said if kind == "no_yaml_line" else str(said)[:MOST_CHARACTERS]
        self.problem = Problem(kind, number, f"{cut}")
        super().__init__(str(self.problem))


@dataclass(frozen=True)
class Entry(SentencePart):
    """One fault that somebody has found."""

    fault: str
    topic: str
    number: float
    text = "{fault} of {topic}"


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
        raise Unreadable("no_yaml_line", line, error.problem) from None
    except (yaml.YAMLError, ValueError, RecursionError):
        raise Unreadable("no_yaml") from None
    if not isinstance(said, dict):
        raise Unreadable("no_keys")
    return Diagnosis(_name(said.get("name")), tuple(_entries(said.get("faults"))))


def _name(said: object) -> str:
    if isinstance(said, bool) or not isinstance(said, str | int) or not str(said).strip():
        raise Unreadable("no_name")
    return str(said).strip()


def _entries(said: object) -> Iterator[Entry]:
    if not isinstance(said, list):
        raise Unreadable("no_list")
    if len(said) > MOST_ENTRIES:
        raise Unreadable("many", len(said))
    for number, each in enumerate(said, 1):
        yield _entry(number, each)


def _entry(place: int, said: object) -> Entry:
    if not isinstance(said, dict) or not {"fault", "topic", "number"} <= set(said):
        raise Unreadable("entry", place)
    fault, topic, number = said["fault"], said["topic"], said["number"]
    if not isinstance(fault, str) or fault not in FAULTS:
        raise Unreadable("fault", place, fault)
    if not isinstance(topic, str) or not topic.startswith("/"):
        raise Unreadable("topic", place, topic)
    if isinstance(number, bool) or not isinstance(number, int | float):
        raise Unreadable("no_number", place, number)
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
