"""How long a lab's nodes run where the result counts: in `grade`, `pack` and for platforms."""

from __future__ import annotations

import os

from roslings.course.card import Card
from roslings.course.files import CourseError

SOAK = "ROSLINGS_SOAK_S"
"""An environment variable: seconds for all labs, in place of those of their cards; 0 for none."""


class BadSoak(CourseError):
    """The environment says no number of seconds."""


def soak_seconds(card: Card, asked: float | None = None) -> float:
    """What was asked for; else what the environment says, else the card. Raises BadSoak."""
    if asked is not None:
        return asked
    text = os.environ.get(SOAK)
    if not text:
        return card.soak_s
    try:
        seconds = float(text)
    except ValueError:
        raise BadSoak(f"{SOAK}={text!r} is no number of seconds; 0 is for none.") from None
    return min(600.0, max(0.0, seconds))
