"""Ctrl-C, also where Python loses it: raised inside a destructor, it is printed and forgotten."""

from __future__ import annotations

import signal
import threading
from typing import NoReturn

_asked = threading.Event()


def listen(*also: signal.Signals) -> None:
    """Take Ctrl-C from now on, even where a script started us deaf to it; `also` counts too."""
    for number in (signal.SIGINT, *also):
        signal.signal(number, _take)


def listen_softly(*also: signal.Signals) -> None:
    """The same, but nothing is interrupted: `check`, and whoever calls it, ends the work."""
    for number in (signal.SIGINT, *also):
        signal.signal(number, _note)


def _note(*_: object) -> None:
    _asked.set()


def _take(*_: object) -> NoReturn:
    _asked.set()
    raise KeyboardInterrupt


def check() -> None:
    """Raise KeyboardInterrupt where Ctrl-C was pressed and the exception did not arrive."""
    if _asked.is_set():
        raise KeyboardInterrupt


def forget() -> None:
    """What follows is the tidying up: only a new Ctrl-C ends that."""
    _asked.clear()
