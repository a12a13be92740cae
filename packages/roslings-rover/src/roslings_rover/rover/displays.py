"""One rover on its map: in a window, in the terminal, or in lines of text."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import AbstractContextManager
from typing import Any, TextIO

from roslings_rover.models.rooms import moving_in
from roslings_rover.rover.driven import DrivenRover
from roslings_rover.rover.map_display import (
    Display,
    MapTerminal,
    MapWindow,
    NewsLines,
    View,
    opened_in,
)
from roslings_rover.rover.text_map import cells
from roslings_rover.rover.words import (
    FIRST_COMMAND,
    KEYS_PACE,
    KEYS_TELL,
    about_tf,
    below,
    beside,
    heard,
    news,
    next_steps,
    position,
    said,
)


def opened(view: View, node: DrivenRover) -> AbstractContextManager[Display[DrivenRover]]:
    """The display that was asked for, or the best that this place has. Raises NoWindow."""
    return opened_in(view, lambda: RoverMapWindow(node), Terminal, lambda: Lines(node, sys.stdout))


class RoverMapWindow(MapWindow):
    """In a window; a picture that would be the same is not drawn again."""

    def __init__(self, node: DrivenRover) -> None:
        super().__init__("roslings rover", node.rover.world)
        (self._path,) = self._axes.plot([], [], color="#1f77b4")
        self._shown: object = None
        print(
            f"The map is in its own window. {_how_to_drive(node)}\nCtrl-C here ends it.", flush=True
        )

    def show(self, node: DrivenRover) -> None:
        """Move the rover and its path."""
        moving = moving_in(node.rover.world)
        told = (news(node), position(node), heard(node))
        now = (node.rover.pose, told, moving, node.drawn_walls)
        if now != self._shown:
            self._shown = now
            path = [*node.rover.path, node.rover.pose]
            self._path.set_data([p.x_m for p in path], [p.y_m for p in path])
            title = "\n".join(filter(None, news(node))) or position(node)
            self._draw_anew(self._drawn(node), title)
        self._flush()

    def _drawn(self, node: DrivenRover) -> Iterator[Any]:
        """What somebody has drawn, what moves, the rover, and over it what it hears."""
        from roslings_rover.rover.picture import DRAWN, draw_moving, draw_rover

        if walls := node.drawn_walls:
            yield from self._axes.plot(walls.x_m, walls.y_m, "s", color=DRAWN, markersize=2)
        yield from draw_moving(node.rover.world, self._axes)
        yield from draw_rover(node.rover, self._axes)
        yield self._words_over(node.rover.pose, heard(node), 18)


def _heard_where(node: DrivenRover) -> str:
    return f"{heard(node)} ({node.sentence.topic})" if node.sentence else ""


def _how_to_drive(node: DrivenRover) -> str:
    if node.by_keys:
        return f"The keys count in this terminal.\n{KEYS_TELL}\n{node.more_keys or KEYS_PACE}"
    return f"Make the rover move, in a second terminal:\nsource setup.bash\n{FIRST_COMMAND}"


class Terminal(MapTerminal):
    """Over the whole terminal."""

    def show(self, node: DrivenRover) -> None:
        """Draw map and words anew, as large as the terminal is now."""
        said, walls = heard(node), node.drawn_walls
        shown = cells(node.rover, *self._size, self._letters, said, node.believed, walls)
        self._put(shown, beside(node), below(node), bold=bool(node.notice))


class Lines(NewsLines):
    """One line whenever the rover has moved."""

    def __init__(self, node: DrivenRover, out: TextIO) -> None:
        super().__init__(out)
        if node.about_place:
            self._say(node.about_place)
        topics = ", ".join([*said(node), *node.says_besides])
        self._say(f"The rover is ready. It hears /cmd_vel and says {topics}.")
        if node.listens:
            self._say("It also hears sentences (std_msgs/msg/String), and /motor_state.")
        if about_tf(node):
            self._say(f"/tf is left out: its type is missing. {' '.join(next_steps())}")
        if percent := node.frames.drift_percent:
            self._say(f"/odom drifts by {percent:g} %. The map shows where the rover truly is.")
        if node.by_keys:
            self._say(f"{KEYS_TELL}\n{node.more_keys or KEYS_PACE}")
            return
        self._say("Make it move, in a second terminal: source setup.bash, then")
        self._say(FIRST_COMMAND)

    def show(self, node: DrivenRover) -> None:
        """Say where it is, if that is news."""
        self._say_news([*news(node), _heard_where(node), position(node)])
