"""Pictures: what the bytes of one held, what was shown to a node, what is kept for the reader."""

from __future__ import annotations

from pydantic import Field

from roslings.record import Columns, PartSeen, Record

SURELY_COMES_BYTES = 62_000
"""A picture in one datagram: on one computer it is not lost. Larger ones go in pieces, best effort:
when one piece is lost, all of it is."""


class PixelsSeen(Record):
    """What the bytes of one picture held; the bytes themselves are not kept."""

    bytes: int
    level: float | None = Field(
        default=None, description="Mean of all values, 0 to 255; None where they cannot be read"
    )
    shows: int | None = Field(default=None, description="Which known picture is most like it")
    off: float | None = Field(default=None, description="Mean distance from that one, in levels")
    swapped_off: float | None = Field(
        default=None, description="The same, with red and blue exchanged"
    )
    round_off: float | None = Field(
        default=None,
        description="Its distance where values beyond 0 and 255 came out at the other end, or with"
        " the other sign; looked at where `off` is large",
    )
    lighter: float = Field(default=0.0, description="Levels added to the known picture before")
    marked: float | None = Field(
        default=None, description="Part of the pixels around the ball that were drawn over"
    )
    swapped_marked: float | None = Field(
        default=None, description="The same, where red and blue are exchanged back"
    )
    spoiled: float | None = Field(
        default=None, description="Part of all other pixels that were changed"
    )


class DiscShown(Record):
    """A ball in a picture, from the upper left corner."""

    x_px: float
    y_px: float
    radius_px: float
    hue: int


class PictureShown(Record):
    """One picture that the grader showed to a node, without its pixels."""

    part: str
    topic: str
    width: int
    height: int
    encoding: str
    step: int
    bytes: int
    stamp_ns: int
    frame_id: str
    ball: DiscShown | None = None
    decoy: DiscShown | None = Field(default=None, description="A ball of another colour")
    sent_ns: int = Field(default=0, description="Observer's monotonic clock, at the first try")
    until_ns: int = Field(default=0, description="How long its answer was waited for")
    tries: int = Field(default=0, description="How often it was sent: some are lost on the way")
    answered: bool = Field(default=False, description="The node published something after it")
    turned: bool = Field(default=False, description="The node's callbacks ran after it")


class PictureKept(Record):
    """A picture for the reader of the report; bounded, so that evidence stays small."""

    title: str
    caption: str = Field(description="What it shows, in words")
    png: str = Field(description="A PNG, in base64", pattern=r"^[A-Za-z0-9+/=]+$")
    width: int
    height: int


CAMERA = "camera"
"""The name of the device that a node is given."""


class CameraSeen(PartSeen):
    """All that was seen of pictures in an experiment; what a message holds is a `PixelsSeen`."""

    NAME = "camera"
    FOR_READERS = ("pictures",)

    shown: Columns[PictureShown] = Field(default_factory=list, description="By the grader")
    pictures: list[PictureKept] = Field(default_factory=list, description="For the reader")
