"""The arithmetic of a robot with two wheels. Metres, seconds, radians."""

import math


class Wheels:
    """Turns motions into wheel speeds, and wheel speeds into motions."""

    def __init__(self, radius, separation):
        self.radius = radius
        self.separation = separation

    def speeds_for(self, forward, turn):
        """Left and right wheel speed in rad/s for a motion in m/s and rad/s."""
        half = turn * self.separation / 2
        return (forward - half) / self.radius, (forward + half) / self.radius

    def motion_of(self, left, right):
        """Motion in m/s and rad/s for two wheel speeds in rad/s."""
        forward = self.radius * (right + left) / 2
        return forward, self.radius * (right - left) / self.separation


class Place:
    """Where the robot is, when it started at zero."""

    def __init__(self):
        self.x = 0.0
        self.y = 0.0
        self.heading = 0.0

    def move(self, forward, turn, seconds):
        """Go on for a short time, in the direction of the middle of that time."""
        middle = self.heading + turn * seconds / 2
        self.x += forward * seconds * math.cos(middle)
        self.y += forward * seconds * math.sin(middle)
        self.heading += turn * seconds
