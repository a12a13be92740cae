"""A rover in the room of a seed: it obeys the commands that come, and its drive is recorded."""

from __future__ import annotations

import math
from collections.abc import Sequence

from roslings.lockstep.record import (
    BumpSeen,
    DriveTick,
    End,
    LockstepDrive,
    SleeperSeen,
    VelocityCommand,
)
from roslings.verdict import Frozen
from roslings_rover.models.differential_drive import Motion
from roslings_rover.models.rooms import moving_in, room_of
from roslings_rover.rover.in_room import RoomRover

NS_PER_S = 10**9


class RoomPlan(Frozen):
    """A drive: its room, and how long."""

    room: int
    """Its seed."""
    length_s: float = 60.0
    """Of robot time."""
    period_s: float = 0.05
    """Of robot time, a tick."""
    scan_every_ticks: int = 4
    """The rover's scanner turns five times a second."""
    command_lasts_s: float = 0.5
    """Of robot time: the rover then stops by itself."""
    noise_seed: int = 0
    """Of the sensors."""
    discovery_s: float = 20.0
    """Of wall time, until all nodes are found."""

    @property
    def tick_count(self) -> int:
        """Whole ticks."""
        return round(self.length_s / self.period_s)

    @property
    def period_ns(self) -> int:
        """The same as whole nanoseconds, so that sums are exact."""
        return round(self.period_s * NS_PER_S)


class DrivenRoomRover:
    """The rover, by robot time: each tick is one period later than the one before."""

    def __init__(self, plan: RoomPlan, begins_ns: int) -> None:
        self.plan = plan
        self.rover = RoomRover(room_of(plan.room), plan.noise_seed)
        self.ticks: list[DriveTick] = []
        self.refused = 0
        self.stray = ""
        self.now_ns = begins_ns
        self._told_ns = begins_ns

    @property
    def scans_now(self) -> bool:
        """In this tick the scanner has turned once more."""
        return len(self.ticks) % self.plan.scan_every_ticks == 0

    def obey(self, commands: Sequence[VelocityCommand]) -> None:
        """Follow each in turn; one that is no finite number is refused, and counted."""
        for command in commands:
            self.stray = self.stray or command.stray
            try:
                self.rover.drive(Motion(command.forward_m_s, command.turn_rad_s))
            except ValueError:
                self.refused += 1
                continue
            self._told_ns = self.now_ns

    def step(self, part: int = 1) -> None:
        """Let a period go by, or the whole part of one."""
        self.rover.step(self.plan.period_s / part)
        self.now_ns += self.plan.period_ns // part

    def end_tick(self, commands: Sequence[VelocityCommand], late: bool = False) -> None:
        """Write down what was said in it; who has said nothing for long stops the rover."""
        if self.now_ns - self._told_ns > self.plan.command_lasts_s * NS_PER_S:
            self.rover.drive(Motion())
        pose = self.rover.pose
        self.ticks.append(
            DriveTick(
                time_s=round((len(self.ticks) + 1) * self.plan.period_s, 9),
                x_m=pose.x_m,
                y_m=pose.y_m,
                heading_rad=pose.heading_rad,
                commands=tuple(filter(_is_finite, commands)),
                moving=tuple((each.x_m, each.y_m) for each in moving_in(self.rover.world)),
                late=late,
            )
        )

    def record(
        self, end: End, why: str, wall_s: float, sleepers: Sequence[SleeperSeen] = ()
    ) -> LockstepDrive:
        """All that was, so far."""
        return LockstepDrive(
            room=self.plan.room,
            period_s=self.plan.period_s,
            end=end,
            why=why,
            ticks=tuple(self.ticks),
            bumps=tuple(
                BumpSeen(time_s=b.time_s, x_m=b.pose.x_m, y_m=b.pose.y_m, moving=b.moving)
                for b in self.rover.bumps
            ),
            sleepers=tuple(sleepers),
            refused_commands=self.refused,
            stray=self.stray,
            way_m=self.rover.way_m,
            wall_s=wall_s,
        )


def _is_finite(command: VelocityCommand) -> bool:
    return math.isfinite(command.forward_m_s) and math.isfinite(command.turn_rad_s)
