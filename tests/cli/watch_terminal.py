"""`./roslings watch` on a terminal of 80 columns, as a student has it."""

from __future__ import annotations

import os
import pty
import re
import select
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path

from roslings.course import root

PATIENCE_S = 120.0
"""Only a test that fails waits so long."""
ESCAPES = re.compile(r"\x1b(\[[0-9;?]*[a-zA-Z]|[=>]|\][^\x07\x1b]*(\x07|\x1b\\))")


@dataclass
class Watched:
    """The command on a terminal of 80 columns."""

    process: subprocess.Popen[bytes]
    screen: int
    _said: bytearray = field(default_factory=bytearray)

    def press(self, key: str) -> None:
        """Press a key; what stood there before no longer counts."""
        self._said.clear()
        os.write(self.screen, key.encode())

    def forget(self) -> None:
        """What stood there no longer counts; what is on its way neither."""
        while select.select([self.screen], [], [], 0.0)[0]:
            os.read(self.screen, 65536)
        self._said.clear()

    def shows(self, pattern: str) -> str:
        """Wait until the screen has shown it; all that it has shown since the last key."""
        end_s = time.monotonic() + PATIENCE_S
        while not re.search(pattern, self.said()):
            assert time.monotonic() < end_s, f"{pattern!r} does not come:\n{self.said()}"
            if select.select([self.screen], [], [], 0.1)[0]:
                self._said += os.read(self.screen, 65536)
        return self.said()

    @property
    def moves(self) -> bool:
        """It has sent colours, or movements of the cursor."""
        return b"\x1b" in self._said

    def said(self) -> str:
        """Without colours and movements of the cursor."""
        return ESCAPES.sub("", self._said.decode("utf-8", "replace")).replace("\r", "")


@contextmanager
def watching(home: Path, *words: str) -> Iterator[Watched]:
    """`./roslings watch WORDS` of a student with an empty home; it ends well, by itself."""
    screen, other_end = pty.openpty()
    own = {
        "HOME": str(home),
        "ROSLINGS_WS": str(home / "roslings_ws"),
        "TERM": "xterm",
        "COLUMNS": "80",
        "LINES": "24",
        "EDITOR": str(home / "editor"),
        "VISUAL": "",
    }
    process = subprocess.Popen(
        [sys.executable, "-m", "roslings", "watch", *words],
        cwd=root(),
        env={**os.environ, **own},
        stdin=other_end,
        stdout=other_end,
        stderr=other_end,
        start_new_session=True,
    )
    os.close(other_end)
    try:
        yield Watched(process, screen)
        assert process.wait(PATIENCE_S) == 0
    finally:
        if process.poll() is None:
            process.kill()
            process.wait()
        os.close(screen)
