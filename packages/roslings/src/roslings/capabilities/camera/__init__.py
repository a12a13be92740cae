"""Cameras: pictures that a node publishes, and pictures that a node looks at."""

from roslings.capabilities.camera.record import CameraSeen
from roslings.capability import Capability

CAPABILITY = Capability(
    "camera",
    CameraSeen,
    in_schema_1={"shown": "shown", "pictures": "pictures"},
    sections="roslings.capabilities.camera.report:pictures",
    companions="roslings.capabilities.camera.companions:camera_for",
)
