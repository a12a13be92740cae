"""A robot that drives: where it went, and what it was told."""

from roslings.capabilities.robot.record import RobotSeen
from roslings.capability import Capability

CAPABILITY = Capability(
    "robot",
    RobotSeen,
    in_schema_1={"drive": "drive", "ways": "ways"},
    sections="roslings.capabilities.robot.report:ways",
)
