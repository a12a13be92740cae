"""The record of one drive: what was said and done at each tick. A grader reads it later."""

from __future__ import annotations

from pathlib import Path
from typing import Literal

from roslings.verdict import Frozen

End = Literal["done", "never quiet", "over budget", "a node ended", "nobody follows", "no account"]


class VelocityCommand(Frozen):
    """A /cmd_vel: what the rover takes of it."""

    forward_m_s: float
    turn_rad_s: float
    stray: str = ""
    """The first of the other fields that is not 0, as `linear.y is 1.0`: this rover has no use for
    it."""


class DriveTick(Frozen):
    """One step of the clock."""

    time_s: float
    """Robot time since the start, when the tick was over."""
    x_m: float
    y_m: float
    heading_rad: float
    commands: tuple[VelocityCommand, ...] = ()
    """All that were heard in this tick, in their order; the rover obeys the last."""
    moving: tuple[tuple[float, float], ...] = ()
    """Where what moves in the room was then, x and y in metres: always in the same order."""
    late: bool = False
    """A node still computed when its time was over: what it says counts at a later tick."""

    @property
    def command(self) -> VelocityCommand | None:
        """What the rover obeys from now on; None where nothing was said."""
        return self.commands[-1] if self.commands else None


class BumpSeen(Frozen):
    """The rover ran into something."""

    time_s: float
    x_m: float
    y_m: float
    moving: bool
    """It was something that moves."""


class SleeperSeen(Frozen):
    """A thread that slept on the wall clock while robot time went on."""

    pid: int
    ticks: int
    words: str
    thread: str = ""
    """Its name; empty for the main thread."""


class LockstepDrive(Frozen):
    """A drive, from its first tick to its end."""

    room: int
    """Its seed."""
    period_s: float
    end: End
    why: str = ""
    """Why it ended before its time."""
    ticks: tuple[DriveTick, ...] = ()
    bumps: tuple[BumpSeen, ...] = ()
    sleepers: tuple[SleeperSeen, ...] = ()
    refused_commands: int = 0
    """Those that were no finite numbers."""
    stray: str = ""
    """What the first command with one said in another field than those that drive the rover."""
    way_m: float = 0.0
    wall_s: float = 0.0
    """Of wall time, from the first tick to the last."""
    stall_s: float = 0.0
    """In real time: so late was the world itself, at most."""

    @property
    def commands(self) -> tuple[VelocityCommand | None, ...]:
        """The command of each tick: two equal drives have the same."""
        return tuple(tick.command for tick in self.ticks)

    @property
    def tick_s(self) -> float:
        """Of wall time, a tick in the mean."""
        return self.wall_s / len(self.ticks) if self.ticks else 0.0

    def write(self, file: Path) -> None:
        """As JSON; a reader finds all of it or nothing."""
        fresh = file.with_suffix(".part")
        fresh.write_text(self.model_dump_json(), "utf-8")
        fresh.replace(file)

    @classmethod
    def read(cls, file: Path) -> LockstepDrive:
        """What was written."""
        return cls.model_validate_json(file.read_text("utf-8"))
