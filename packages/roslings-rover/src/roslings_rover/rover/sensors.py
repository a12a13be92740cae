"""The rover's sensors of distance: an ultrasonic sensor and a laser scanner."""

from __future__ import annotations

import math
import random
from dataclasses import dataclass

from roslings_rover.models.differential_drive import Pose
from roslings_rover.models.world import World


@dataclass(frozen=True)
class DistanceReading:
    """One measured distance, with infinities as REP 117 has them."""

    range_m: float
    """-inf: something is too near to measure; +inf: nothing within reach."""


@dataclass(frozen=True)
class RangeSensor:
    """An ultrasonic sensor at the rover's front: the nearest thing within a cone.

    The figures of a common HC-SR04: a cone of 15 degrees (0.26 rad), from 2 cm to 4 m.
    """

    field_of_view_rad: float = 0.26
    nearest_m: float = 0.02
    farthest_m: float = 4.0
    mounted_ahead_m: float = 0.10
    noise_m: float = 0.003
    """Standard deviation of one reading."""
    rays: int = 7

    def read(self, world: World, pose: Pose, chance: random.Random) -> DistanceReading:
        """What it measures from `pose`."""
        x_m, y_m = pose.ahead(self.mounted_ahead_m)
        half, steps = self.field_of_view_rad / 2, self.rays - 1
        angles = (pose.heading_rad - half + i * 2 * half / steps for i in range(self.rays))
        true_m = min(world.distance(x_m, y_m, angle) for angle in angles)
        measured_m = true_m + chance.gauss(0.0, self.noise_m)
        return DistanceReading(by_rep_117(measured_m, self.nearest_m, self.farthest_m))


@dataclass(frozen=True)
class Scanner:
    """A laser scanner on top of the rover: one ray a degree, all around, from straight ahead on."""

    rays: int = 360
    nearest_m: float = 0.12
    farthest_m: float = 6.0
    noise_m: float = 0.005
    turns_hz: float = 5.0

    @property
    def step_rad(self) -> float:
        """The angle between two rays."""
        return 2 * math.pi / self.rays

    def read(self, world: World, pose: Pose, chance: random.Random) -> list[float]:
        """Distances in metres, `rays` of them, counter-clockwise; infinities by REP 117."""
        shapes = world.shapes
        return [
            by_rep_117(
                world.distance(pose.x_m, pose.y_m, pose.heading_rad + i * self.step_rad, shapes)
                + chance.gauss(0.0, self.noise_m),
                self.nearest_m,
                self.farthest_m,
            )
            for i in range(self.rays)
        ]


def by_rep_117(range_m: float, nearest_m: float, farthest_m: float) -> float:
    """-inf for too near, +inf for nothing within reach (REP 117, "Informational Distance")."""
    if range_m < nearest_m:
        return -math.inf
    return math.inf if range_m > farthest_m else range_m
