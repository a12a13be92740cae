"""The steps of a walk: what they are called, and how long each may take.

It starts nothing, so that evidence is judged with it alone.
"""

from __future__ import annotations

from collections.abc import Mapping

from graders.e_stop.contract import StopContract
from graders.e_stop.orders import Happens

BUTTON_COMES = frozenset({Happens.JOIN, Happens.SECOND_JOINS})
BEGUN = 0
"""The step before the first event."""


def part_of(walk: int, step: int) -> str:
    """The name of a step's stretch."""
    return f"walk {walk}, step {step}"


def takes_s(event: Happens, stops: Mapping[str, StopContract]) -> float:
    """How long after an event a guard may still do as before; 0: the event gives no reason."""
    if event in {Happens.FREEZE, Happens.LEAVE, Happens.SECOND_LEAVES}:
        return stops["lost"].within_s
    if event is Happens.SILENCE:
        return stops["silent"].within_s
    if event is Happens.PRESS or event in BUTTON_COMES:
        return stops["pressed"].within_s
    return 0.0
