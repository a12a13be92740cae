"""Values of messages, answers and results: when two are the same, and how one is told.

Whoever compares a number with the card's does it here. How far off still counts is a word of the
card, `numbers_within`.
"""

from __future__ import annotations

import math
from typing import Any

from roslings.course.contract import NUMBERS_WITHIN


def field_of(content: Any, name: str) -> Any:
    """A field, with dots that lead into fields; None where there is none."""
    for step in name.split("."):
        content = content.get(step) if isinstance(content, dict) else None
    return content


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


LOOKS_LIKE = {
    2.0: "twice as much",
    0.5: "half of it",
    -1.0: "with the wrong sign",
    100.0: "a hundred times as much: in cm, or in percent?",
    1000.0: "a thousand times as much: in mm?",
    0.01: "a hundredth of it: divided by 100 once too often?",
    0.001: "a thousandth of it: divided by 1000 once too often?",
    math.degrees(1): "180/pi times as much: in degrees?",
    math.radians(1): "pi/180 of it: turned into radians once too often?",
}
"""Found over wanted to what is probably the reason."""


def remark(found: Any, wanted: Any) -> str:
    """What the wrong number looks like."""
    goal, number = as_number(wanted), as_number(found)
    if not goal or number is None or not math.isfinite(goal):
        return ""
    if math.isinf(number):
        return ", as if it were out of range: compare the units, and the limits"
    if math.isnan(number):
        return ""
    for factor, words in LOOKS_LIKE.items():
        if math.isclose(number / goal, factor, rel_tol=0.02):
            return f", {words}"
    return ""
