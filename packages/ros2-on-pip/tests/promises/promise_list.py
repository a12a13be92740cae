"""A list of promises: what Jazzy's code does that a program may lean on, and so ours does too.

One file of YAML for each stand-in. What is wrong in it is told with its file and line.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import yaml

from ros2_on_pip.problem import did_you_mean

COMMIT = re.compile(r"[0-9a-f]{40}")
REPOSITORY = re.compile(r"[\w.-]+/[\w.-]+")
TEST = re.compile(r"[\w/]+\.py::test_\w+(\[.+\])?")
PARTS = ("places", "promises")
REASONS = ("left_out", "differs")
PLACE = ("repository", "commit", "path")
PROMISE = ("promise", "covers", "source", "test")
SOURCE = ("place", "name")


class BadList(Exception):
    """A list cannot be read as it stands."""

    def __init__(self, file: Path, line: int, reason: str) -> None:
        super().__init__(f"{file.name}, line {line}: {reason}")


@dataclass(frozen=True)
class Source:
    """Where in the real code a promise was read: a class or function of a file at a commit."""

    repository: str
    commit: str
    path: str
    name: str


@dataclass(frozen=True)
class Promise:
    """What is promised, of which public names, where it was read, and the test that holds it."""

    name: str
    promise: str
    covers: tuple[str, ...]
    source: Source
    test: str


@dataclass(frozen=True)
class Listed:
    """What one file lists. `left_out` and `differs`: a name or a habit, and why."""

    file: Path
    promises: tuple[Promise, ...]
    left_out: Mapping[str, str] = field(default_factory=dict)
    differs: Mapping[str, str] = field(default_factory=dict)

    @property
    def covered(self) -> set[str]:
        """Every public name that some promise is about."""
        return {name for promise in self.promises for name in promise.covers}


class Entry(dict[str, Any]):
    """A mapping of YAML, with the file and the line that it begins at."""

    def __init__(self, file: Path, line: int) -> None:
        self.file, self.line = file, line

    def refuse(self, reason: str) -> BadList:
        """What is wrong with it."""
        return BadList(self.file, self.line, reason)

    def require(self, keys: Iterable[str], optional: Iterable[str] = ()) -> None:
        """Raises BadList where one of `keys` is missing or empty, or an unknown one is there."""
        needed = list(keys)
        known = [*needed, *optional]
        for name in self:
            if name not in known:
                raise self.refuse(f"'{name}' is not known here.{did_you_mean(name, known)}")
        for name in needed:
            if not self.get(name):
                raise self.refuse(f"'{name}' is missing")

    def text(self, name: str) -> str:
        """A text in it. Raises BadList."""
        value = self[name]
        if not isinstance(value, str):
            raise self.refuse(f"'{name}' must be a text, and is {value!r}")
        return value

    def inner(self, name: str) -> Entry:
        """A mapping in it. Raises BadList."""
        value = self.get(name) or Entry(self.file, self.line)
        if not isinstance(value, Entry):
            raise self.refuse(f"'{name}' must have names and colons inside it")
        return value

    def like(self, name: str, form: re.Pattern[str]) -> str:
        """A text of this form. Raises BadList."""
        value = self.text(name)
        if not form.fullmatch(value):
            raise self.refuse(f"'{name}' is not of its form: {value}")
        return value


def read(file: Path) -> Listed:
    """The list in a file. Raises BadList, which names the file and the line."""
    try:
        node = yaml.compose(file.read_text("utf-8"), Loader=yaml.SafeLoader)
    except yaml.MarkedYAMLError as fault:
        line = fault.problem_mark.line + 1 if fault.problem_mark else 1
        raise BadList(file, line, f"no valid YAML: {fault.problem}") from None
    root = _plain(file, node)
    if not isinstance(root, Entry):
        raise BadList(file, 1, f"a list has the parts {', '.join(PARTS)}")
    root.require(PARTS, REASONS)
    sources = _places(root.inner("places"))
    inner = root.inner("promises")
    promises = tuple(_promise(name, inner.inner(name), sources) for name in inner)
    _require_once(inner, promises)
    _require_used(root.inner("places"), promises)
    return Listed(file, promises, _reasons(root, "left_out"), _reasons(root, "differs"))


def _plain(file: Path, node: yaml.Node | None) -> Any:
    """Mappings as entries. Raises BadList where a name stands twice."""
    if isinstance(node, yaml.SequenceNode):
        return [_plain(file, one) for one in node.value]
    if not isinstance(node, yaml.MappingNode):
        return node.value if node else None
    entry = Entry(file, node.start_mark.line + 1)
    for key, value in node.value:
        if key.value in entry:
            line = key.start_mark.line + 1
            raise BadList(file, line, f"'{key.value}' stands here twice")
        entry[key.value] = _plain(file, value)
    return entry


def _places(entry: Entry) -> dict[str, Source]:
    """Name of a file of the real code to that file. Raises BadList."""
    found = {}
    for name in entry:
        place = entry.inner(name)
        place.require(PLACE)
        found[name] = Source(
            place.like("repository", REPOSITORY),
            place.like("commit", COMMIT),
            place.text("path"),
            name="",
        )
    return found


def _promise(name: str, entry: Entry, places: Mapping[str, Source]) -> Promise:
    """Raises BadList."""
    entry.require(PROMISE)
    source = entry.inner("source")
    source.require(SOURCE)
    place = source.text("place")
    if place not in places:
        raise source.refuse(f"there is no place '{place}'.{did_you_mean(place, places)}")
    covers = entry["covers"]
    if not isinstance(covers, list) or not all(isinstance(one, str) for one in covers):
        raise entry.refuse("'covers' must be a list of names")
    return Promise(
        name=name,
        promise=entry.text("promise"),
        covers=tuple(covers),
        source=replace(places[place], name=source.text("name")),
        test=entry.like("test", TEST),
    )


def _require_once(entry: Entry, promises: Iterable[Promise]) -> None:
    """Raises BadList where two say the same, or one names a thing twice."""
    seen: dict[str, str] = {}
    for promise in promises:
        line = entry.inner(promise.name)
        sentence = promise.promise.casefold()
        if sentence in seen:
            raise line.refuse(f"'{seen[sentence]}' promises the same")
        seen[sentence] = promise.name
        if len(set(promise.covers)) < len(promise.covers):
            raise line.refuse("'covers' has a name twice")


def _require_used(places: Entry, promises: Iterable[Promise]) -> None:
    """Raises BadList where no promise was read in a place."""
    used = {(one.source.repository, one.source.path) for one in promises}
    for name in places:
        place = places.inner(name)
        if (place["repository"], place["path"]) not in used:
            raise place.refuse(f"no promise has its source in '{name}'")


def _reasons(root: Entry, part: str) -> dict[str, str]:
    """Each name with its reason. Raises BadList."""
    entry = root.inner(part)
    return {name: entry.text(name) for name in entry}
