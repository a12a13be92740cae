"""A race of two rovers in one room: their lanes, the start, and who is first. Knows no ROS."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from roslings_rover.models.differential_drive import Pose
from roslings_rover.models.world import Circle, World, default_world
from roslings_rover.rover.rover import Rover

START_M, FINISH_M = -1.5, 4.5
"""Both lanes go east, through the part of the room where nothing stands."""
FULL_M_S = 1.0
"""What both are told at the start: faster than motors can, so the limit of each decides."""
LIGHTS = 3
DEAD_HEAT_S = 0.5
"""Nearer to each other at the finish, nobody has won."""


@dataclass(frozen=True)
class Lane:
    """A colour, which is the name of a namespace, too, and where its rover starts."""

    colour: str
    y_m: float
    hue: int
    """As OpenCV counts: 0 is red, 120 blue."""


LANES = (Lane("red", -0.75, 5), Lane("blue", -1.55, 120))


class Entrant:
    """One rover of the race."""

    def __init__(self, lane: Lane, world: World, seed: int = 0) -> None:
        self.lane = lane
        self.rover = Rover(world, Pose(START_M, lane.y_m), seed=seed)
        self.told_m_s = 0.0
        """What it is told to drive."""
        self.finished_s: float | None = None
        """Seconds from the start; None before it is at the finish."""
        self._began_s = 0.0

    @property
    def colour(self) -> str:
        """Of its rover, and its namespace."""
        return self.lane.colour

    @property
    def running_s(self) -> float:
        """Seconds since the start, until it was at the finish."""
        return self.rover.time_s - self._began_s if self.finished_s is None else self.finished_s

    def go(self) -> None:
        """From now on its time counts."""
        self.told_m_s, self._began_s = FULL_M_S, self.rover.time_s

    def look(self) -> None:
        """Stop it at the finish, and keep its time."""
        if self.told_m_s and self.rover.pose.x_m >= FINISH_M:
            self.finished_s, self.told_m_s = self.running_s, 0.0


class Race:
    """Both rovers in one room. `look` again and again; `count_down` while the lights are on."""

    def __init__(self, seed: int = 0) -> None:
        self.world = default_world()
        """Without the rovers: each of them is a thing in the world of the other."""
        self.entrants = [Entrant(lane, self.world, seed) for lane in LANES]
        self.lights = LIGHTS

    @property
    def started(self) -> bool:
        """The lights are off."""
        return self.lights == 0

    def count_down(self) -> None:
        """One light less; with the last one the race starts."""
        if self.started:
            return
        self.lights -= 1
        if self.started:
            for each in self.entrants:
                each.go()

    def look(self) -> None:
        """Let each see the other, and those at the finish stand."""
        for each in self.entrants:
            each.rover.world = replace(
                self.world, obstacles=(*self.world.obstacles, *self._others(each))
            )
            each.look()

    def _others(self, entrant: Entrant) -> list[Circle]:
        rovers = (each.rover for each in self.entrants if each is not entrant)
        return [Circle(each.pose.x_m, each.pose.y_m, each.body.radius_m) for each in rovers]

    @property
    def told(self) -> str:
        """What the map says of it, at most 80 columns."""
        if not self.started:
            return f"Ready: {self.lights}"
        return result(self.entrants) or "Go! The first at the finish wins."


def result(entrants: Sequence[Entrant]) -> str:
    """Who has won; empty while it is open, which it is for a moment behind the first one, too."""
    home = sorted((each for each in entrants if each.finished_s is not None), key=_time_s)
    if not home:
        return ""
    first = home[0]
    others = [each for each in entrants if each is not first]
    if min(_time_s(each) for each in others) - _time_s(first) > DEAD_HEAT_S:
        return " ".join(
            [f"{first.colour.capitalize()} wins: {_time_s(first):.1f} s.", *map(_later, home[1:])]
        )
    if len(home) < len(entrants):
        return ""
    times = ", ".join(f"{each.colour} {_time_s(each):.1f} s" for each in home)
    return f"A dead heat: {times}. Have both the same limit?"


def _later(entrant: Entrant) -> str:
    return f"{entrant.colour.capitalize()}: {_time_s(entrant):.1f} s."


def _time_s(entrant: Entrant) -> float:
    return entrant.running_s
