"""What went over a serial cable, and what the board at its end made of it."""

from __future__ import annotations

from pydantic import Field

from roslings.record import Columns, PartSeen, Record


class CableLine(Record):
    """One whole line on a serial cable, without the end of line, as it was sent."""

    board_s: float = Field(description="The board's clock")
    sent_ns: int = Field(description="Observer's monotonic clock")
    text: str


class MotorsSeen(Record):
    """What reached the motors, from one moment on."""

    board_s: float
    left_pwm: int
    right_pwm: int


class BoardMark(Record):
    """How things really stood at a moment of the experiment."""

    part: str
    arrival_ns: int = Field(description="Observer's monotonic clock")
    board_s: float
    x_m: float
    y_m: float
    heading_rad: float
    left_pwm: int
    right_pwm: int
    since_s: float | None = Field(
        default=None, description="The board's clock when this motion was first said, if one was"
    )


class BoardSeen(Record):
    """All that was seen at the board's end of a serial cable."""

    told: Columns[CableLine] = Field(default_factory=list, description="By the board, unspoiled")
    heard: Columns[CableLine] = Field(default_factory=list, description="From the node")
    motors: Columns[MotorsSeen] = Field(default_factory=list)
    marks: Columns[BoardMark] = Field(default_factory=list)
    rejected: int = Field(default=0, description="Lines of the node that the board refused")
    lost_bytes: int = Field(default=0, description="Sent by the board, and read too late")
    host_bits_s: int | None = Field(
        default=None, description="To which the node has set its end at last; None where it has not"
    )


class CableLimits(Record):
    """How long whoever measured waited."""

    stands_within_s: float = Field(default=5.0, description="For the wheels to stand")


class SerialSeen(PartSeen):
    """All that was seen of a serial cable in an experiment."""

    NAME = "serial"
    REQUESTS = ("board",)

    limits: CableLimits = Field(default_factory=CableLimits)
    board: BoardSeen | None = Field(default=None, description="The board, where there was one")
