"""What went over a serial cable, and what the board at its end made of it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Any

from pydantic import Field

from roslings.record import Columns, PartSeen, Record
from roslings.record.columns import InColumns
from roslings_rover.models.board_lines import checksum


class CableLine(Record):
    """One whole line on a serial cable, without the end of line, as it was sent."""

    board_s: float = Field(description="The board's clock")
    sent_ns: int = Field(description="Observer's monotonic clock")
    text: str


@dataclass(slots=True)
class _Unsealed:
    """A line in columns: its checksum, which nothing packs, is reckoned again."""

    board_s: float
    sent_ns: int
    text: str


SEAL = len("FFFF")


def unsealed(text: str) -> str:
    """A line without its checksum; one that has none, or a wrong one, with all that it has.

    What then ends in `*` had its checksum; so what did before gets an end of line more.
    """
    cut = text[:-SEAL]
    if cut[:1] == "$" and cut[1:].endswith("*") and text.isascii() and sealed(cut) == text:
        return cut
    return f"{text}\n" if text.rstrip("\n").endswith("*") else text


def sealed(text: str) -> str:
    """The line again."""
    if text.endswith("*"):
        return f"{text}{checksum(text[1:-1].encode('latin-1')):04X}"
    return text[:-1] if text.rstrip("\n").endswith("*") else text


def _all_unsealed(lines: list[CableLine]) -> list[_Unsealed]:
    return [_Unsealed(line.board_s, line.sent_ns, unsealed(line.text)) for line in lines]


def _all_sealed(lines: list[Any]) -> list[Any]:
    """Of anything that is no line, pydantic tells."""
    for line in lines:
        if isinstance(line, dict) and isinstance(text := line.get("text"), str):
            line["text"] = sealed(text)
    return lines


CableLines = Annotated[list[CableLine], InColumns(_all_unsealed, _all_sealed)]


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

    told: CableLines = Field(default_factory=list, description="By the board, unspoiled")
    heard: CableLines = Field(default_factory=list, description="From the node")
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
