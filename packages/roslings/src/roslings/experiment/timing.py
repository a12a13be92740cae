"""Stretches whose times are judged, and what held the nodes and their observer up meanwhile."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from roslings.evidence import HeldUpSeen
from roslings.experiment.own_time import OwnTime
from roslings.experiment.scene import Scene


@contextmanager
def timing(scene: Scene, part: str) -> Iterator[None]:
    """A timed stretch, beside which no node starts up; `part` is its name in the evidence.

    >>> with timing(scene, "row"):
    ...     caller.send({"data": True}).wait(5.0)
    """
    with scene.timed(), accounting(scene, part):
        yield


@contextmanager
def accounting(scene: Scene, part: str) -> Iterator[None]:
    """The same for a stretch that cannot wait until the others have started up."""
    seen, own = scene.seen, OwnTime(scene.arena)
    before_s, seen.stall_s = seen.stall_s, 0.0
    try:
        yield
    finally:
        seen.held_up[part] = _worse(seen.held_up.get(part), own.waited_s(), seen.stall_s)
        seen.stall_s = max(seen.stall_s, before_s)


def _worse(before: HeldUpSeen | None, cpu_wait_s: float, stall_s: float) -> HeldUpSeen:
    """What several stretches of one name say together."""
    if before is None:
        return HeldUpSeen(cpu_wait_s=cpu_wait_s, stall_s=stall_s)
    return HeldUpSeen(
        cpu_wait_s=max(before.cpu_wait_s, cpu_wait_s), stall_s=max(before.stall_s, stall_s)
    )
