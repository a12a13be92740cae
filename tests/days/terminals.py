"""Terminals for those who follow a page word by word: a bash on a pseudo-terminal each."""

from __future__ import annotations

import os
import pty
import re
import select
import signal
import subprocess
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path

from roslings.course import root
from until_told import OPEN, until_told

PATIENCE_S = 240.0
"""Only a page that does not hold its promise waits so long; a first use downloads ROS."""
LOOK_EVERY_S = 0.05
ESCAPES = re.compile(r"\x1b(\[[0-9;?]*[a-zA-Z]|[=>]|\][^\x07]*\x07)")
KEPT = re.compile(r"PATH|LANG|LC_ALL|ROSLINGS_(?!WS$).*|PIP_.*|UV_.*|https?_proxy|no_proxy", re.I)


@dataclass
class Terminal:
    """A bash on a pseudo-terminal of 100 columns, as a student has it."""

    shell: subprocess.Popen[bytes]
    screen: int
    _said: bytearray = field(default_factory=bytearray)
    _mark: int = 0
    _typed: str = ""

    def type(self, line: str) -> None:
        """Type a line and press Enter; what stood there before no longer counts."""
        self.heard()
        self._mark, self._typed = len(self._said), line
        os.write(self.screen, line.encode() + b"\n")

    def press(self, keys: str) -> None:
        """Press keys, without Enter."""
        os.write(self.screen, keys.encode())

    def press_ctrl_c(self) -> None:
        """Interrupt what runs in the foreground."""
        os.write(self.screen, b"\x03")

    def heard(self) -> str:
        """What came since the last line was typed, without colours and cursor movements."""
        return ESCAPES.sub("", self._said[self._mark :].decode("utf-8", "replace"))

    def said_before(self) -> str:
        """All that it ever showed, what came before the last line that was typed too."""
        return ESCAPES.sub("", self._said.decode("utf-8", "replace"))

    def read_on(self, ending: threading.Event) -> None:
        """Take what comes, for a thread of its own: a terminal that nobody reads blocks."""
        while not ending.is_set():
            if select.select([self.screen], [], [], 0.1)[0]:
                try:
                    self._said += os.read(self.screen, 65536)
                except OSError:  # the shell is gone
                    return

    def rest(self) -> None:
        """Let some time pass, while something is waited for."""
        time.sleep(LOOK_EVERY_S)

    def shows(self, pattern: str) -> None:
        """Wait until the screen has shown it."""
        self.until(lambda: bool(re.search(pattern, self.heard())), f"never {pattern!r}")

    def tells(self, verdict: str) -> None:
        """Wait for a verdict; while nobody can tell, the same line is typed again."""
        until_told(partial(self._asked, verdict), lambda said: OPEN in said)
        self.shows(verdict)

    def _asked(self, verdict: str) -> str:
        self.shows(f"(?:{verdict})|{OPEN}")
        if OPEN in (said := self.heard()):
            self.is_free()
            self.type(self._typed)
        return said

    def is_free(self) -> None:
        """Wait until the prompt is back."""
        self.until(lambda: self.heard().endswith("ready> "), "no prompt")

    def until(self, holds: Callable[[], bool], missing: str) -> None:
        """Wait until something holds of this terminal."""
        until(holds, lambda: f"{missing}:\n{self}", self.rest)

    def __str__(self) -> str:
        return self.heard()[-3000:]


def until(
    holds: Callable[[], bool],
    missing: Callable[[], str],
    rest: Callable[[], None] | None = None,
) -> None:
    """Wait until something holds."""
    late_s = time.monotonic() + PATIENCE_S
    while not holds():
        assert time.monotonic() < late_s, missing()
        rest() if rest else time.sleep(LOOK_EVERY_S)


@contextmanager
def opened(home: Path, domain: int) -> Iterator[Terminal]:
    """A new terminal in the roslings folder; all that was started in it ends with it."""
    screen, other_end = pty.openpty()
    shell = subprocess.Popen(
        ["bash", "--norc", "--noprofile", "-i"],
        cwd=root(),
        env=surroundings(home, domain),
        stdin=other_end,
        stdout=other_end,
        stderr=other_end,
        start_new_session=True,
        preexec_fn=take_terminal,
    )
    os.close(other_end)
    ending, terminal = threading.Event(), Terminal(shell, screen)
    reader = threading.Thread(target=terminal.read_on, args=[ending])
    reader.start()
    try:
        yield terminal
    finally:
        end_session(shell)
        ending.set()
        reader.join()
        os.close(screen)


def take_terminal() -> None:
    """Make standard input the terminal of this session, so that Ctrl-C is heard."""
    import fcntl
    import termios

    fcntl.ioctl(0, termios.TIOCSCTTY, 0)


def surroundings(home: Path, domain: int) -> dict[str, str]:
    """An empty home, no ROS, no screen; the domain only keeps tests apart."""
    kept = {key: value for key, value in os.environ.items() if KEPT.fullmatch(key)}
    own = {"HOME": str(home), "TERM": "xterm", "PS1": "ready> ", "ROS_DOMAIN_ID": str(domain)}
    return {"LANG": "C.UTF-8", **kept, **own, "COLUMNS": "100", "LINES": "40"}


def end_session(shell: subprocess.Popen[bytes]) -> None:
    """End the shell and every process that was started in its terminal."""
    until(lambda: not killed(session_of(shell)), lambda: f"{session_of(shell)} do not end")
    shell.wait()


def killed(processes: list[int]) -> list[int]:
    """Kill what is still there."""
    for process in processes:
        with suppress(ProcessLookupError):
            os.kill(process, signal.SIGKILL)
    return processes


def session_of(shell: subprocess.Popen[bytes]) -> list[int]:
    """The processes of a terminal that still run."""
    found = []
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            state, _, _, session = stat.read_text().rpartition(")")[2].split()[:4]
        except OSError:
            continue
        if int(session) == shell.pid and state != "Z":
            found.append(int(stat.parent.name))
    return found
