"""What the engine knows of a kind of thing that a robot program does, and where it finds it.

The rooms of the engine call no capability by its name: they ask here. A course of others brings
its own by an entry point of the group `roslings.capability`:

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
from importlib import import_module
from importlib.metadata import EntryPoint, entry_points
from typing import Any, Generic, TypeVar

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
    """Words of a node: a `Contract` whose fields the nodes of every card get."""
    card: type[Any] | None = None
    """Words of the package, for every card."""
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
        "bags",
        "qos",
    )
}
"""Name to where it is; others come by entry points. None is imported before it is asked for."""


def at(place: Place) -> Any:
    """What is there. Raises ImportError and AttributeError where nothing is."""
    module, _, name = place.partition(":")
    return getattr(import_module(module), name)


@cache
def capability(name: str) -> Capability[Any] | None:
    """The capability of this name; None where nobody here has it."""
    place = BUILT_IN.get(name)
    if place is None:
        found = _others().get(name)
        return None if found is None else _loaded(found)
    return at(place)  # type: ignore[no-any-return]


def capabilities() -> tuple[Capability[Any], ...]:
    """All that are here: the built-in ones first, in the order of the table."""
    known = (capability(name) for name in (*BUILT_IN, *sorted(_others())))
    return tuple(each for each in known if each is not None)


@cache
def _others() -> dict[str, EntryPoint]:
    return {each.name: each for each in entry_points(group=GROUP) if each.name not in BUILT_IN}


def _loaded(found: EntryPoint) -> Capability[Any]:
    """What an entry point leads to. Raises TypeError where that is no capability."""
    made = found.load()
    if not isinstance(made, Capability):
        raise TypeError(f"{found.value} (entry point {found.name!r} of {GROUP}) is no Capability")
    return made
