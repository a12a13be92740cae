"""A program of the course in a process and a domain of its own, read line by line."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from roslings_rover.command_names import COMMANDS
from sources import python_path

PATIENCE_S = 60.0
"""Only a test that fails waits so long."""


def until(condition: Callable[[], bool], missing: Callable[[], str]) -> None:
    """Ask again and again, until it holds; where it never does, the test says what is missing."""
    late_s = time.monotonic() + PATIENCE_S
    while not condition():
        assert time.monotonic() < late_s, missing()
        time.sleep(0.01)


class Program:
    """A running `./roslings ...`."""

    def __init__(self, process: subprocess.Popen[str]) -> None:
        self.process, self.lines = process, list[str]()
        self._changed = threading.Condition()
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def _read(self) -> None:
        assert self.process.stdout
        for line in self.process.stdout:
            with self._changed:
                self.lines.append(line.rstrip("\n"))
                self._changed.notify_all()

    def wait_for(self, pattern: str) -> str:
        """Wait for a line with `pattern`; the line."""

        def found() -> str | None:
            return next((line for line in self.lines if re.search(pattern, line)), None)

        with self._changed:
            line = self._changed.wait_for(found, PATIENCE_S)
        assert line, f"no line with {pattern!r} in {self.lines}"
        return line

    def interrupt(self) -> int:
        """Press Ctrl-C; the exit code."""
        self.process.send_signal(signal.SIGINT)
        code = self.process.wait(PATIENCE_S)
        self._reader.join(PATIENCE_S)
        return code


def environment(domain: int, home: Path) -> dict[str, str]:
    """A new terminal: nothing of the test's own environment but what Python needs."""
    kept = {k: os.environ[k] for k in ("PATH", "LD_LIBRARY_PATH", "LANG") if k in os.environ}
    return kept | {"ROS_DOMAIN_ID": str(domain), "HOME": str(home), "PYTHONPATH": python_path()}


def typed(words: list[str]) -> list[str]:
    """The module that runs a command, and its words: of this package, of `ros2`, of the course."""
    if words[0] == "ros2":
        return ["ros2_on_pip", *words[1:]]
    own = words[0] in {name for _, name, _, _ in COMMANDS}
    return ["roslings_rover" if own else "roslings", *words]


@contextmanager
def running(
    words: list[str], environment: dict[str, str], folder: Path, keys: int = subprocess.DEVNULL
) -> Iterator[Program]:
    """A command of the course while the block runs; nothing of it is left afterwards.

    `keys` is a descriptor that it reads from.
    """
    process = subprocess.Popen(
        [sys.executable, "-m", *typed(words)],
        env=environment,
        cwd=folder,
        text=True,
        start_new_session=True,
        stdin=keys,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
    )
    try:
        yield Program(process)
    finally:
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGKILL)
        process.wait()


def run(
    words: list[str], environment: dict[str, str], folder: Path
) -> subprocess.CompletedProcess[str]:
    """A command of the course, to its end."""
    return subprocess.run(
        [sys.executable, "-m", *typed(words)],
        env=environment,
        cwd=folder,
        text=True,
        capture_output=True,
        stdin=subprocess.DEVNULL,
        timeout=PATIENCE_S,
        check=False,
    )
