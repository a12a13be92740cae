"""The rover itself: what it was told, how it moves, what it sees."""

from __future__ import annotations

import math
import random
from dataclasses import dataclass, replace

from roslings_rover.models.differential_drive import Body, Motion, Pose, Wheels, moved
from roslings_rover.models.pinhole import Disc, PinholeCameraModel
from roslings_rover.models.world import Ball, World, default_world
from roslings_rover.rover.sensors import DistanceReading, RangeSensor, Scanner

LONGEST_STEP_S = 0.005
"""A longer step is cut up: the motors' lag and the arc are then exact enough to compare."""

TOUCH_M = 0.02
"""One small step before it would overlap."""

PATH_STEP_M = 0.02
PATH_POINTS = 20_000
TURN_STEP_RAD = math.radians(10)


@dataclass(frozen=True)
class RoverMoment:
    """Where the rover was at a time of its own clock."""

    time_s: float
    pose: Pose


class Rover:
    """A robot with two driven wheels. All of its state is public; nothing happens but in `step`."""

    def __init__(
        self,
        world: World | None = None,
        pose: Pose = Pose(),  # noqa: B008 - a Pose cannot change
        body: Body = Body(),  # noqa: B008 - nor can a Body
        seed: int = 0,
    ) -> None:
        self.world = world or default_world()
        self.body = body
        self.pose = pose
        self.wheels = Wheels()
        self.wanted = Wheels()
        self.turned_rad = (0.0, 0.0)
        """How far each wheel has turned since the start, left and right."""
        self.time_s = 0.0
        self.way_m = 0.0
        self.most_m_s = math.inf
        """A speed limit that somebody has set, ahead and backwards."""
        self._told = Motion()
        self.touches = False
        """Its rim is against something, and it was told to go on."""
        self.path: list[Pose] = [pose]
        """A place for every 2 cm of its way."""
        self.trail: list[RoverMoment] = [RoverMoment(0.0, pose)]
        """A moment for every 2 cm and for every turn of 10 degrees."""
        self.range_sensor, self.scanner, self.camera_model = (
            RangeSensor(),
            Scanner(),
            PinholeCameraModel(),
        )
        self._chance = random.Random(seed)

    def drive(self, motion: Motion) -> None:
        """Move so from now on. Raises ValueError for a speed that is not a number."""
        if not (math.isfinite(motion.forward_m_s) and math.isfinite(motion.turn_rad_s)):
            raise ValueError("a speed of the rover must be a finite number")
        self._told = motion
        self.turn_wheels(self.body.wheels_for(self._limited(motion)))

    def limit(self, most_m_s: float) -> None:
        """Drive no faster than this from now on, by motions; infinity takes the limit away."""
        if most_m_s != self.most_m_s:
            self.most_m_s = most_m_s
            self.drive(self._told)

    def _limited(self, motion: Motion) -> Motion:
        """Ahead and turn slowed alike: it stays on its curve."""
        if abs(motion.forward_m_s) <= self.most_m_s:
            return motion
        slower = self.most_m_s / abs(motion.forward_m_s)
        return Motion(motion.forward_m_s * slower, motion.turn_rad_s * slower)

    def turn_wheels(self, wheels: Wheels) -> None:
        """Drive each motor towards a speed of its own; no limit holds for it."""
        self.wanted = wheels

    @property
    def motion(self) -> Motion:
        """How it moves at this moment."""
        return self.body.motion_of(self.wheels)

    def step(self, dt_s: float) -> None:
        """Let time go on. Raises ValueError where it would go back."""
        if not dt_s >= 0:
            raise ValueError(f"a step of {dt_s} s is no step")
        steps = math.ceil(dt_s / LONGEST_STEP_S - 1e-9)
        for _ in range(steps):
            self._small_step(dt_s / steps)
        self._remember()

    def _small_step(self, dt_s: float) -> None:
        self.wheels = self.body.follow(self.wheels, self.wanted, dt_s)
        there = moved(self.pose, self.motion, dt_s)
        self.touches = self._runs_into(there)
        if self.touches:  # its motors are too weak to slip: the wheels stand
            there = replace(there, x_m=self.pose.x_m, y_m=self.pose.y_m)
            self.wheels = self._turning_on_the_spot()
        self.turned_rad = (
            self.turned_rad[0] + self.wheels.left_rad_s * dt_s,
            self.turned_rad[1] + self.wheels.right_rad_s * dt_s,
        )
        self.way_m += math.hypot(there.x_m - self.pose.x_m, there.y_m - self.pose.y_m)
        self.pose = there
        self.time_s += dt_s

    def _runs_into(self, there: Pose) -> bool:
        """It would overlap with something, and more than now: away from a wall it can go."""
        gap_m = self.world.room_at(there.x_m, there.y_m)
        return gap_m < self.body.radius_m and gap_m < self.world.room_at(
            self.pose.x_m, self.pose.y_m
        )

    @property
    def touched_ball(self) -> Ball | None:
        """The ball that it has driven to, while it touches something."""
        reach_m = self.body.radius_m + TOUCH_M
        near = (
            ball
            for ball in self.world.balls
            if ball.shape.gap(self.pose.x_m, self.pose.y_m) < reach_m
        )
        return next(near, None) if self.touches else None

    def _turning_on_the_spot(self) -> Wheels:
        """A round robot that cannot go forward can still turn."""
        turn = (self.wheels.right_rad_s - self.wheels.left_rad_s) / 2
        return Wheels(-turn, turn)

    def _remember(self) -> None:
        last = self.path[-1]
        went_m = math.hypot(self.pose.x_m - last.x_m, self.pose.y_m - last.y_m)
        if went_m >= PATH_STEP_M and len(self.path) < PATH_POINTS:
            self.path.append(self.pose)
        self._remember_the_time()

    def _remember_the_time(self) -> None:
        last = self.trail[-1].pose
        went_m = math.hypot(self.pose.x_m - last.x_m, self.pose.y_m - last.y_m)
        turned_rad = abs(math.remainder(self.pose.heading_rad - last.heading_rad, math.tau))
        moved_on = went_m >= PATH_STEP_M or turned_rad >= TURN_STEP_RAD
        if moved_on and len(self.trail) < PATH_POINTS:
            self.trail.append(RoverMoment(self.time_s, self.pose))

    def range(self) -> DistanceReading:
        """One reading of the ultrasonic sensor."""
        return self.range_sensor.read(self.world, self.pose, self._chance)

    def scan(self) -> list[float]:
        """One turn of the laser scanner."""
        return self.scanner.read(self.world, self.pose, self._chance)

    def see(self) -> list[Disc]:
        """The balls that the camera sees."""
        return self.camera_model.see(self.world, self.pose)
