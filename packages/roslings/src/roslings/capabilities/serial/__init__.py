"""Serial: a board on a cable, and the lines on it."""

from roslings.capabilities.serial.record import SerialSeen
from roslings.capability import Capability

CAPABILITY = Capability(
    "serial",
    SerialSeen,
    in_schema_1={"board": "board"},
    words="roslings.capabilities.serial.contract:WORDS",
    sections="roslings.capabilities.serial.report:sections",
    companions="roslings.capabilities.serial.companions:board_for",
)
