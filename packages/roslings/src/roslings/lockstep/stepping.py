"""One message at a time: odom, quiet, scan, quiet, clock, quiet; then the rover goes on.

What a node says after /odom or /scan is obeyed from that moment on. What its timers say is obeyed
from the new time on. No command acts before it was thought of.
"""

from __future__ import annotations

import time
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Protocol

from roslings.lockstep.asleep import Watch
from roslings.lockstep.driven_rover import NS_PER_S, DrivenRoomRover, RoomPlan
from roslings.lockstep.quiet import CAP_S, NeverQuiet, RanNs, ThreadAccount, longest_run_s
from roslings.lockstep.record import End, LockstepDrive, SleeperSeen, VelocityCommand
from roslings.verdict import Frozen
from roslings_rover.rover.in_room import RoomRover

WALL_TIMES = 3.0
"""By the wall clock nothing may be restless for so many times the cap: who wakes up again and again
needs little of a processor. A whole room may take so many times its budget: a busy machine lets all
wait for a processor, and that is nobody's computing."""
LOOKS_AGAIN_S = 0.1
"""So often it is asked how long the nodes compute already."""
BEGINS_S = 1_800_000_000
"""The same in each drive: timers keep to multiples of their period since the clock showed 0."""


class OverBudget(Exception):
    """The nodes used more of a processor than there is for a room."""

    def __init__(self, budget_s: float, robot_s: float) -> None:
        super().__init__(
            f"Your nodes have computed for more than {budget_s:g} s after {robot_s:.1f} s of robot "
            "time. That is too long for each message."
        )


class DriveBudget(Frozen):
    """What nodes may use of a processor, by the kernel's account: a busy machine takes none of it
    away."""

    computing_s: float = 0.5
    """Of a processor, a tick. Then robot time goes on: what is computed counts at a later tick.

    It is a thread's own time on a processor, the first field of /proc/PID/task/TID/schedstat: Linux
    writes `se.sum_exec_runtime` there (proc_pid_schedstat of fs/proc/base.c), in nanoseconds
    (Documentation/scheduler/sched-stats.rst). Waiting for a processor is the second field, and
    does not count.
    """
    cap_s: float = CAP_S
    """Of a processor: so long nothing may run on and on, through all ticks."""
    room_s: float = 120.0
    """Of processors, the whole room: what all nodes have used, together."""
    pace_s: float = 0.0
    """Of wall time: no tick is shorter."""

    def slower(self, times: float, tick_s: float) -> DriveBudget:
        """As if the machine were so many times slower than one that takes `tick_s` for a tick."""
        return DriveBudget(
            computing_s=self.computing_s * times,
            cap_s=self.cap_s * times,
            room_s=self.room_s * times,
            pace_s=tick_s * times,
        )


class LockstepPlan(RoomPlan):
    """A drive beside these nodes."""

    pids: tuple[int, ...]
    """The processes of the nodes, as the world's process sees them; their children belong to
    them."""
    nodes: tuple[str, ...]
    """Their full names; each follows /clock."""
    begins_s: int = BEGINS_S
    """What /clock shows first."""
    budget: DriveBudget = DriveBudget()

    @property
    def longest_s(self) -> float:
        """What it may take of wall time."""
        room_s = WALL_TIMES * self.budget.room_s
        return 2 * self.discovery_s + room_s + 2 * self.budget.cap_s


class WorldTopics(Protocol):
    """What the world says in ROS, and what it hears."""

    def say_odom(self, rover: RoomRover, at_ns: int) -> None:
        """Where the rover is."""

    def say_scan(self, rover: RoomRover, at_ns: int) -> None:
        """What its laser sees."""

    def say_clock(self, at_ns: int) -> None:
        """What time it is."""

    def heard(self) -> list[VelocityCommand]:
        """All commands since the last time."""


class Lockstep:
    """A room, its rover, and the nodes that drive it."""

    def __init__(
        self, plan: LockstepPlan, world_topics: WorldTopics, account: ThreadAccount
    ) -> None:
        self.plan, self.world_topics, self.account = plan, world_topics, account
        self.driven = DrivenRoomRover(plan, plan.begins_s * NS_PER_S)
        self.watch = Watch(account)
        self._began_s = time.monotonic()
        self._used_s = 0.0
        """What the nodes had used before all ticks."""
        self._left_s = 0.0
        """Of what the nodes may compute in this tick."""
        self._quiet_s = self._began_s
        self._rest: RanNs = {}
        """What each thread had run when all were quiet the last time."""
        self._told_s = 0.0
        """So much of what was computed since then has been counted in ticks already."""

    def begin(self) -> None:
        """The clock starts: what the nodes do at their first sight of it comes before all ticks."""
        self._note_quiet()
        self._used_s = self.account.used_s()
        self.world_topics.say_clock(self.driven.now_ns)
        while not self._is_quiet_within(self.plan.budget.computing_s):
            continue
        self.driven.obey(self.world_topics.heard())
        self._began_s, self._used_s = time.monotonic(), self.account.used_s()

    def run(self) -> None:
        """All ticks. Raises NeverQuiet, OverBudget or Gone."""
        for _ in range(self.plan.tick_count):
            self.tick()

    def tick(self) -> None:
        """One of them."""
        driven = self.driven
        with self._paced():
            self._left_s = self.plan.budget.computing_s
            self.world_topics.say_odom(driven.rover, driven.now_ns)
            late, heard = self._settled()
            if driven.scans_now:
                self.world_topics.say_scan(driven.rover, driven.now_ns)
                late, heard = self._settled(heard)
            driven.step()
            self.world_topics.say_clock(driven.now_ns)
            late, heard = self._settled(heard)
            self.watch.look()
            driven.end_tick(heard, late)
        self._keep_to_budget()

    def drive(self, end: End, why: str = "") -> LockstepDrive:
        """The record of all that was."""
        sleepers = [
            SleeperSeen(pid=each.pid, ticks=each.ticks, words=each.words, thread=each.thread)
            for each in self.watch.sleepers
        ]
        return self.driven.record(end, why, time.monotonic() - self._began_s, sleepers)

    def _settled(
        self, before: tuple[VelocityCommand, ...] = ()
    ) -> tuple[bool, tuple[VelocityCommand, ...]]:
        """Wait for quiet, within what is left of the tick; whether it did not come, and what was
        said in this tick so far."""
        late = not self._is_quiet_within(self._left_s)
        heard = self.world_topics.heard()
        self.driven.obey(heard)
        return late, (*before, *heard)

    def _is_quiet_within(self, within_s: float) -> bool:
        """Wait until all is quiet; whether it was before a thread had computed for so long.

        Raises NeverQuiet where nothing has been quiet for too long, through how many ticks.
        """
        while not self.account.is_quiet_within(LOOKS_AGAIN_S):
            computed_s = self._computed_s()
            self._insist_on_quiet(computed_s)
            self._keep_to_budget()
            if computed_s - self._told_s >= within_s:
                self._left_s, self._told_s = 0.0, computed_s
                return False
        self._left_s = max(0.0, within_s - (self._computed_s() - self._told_s))
        self._note_quiet()
        return True

    def _note_quiet(self) -> None:
        self._quiet_s = time.monotonic()
        self._rest, self._told_s = self.account.ran_ns(), 0.0

    def _insist_on_quiet(self, computed_s: float) -> None:
        """Raises NeverQuiet."""
        waited_s, cap_s = time.monotonic() - self._quiet_s, self.plan.budget.cap_s
        if computed_s > cap_s or waited_s > WALL_TIMES * cap_s:
            raise NeverQuiet(waited_s, self.account.look().busy)

    def _computed_s(self) -> float:
        """The longest that one thread had a processor since all were quiet."""
        return longest_run_s(self._rest, self.account.ran_ns())

    @contextmanager
    def _paced(self) -> Iterator[None]:
        """No shorter than the budget's pace."""
        ends_s = time.monotonic() + self.plan.budget.pace_s
        yield
        time.sleep(max(0.0, ends_s - time.monotonic()))

    def _keep_to_budget(self) -> None:
        if self.account.used_s() - self._used_s > self.plan.budget.room_s:
            raise OverBudget(self.plan.budget.room_s, len(self.driven.ticks) * self.plan.period_s)
