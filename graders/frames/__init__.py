"""Frames: where a rover and its laser are, its walls in one frame, and a map of them."""

from graders.frames.record import FramesSeen
from roslings.capability import Capability

CAPABILITY = Capability(
    "frames",
    FramesSeen,
    words="graders.frames.contract:WORDS",
    sections="graders.frames.report:sections",
)
