"""Where a robot really went, and what it was told."""

from __future__ import annotations

from pydantic import Field

from roslings.record import Columns, PartSeen, Record


class PoseSeen(Record):
    """Where a robot really was at a moment."""

    arrival_ns: int = Field(description="Observer's monotonic clock")
    x_m: float
    y_m: float
    heading_rad: float


class CommandSeen(Record):
    """One command that reached a robot."""

    arrival_ns: int
    forward_m_s: float
    turn_rad_s: float


class RobotDriveSeen(Record):
    """A drive: how a robot moved, and what it was told."""

    path: Columns[PoseSeen] = Field(default_factory=list)
    commands: Columns[CommandSeen] = Field(default_factory=list)


class WaySeen(Record):
    """Where something went, on the floor."""

    name: str
    points_m: Columns[tuple[float, float]] = Field(description="x and y, metres")


class RobotSeen(PartSeen):
    """All that was seen of a robot in an experiment."""

    NAME = "robot"
    REQUESTS = ("drive",)

    drive: RobotDriveSeen | None = Field(default=None, description="The robot, where there was one")
    ways: Columns[WaySeen] = Field(default_factory=list)
