"""The rover in a room from a seed: things move around it, and bumps are counted and stop it."""

from __future__ import annotations

import math
from dataclasses import dataclass

from roslings_rover.models.differential_drive import Pose, Wheels
from roslings_rover.models.rooms import SeededRoom, Track
from roslings_rover.models.world import Circle
from roslings_rover.rover.quick_scanner import QuickScanner
from roslings_rover.rover.rover import TOUCH_M, Rover

STANDS_S = 1.0
"""So long a bump stops the rover, whatever it is told."""
KEEPS_AWAY_M = 0.15
"""What moves comes no nearer to the rover: a touch is always the rover's own."""
GIVES_UP_S = 2.0
"""What waits so long for the rover turns round."""


@dataclass(frozen=True)
class Bump:
    """When the rover ran into something, and where it was."""

    time_s: float
    pose: Pose
    moving: bool
    """It was something that moves."""


class GoingThing:
    """Something that goes to and fro on its track. It stops before the rover."""

    def __init__(self, track: Track) -> None:
        self.track = track
        self.shape = track.at(0.0)
        """Where it is now."""
        self._along_m, self._away = 0.0, True
        self._rests_s, self._waited_s = track.rests_home_s, 0.0

    def step(self, dt_s: float, rover: Circle) -> None:
        """Let time go on; `rover` is the floor that it takes."""
        if self._rests_s > 0:
            self._rests_s -= dt_s
            return
        along_m = self._ahead(dt_s)
        there = self.track.at(along_m)
        if _is_too_near(there, self.shape, rover):
            self._wait(dt_s)
            return
        self._waited_s = 0.0
        self._along_m, self.shape = along_m, there
        self._rest_at_an_end()

    def _ahead(self, dt_s: float) -> float:
        way_m = self.track.speed_m_s * dt_s
        along_m = self._along_m + (way_m if self._away else -way_m)
        return min(max(along_m, 0.0), self.track.length_m)

    def _wait(self, dt_s: float) -> None:
        self._waited_s += dt_s
        if self._waited_s >= GIVES_UP_S:
            self._waited_s, self._away = 0.0, not self._away

    def _rest_at_an_end(self) -> None:
        if self._away and self._along_m >= self.track.length_m:
            self._away, self._rests_s = False, self.track.rests_away_s
        elif not self._away and self._along_m <= 0:
            self._away, self._rests_s = True, self.track.rests_home_s


def _is_too_near(there: Circle, here: Circle, rover: Circle) -> bool:
    """It would be near the rover, and nearer than now."""
    gap_m = there.gap(rover.x_m, rover.y_m) - rover.radius_m
    return gap_m < KEEPS_AWAY_M and gap_m < here.gap(rover.x_m, rover.y_m) - rover.radius_m


class RoomRover(Rover):
    """A rover in such a room. The same seeds, steps and commands give the same drive."""

    def __init__(self, room: SeededRoom, seed: int = 0) -> None:
        """`seed` is for the noise of the sensors."""
        super().__init__(room.at_first, seed=seed)
        self.room = room
        self.scanner = QuickScanner()
        self.bumps: list[Bump] = []
        self._things = [GoingThing(track) for track in room.tracks]
        self._in_touch = False
        self._asked = Wheels()
        self._stands_until_s = -math.inf

    @property
    def stands_still(self) -> bool:
        """It has bumped, and follows nothing for a moment."""
        return self.time_s < self._stands_until_s

    def turn_wheels(self, wheels: Wheels) -> None:
        """Drive each motor towards a speed of its own, once it follows again."""
        self._asked = wheels
        super().turn_wheels(Wheels() if self.stands_still else wheels)

    def _small_step(self, dt_s: float) -> None:
        self._move_things(dt_s)
        if not self.stands_still:
            self.wanted = self._asked
        super()._small_step(dt_s)
        self._feel()

    def _move_things(self, dt_s: float) -> None:
        if not self._things:
            return
        before = [thing.shape for thing in self._things]
        here = Circle(self.pose.x_m, self.pose.y_m, self.body.radius_m)
        for thing in self._things:
            thing.step(dt_s, here)
        if (now := [thing.shape for thing in self._things]) != before:
            self.world = self.room.world_with(tuple(now))

    def _feel(self) -> None:
        """A bump begins with a touch, and is over where the rover has left what it touched."""
        if self.touches and not self._in_touch:
            self._in_touch = True
            self._bump()
        elif self._in_touch and not self.touches:
            gap_m = self.world.room_at(self.pose.x_m, self.pose.y_m)
            self._in_touch = gap_m < self.body.radius_m + TOUCH_M

    def _bump(self) -> None:
        self.bumps.append(Bump(self.time_s, self.pose, self._is_at_something_moving()))
        self._stands_until_s = self.time_s + STANDS_S
        self.wheels = self.wanted = Wheels()

    def _is_at_something_moving(self) -> bool:
        gaps_m = (thing.shape.gap(self.pose.x_m, self.pose.y_m) for thing in self._things)
        return min(gaps_m, default=math.inf) < self.body.radius_m + TOUCH_M
