"""Keys of a terminal, one by one, and what each means for a robot that is driven by them."""

from __future__ import annotations

import os
import select
import sys
import termios
import tty
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from typing import Any, TextIO

FASTER, SLOWER = 1.1, 0.9
ARROWS = {"\x1b[A": "i", "\x1b[B": ",", "\x1b[C": "l", "\x1b[D": "j"}
"""What a terminal sends for up, down, right and left, to the letter that does the same."""
LONGEST_KEY = 768
"""Bytes: a key that is held sends them faster than they are read, and the newest one counts. Of so
many, no arrow is cut in two: it has three."""

WAYS = {
    "i": (1, 0),
    "u": (1, 1),
    "o": (1, -1),
    "j": (0, 1),
    "k": (0, 0),
    "l": (0, -1),
    ",": (-1, 0),
    "m": (-1, -1),
    ".": (-1, 1),
}
"""Key to forward and to turn, each -1, 0 or 1; positive is ahead, and to the left (REP 103)."""
PACES = {
    "q": (FASTER, FASTER),
    "z": (SLOWER, SLOWER),
    "w": (FASTER, 1.0),
    "x": (SLOWER, 1.0),
    "e": (1.0, FASTER),
    "c": (1.0, SLOWER),
}
"""Key to the factors of both speeds."""

HELP = """\
   u  i  o      i or arrow up: ahead       q / z: faster / slower
   j  k  l      j, l: turn                 w / x: the same, driving only
   m  ,  .      k or any other key: stop   e / c: the same, turning only"""
"""The keys as they lie; at most 80 columns."""


class NoKeys(Exception):
    """There is no terminal to read keys from."""

    def __init__(self) -> None:
        super().__init__(
            "keys are read from a terminal, and this is none. Type the command in a terminal"
            " of its own, without a pipe and not in a launch file."
        )


@dataclass(frozen=True)
class Steering:
    """What a robot is told."""

    forward_m_s: float = 0.0
    turn_rad_s: float = 0.0


@dataclass(frozen=True)
class Hands:
    """How fast the keys drive, and what they say now."""

    speed_m_s: float = 0.5
    turn_rad_s: float = 1.0
    way: tuple[int, int] = (0, 0)

    def press(self, key: str) -> Hands:
        """After one more key; one without a meaning stops."""
        if key in PACES:
            driving, turning = PACES[key]
            return replace(
                self, speed_m_s=self.speed_m_s * driving, turn_rad_s=self.turn_rad_s * turning
            )
        return replace(self, way=WAYS.get(ARROWS.get(key, key), (0, 0)))

    @property
    def steering(self) -> Steering:
        """What the robot is told now."""
        forward, turn = self.way
        return Steering(forward * self.speed_m_s, turn * self.turn_rad_s)


@contextmanager
def keys_of(terminal: TextIO = sys.stdin) -> Iterator[Keys]:
    """Keys as they are pressed, unseen, without Enter; Ctrl-C stays Ctrl-C. Raises NoKeys."""
    if not terminal.isatty():
        raise NoKeys
    descriptor = terminal.fileno()
    keys = Keys(descriptor, termios.tcgetattr(descriptor))
    try:
        tty.setcbreak(descriptor)
        yield keys
    finally:
        keys.restore()


@dataclass(frozen=True)
class Keys:
    """A terminal that hands out each key."""

    descriptor: int
    before: list[Any]
    """How the terminal was, as termios tells it."""

    def restore(self) -> None:
        """Make the terminal as it was."""
        termios.tcsetattr(self.descriptor, termios.TCSADRAIN, self.before)

    @contextmanager
    def handed_over(self) -> Iterator[None]:
        """Another program has the terminal while the block runs."""
        self.restore()
        try:
            yield
        finally:
            tty.setcbreak(self.descriptor)

    def next(self, within_s: float) -> str:
        """The key that is pressed within this time; empty where none is, or the terminal is gone.

        Of a key that repeats, what waits counts once.
        """
        if not select.select([self.descriptor], [], [], within_s)[0]:
            return ""
        pressed = os.read(self.descriptor, LONGEST_KEY).decode("utf-8", "replace")
        return next((name for name in ARROWS if pressed.endswith(name)), pressed[-1:])
