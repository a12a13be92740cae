"""What the engine knows of a kind of thing that a robot program does, and where it finds it.

The rooms of the engine call no capability by its name: they ask here. What only one lab needs
lies beside its grader (`folders/lab_folders.py`), and its `__init__.py` has the `CAPABILITY`. What
several courses use is a package of its own, with an entry point of the group
`roslings.capability`:

    [project.entry-points."roslings.capability"]
    lifecycle = "my_course.lifecycle:CAPABILITY"

Experiments and checks import what they need of a capability as plain Python; only what the engine
itself must call stands in `Capability`.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from contextlib import ExitStack
from dataclasses import dataclass, field
from functools import cache
from importlib.metadata import EntryPoint, entry_points
from pathlib import Path
from typing import Any, Generic, TypeVar

from roslings.folders.course_folder import root
from roslings.folders.lab_folders import imported, lab_folders, module_of
from roslings.record import PartSeen

R = TypeVar("R", bound=PartSeen)
Plain = bool | int | float | str
Upgrade = Callable[[dict[str, Any]], dict[str, Any]]
"""Makes a part of version n to one of n + 1, both as JSON has them."""
Place = str
"""Where a function is, `module:name`: who reads evidence imports nothing that draws or runs."""


Row = tuple[str, ...]
"""What a line of a table in task.md has: its name, and what the card says."""
Rows = Callable[[Any], Iterable[Row]]


def no_rows(contract: Any) -> Iterable[Row]:
    """For a capability of which a table says nothing."""
    return ()


@dataclass(frozen=True)
class Words:
    """What a card may say of a capability, and how task.md says it to the student."""

    node: type[Any] | None = None
    """Words of a node: `NodeWords` whose fields the nodes of every card get."""
    card: type[Any] | None = None
    """Words of the package, for every card: `CardWords`."""
    interface: Rows = no_rows
    """From a node: what goes in and out of it."""
    settings: Rows = no_rows
    """From a node: what is set."""
    package: Rows = no_rows
    """From a card."""


@dataclass(frozen=True)
class Capability(Generic[R]):
    """One kind of thing that a robot program does, and all that the engine asks of it."""

    name: str
    """Its key in evidence."""
    seen: type[R] | None = None
    """The record of an experiment; None where the engine's own record has all of it."""
    upgrade: Mapping[int, Upgrade] = field(default_factory=dict)
    """Version n of the record to the step to n + 1."""
    in_schema_1: Mapping[str, str] = field(default_factory=dict)
    """Fields that evidence of schema 1 had for it, to the fields of the record today."""
    formerly: Mapping[tuple[str, int], tuple[str, ...]] = field(default_factory=dict)
    """Fields of its record, in version 1, that another capability's record had up to a version:
    that one's name and version, to the fields."""
    words: Place | None = None
    """Its `Words`; None where a card says nothing of it."""
    sections: Place | None = None
    """evidence -> sections of a report's page (Markup); none where it saw nothing."""
    companions: Place | None = None
    """(node, card, arena, stack) -> parameters that lead a node, left running alone, to stand-ins
    for the devices that it needs; the stack ends them."""

    @property
    def version(self) -> int:
        """The version of the record."""
        return 1 if self.seen is None else int(self.seen.model_fields["v"].default)

    @property
    def words_here(self) -> Words | None:
        """What a card may say of it."""
        return at(self.words) if self.words else None

    def sections_of(self, evidence: Any) -> Iterable[Any]:
        """What a page shows of evidence that this capability saw."""
        return at(self.sections)(evidence) if self.sections else ()

    def companions_of(
        self, node: Any, card: Any, arena: Any, running: ExitStack
    ) -> Mapping[str, Plain]:
        """Stand-ins for the devices of a node that is left running, until `running` ends."""
        return at(self.companions)(node, card, arena, running) if self.companions else {}


GROUP = "roslings.capability"
BUILT_IN = {
    name: f"roslings.capabilities.{name}:CAPABILITY"
    for name in (
        "topics",
        "services",
        "actions",
        "parameters",
        "launch",
        "camera",
        "serial",
        "robot",
        "qos",
    )
}
"""Name to where it is; the others are found. None is imported before it is asked for."""
ATTRIBUTE = "CAPABILITY"
"""What a lab's own folder calls it."""


def at(place: Place) -> Any:
    """What is there. Raises ImportError, AttributeError, and BadLabFolder, where nothing is."""
    module, _, name = place.partition(":")
    return getattr(imported(module), name)


def capability(name: str) -> Capability[Any] | None:
    """The capability of this name; None where nobody here has it."""
    if name in BUILT_IN:
        return _built_in(name)
    return _others(root()).get(name)


def capabilities() -> tuple[Capability[Any], ...]:
    """All that are here: the built-in ones first, in the order of the table."""
    others = _others(root())
    return (*map(_built_in, BUILT_IN), *(others[name] for name in sorted(others)))


def of_labs() -> tuple[Capability[Any], ...]:
    """Those that a lab of the course brings, in a folder beside its grader."""
    return tuple(_of_folders(root()).values())


@cache
def _built_in(name: str) -> Capability[Any]:
    return at(BUILT_IN[name])  # type: ignore[no-any-return]


@cache
def _others(course: Path) -> dict[str, Capability[Any]]:
    """Those of packages, and those of a course's labs: a lab's own comes first."""
    installed = (each for each in entry_points(group=GROUP) if each.name not in BUILT_IN)
    return {**{each.name: _loaded(each) for each in installed}, **_of_folders(course)}


@cache
def _of_folders(course: Path) -> dict[str, Capability[Any]]:
    """Of the course that is used now. Raises TypeError where one has the name of a built-in one."""
    brought = (imported(module_of(folder)) for folder in lab_folders())
    found = [vars(each)[ATTRIBUTE] for each in brought if ATTRIBUTE in vars(each)]
    if taken := [each.name for each in found if each.name in BUILT_IN]:
        raise TypeError(f"a lab's own capability is called {taken[0]!r}, as a built-in one is")
    return {each.name: each for each in found}


def _loaded(found: EntryPoint) -> Capability[Any]:
    """What an entry point leads to. Raises TypeError where that is no capability."""
    made = found.load()
    if not isinstance(made, Capability):
        raise TypeError(f"{found.value} (entry point {found.name!r} of {GROUP}) is no Capability")
    return made
