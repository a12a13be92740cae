"""Where the map is shown: a window, the terminal, or lines of text for a file or a pipe."""

from __future__ import annotations

import os
import shutil
import sys
import textwrap
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any, Literal, Protocol, TextIO

from roslings_rover.errors import DeviceTrouble
from roslings_rover.models.rooms import moving_in
from roslings_rover.models.world import colour_of
from roslings_rover.rover.driven import DrivenRover
from roslings_rover.rover.text_map import ASCII, FLOOR, UNICODE, Cell, cells
from roslings_rover.rover.words import (
    FIRST_COMMAND,
    KEYS_PACE,
    KEYS_TELL,
    below,
    beside,
    heard,
    news,
    next_steps,
    position,
    said,
)

View = Literal["auto", "window", "terminal", "lines"]
SIDE_COLUMNS = 34
LEAST_LINES = 18
LEAST_COLUMNS = 60
STYLES = {
    "floor": "",
    "wall": "bright_black",
    "path": "cyan",
    "rover": "bold yellow",
    "moving": "bold red",
    "believed": "bright_black",
    "said": "bold magenta",
}


class Display(Protocol):
    """Shows a rover again and again."""

    every_s: float

    @property
    def closed(self) -> bool:
        """Somebody closed it: the rover ends, too."""
        ...

    def show(self, node: DrivenRover) -> None:
        """Show how things stand now."""
        ...


class NoWindow(DeviceTrouble):
    """A window was asked for and cannot be opened here."""

    def __init__(self, because: str) -> None:
        super().__init__(f"There is no window: {because}. Type: ./roslings rover --view terminal")


@contextmanager
def opened(view: View, node: DrivenRover) -> Iterator[Display]:
    """The display that was asked for, or the best that this place has. Raises NoWindow."""
    place = place_for(view)
    if place == "window":
        with Window(node) as window:
            yield window
    elif place == "terminal":
        with Terminal() as terminal:
            yield terminal
    else:
        yield Lines(node, sys.stdout)


def place_for(view: View) -> Literal["window", "terminal", "lines"]:
    """Where the map goes: as asked for, or the best that there is here. Raises NoWindow."""
    because = why_no_window()
    if view == "window" and because:
        raise NoWindow(because)
    if view == "window" or (view == "auto" and not because):
        return "window"
    if view == "terminal" or (view == "auto" and _is_roomy_terminal()):
        return "terminal"
    return "lines"


def why_no_window() -> str:
    """Why this place has no window; empty where it has one."""
    if not (os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY")):
        return "this terminal has no screen (DISPLAY is not set)"
    try:
        import tkinter

        import matplotlib.pyplot as plt

        tkinter.Tk().destroy()
        plt.switch_backend("TkAgg")
    except ImportError:
        return "this Python has no tkinter"
    except Exception as error:  # tkinter.TclError is known only where tkinter is there
        return f"the screen cannot be opened ({error})"
    return ""


def _is_roomy_terminal() -> bool:
    columns, lines = shutil.get_terminal_size()
    return sys.stdout.isatty() and columns >= LEAST_COLUMNS and lines >= LEAST_LINES


class Window:
    """The map in a window of matplotlib's."""

    every_s = 0.1

    def __init__(self, node: DrivenRover) -> None:
        import matplotlib.pyplot as plt

        from roslings_rover.rover.picture import draw_world

        self._plt = plt
        self._figure, self._axes = plt.subplots(figsize=(7, 7), layout="constrained")
        self._title("roslings rover")
        draw_world(node.rover.world, self._axes)
        (self._path,) = self._axes.plot([], [], color="#1f77b4")
        self._parts: list[Any] = []
        self._shown: object = None
        print(
            f"The map is in its own window. {_how_to_drive(node)}\nCtrl-C here ends it.", flush=True
        )

    def __enter__(self) -> Window:
        self._plt.show(block=False)
        return self

    def __exit__(self, *_: object) -> None:
        self._plt.close(self._figure)

    @property
    def closed(self) -> bool:
        """The window was closed."""
        return not self._plt.fignum_exists(self._figure.number)

    def show(self, node: DrivenRover) -> None:
        """Move the rover and its path; a picture that would be the same is not drawn again."""
        moving = moving_in(node.rover.world)
        now = (node.rover.pose, news(node), position(node), heard(node), moving)
        if now != self._shown:
            self._shown = now
            self._draw(node)
        self._figure.canvas.flush_events()

    def _draw(self, node: DrivenRover) -> None:
        from roslings_rover.rover.picture import draw_moving, draw_rover

        for part in self._parts:
            part.remove()
        path = [*node.rover.path, node.rover.pose]
        self._path.set_data([p.x_m for p in path], [p.y_m for p in path])
        moving = draw_moving(node.rover.world, self._axes)
        self._parts = [*moving, *draw_rover(node.rover, self._axes), self._words(node)]
        title = "\n".join(filter(None, news(node))) or position(node)
        self._axes.set_title(title, fontsize=10)
        self._figure.canvas.draw_idle()

    def _words(self, node: DrivenRover) -> Any:
        """What it hears, over the rover."""
        return self._axes.annotate(
            heard(node),
            (node.rover.pose.x_m, node.rover.pose.y_m),
            xytext=(0, 18),
            textcoords="offset points",
            ha="center",
            parse_math=False,
        )

    def _title(self, text: str) -> None:
        if self._figure.canvas.manager is not None:
            self._figure.canvas.manager.set_window_title(text)


def _heard_where(node: DrivenRover) -> str:
    return f"{heard(node)} ({node.sentence.topic})" if node.sentence else ""


def _how_to_drive(node: DrivenRover) -> str:
    if node.by_keys:
        return f"The keys count in this terminal.\n{KEYS_TELL}\n{node.more_keys or KEYS_PACE}"
    return f"Make the rover move, in a second terminal:\nsource setup.bash\n{FIRST_COMMAND}"


class Terminal:
    """The map over the whole terminal; what stood there before comes back at the end."""

    every_s = 0.1
    closed = False

    def __init__(self) -> None:
        from rich.console import Console
        from rich.live import Live

        self._console = Console()
        self._live = Live(console=self._console, screen=True, auto_refresh=False)
        encoding = (self._console.encoding or "").lower().replace("-", "")
        self.letters = UNICODE if encoding.startswith("utf") else ASCII

    def __enter__(self) -> Terminal:
        self._live.__enter__()
        return self

    def __exit__(self, *_: object) -> None:
        self._live.__exit__(None, None, None)

    def show(self, node: DrivenRover) -> None:
        """Draw map and words anew, as large as the terminal is now."""
        drawn = cells(node.rover, *self.size, self.letters, heard(node), node.believed)
        self.put(drawn, beside(node), below(node), bold=bool(node.notice))

    @property
    def size(self) -> tuple[int, int]:
        """Columns and lines of the map, as large as the terminal is now."""
        columns, lines = self._console.size
        return max(columns - SIDE_COLUMNS, 20), lines - 3

    def put(self, drawn: list[list[Cell]], words: list[str], told: list[str], bold: bool) -> None:
        """A map, the words beside it, and what is told below."""
        from rich.text import Text

        columns, lines = self._console.size
        rows = _as_high(drawn, len(words[: lines - 3]))
        text = Text(no_wrap=True, overflow="crop")
        for row, word in zip(rows, _filled(words, len(rows)), strict=True):
            _append_row(text, row)
            text.append(f"  {word}\n")
        text.append("\n".join(_within(told, columns)), style="bold" if bold else "")
        self._live.update(text, refresh=True)


def _as_high(drawn: list[list[Cell]], lines: int) -> list[list[Cell]]:
    """The map, with empty lines below it where the words beside it need them."""
    return [*drawn, *[[FLOOR] * len(drawn[0])] * (lines - len(drawn))]


def _within(words: list[str], columns: int) -> list[str]:
    """Three lines within the terminal's width: a long one goes on where one is empty."""
    lines = [
        piece
        for line in words
        for piece in textwrap.wrap(line, columns, break_on_hyphens=False) or [""]
    ]
    return ["", *lines] if len(lines) <= 2 else lines[:3]


def _filled(words: list[str], lines: int) -> list[str]:
    return [*words[:lines], *[""] * (lines - len(words))]


def _append_row(text: Any, row: list[Cell]) -> None:
    for cell in row:
        text.append(
            cell.letter, style=colour_of(cell.hue) if cell.hue is not None else STYLES[cell.kind]
        )


class Lines:
    """One line whenever the rover has moved: for a pipe, a file, or a very small terminal."""

    every_s = 1.0
    closed = False

    def __init__(self, node: DrivenRover, out: TextIO) -> None:
        self._out, self._last = out, list[str]()
        if node.about_place:
            self._say(node.about_place)
        topics = ", ".join([*said(node), *node.says_besides])
        self._say(f"The rover is ready. It hears /cmd_vel and says {topics}.")
        if node.listens:
            self._say("It also hears sentences (std_msgs/msg/String), and /motor_state.")
        if node.tf and not node.publishes_tf:
            self._say(f"/tf is left out: its type is missing. {' '.join(next_steps())}")
        if node.by_keys:
            self._say(f"{KEYS_TELL}\n{node.more_keys or KEYS_PACE}")
            return
        self._say("Make it move, in a second terminal: source setup.bash, then")
        self._say(FIRST_COMMAND)

    def show(self, node: DrivenRover) -> None:
        """Say where it is, if that is news."""
        now = [*news(node), _heard_where(node), position(node)]
        for line in now:
            if line and line not in self._last:
                self._say(line)
        self._last = now

    def _say(self, line: str) -> None:
        print(line, file=self._out, flush=True)
