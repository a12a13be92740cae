"""Keys that pause and go on, where this process has a terminal for itself."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Protocol

from ros2_on_pip.keyboard import keys_of

SPACE = " "
RIGHT, UP, DOWN = "\x1b[C", "\x1b[A", "\x1b[B"


class KeySource(Protocol):
    """Where keys come from."""

    def next(self, within_s: float) -> str:
        """The key that is pressed within this time; empty where none is."""
        ...


@contextmanager
def pressed(wanted: bool) -> Iterator[KeySource | None]:
    """The keyboard; None where there is none, or where nobody wants it.

    A job in the background has a terminal too, and would be stopped for reading from it.
    """
    if not (wanted and _is_ours()):
        yield None
        return
    with keys_of() as keys:
        yield keys


def _is_ours() -> bool:
    if not sys.stdin.isatty():
        return False
    try:
        return os.tcgetpgrp(sys.stdin.fileno()) == os.getpgrp()
    except OSError:
        return True  # it is a terminal, and not the one whose jobs the shell stops
