"""Bags: a program reads a drive that nobody could know before; a diagnosis tells what is wrong."""

from graders.black_box.record import BagsSeen
from roslings.capability import Capability

CAPABILITY = Capability(
    "bags",
    BagsSeen,
    words="graders.black_box.contract:WORDS",
    sections="graders.black_box.report:sections",
)
