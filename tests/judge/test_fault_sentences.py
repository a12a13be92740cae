"""The sentences of faults are templates in their classes; each finds what it needs."""

from __future__ import annotations

import pkgutil
from collections.abc import Iterator
from dataclasses import dataclass, fields
from importlib import import_module
from string import Formatter

import pytest

import roslings.capabilities
import roslings.judge.faults
import roslings_learn.drills
from roslings.judge.faults.base import SENTENCES, Fault, Sentence

ROOMS = (roslings.capabilities, roslings_learn.drills, roslings.judge.faults)


def _all_faults() -> Iterator[type[Fault]]:
    """Every class of faults that the engine has."""
    for room in ROOMS:
        for found in pkgutil.walk_packages(room.__path__, f"{room.__name__}."):
            if "faults" in found.name:
                import_module(found.name)
    waiting = [Fault]
    while waiting:
        kind = waiting.pop()
        waiting += kind.__subclasses__()
        yield kind


def _templates() -> list[tuple[type[Fault], str, str]]:
    return [
        (kind, name, written.template)
        for kind in sorted(_all_faults(), key=lambda kind: kind.__qualname__)
        for name in SENTENCES
        if isinstance(written := vars(kind).get(name), Sentence)
    ]


def test_each_template_finds_its_fields() -> None:
    """What stands in braces is a field of the fault, or a property of its class."""
    templates = _templates()
    assert len(templates) > 250
    for kind, name, template in templates:
        known = {field.name for field in fields(kind)} | set(dir(kind))
        named = {part.partition(".")[0] for _, part, _, _ in Formatter().parse(template) if part}
        assert named <= known, f"{kind.__name__}.{name}"


@dataclass(eq=False)
class Late(Fault):
    """A fault of the tests."""

    name: str
    late_s: float
    hint: str = "no template: {name}"
    expected = "{spoken} in time; set(){{}}"
    measured = "{late_s:.1f} s late"

    @property
    def spoken(self) -> str:
        """Its name, as it is told."""
        return f"/{self.name}"


def test_a_sentence_is_filled_in() -> None:
    """By fields with their formats, and by properties; a field of a sentence's name stays one."""
    late = Late("arm", 2.25)
    assert str(late) == "expected /arm in time; set(){}; measured 2.2 s late"
    assert late.hint == "no template: {name}"
    assert Late.measured == "{late_s:.1f} s late"


def test_a_name_that_is_not_there_is_an_error() -> None:
    """Nobody reads a sentence with a hole."""

    class Wrong(Late):
        measured = "{lat_s} s"

    with pytest.raises(AttributeError, match="lat_s"):
        _ = Wrong("arm", 1.0).measured
