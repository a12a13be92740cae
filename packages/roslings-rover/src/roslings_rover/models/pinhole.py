"""Where the camera on the rover sees the balls: the pinhole model, without drawing anything.

u = cx - f * left / ahead and v = cy - f * up / ahead, with the focal length f in pixels;
R. Hartley and A. Zisserman, "Multiple View Geometry in Computer Vision", 2nd edition, chapter 6.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from roslings_rover.models.differential_drive import Pose
from roslings_rover.models.world import Ball, World


@dataclass(frozen=True)
class Disc:
    """A ball in the picture; u grows to the right and v down, from the upper left corner."""

    u_px: float
    v_px: float
    radius_px: float
    hue: int


@dataclass(frozen=True)
class PinholeCameraModel:
    """The rover's camera. Its field of view is that of the Raspberry Pi camera module 2."""

    width_px: int = 640
    height_px: int = 480
    field_of_view_rad: float = math.radians(62.2)
    """From the left edge of the picture to the right one."""
    height_m: float = 0.15
    mounted_ahead_m: float = 0.08

    @property
    def focal_px(self) -> float:
        """Half the width over the tangent of half the field of view."""
        return self.width_px / 2 / math.tan(self.field_of_view_rad / 2)

    @property
    def horizon_px(self) -> float:
        """The row that looks straight ahead."""
        return (self.height_px - 1) / 2

    def place(self, pose: Pose) -> Pose:
        """Where the camera is when the rover is at `pose`."""
        return Pose(*pose.ahead(self.mounted_ahead_m), pose.heading_rad)

    def see(self, world: World, pose: Pose) -> list[Disc]:
        """The balls in the picture, the farthest first; what an obstacle hides is left out."""
        here = self.place(pose)
        balls = [ball for ball in world.balls if self._in_sight(world, here, ball)]
        balls.sort(key=lambda ball: -math.hypot(ball.x_m - here.x_m, ball.y_m - here.y_m))
        discs = [self._disc(here, ball) for ball in balls]
        return [disc for disc in discs if self._touches_the_picture(disc)]

    def _in_sight(self, world: World, here: Pose, ball: Ball) -> bool:
        ahead_m, left_m = here.seen_from_here(ball.x_m, ball.y_m)
        if ahead_m <= ball.radius_m:
            return False
        angle_rad = here.heading_rad + math.atan2(left_m, ahead_m)
        clear_m = world.distance(here.x_m, here.y_m, angle_rad, world.obstacles)
        return clear_m > math.hypot(ahead_m, left_m)

    def _disc(self, here: Pose, ball: Ball) -> Disc:
        ahead_m, left_m = here.seen_from_here(ball.x_m, ball.y_m)
        up_m = ball.radius_m - self.height_m
        return Disc(
            u_px=(self.width_px - 1) / 2 - self.focal_px * left_m / ahead_m,
            v_px=self.horizon_px - self.focal_px * up_m / ahead_m,
            radius_px=self.focal_px * ball.radius_m / ahead_m,
            hue=ball.hue,
        )

    def _touches_the_picture(self, disc: Disc) -> bool:
        reach = disc.radius_px
        return (
            -reach < disc.u_px < self.width_px + reach
            and -reach < disc.v_px < self.height_px + reach
        )
