"""Where the rover believes that it is: what its wheels have counted, errors included."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from roslings_rover.models.differential_drive import Motion, Pose, wrapped

if TYPE_CHECKING:
    from roslings_rover.rover.messages import InMotion

PER_CENT = 0.01


class Odometer:
    """Counts each metre and each turn by the same share too long. Without drift it is the truth.

    So does a robot whose wheels are smaller than it was told: the commonest error that odometry
    has (J. Borenstein and L. Feng, "UMBmark", 1995).
    """

    def __init__(self, start: Pose, drift_percent: float = 0.0) -> None:
        self.pose, self.motion = start, Motion()
        self._scale = 1 + drift_percent * PER_CENT
        self._truth = start

    def follow(self, rover: InMotion) -> None:
        """Count what the rover has gone since the last time."""
        motion, scale = rover.motion, self._scale
        self.motion = Motion(motion.forward_m_s * scale, motion.turn_rad_s * scale)
        self.pose = rover.pose if scale == 1 else self._counted(rover.pose)
        self._truth = rover.pose

    def _counted(self, truth: Pose) -> Pose:
        """A way on an arc leaves along its chord, which stands at half the turn."""
        forward_m, left_m = self._truth.seen_from_here(truth.x_m, truth.y_m)
        turned_rad = math.remainder(truth.heading_rad - self._truth.heading_rad, math.tau)
        more_rad = (self._scale - 1) * turned_rad
        tilted = Pose(0.0, 0.0, more_rad / 2)
        forward_m, left_m = tilted.ahead(forward_m * self._scale, left_m * self._scale)
        x_m, y_m = self.pose.ahead(forward_m, left_m)
        return Pose(x_m, y_m, wrapped(self.pose.heading_rad + turned_rad + more_rad))
