"""The keys of the terminal that watches; without a terminal on both sides there are none."""

from __future__ import annotations

import os
import signal
import sys
import termios
from collections import deque
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from types import FrameType

from ros2_on_pip.keyboard import Keys, NoKeys, keys_of

QUIT = "q"
LOOKS_EACH_S = 0.05
"""How often it looks for a key while a check runs."""
NEW_LINE = "\r\x1b[K"
"""What goes on writes its progress on this line: it makes room."""


@dataclass
class Keyboard:
    """The keys that are pressed; none where there is no terminal, or where none are wanted."""

    keys: Keys | None = None
    has_quit: bool = field(default=False, init=False)
    _waiting: deque[str] = field(default_factory=deque, init=False)

    def is_pressed(self) -> bool:
        """Whether a key waits."""
        self._hear()
        return bool(self._waiting)

    def take(self) -> str:
        """The key that waits; empty where none does."""
        return self._waiting.popleft() if self._waiting else ""

    def _hear(self) -> str:
        """The key that is new; one that is held down counts once, until it is taken."""
        key = self.keys.next(0.0) if self.keys else ""
        if not key or key in self._waiting:
            return ""
        self._waiting.append(key)
        return key

    @contextmanager
    def heard_meanwhile(self, meaning: Callable[[str], str]) -> Iterator[None]:
        """While the block runs, each key is answered at once, and `q` ends the block.

        A signal looks for keys, and no thread: the block forks. Raises KeyboardInterrupt at `q`;
        one more `q` while all is put away does nothing.
        """
        if self.keys is None:
            yield
            return

        def look(_: int, __: FrameType | None) -> None:
            if (key := self._hear()) and not self.has_quit:
                _say(f"{NEW_LINE}{meaning(key)}\n")
                if key == QUIT:
                    self.has_quit = True
                    raise KeyboardInterrupt

        before = signal.signal(signal.SIGALRM, look)
        signal.setitimer(signal.ITIMER_REAL, LOOKS_EACH_S, LOOKS_EACH_S)
        try:
            yield
        finally:
            signal.setitimer(signal.ITIMER_REAL, 0.0)
            signal.signal(signal.SIGALRM, before)

    def forget(self) -> None:
        """What was typed and not read goes to nobody: no `q` more stands at the shell's prompt."""
        if self.keys:
            with suppress(termios.error):  # the terminal is gone
                termios.tcflush(self.keys.descriptor, termios.TCIFLUSH)


def _say(text: str) -> None:
    """To the terminal at once: what a signal breaks into may be in the middle of a `print`."""
    os.write(sys.stdout.fileno(), text.encode(sys.stdout.encoding, "replace"))


@contextmanager
def keyboard(plain: bool) -> Iterator[Keyboard]:
    """With `plain`, or in a pipe, lines come as they always did."""
    if plain or not sys.stdout.isatty():
        yield Keyboard()
        return
    try:
        with keys_of() as keys:
            there = Keyboard(keys)
            try:
                yield there
            finally:
                there.forget()
    except NoKeys:
        yield Keyboard()
