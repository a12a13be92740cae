"""Values of messages, answers and results: when two are the same, and how one is told.

Whoever compares a number with the card's does it here. How far off still counts is a word of the
card, `numbers_within`.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

from roslings.course.contract import NUMBERS_WITHIN
from roslings.judge.faults.sentences import SentencePart, one_of

Fields = Mapping[str, object]
"""What a message holds, by the names of its fields. What a field is, only its reader knows."""


def field_of(content: object, name: str) -> object:
    """A field, with dots that lead into fields; None where there is none."""
    for step in name.split("."):
        content = content.get(step) if isinstance(content, dict) else None
    return content


def number_of(content: object, name: str) -> float:
    """A field that is a number, with dots as above. Raises TypeError where it is none."""
    number = as_number(field_of(content, name))
    if number is None:
        raise TypeError(f"the field {name!r} is no number in {content!r}")
    return number


def same(found: Any, wanted: Any, within: float = NUMBERS_WITHIN) -> bool:
    """Equal. Whole numbers to the last digit, others as far as `within` says; NaN is NaN."""
    if isinstance(wanted, bool) or not isinstance(wanted, int | float):
        return bool(found == wanted)
    if _is_whole(wanted) and _is_whole(found):
        return bool(found == wanted)
    number = as_number(found)
    if number is None or math.isnan(number) or math.isnan(wanted):
        return number is not None and math.isnan(number) and math.isnan(wanted)
    return math.isclose(number, wanted, rel_tol=within, abs_tol=within)


def _is_whole(value: Any) -> bool:
    return isinstance(value, int) and not isinstance(value, bool)


def as_number(value: Any) -> float | None:
    """A number of the evidence, where NaN and the infinities are texts; None for other things."""
    if isinstance(value, bool) or value is None:
        return None
    try:
        return float(value)
    except (TypeError, ValueError):
        return None


def shown(value: Any) -> str:
    """A value in words: four digits are enough."""
    if isinstance(value, bool):
        return str(value).lower()
    number = as_number(value)
    if number is None:
        return repr(value)
    if math.isinf(number):
        return "+infinity" if number > 0 else "-infinity"
    short = f"{number:.4g}"
    return "NaN" if math.isnan(number) else f"{number:.6f}" if "e-" in short else short


Like = Literal[
    "twice",
    "half",
    "sign",
    "hundred",
    "thousand",
    "hundredth",
    "thousandth",
    "degrees",
    "radians",
    "infinite",
]
LOOKS_LIKE: Mapping[float, Like] = {
    2.0: "twice",
    0.5: "half",
    -1.0: "sign",
    100.0: "hundred",
    1000.0: "thousand",
    0.01: "hundredth",
    0.001: "thousandth",
    math.degrees(1): "degrees",
    math.radians(1): "radians",
}
"""Found over wanted to what is probably the reason."""


@dataclass(frozen=True)
class Looks(SentencePart):
    """What a wrong number looks like."""

    like: Like
    text = one_of(
        twice="twice as much",
        half="half of it",
        sign="with the wrong sign",
        hundred="a hundred times as much: in cm, or in percent?",
        thousand="a thousand times as much: in mm?",
        hundredth="a hundredth of it: divided by 100 once too often?",
        thousandth="a thousandth of it: divided by 1000 once too often?",
        degrees="180/pi times as much: in degrees?",
        radians="pi/180 of it: turned into radians once too often?",
        infinite="as if it were out of range: compare the units, and the limits",
    )

    @property
    def which_text(self) -> str:
        """The probable reason."""
        return self.like


def looks_of(found: Any, wanted: Any) -> Looks | None:
    """What the wrong number looks like; None where it looks like nothing."""
    goal, number = as_number(wanted), as_number(found)
    if not goal or number is None or not math.isfinite(goal) or math.isnan(number):
        return None
    if math.isinf(number):
        return Looks("infinite")
    close = (
        like for of, like in LOOKS_LIKE.items() if math.isclose(number / goal, of, rel_tol=0.02)
    )
    return next(map(Looks, close), None)
