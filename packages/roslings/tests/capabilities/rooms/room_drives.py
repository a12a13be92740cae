"""Drives made by hand, tick by tick: twenty ticks are a second."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from roslings.capabilities.rooms.record import RoomBump, RoomDriveSeen, RoomsSeen, RoomTick
from roslings.evidence import ExperimentSeen
from roslings.judge import ExperimentView

PERIOD_S = 0.05
HULL_M = 0.12
FREE_M = 9.0
"""Nothing is near."""


def tick(x_m: float = 0.0, y_m: float = 0.0, **words: Any) -> RoomTick:
    """The rover at a place, driving, with nothing near."""
    usual = {
        "heading_rad": 0.0,
        "forward_m_s": 0.2,
        "turn_rad_s": 0.0,
        "left_m": FREE_M,
        "right_m": FREE_M,
        "nearest_m": FREE_M,
    }
    return RoomTick.model_validate({"x_m": x_m, "y_m": y_m, **usual, **words})


def straight(count: int, step_m: float = 0.01, **words: Any) -> list[RoomTick]:
    """Along x."""
    return [tick(number * step_m, **words) for number in range(count)]


def beside(*distances_m: float, side: str = "left") -> list[RoomTick]:
    """A tick at each distance from a wall."""
    return [
        tick(number * 0.01, **{f"{side}_m": each_m}) for number, each_m in enumerate(distances_m)
    ]


def thing(ahead_m: float, left_m: float = 0.0, radius_m: float = 0.1) -> dict[str, float]:
    """Something that moves, as a tick has it: by its middle, and from the hull."""
    apart_m = (ahead_m**2 + left_m**2) ** 0.5
    return {
        "moving_m": apart_m - radius_m - HULL_M,
        "moving_ahead_m": ahead_m,
        "moving_left_m": left_m,
    }


NEAR, AWAY = thing(0.5), thing(2.0)
"""Something in the way, and far from it."""


def drive(ticks: Sequence[RoomTick] = (), **words: Any) -> RoomDriveSeen:
    """In lockstep, in a room of the student's choice."""
    usual = {"seed": 17, "kind": "open", "chosen": True, "side": "left", "clock": "lockstep"}
    return RoomDriveSeen.model_validate({**usual, "period_s": PERIOD_S, "ticks": [*ticks], **words})


def bump(time_s: float, moving: bool = False) -> RoomBump:
    """A touch."""
    return RoomBump(time_s=time_s, x_m=1.0, y_m=-0.5, moving=moving)


def seen(*drives: RoomDriveSeen, **words: Any) -> ExperimentView:
    """An experiment with these drives."""
    part = {"rooms": RoomsSeen(drives=[*drives])}
    return ExperimentView(ExperimentSeen(name="own", clock="wall", parts=part, **words))
