"""What was seen of frames: steps of the tree, points on walls, and a map."""

from __future__ import annotations

from typing import ClassVar, Literal

from pydantic import Field

from roslings.record import Columns, PartSeen, Record

HEARS_ON = "hears on"
"""The stretches of a drive in which the node is waited for."""

Source = Literal["tf", "tf_static", "late"]
"""A topic; `late`: what a subscription got on /tf_static that came after it was said."""

Stamp = Literal["own", "zero", "other"]
"""Of the odometry or the scan that a message is about, none at all, or any other time."""

WayWrong = Literal["", "other_time", "beam_angles", "mount", "heading", "inverse", "laser_frame"]
"""A mistake that explains where points lie; empty: they lie right, or nothing explains them."""

Part = Literal["before", "standing", "moving", "after"]
"""Of a drive; before the first odometry, and after the last one."""

MapSlip = Literal["", "rows_and_columns", "cut_towards_zero", "elsewhere"]
"""A mistake that explains where walls lie in a map."""


class StepSeen(Record):
    """Where a frame is in its parent, as it was told; equal steps of one drive are kept once."""

    source: Source
    parent: str
    child: str
    x_m: float
    y_m: float
    yaw_rad: float
    tilted: bool = Field(description="It is turned about x or y, too")
    length: float = Field(description="Of the quaternion: 1 where it is one")
    is_finite: bool = Field(default=True, description="None of its numbers is inf or NaN")


class BodySeen(Record):
    """Where the rover was told to be, beside the odometry of this stamp."""

    parent: str
    child: str
    stamp: Stamp
    off_m: float = Field(description="0 where no odometry has this stamp")
    off_rad: float
    length: float = Field(description="Of the quaternion: 1 where it is one")
    is_finite: bool = Field(default=True, description="None of its numbers is inf or NaN")


class ScanSaid(Record):
    """A scan of the grader's."""

    part: Part
    turn_rad_s: float
    answers: int = 0


class WallsSeen(Record):
    """The points of one message, beside the scan of this stamp."""

    frame: str
    stamp: Stamp
    part: Part
    distances: int = Field(description="Of the scan; 0 where there is none")
    points: int
    endless: int = Field(description="Points that are no finite numbers")
    off_m: float = Field(default=0.0, description="How far from the walls, in the mean")
    like: WayWrong = ""


class MapSeen(Record):
    """The last map that came."""

    frame: str
    cell_m: float
    width: int
    height: int
    cells: int = Field(description="So many numbers it holds")
    x_m: float = Field(description="The place of its first cell's corner")
    y_m: float
    yaw_rad: float
    tilted: bool = Field(default=False, description="Its origin is turned about x or y, too")
    length: float = Field(default=1.0, description="Of the origin's quaternion")
    z_m: float = 0.0
    is_finite: bool = Field(default=True, description="No number of the origin is inf or NaN")
    values: list[int] = Field(description="Each that is in it, the first few")
    walls: float = Field(default=0.0, description="Part of the cells with walls that are 100")
    true_walls: float = Field(default=0.0, description="Part of what is 100 that is at a wall")
    free: float = Field(default=0.0, description="Part of the cells with beams that are 0")
    unknown: float = Field(default=0.0, description="Part of the others that are -1")
    like: MapSlip = ""


class FramesDriveSeen(Record):
    """A rover in a room, of which the node was told."""

    seed: int
    laser_x_m: float
    laser_y_m: float
    laser_yaw_rad: float
    heard: bool = Field(default=False, description="The node has subscribed to both topics")
    blocked_s: float = Field(default=0.0, description="One callback took longer than this; 0: none")
    odometry: int = Field(default=0, description="So many messages")
    told: int = Field(default=0, description="Those that /tf has a step for")
    told_again: int = Field(default=0, description="Steps of one child and stamp, but the first")
    body: Columns[BodySeen] = Field(default_factory=list)
    scans: Columns[ScanSaid] = Field(default_factory=list)
    walls: Columns[WallsSeen] = Field(default_factory=list)
    map: MapSeen | None = None


class FramesSeen(PartSeen):
    """All that was seen of them in an experiment."""

    NAME: ClassVar[str] = "frames"
    FOR_READERS: ClassVar[tuple[str, ...]] = ("shown",)

    steps: Columns[StepSeen] = Field(default_factory=list)
    drive: FramesDriveSeen | None = None
    shown: str = Field(default="", description="The middle of the map: one letter a cell")
