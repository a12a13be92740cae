"""What was seen of drives in rooms: tick by tick, and by which clock."""

from __future__ import annotations

from typing import Literal

from pydantic import ConfigDict, Field

from roslings.record import SMALL, Columns, PartSeen, Record

Side = Literal["left", "right"]
DriveClock = Literal["lockstep", "wall"]
WhyWall = Literal[
    "sleeps", "ends otherwise", "never quiet", "over budget", "nobody follows", "no account"
]
"""Why lockstep could not tell how a node drives: it was driven in real time instead."""


class RoomTick(Record):
    """One step of the clock: lengths in metres, to the millimetre; angles in radians."""

    model_config = ConfigDict(**SMALL)

    x_m: float
    y_m: float
    heading_rad: float
    forward_m_s: float | None = Field(description="The last command in it; None: there was none")
    turn_rad_s: float | None
    left_m: float = Field(description="From the laser to the nearest thing on the left")
    right_m: float = Field(description="From the laser to the nearest thing on the right")
    nearest_m: float = Field(description="From the rover's hull to what is nearest of all")
    moving_m: float | None = Field(
        default=None, description="From the hull to the nearest thing that moves; None: none does"
    )
    moving_ahead_m: float | None = Field(
        default=None, description="So far ahead of the rover's middle that thing's middle was"
    )
    moving_left_m: float | None = Field(default=None, description="And so far to the left of it")


class RoomBump(Record):
    """The rover ran into something."""

    time_s: float
    x_m: float
    y_m: float
    moving: bool = Field(description="It was something that moves")


class RoomSleeper(Record):
    """A thread of a node that slept on the wall clock while robot time went on."""

    thread: str = Field(description="Its name; empty for the main thread")
    ticks: int = Field(description="In so many ticks it was seen asleep")


class RoomDriveSeen(Record):
    """One drive through one room: the one that is judged."""

    seed: int = Field(description="The room")
    kind: str
    chosen: bool = Field(description="A room of the student's own choice")
    side: Side | None = Field(default=None, description="What the node's parameter said")
    clock: DriveClock
    why_wall: WhyWall | None = Field(default=None, description="None: lockstep is believed")
    told: str = Field(default="", description="More of why, where the drive in lockstep broke off")
    sleepers: Columns[RoomSleeper] = Field(default_factory=list)
    ended: str = Field(default="", description="The process that ended before its time")
    period_s: float = Field(description="Of a tick, in robot time")
    ticks: Columns[RoomTick] = Field(default_factory=list)
    bumps: Columns[RoomBump] = Field(default_factory=list)
    refused_commands: int = Field(default=0, description="They were no finite numbers")
    stray: str = Field(
        default="", description="A field of a command that is not 0, and drives no wheel"
    )
    late_ticks: int = Field(default=0, description="A node still computed when the tick was over")
    stall_s: float = Field(default=0.0, description="In real time: so late the world was, at most")
    held_s: float = Field(
        default=0.0, description="In real time: so long a node waited for a processor, at most"
    )


class FloorSeen(Record):
    """What stands in a room; the rover starts at (0, 0) and looks along x."""

    seed: int
    inside: tuple[float, float, float, float] = Field(description="West, south, east, north")
    boxes: Columns[tuple[float, float, float, float]] = Field(description="The same of each")
    circles: Columns[tuple[float, float, float]] = Field(description="x, y, and radius")


class RoomsSeen(PartSeen):
    """All that was seen of rooms in an experiment."""

    NAME = "rooms"
    FOR_READERS = ("floors",)

    drives: Columns[RoomDriveSeen] = Field(default_factory=list)
    floors: Columns[FloorSeen] = Field(default_factory=list)
