"""Where a map is shown: a window, the whole terminal, or lines of text for a file or a pipe.

What is drawn on it says who shows something: one rover (`displays.py`), or a race of two.
"""

from __future__ import annotations

import os
import shutil
import sys
import textwrap
import threading
import time
from collections.abc import Callable, Iterable, Iterator
from contextlib import AbstractContextManager, contextmanager
from typing import Any, Literal, Protocol, TextIO, TypeVar

from roslings_rover.errors import DeviceTrouble
from roslings_rover.models.differential_drive import Pose
from roslings_rover.models.world import World, colour_of
from roslings_rover.rover.text_map import FLOOR, MapCell, letters_for

View = Literal["auto", "window", "terminal", "lines"]
Place = Literal["window", "terminal", "lines"]
Node = TypeVar("Node")
Node_contra = TypeVar("Node_contra", contravariant=True)
Window = TypeVar("Window", bound="MapWindow")
Terminal = TypeVar("Terminal", bound="MapTerminal")
SIDE_COLUMNS = 34
LEAST_LINES = 18
LEAST_COLUMNS = 60
STYLES = {
    "floor": "",
    "wall": "bright_black",
    "drawn": "green",
    "path": "cyan",
    "rover": "bold yellow",
    "moving": "bold red",
    "believed": "bright_black",
    "said": "bold magenta",
}


class Display(Protocol[Node_contra]):
    """Shows a node, and what it drives, again and again."""

    every_s: float

    @property
    def closed(self) -> bool:
        """Somebody closed it: what is shown ends, too."""
        ...

    def show(self, node: Node_contra) -> None:
        """Show how things stand now."""
        ...


class NoWindow(DeviceTrouble):
    """A window was asked for and cannot be opened here."""

    def __init__(self, because: str) -> None:
        super().__init__(f"There is no window: {because}. Type: ./roslings rover --view terminal")


@contextmanager
def opened_in(
    view: View,
    window: Callable[[], AbstractContextManager[Display[Node]]],
    terminal: Callable[[], AbstractContextManager[Display[Node]]],
    lines: Callable[[], Display[Node]],
) -> Iterator[Display[Node]]:
    """The display that was asked for, or the best that this place has. Raises NoWindow."""
    place = place_for(view)
    if place == "lines":
        yield lines()
        return
    with window() if place == "window" else terminal() as display:
        yield display


def shown_until(
    asked: threading.Event, display: Display[Node], node: Node, turn: Callable[[], None]
) -> None:
    """Take one `turn` after another, and show them, until the end is asked for or it is closed."""
    due_s = time.monotonic()
    while not (asked.is_set() or display.closed):
        turn()
        if time.monotonic() >= due_s:
            display.show(node)
            due_s = time.monotonic() + display.every_s


def place_for(view: View) -> Place:
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


class MapWindow:
    """A map in a window of matplotlib's."""

    every_s = 0.1

    def __init__(self, title: str, world: World) -> None:
        import matplotlib.pyplot as plt

        from roslings_rover.rover.picture import draw_world

        self._plt = plt
        self._figure, self._axes = plt.subplots(figsize=(7, 7), layout="constrained")
        if self._figure.canvas.manager is not None:
            self._figure.canvas.manager.set_window_title(title)
        draw_world(world, self._axes)
        self._parts: list[Any] = []

    def __enter__(self: Window) -> Window:
        self._plt.show(block=False)
        return self

    def __exit__(self, *_: object) -> None:
        self._plt.close(self._figure)

    @property
    def closed(self) -> bool:
        """The window was closed."""
        return not self._plt.fignum_exists(self._figure.number)

    def _draw_anew(self, parts: Iterable[Any], title: str) -> None:
        """What moves: the parts of last time go before those of now are drawn."""
        for part in self._parts:
            part.remove()
        self._parts = [*parts]
        self._axes.set_title(title, fontsize=10)
        self._figure.canvas.draw_idle()

    def _flush(self) -> None:
        """Let the window answer its buttons, and show what was drawn."""
        self._figure.canvas.flush_events()

    def _words_over(self, pose: Pose, words: str, points: int) -> Any:
        """Words so many points above a place."""
        return self._axes.annotate(
            words,
            (pose.x_m, pose.y_m),
            xytext=(0, points),
            textcoords="offset points",
            ha="center",
            parse_math=False,
        )


class MapTerminal:
    """A map over the whole terminal; what stood there before comes back at the end."""

    every_s = 0.1
    closed = False

    def __init__(self) -> None:
        from rich.console import Console
        from rich.live import Live

        self._console = Console()
        self._live = Live(console=self._console, screen=True, auto_refresh=False)
        self._letters = letters_for(self._console.encoding)

    def __enter__(self: Terminal) -> Terminal:
        self._live.__enter__()
        return self

    def __exit__(self, *_: object) -> None:
        self._live.__exit__(None, None, None)

    @property
    def _size(self) -> tuple[int, int]:
        """Columns and lines of the map, as large as the terminal is now."""
        columns, lines = self._console.size
        return max(columns - SIDE_COLUMNS, 20), lines - 3

    def _put(
        self, drawn: list[list[MapCell]], words: list[str], told: list[str], bold: bool
    ) -> None:
        """A map, the words beside it, and what is told below."""
        from rich.text import Text

        columns, lines = self._console.size
        words = without_gaps(words, lines - 3)
        rows = _as_high(drawn, len(words))
        text = Text(no_wrap=True, overflow="crop")
        for row, word in zip(rows, _filled(words, len(rows)), strict=True):
            _append_row(text, row)
            text.append(f"  {word}\n")
        text.append("\n".join(_within(told, columns)), style="bold" if bold else "")
        self._live.update(text, refresh=True)


def _as_high(drawn: list[list[MapCell]], lines: int) -> list[list[MapCell]]:
    """The map, with empty lines below it where the words beside it need them."""
    return [*drawn, *[[FLOOR] * len(drawn[0])] * (lines - len(drawn))]


def without_gaps(words: list[str], lines: int) -> list[str]:
    """At most so many lines: the empty ones go first, from below."""
    kept = [*words]
    for number in reversed(range(len(words))):
        if len(kept) > lines and not words[number]:
            del kept[number]
    return kept[:lines]


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


def _append_row(text: Any, row: list[MapCell]) -> None:
    for cell in row:
        text.append(
            cell.letter, style=colour_of(cell.hue) if cell.hue is not None else STYLES[cell.kind]
        )


class NewsLines:
    """One line for whatever is news: for a pipe, a file, or a very small terminal."""

    every_s = 1.0
    closed = False

    def __init__(self, out: TextIO) -> None:
        self._out, self._last = out, list[str]()

    def _say_news(self, now: list[str]) -> None:
        """Of the lines that hold now those that did not hold last time."""
        for line in now:
            if line and line not in self._last:
                self._say(line)
        self._last = now

    def _say(self, line: str) -> None:
        print(line, file=self._out, flush=True)
