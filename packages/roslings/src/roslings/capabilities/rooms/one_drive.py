"""One drive: nodes that are started for it, in a domain of its own, and the world beside them."""

from __future__ import annotations

import os
import secrets
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from ros2_on_pip.domain_lease import leased_domain
from roslings.arena import Process
from roslings.arena.companion import Surroundings
from roslings.capabilities.rooms.contract import RoomsContract
from roslings.capabilities.rooms.drivers import MARK, DriveDomain, RoomDriver
from roslings.capabilities.rooms.processes import marked
from roslings.capabilities.rooms.seeds import RoomToDrive
from roslings.experiment import Scene
from roslings.experiment.on_the_wall import longest_wait_s
from roslings.lockstep import (
    DriveBudget,
    LockstepDrive,
    LockstepPlan,
    NoAccount,
    RealTimePlan,
    drive_beside,
)
from roslings.lockstep.driven_rover import RoomPlan
from roslings.lockstep.record import End

BUDGET_TIMES, LEAST_BUDGET_S = 2.0, 30.0
"""Of processors the nodes may use so many times the room's robot time, and so long in any case. A
node with one timer takes some hundredths of it."""
STARTS_WITHIN_S, ENDS_WITHIN_S = 20.0, 2.0
LOOKS_AGAIN_S = 0.05
HIDDEN = "/proc shows no processes of others"
ENDED = "The node ended before the room was there."
UNSTARTED = "The launch file has started no executable of the package."


@dataclass(frozen=True)
class Driven:
    """A drive, and what became of the nodes."""

    drive: LockstepDrive
    ended: str = ""
    """The process that ended before its time, by its name in the evidence."""
    held_s: float = 0.0
    """The longest time that a thread of the nodes was ready to run, and no processor was free."""


@dataclass(frozen=True)
class BegunDriver:
    """Nodes that run, and where."""

    process: Process
    mark: str
    around: Surroundings
    """Of the world: what its own process is told."""


@dataclass(frozen=True)
class DriveStage:
    """What all drives of an experiment have in common."""

    scene: Scene
    driver: RoomDriver
    contract: RoomsContract
    folder: Path
    """For records; no node can see it."""
    called_off: threading.Event

    @property
    def budget(self) -> DriveBudget:
        """What the nodes may use of processors in one room."""
        return DriveBudget(room_s=max(BUDGET_TIMES * self.contract.drives_s, LEAST_BUDGET_S))

    def in_lockstep(self, room: RoomToDrive, budget: DriveBudget) -> Driven:
        """One drive by /clock."""
        with self.begun(room, simulated=True) as begun:
            pids = self._pids(begun)
            drive = self._beside(room, begun, pids, budget) if pids else _undriven(room, begun)
            if drive.end == "a node ended":
                return Driven(drive, self._noted(room, begun.process))
        self._note_what_it_wrote(room, begun.process)
        return Driven(drive)

    def in_real_time(self, room: RoomToDrive, begun: BegunDriver) -> Driven:
        """One drive by the wall clock, beside nodes that run already."""
        process = begun.process
        before_ns = process.waits_ns()
        plan = RealTimePlan(room=room.seed, length_s=self.contract.drives_s, noise_seed=room.seed)
        drive = drive_beside(plan, begun.around, self.folder, self.called_off)
        now_ns = process.waits_ns()
        ended = "" if process.alive else self._noted(room, process)
        return Driven(drive, ended, longest_wait_s(before_ns, now_ns) if now_ns else 0.0)

    @contextmanager
    def begun(self, room: RoomToDrive, simulated: bool) -> Iterator[BegunDriver]:
        """Start the nodes, until the block ends."""
        mark = f"{MARK}{secrets.token_hex(8)}"
        with leased_domain() as number:
            around = Surroundings({**os.environ, "ROS_DOMAIN_ID": str(number)})
            domain = DriveDomain.numbered(number)
            started = self.driver.begun(self.scene, room.side, domain, mark, simulated)
            with started as process:
                yield BegunDriver(process, mark, around)

    def _pids(self, begun: BegunDriver) -> tuple[int, ...]:
        """The nodes' processes, as soon as all are there; those that are, when they are late."""
        ends_s = time.monotonic() + STARTS_WITHIN_S
        while True:
            pids = self.driver.pids(begun.mark)
            is_late = time.monotonic() > ends_s or self.called_off.is_set()
            if len(pids) >= len(self.driver.nodes) or is_late or not begun.process.alive:
                return pids
            time.sleep(LOOKS_AGAIN_S)

    def _beside(
        self, room: RoomToDrive, begun: BegunDriver, pids: tuple[int, ...], budget: DriveBudget
    ) -> LockstepDrive:
        plan = LockstepPlan(
            room=room.seed,
            length_s=self.contract.drives_s,
            noise_seed=room.seed,
            pids=pids,
            nodes=tuple(self.driver.nodes),
            budget=budget,
        )
        return drive_beside(plan, begun.around, self.folder, self.called_off)

    def _note_what_it_wrote(self, room: RoomToDrive, process: Process) -> None:
        """Of a process that has ended as it should; most write nothing."""
        if process.lines():
            self._keep(room, process)

    def _noted(self, room: RoomToDrive, process: Process) -> str:
        """Keep what it wrote and how it ended."""
        process.wait_ended(ENDS_WITHIN_S)  # a launch goes on without its node
        return self._keep(room, process)

    def _keep(self, room: RoomToDrive, process: Process) -> str:
        """Under a name of its own, for it is one of many."""
        label = f"{self.driver.label} in room {room.seed}"
        kept = process.seen.model_copy(update={"lines": process.lines()})
        self.scene.seen.processes[label] = kept
        return label


def _undriven(room: RoomToDrive, begun: BegunDriver) -> LockstepDrive:
    """No process of the nodes is to be seen: why, and no tick."""
    if not begun.process.alive:
        return _without_ticks(room, "a node ended", ENDED)
    if marked(begun.mark):
        return _without_ticks(room, "nobody follows", UNSTARTED)
    return _without_ticks(room, "no account", str(NoAccount(HIDDEN)))


def _without_ticks(room: RoomToDrive, end: End, why: str) -> LockstepDrive:
    plan = RoomPlan(room=room.seed)
    return LockstepDrive(room=plan.room, period_s=plan.period_s, end=end, why=why)
