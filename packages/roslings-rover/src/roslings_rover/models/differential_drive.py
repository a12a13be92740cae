"""How the rover is built, and how its wheels make it move.

The equations are those of every differential drive: R. Siegwart, I. Nourbakhsh and
D. Scaramuzza, "Introduction to Autonomous Mobile Robots", 2nd edition, section 3.2; the exact
arc is in S. Thrun, W. Burgard and D. Fox, "Probabilistic Robotics", section 5.3.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

STRAIGHT_RAD = 1e-9
"""Below this turn an arc is a straight line, and its formula would divide by zero."""


@dataclass(frozen=True)
class Pose:
    """A place and a direction on the floor."""

    x_m: float = 0.0
    y_m: float = 0.0
    heading_rad: float = 0.0
    """0 looks along x; within -pi (not included) to pi."""

    def ahead(self, forward_m: float, left_m: float = 0.0) -> tuple[float, float]:
        """The point that lies so far ahead and to the left, in the world's (x, y) in metres."""
        cos, sin = math.cos(self.heading_rad), math.sin(self.heading_rad)
        return (
            self.x_m + forward_m * cos - left_m * sin,
            self.y_m + forward_m * sin + left_m * cos,
        )

    def seen_from_here(self, x_m: float, y_m: float) -> tuple[float, float]:
        """The inverse of `ahead`: how far forward and left a point of the world lies."""
        dx, dy = x_m - self.x_m, y_m - self.y_m
        cos, sin = math.cos(self.heading_rad), math.sin(self.heading_rad)
        return dx * cos + dy * sin, dy * cos - dx * sin


@dataclass(frozen=True)
class Motion:
    """A speed forward in m/s and a turn in rad/s: what a ROS Twist says of such a robot."""

    forward_m_s: float = 0.0
    turn_rad_s: float = 0.0


@dataclass(frozen=True)
class Wheels:
    """Speeds of the two wheels in rad/s; positive drives forward."""

    left_rad_s: float = 0.0
    right_rad_s: float = 0.0


@dataclass(frozen=True)
class Body:
    """The rover's measures. It is round, and its wheels stand on a line through its centre."""

    wheel_radius_m: float = 0.035
    wheel_separation_m: float = 0.16
    radius_m: float = 0.12
    fastest_wheel_rad_s: float = 17.0
    motor_lag_s: float = 0.08
    """After so long a motor has made 63 % of the way to its new speed."""

    def wheels_for(self, motion: Motion) -> Wheels:
        """Wheel speeds for a motion, both slowed alike where one would be too fast.

        `left = (v - w L / 2) / r` and `right = (v + w L / 2) / r`, with the speed v forward, the
        turn w, the separation L and the wheel radius r.
        """
        half_m = self.wheel_separation_m / 2
        left = (motion.forward_m_s - motion.turn_rad_s * half_m) / self.wheel_radius_m
        right = (motion.forward_m_s + motion.turn_rad_s * half_m) / self.wheel_radius_m
        slower = min(1.0, self.fastest_wheel_rad_s / max(abs(left), abs(right), 1e-12))
        return Wheels(left * slower, right * slower)

    def motion_of(self, wheels: Wheels) -> Motion:
        """The inverse: v = r (right + left) / 2 and w = r (right - left) / L."""
        left_m_s = wheels.left_rad_s * self.wheel_radius_m
        right_m_s = wheels.right_rad_s * self.wheel_radius_m
        return Motion((left_m_s + right_m_s) / 2, (right_m_s - left_m_s) / self.wheel_separation_m)

    def follow(self, wheels: Wheels, wanted: Wheels, dt_s: float) -> Wheels:
        """The wheel speeds `dt_s` later, when the motors are driven towards `wanted`.

        A small DC motor without inductance is a lag of first order:
        speed' = (wanted - speed) / lag, here solved exactly for one step.
        """
        part = 1 - math.exp(-dt_s / self.motor_lag_s)
        return Wheels(
            wheels.left_rad_s + (wanted.left_rad_s - wheels.left_rad_s) * part,
            wheels.right_rad_s + (wanted.right_rad_s - wheels.right_rad_s) * part,
        )


def moved(pose: Pose, motion: Motion, dt_s: float) -> Pose:
    """The pose after `dt_s` of a steady motion: exactly, along an arc of radius v / w."""
    turn_rad = motion.turn_rad_s * dt_s
    way_m = motion.forward_m_s * dt_s
    if abs(turn_rad) < STRAIGHT_RAD:
        forward_m, left_m = way_m, 0.0
    else:
        radius_m = way_m / turn_rad
        forward_m, left_m = radius_m * math.sin(turn_rad), radius_m * (1 - math.cos(turn_rad))
    x_m, y_m = pose.ahead(forward_m, left_m)
    return Pose(x_m, y_m, wrapped(pose.heading_rad + turn_rad))


def wrapped(angle_rad: float) -> float:
    """The same direction as an angle from -pi (not included) to pi."""
    return math.pi - (math.pi - angle_rad) % (2 * math.pi)
