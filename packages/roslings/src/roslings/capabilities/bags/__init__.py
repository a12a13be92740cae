"""Bags: a program reads a drive that nobody could know before; a diagnosis tells what is wrong."""

from roslings.capabilities.bags.record import BagsSeen
from roslings.capability import Capability

CAPABILITY = Capability(
    "bags",
    BagsSeen,
    words="roslings.capabilities.bags.contract:WORDS",
    sections="roslings.capabilities.bags.report:sections",
)
