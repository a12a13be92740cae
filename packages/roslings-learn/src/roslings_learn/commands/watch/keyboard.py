"""The keys of the terminal that watches; without a terminal on both sides there are none."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass

from ros2_on_pip.keyboard import Keys, NoKeys, keys_of


@dataclass
class Keyboard:
    """The keys that are pressed; none where there is no terminal, or where none are wanted."""

    keys: Keys | None = None
    _pressed: str = ""

    def is_pressed(self) -> bool:
        """Whether a key waits."""
        self._pressed = self._pressed or (self.keys.next(0.0) if self.keys else "")
        return bool(self._pressed)

    def take(self) -> str:
        """The key that waits; empty where none does."""
        key, self._pressed = self._pressed, ""
        return key


@contextmanager
def keyboard(plain: bool) -> Iterator[Keyboard]:
    """With `plain`, or in a pipe, lines come as they always did."""
    if plain or not sys.stdout.isatty():
        yield Keyboard()
        return
    try:
        with keys_of() as keys:
            yield Keyboard(keys)
    except NoKeys:
        yield Keyboard()
