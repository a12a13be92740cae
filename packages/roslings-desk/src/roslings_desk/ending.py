"""How the desk ends: by Ctrl-C, by `kill`, with its terminal; what it drives is stopped before."""

from __future__ import annotations

import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType

ENDS_IT = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


class SignalHandler:
    """What a signal does: it interrupts what begins, and asks a server to leave.

    An exception at any place of a loop that starts or ends would leave half of it behind. So none
    is raised any more from the moment at which there is a server.
    """

    def __init__(self) -> None:
        self._leave: Callable[[], object] | None = None

    def __call__(self, number: int, frame: FrameType | None) -> None:
        """Handle the signal. Raises KeyboardInterrupt where nothing is served yet."""
        if self._leave is None:
            raise KeyboardInterrupt
        self._leave()

    def asks(self, leave: Callable[[], object]) -> None:
        """From now on each signal calls this."""
        self._leave = leave


@contextmanager
def ending() -> Iterator[SignalHandler]:
    """Take the signals for the time of the block, and then give them back.

    Ctrl-C counts also where a script started us deaf to it; `nohup` keeps its meaning.
    """
    taken = SignalHandler()
    before = {
        number: signal.signal(number, taken)
        for number in ENDS_IT
        if number != signal.SIGHUP or signal.getsignal(number) is not signal.SIG_IGN
    }
    try:
        yield taken
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
