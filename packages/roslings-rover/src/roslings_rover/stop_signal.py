"""Ctrl-C as a wish, not as an exception: nothing is then left half done."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def listening() -> Iterator[threading.Event]:
    """An event that is set when somebody asks to stop: Ctrl-C, or a kind `kill`.

    Also where a script started us deaf to it, as a shell does with a job in the background.
    """
    asked = threading.Event()

    def take(*_: object) -> None:
        asked.set()

    before = {number: signal.signal(number, take) for number in (signal.SIGINT, signal.SIGTERM)}
    try:
        yield asked
    finally:
        for number, action in before.items():
            signal.signal(number, action)
