"""The same room in real time: for nodes that lockstep cannot tell of.

The world goes on by the wall clock, whatever the nodes do, and says nothing on /clock. Two drives
of one package are never equal here: whoever judges one needs bands.
"""

from __future__ import annotations

import time
from typing import Protocol

from roslings.lockstep.driven_rover import DrivenRoomRover, RoomPlan
from roslings.lockstep.record import LockstepDrive, VelocityCommand
from roslings_rover.rover.in_room import RoomRover

STEPS_A_TICK = 5
"""So often in a tick commands are taken: a command acts within 10 ms, as on a real rover."""


class RealTimePlan(RoomPlan):
    """A drive by the wall clock: no process of the nodes need be known."""

    @property
    def longest_s(self) -> float:
        """What it may take of wall time."""
        return self.discovery_s + 2 * self.length_s


class RealTimeTopics(Protocol):
    """What the world says in ROS, and what it hears."""

    def await_driver(self, within_s: float) -> bool:
        """Wait for somebody who listens and drives; whether there is one."""

    def say_odom(self, rover: RoomRover, at_ns: int) -> None:
        """Where the rover is."""

    def say_scan(self, rover: RoomRover, at_ns: int) -> None:
        """What its laser sees."""

    def heard(self) -> list[VelocityCommand]:
        """All commands since the last time."""


class RealTime:
    """A room, its rover, and whoever drives it."""

    def __init__(self, plan: RealTimePlan, world_topics: RealTimeTopics) -> None:
        self.plan, self.world_topics = plan, world_topics
        self._stall_s = 0.0

    def run(self) -> LockstepDrive:
        """All ticks. Where nobody is there to drive, the rover stands in its room."""
        self.world_topics.await_driver(self.plan.discovery_s)
        self.world_topics.heard()
        driven = DrivenRoomRover(self.plan, time.time_ns())
        began_s = time.monotonic()
        for number in range(self.plan.tick_count):
            self._tick(driven, began_s + number * self.plan.period_s)
        drive = driven.record("done", "", time.monotonic() - began_s)
        return drive.model_copy(update={"stall_s": self._stall_s})

    def _tick(self, driven: DrivenRoomRover, begins_s: float) -> None:
        self.world_topics.say_odom(driven.rover, driven.now_ns)
        if driven.scans_now:
            self.world_topics.say_scan(driven.rover, driven.now_ns)
        said: list[VelocityCommand] = []
        for step in range(1, STEPS_A_TICK + 1):
            self._sleep_until(begins_s + step * self.plan.period_s / STEPS_A_TICK)
            heard = self.world_topics.heard()
            driven.obey(heard)
            driven.step(STEPS_A_TICK)
            said += heard
        driven.end_tick(said)

    def _sleep_until(self, due_s: float) -> None:
        """This computer's own lateness is written down: it makes the nodes late, too."""
        time.sleep(max(0.0, due_s - time.monotonic()))
        self._stall_s = max(self._stall_s, time.monotonic() - due_s)
