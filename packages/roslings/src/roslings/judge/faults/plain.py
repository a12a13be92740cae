"""The fields of a fault as JSON has them: programs compare these, people read sentences."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping
from dataclasses import fields, is_dataclass
from typing import Any

from pydantic import JsonValue

from roslings.judge.faults.base import Fault
from roslings.judge.faults.sentences import SentencePart

WORDS = "words"
"""The key beside the fields of a part of a sentence: which class it is."""


def fields_of(fault: Fault) -> dict[str, JsonValue]:
    """All that a verdict tells of them."""
    return {name: each for name, each in _fields_of(fault).items() if name not in fault.UNTOLD}


def plain(value: Any) -> JsonValue:
    """A value as JSON has it. NaN and the infinities are texts, as they are in evidence."""
    if isinstance(value, float) and not math.isfinite(value):
        return str(value)
    if value is None or isinstance(value, bool | int | float | str):
        return value
    if isinstance(value, SentencePart):
        return {WORDS: type(value).__name__, **_fields_of(value)}
    if is_dataclass(value):
        return _fields_of(value)
    if hasattr(value, "_asdict"):
        return plain(value._asdict())
    return _several(value)


def _several(value: Any) -> JsonValue:
    if isinstance(value, Mapping):
        return {str(key): plain(each) for key, each in value.items()}
    return [plain(each) for each in value] if isinstance(value, Collection) else str(value)


def _fields_of(value: Any) -> dict[str, JsonValue]:
    return {each.name: plain(getattr(value, each.name)) for each in fields(value)}
