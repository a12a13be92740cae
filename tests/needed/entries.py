"""What tests are installed with, entry by entry: pins, groups of packages, options of pytest.

An entry that is new beside the others changes nothing for a test that ran without it: who uses it
has become another file. One that is another or gone does. So each is a need of its own, and a
landing that adds a package makes no record stale.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

OF_TESTS = "test"
"""The group that the tests run with."""

READ_BY_AUTHORS_ONLY = ("ruff", "mypy", "importlinter")
"""Tools whose tables no slow test runs with; the tests that hold them are not slow."""


def pins(text: str) -> Iterator[str]:
    """Of constraints.txt: each without the groups that it names behind it."""
    for line in text.splitlines():
        if pin := line.partition("#")[0].strip():
            yield pin


def settings(text: str) -> Iterator[str]:
    """Of pyproject.toml: each as `table.name = value`, each member of a list by itself.

    Of groups the packages count, not in which of them each stands: where one has moved to another
    group, the same is installed; and who installs a group by its name has become another file.
    """
    said = tomllib.loads(text)
    tools = said.get("tool", {})
    for name in READ_BY_AUTHORS_ONLY:
        tools.pop(name, None)
    groups = said.pop("dependency-groups", {})
    yield from sorted({f"a group has {each!r}" for name in groups for each in _of(name, groups)})
    yield from (f"tests have {each!r}" for each in sorted(_of(OF_TESTS, groups)))
    yield from _flat("", said)


def _of(name: str, groups: Mapping[str, Sequence[Any]]) -> set[str]:
    """The packages of a group, and of those that it includes."""
    members = groups.get(name, ())
    own = {each for each in members if isinstance(each, str)}
    included = (each["include-group"] for each in members if isinstance(each, dict))
    return own.union(*(_of(each, groups) for each in included))


def _flat(place: str, said: Any) -> Iterator[str]:
    if isinstance(said, dict):
        for name, value in said.items():
            yield from _flat(f"{place}.{name}" if place else name, value)
    elif isinstance(said, list):
        for value in said:
            nested = isinstance(value, dict)
            yield from _flat(place, value) if nested else (f"{place} has {value!r}",)
    else:
        yield f"{place} = {said!r}"
