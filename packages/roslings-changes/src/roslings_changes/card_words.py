"""The words of a card: where each stands in the file, what it says, and of what kind it is."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal, get_args, get_origin

from pydantic.fields import FieldInfo

from roslings.course.card import Card
from roslings.course.contract import Contract
from roslings.course.files import Location, line_in, read_tree
from roslings.course.kinds import Kind, kind_of

NAMES = ("executable", "topic", "service", "action", "name", "path")
"""What a thing of a list is called by, where it is."""


@dataclass(frozen=True)
class CardWord:
    """One word that a card says, with all that is needed to say another one in its place."""

    path: Location
    """Keys and numbers that lead to it in the file."""
    name: str
    """The same for people: things of a list by what they are called."""
    kind: Kind
    key: str
    """What it is called where it is defined: `hz`, `within_s`."""
    value: Any
    around: Mapping[str, Any]
    """The part of the card that it stands in."""
    choices: tuple[Any, ...]
    """All that it could say, where these are few."""
    file: Path
    line: int

    @property
    def place(self) -> str:
        """How a mutant names it: `nodes.0.publishes.0.rate.hz`, whatever things are called."""
        return ".".join(map(str, self.path))


def words_of(file: Path) -> list[CardWord]:
    """The words that stand in a card, in its order, without those for people."""
    return [word for word in _all_of(file) if word.kind not in (Kind.PROSE, Kind.PROMISE)]


def texts_of(file: Path) -> list[CardWord]:
    """The texts of a card that say in words what the package does."""
    return [word for word in _all_of(file) if word.kind is Kind.PROMISE and word.value]


def _all_of(file: Path) -> Iterator[CardWord]:
    return _in_contract(Card, read_tree(file), (), "", file)


def _in_contract(
    model: type[Contract], tree: Mapping[str, Any], path: Location, name: str, file: Path
) -> Iterator[CardWord]:
    for key, value in tree.items():
        field = model.model_fields[key]
        at, called = (*path, key), f"{name}.{key}".lstrip(".")
        if (kind := kind_of(field)) is None:
            yield from _in_part(_contract_in(field.annotation), value, at, called, file)
        elif kind is not Kind.STIMULUS and isinstance(value, dict | list):
            pairs = value.items() if isinstance(value, dict) else enumerate(value)
            for part, said in pairs:
                line = line_in(file, (*at, part))
                yield CardWord(
                    (*at, part), f"{called}.{part}", kind, key, said, tree, (), file, line
                )
        else:
            line = line_in(file, at)
            yield CardWord(at, called, kind, key, value, tree, _choices(field), file, line)


def _in_part(
    model: type[Contract], value: Any, path: Location, name: str, file: Path
) -> Iterator[CardWord]:
    """One contract, a list of them, or some by name."""
    if isinstance(value, list):
        for number, each in enumerate(value):
            called = next((str(each[key]) for key in NAMES if key in each), str(number))
            yield from _in_contract(model, each, (*path, number), f"{name}.{called}", file)
    elif issubclass(model, Contract) and not _is_named(value, model):
        yield from _in_contract(model, value, path, name, file)
    else:
        for key, each in value.items():
            yield from _in_contract(model, each, (*path, key), f"{name}.{key}", file)


def _is_named(value: Mapping[str, Any], model: type[Contract]) -> bool:
    """Its keys are names that the card gives, and each has a contract below it."""
    return not set(value) <= set(model.model_fields)


def _contract_in(annotation: Any) -> type[Contract]:
    """The contract that a field holds: one, a tuple of them, some by name, or perhaps none."""
    if isinstance(annotation, type) and issubclass(annotation, Contract):
        return annotation
    for inner in get_args(annotation):
        if inner not in (str, Ellipsis, type(None)):
            return _contract_in(inner)
    raise TypeError(f"{annotation} holds no part of a card")


def _choices(field: FieldInfo) -> tuple[Any, ...]:
    """What a `Literal` names."""
    return get_args(field.annotation) if get_origin(field.annotation) is Literal else ()
