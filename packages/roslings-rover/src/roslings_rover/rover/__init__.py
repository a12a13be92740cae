"""The rover: a small robot with two driven wheels, in a world with obstacles and balls.

Nothing here knows ROS or the time of day: `Rover.step(dt_s)` moves it on, and the same seed and
the same steps give the same drive. Lengths are metres, times seconds, angles radians; x points
forward (or east), y left (or north), angles grow counter-clockwise (REP 103).
"""

from roslings_rover.models.differential_drive import Body, Motion, Pose, Wheels
from roslings_rover.models.pinhole import Disc, PinholeCameraModel
from roslings_rover.models.world import Ball, Box, Circle, World, default_world
from roslings_rover.rover.rover import Rover
from roslings_rover.rover.sensors import DistanceReading, RangeSensor, Scanner

__all__ = [
    "Ball",
    "Body",
    "Box",
    "Circle",
    "Disc",
    "DistanceReading",
    "Motion",
    "PinholeCameraModel",
    "Pose",
    "RangeSensor",
    "Rover",
    "Scanner",
    "Wheels",
    "World",
    "default_world",
]
