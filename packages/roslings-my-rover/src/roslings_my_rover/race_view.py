"""Where the race is seen: a window, the terminal, or lines; both rovers in their colours."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import AbstractContextManager
from typing import Any, TextIO

from roslings_my_rover.race import FINISH_M, LANES, Entrant
from roslings_my_rover.race_nodes import RaceNode, RacingRover
from roslings_rover.rover.map_display import (
    Display,
    MapTerminal,
    MapWindow,
    NewsLines,
    View,
    opened_in,
)
from roslings_rover.rover.picture import WALL, draw_rover
from roslings_rover.rover.text_map import Letters, MapCell, TextMap, size_for
from roslings_rover.rover.words import heard, position, shown

FINISH = MapCell(":", "wall")
SLOWER = "ros2 param set /red/speed_limiter careful true"
"""What changes the race while it runs."""
ROOM_FOR_FINISH_M = 0.4
"""The finish is drawn so far beyond the outer lanes."""
TITLE = "A race of two rovers"


def opened(view: View, node: RaceNode) -> AbstractContextManager[Display[RaceNode]]:
    """The display that was asked for, or the best that this place has. Raises NoWindow."""
    return opened_in(view, lambda: RaceWindow(node), RaceTerminal, lambda: RaceLines(sys.stdout))


def cells(node: RaceNode, columns: int, lines: int, letters: Letters) -> list[list[MapCell]]:
    """The map, letter by letter: the finish, both ways, names and rovers."""
    world = node.race.world
    sheet = RaceSheet(world, *size_for(world, columns, lines), letters)
    sheet.put_obstacles()
    sheet.put_finish()
    for each in node.race.entrants:
        sheet.put_path(each.rover.path, each.lane.hue)
    for ball in world.balls:
        sheet.put_ball(ball)
    for rover in node.rovers:
        sheet.put_words(rover.rover.pose, heard(rover))
    for each in node.race.entrants:
        sheet.put_rover(each.rover.pose, hue=each.lane.hue)
    return list(sheet.rows())


class RaceSheet(TextMap):
    """A map with a finish."""

    def put_finish(self) -> None:
        """A line across both lanes."""
        ys_m = [lane.y_m for lane in LANES]
        column, first = self._position(FINISH_M, max(ys_m) + ROOM_FOR_FINISH_M)
        _, last = self._position(FINISH_M, min(ys_m) - ROOM_FOR_FINISH_M)
        for line in range(int(first), int(last) + 1):
            self._set(column, line, FINISH)


def beside(node: RaceNode) -> list[str]:
    """How fast and how far each is; at most 32 columns."""
    entrants = node.race.entrants
    return [
        TITLE,
        "",
        _row("", [each.colour for each in entrants]),
        _row("speed", [shown(each.rover.motion.forward_m_s) for each in entrants], "m/s"),
        _row("way", [shown(each.rover.way_m) for each in entrants], "m"),
        _row("time", [_time(node, each) for each in entrants], "s"),
        "",
        f":  the finish, x {FINISH_M:g} m",
        *(f"   {rover.space}/cmd_vel drives {rover.space[1:]}" for rover in node.rovers),
        "",
        "Ctrl-C ends it",
    ]


def _row(name: str, values: list[str], unit: str = "") -> str:
    return " ".join([f"{name:6}", *(f"{value:>6}" for value in values), unit]).rstrip()


def _time(node: RaceNode, entrant: Entrant) -> str:
    return f"{entrant.running_s:.1f}" if node.race.started else "-"


def below(node: RaceNode) -> list[str]:
    """The news, and what may be tried; always two lines of at most 80 columns."""
    over = any(each.finished_s is not None for each in node.race.entrants)
    return [node.told, "" if over else f"In a second terminal: {SLOWER}"]


def where(rover: RacingRover) -> str:
    """Its colour, what it says, where it is and whether it moves, in one line."""
    return " ".join(filter(None, [f"{rover.space[1:]}:", heard(rover), position(rover)]))


class RaceWindow(MapWindow):
    """In a window, with the finish."""

    def __init__(self, node: RaceNode) -> None:
        super().__init__(TITLE, node.race.world)
        self._axes.axvline(FINISH_M, color=WALL, linestyle=":")
        print("The race is in its own window. Ctrl-C here ends it.", flush=True)

    def show(self, node: RaceNode) -> None:
        """Move both rovers and their paths."""
        parts = (part for rover in node.rovers for part in self._drawn(rover))
        self._draw_anew(parts, "\n".join(below(node)))
        self._flush()

    def _drawn(self, rover: RacingRover) -> Iterator[Any]:
        colour, path = rover.entrant.colour, rover.rover.path
        yield from self._axes.plot([p.x_m for p in path], [p.y_m for p in path], color=colour)
        yield from draw_rover(rover.rover, self._axes, colour)
        yield self._words_over(rover.rover.pose, heard(rover), 12)


class RaceTerminal(MapTerminal):
    """Over the whole terminal."""

    def show(self, node: RaceNode) -> None:
        """Draw map and words anew."""
        drawn = cells(node, *self._size, self._letters)
        self._put(drawn, beside(node), below(node), bold=True)


class RaceLines(NewsLines):
    """One line for each rover that has moved, and the news."""

    def __init__(self, out: TextIO) -> None:
        super().__init__(out)
        spaces = " and ".join(f"/{lane.colour}" for lane in LANES)
        self._say(f"The rovers are ready, in {spaces}. The finish is at x {FINISH_M:g} m.")

    def show(self, node: RaceNode) -> None:
        """Say what is news."""
        self._say_news([node.told, *map(where, node.rovers)])
