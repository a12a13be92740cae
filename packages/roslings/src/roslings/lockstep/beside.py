"""Begin the world beside the nodes, and read what it has recorded."""

from __future__ import annotations

import threading
import time
from pathlib import Path

from roslings.arena.companion import Companion, Surroundings
from roslings.lockstep.real_time import RealTimePlan
from roslings.lockstep.record import LockstepDrive
from roslings.lockstep.stepping import LockstepPlan

PROGRAM = Path(__file__).with_name("program.py")
STARTS_WITHIN_S = 60.0
LOOKS_AGAIN_S = 0.5


class NoDrive(Exception):
    """The world's own program failed: no fault of the nodes."""

    def __init__(self, why: str) -> None:
        super().__init__(f"The world of this room has failed: {why}")


class LateDrive(NoDrive):
    """This computer was too busy."""

    def __init__(self) -> None:
        super().__init__("it did not end in time")


def drive_beside(
    plan: LockstepPlan | RealTimePlan,
    around: Surroundings,
    folder: Path,
    called_off: threading.Event | None = None,
) -> LockstepDrive:
    """Drive beside nodes that run already. Raises NoDrive. `folder` is one that no node can see.

    `around` names no sandbox: in one, the world would not see the nodes in /proc. Another thread
    may set `called_off`: then the drive breaks off.
    """
    if around.sandbox:
        raise ValueError("in a sandbox of its own the world cannot see the nodes")
    file = folder / f"drive-{time.monotonic_ns()}.json"
    called_off = called_off or threading.Event()
    changed = threading.Condition()

    def notify() -> None:
        with changed:
            changed.notify_all()

    clock = "real_time" if isinstance(plan, RealTimePlan) else "lockstep"
    order = {clock: plan.model_dump(mode="json"), "file": str(file)}
    with Companion(PROGRAM, order, around, notify) as world, changed:
        ends_s = time.monotonic() + STARTS_WITHIN_S + plan.longest_s
        while not (world.told("driven") or world.told("failed")):
            if time.monotonic() > ends_s:
                raise LateDrive
            if called_off.is_set():
                raise NoDrive("it was called off")
            changed.wait(LOOKS_AGAIN_S)
        for failure in world.told("failed"):
            raise NoDrive(str(failure["failed"]))
    return LockstepDrive.read(file)
