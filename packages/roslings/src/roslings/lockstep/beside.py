"""Begin the world beside the nodes, and read what it has recorded."""

from __future__ import annotations

import threading
import time
from pathlib import Path

from roslings.arena.companion import Companion, Surroundings
from roslings.lockstep.record import Drive
from roslings.lockstep.stepping import Plan

PROGRAM = Path(__file__).with_name("program.py")
STARTS_WITHIN_S = 30.0
LOOKS_AGAIN_S = 0.5


class NoDrive(Exception):
    """The world's own program failed: no fault of the nodes."""

    def __init__(self, why: str) -> None:
        super().__init__(f"The world of this room has failed: {why}")


def drive_beside(plan: Plan, around: Surroundings, folder: Path) -> Drive:
    """Drive beside nodes that run already. Raises NoDrive. `folder` is one that no node can see.

    `around` names no sandbox: in one, the world would not see the nodes in /proc.
    """
    if around.sandbox:
        raise ValueError("in a sandbox of its own the world cannot see the nodes")
    file = folder / f"drive-{time.monotonic_ns()}.json"
    changed = threading.Condition()

    def notify() -> None:
        with changed:
            changed.notify_all()

    order = {"plan": plan.model_dump(mode="json"), "file": str(file)}
    with Companion(PROGRAM, order, around, notify) as world, changed:
        ends_s = time.monotonic() + _longest_s(plan)
        while not (world.told("driven") or world.told("failed")):
            if time.monotonic() > ends_s:
                raise NoDrive("it did not end in time")
            changed.wait(LOOKS_AGAIN_S)
        for failure in world.told("failed"):
            raise NoDrive(str(failure["failed"]))
    return Drive.read(file)


def _longest_s(plan: Plan) -> float:
    """What it may take of wall time, all in all."""
    budget = plan.budget
    return STARTS_WITHIN_S + 2 * plan.discovery_s + budget.room_s + 2 * budget.cap_s
