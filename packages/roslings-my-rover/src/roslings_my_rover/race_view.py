"""Where the race is seen: a window, the terminal, or lines; both rovers in their colours."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, Protocol, TextIO

from roslings_my_rover.race import FINISH_M, LANES, Entrant
from roslings_my_rover.race_nodes import RaceNode, RacingRover
from roslings_rover.rover.displays import Terminal, View, place_for
from roslings_rover.rover.picture import WALL, draw_rover, draw_world
from roslings_rover.rover.text_map import Cell, Letters, Sheet, size_for
from roslings_rover.rover.words import heard, position, shown

FINISH = Cell(":", "wall")
SLOWER = "ros2 param set /red/speed_limiter careful true"
"""What changes the race while it runs."""
ROOM_FOR_FINISH_M = 0.4
"""The finish is drawn so far beyond the outer lanes."""


class RaceDisplay(Protocol):
    """Shows a race again and again."""

    every_s: float

    @property
    def closed(self) -> bool:
        """Somebody closed it: the race ends, too."""
        ...

    def show(self, node: RaceNode) -> None:
        """Show how things stand now."""
        ...


@contextmanager
def opened(view: View, node: RaceNode) -> Iterator[RaceDisplay]:
    """The display that was asked for, or the best that this place has. Raises NoWindow."""
    place = place_for(view)
    if place == "window":
        with RaceWindow(node) as window:
            yield window
    elif place == "terminal":
        with Terminal() as terminal:
            yield RaceTerminal(terminal)
    else:
        yield RaceLines(sys.stdout)


def cells(node: RaceNode, columns: int, lines: int, letters: Letters) -> list[list[Cell]]:
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


class RaceSheet(Sheet):
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
        "A race of two rovers",
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


class RaceWindow:
    """The map in a window of matplotlib's."""

    every_s = 0.1

    def __init__(self, node: RaceNode) -> None:
        import matplotlib.pyplot as plt

        self._plt = plt
        self._figure, self._axes = plt.subplots(figsize=(7, 7), layout="constrained")
        draw_world(node.race.world, self._axes)
        self._axes.axvline(FINISH_M, color=WALL, linestyle=":")
        self._parts: list[Any] = []
        print("The race is in its own window. Ctrl-C here ends it.", flush=True)

    def __enter__(self) -> RaceWindow:
        self._plt.show(block=False)
        return self

    def __exit__(self, *_: object) -> None:
        self._plt.close(self._figure)

    @property
    def closed(self) -> bool:
        """The window was closed."""
        return not self._plt.fignum_exists(self._figure.number)

    def show(self, node: RaceNode) -> None:
        """Move both rovers and their paths."""
        for part in self._parts:
            part.remove()
        self._parts = [part for rover in node.rovers for part in self._drawn(rover)]
        self._axes.set_title("\n".join(below(node)), fontsize=10)
        self._figure.canvas.draw_idle()
        self._figure.canvas.flush_events()

    def _drawn(self, rover: RacingRover) -> Iterator[Any]:
        colour, path = rover.entrant.colour, rover.rover.path
        yield from self._axes.plot([p.x_m for p in path], [p.y_m for p in path], color=colour)
        yield from draw_rover(rover.rover, self._axes, colour)
        yield self._axes.annotate(
            heard(rover),
            (rover.rover.pose.x_m, rover.rover.pose.y_m),
            xytext=(0, 12),
            textcoords="offset points",
            ha="center",
            parse_math=False,
        )


class RaceTerminal:
    """The map over the whole terminal."""

    every_s = 0.1
    closed = False

    def __init__(self, terminal: Terminal) -> None:
        self._terminal = terminal

    def show(self, node: RaceNode) -> None:
        """Draw map and words anew."""
        terminal = self._terminal
        drawn = cells(node, *terminal.size, terminal.letters)
        terminal.put(drawn, beside(node), below(node), bold=True)


class RaceLines:
    """One line for each rover that has moved, and the news."""

    every_s = 1.0
    closed = False

    def __init__(self, out: TextIO) -> None:
        self._out, self._last = out, list[str]()
        spaces = " and ".join(f"/{lane.colour}" for lane in LANES)
        self._say(f"The rovers are ready, in {spaces}. The finish is at x {FINISH_M:g} m.")

    def show(self, node: RaceNode) -> None:
        """Say what is news."""
        now = [node.told, *map(where, node.rovers)]
        for line in now:
            if line and line not in self._last:
                self._say(line)
        self._last = now

    def _say(self, line: str) -> None:
        print(line, file=self._out, flush=True)
