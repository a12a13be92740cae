"""One message at a time: odom, quiet, scan, quiet, clock, quiet; then the rover goes on.

What a node says after /odom or /scan is obeyed from that moment on, what its timers say from the
new time on: no command acts before it was thought of.
"""

from __future__ import annotations

import math
import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Protocol

from roslings.lockstep.asleep import Watch
from roslings.lockstep.quiet import CAP_S, Account, NeverQuiet
from roslings.lockstep.record import BumpSeen, CommandSeen, Drive, DriveTick, End, SleeperSeen
from roslings.verdict import Frozen
from roslings_rover.models.differential_drive import Motion
from roslings_rover.models.rooms import room_of
from roslings_rover.rover.in_room import RoomRover

NS_PER_S = 10**9
BEGINS_S = 1_800_000_000
"""The same in each drive: timers keep to multiples of their period since the clock showed 0."""


class OverBudget(Exception):
    """A room took more wall time than there is for it."""

    def __init__(self, budget_s: float, robot_s: float) -> None:
        super().__init__(
            f"The {budget_s:g} s of wall time for this room were over after {robot_s:.1f} s of "
            "robot time. Your nodes compute too long for each message."
        )


class Budget(Frozen):
    """What wall time there is."""

    computing_s: float = 0.5
    """A tick; then time goes on, and what is computed still counts at a later tick."""
    cap_s: float = CAP_S
    """So long nothing may run on and on, through all ticks."""
    room_s: float = 120.0
    """The whole room."""
    pace_s: float = 0.0
    """No tick is shorter than this."""

    def slower(self, times: float, tick_s: float) -> Budget:
        """As if the machine were so many times slower than one that takes `tick_s` for a tick."""
        return Budget(
            computing_s=self.computing_s * times,
            cap_s=self.cap_s * times,
            room_s=self.room_s * times,
            pace_s=tick_s * times,
        )


class Plan(Frozen):
    """A drive: its room, how long, and beside whom."""

    room: int
    """Its seed."""
    pids: tuple[int, ...]
    """The processes of the nodes, as the world's process sees them; their children belong to
    them."""
    nodes: tuple[str, ...]
    """Their full names; each follows /clock."""
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
    begins_s: int = BEGINS_S
    """What /clock shows first."""
    discovery_s: float = 20.0
    """Of wall time, until all nodes are found."""
    budget: Budget = Budget()

    @property
    def tick_count(self) -> int:
        """Whole ticks."""
        return round(self.length_s / self.period_s)

    @property
    def period_ns(self) -> int:
        """The same as whole nanoseconds, so that sums are exact."""
        return round(self.period_s * NS_PER_S)


class Voice(Protocol):
    """What the world says in ROS, and what it hears."""

    def say_odom(self, rover: RoomRover, at_ns: int) -> None:
        """Where the rover is."""

    def say_scan(self, rover: RoomRover, at_ns: int) -> None:
        """What its laser sees."""

    def say_clock(self, at_ns: int) -> None:
        """What time it is."""

    def heard(self) -> list[CommandSeen]:
        """All commands since the last time."""


class Lockstep:
    """A room, its rover, and the nodes that drive it."""

    def __init__(self, plan: Plan, voice: Voice, account: Account) -> None:
        self.plan, self.voice, self.account = plan, voice, account
        self.rover = RoomRover(room_of(plan.room), plan.noise_seed)
        self.watch = Watch(account)
        self.ticks: list[DriveTick] = []
        self.refused = 0
        self._now_ns = plan.begins_s * NS_PER_S
        self._told_ns = self._now_ns
        self._quiet_s = time.monotonic()
        self._began_s = self._quiet_s
        self._left_s = 0.0
        """Of what the nodes may compute in this tick."""

    def begin(self) -> None:
        """The clock starts: what the nodes do at their first sight of it comes before all ticks."""
        self._quiet_s = time.monotonic()
        self.voice.say_clock(self._now_ns)
        while not self._is_quiet_within(self.plan.budget.computing_s):
            continue
        self._obey(self.voice.heard())
        self._began_s = time.monotonic()

    def run(self) -> None:
        """All ticks. Raises NeverQuiet, OverBudget or Gone."""
        for _ in range(self.plan.tick_count):
            self.tick()

    def tick(self) -> None:
        """One of them."""
        with self._paced():
            self._left_s = self.plan.budget.computing_s
            self.voice.say_odom(self.rover, self._now_ns)
            late, heard = self._settled()
            if len(self.ticks) % self.plan.scan_every_ticks == 0:
                self.voice.say_scan(self.rover, self._now_ns)
                late, heard = self._settled(heard)
            self.rover.step(self.plan.period_s)
            self._now_ns += self.plan.period_ns
            self.voice.say_clock(self._now_ns)
            late, heard = self._settled(heard)
            self.watch.look()
            self._stop_without_commands()
            self._write(heard, late)
        self._keep_to_budget()

    def drive(self, end: End, why: str = "") -> Drive:
        """The record of all that was."""
        return Drive(
            room=self.plan.room,
            period_s=self.plan.period_s,
            end=end,
            why=why,
            ticks=tuple(self.ticks),
            bumps=tuple(
                BumpSeen(time_s=b.time_s, x_m=b.pose.x_m, y_m=b.pose.y_m, moving=b.moving)
                for b in self.rover.bumps
            ),
            sleepers=tuple(
                SleeperSeen(pid=each.pid, ticks=each.ticks, words=each.words)
                for each in self.watch.sleepers
            ),
            refused_commands=self.refused,
            way_m=self.rover.way_m,
            wall_s=time.monotonic() - self._began_s,
        )

    def _settled(
        self, before: tuple[CommandSeen, ...] = ()
    ) -> tuple[bool, tuple[CommandSeen, ...]]:
        """Wait for quiet, within what is left of the tick; whether it did not come, and what was
        said in this tick so far."""
        began_s = time.monotonic()
        late = not self._is_quiet_within(self._left_s)
        self._left_s = max(0.0, self._left_s - (time.monotonic() - began_s))
        heard = self.voice.heard()
        self._obey(heard)
        return late, (*before, *heard)

    def _is_quiet_within(self, within_s: float) -> bool:
        """Raises NeverQuiet where nothing has been quiet for too long, through how many ticks."""
        if self.account.is_quiet_within(within_s):
            self._quiet_s = time.monotonic()
            return True
        waited_s = time.monotonic() - self._quiet_s
        if waited_s > self.plan.budget.cap_s:
            raise NeverQuiet(waited_s, self.account.look().busy)
        return False

    def _obey(self, commands: list[CommandSeen]) -> None:
        for command in commands:
            try:
                self.rover.drive(Motion(command.forward_m_s, command.turn_rad_s))
            except ValueError:
                self.refused += 1
                continue
            self._told_ns = self._now_ns

    def _stop_without_commands(self) -> None:
        if self._now_ns - self._told_ns > self.plan.command_lasts_s * NS_PER_S:
            self.rover.drive(Motion())

    def _write(self, commands: tuple[CommandSeen, ...], late: bool) -> None:
        pose = self.rover.pose
        self.ticks.append(
            DriveTick(
                time_s=round((len(self.ticks) + 1) * self.plan.period_s, 9),
                x_m=pose.x_m,
                y_m=pose.y_m,
                heading_rad=pose.heading_rad,
                commands=tuple(filter(_is_finite, commands)),
                late=late,
            )
        )

    @contextmanager
    def _paced(self) -> Iterator[None]:
        """No shorter than the budget's pace."""
        ends_s = time.monotonic() + self.plan.budget.pace_s
        yield
        time.sleep(max(0.0, ends_s - time.monotonic()))

    def _keep_to_budget(self) -> None:
        if time.monotonic() - self._began_s > self.plan.budget.room_s:
            raise OverBudget(self.plan.budget.room_s, len(self.ticks) * self.plan.period_s)


def _is_finite(command: CommandSeen) -> bool:
    return math.isfinite(command.forward_m_s) and math.isfinite(command.turn_rad_s)
