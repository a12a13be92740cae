"""Programs beside the notebook: what a terminal would start, started from a cell."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from pathlib import Path
from types import TracebackType

from ros2_on_pip import mortal
from roslings_learn.notebook.errors import NeverSaid, ProgramEnded
from roslings_learn.notebook.place import LOGS_ON_STDOUT, settle_in

LAUNCH = Path(mortal.__file__)
USUALLY_S = 10.0
END_WITHIN_S = 5.0
LOOK_EVERY_S = 0.02


class NotebookProgram:
    """A program that runs beside the cell. A context manager: leaving the block ends it."""

    def __init__(self, command: str) -> None:
        settle_in()
        self.command = command
        self._process = begin(command)
        self._lines: list[str] = []
        self._reader = threading.Thread(target=self._read, name="roslings program", daemon=True)
        self._reader.start()

    def __enter__(self) -> NotebookProgram:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self.stop()

    @property
    def lines(self) -> list[str]:
        """What it said until now, line by line."""
        return list(self._lines)

    @property
    def runs(self) -> bool:
        """It has not ended."""
        return self._process.poll() is None

    def says(self, text: str, *, timeout_s: float = USUALLY_S) -> str:
        """Wait for a line that holds `text`; returns the line. Raises ProgramEnded, NeverSaid."""
        end_s = time.monotonic() + timeout_s
        while (line := self._line_with(text)) is None:
            if not self._reader.is_alive() and self._line_with(text) is None:
                raise ProgramEnded(self.command, self._process.wait(), text, self.lines)
            if time.monotonic() > end_s:
                raise NeverSaid(self.command, text, timeout_s, self.lines)
            time.sleep(LOOK_EVERY_S)
        return line

    def stop(self) -> int:
        """Press Ctrl-C; returns the exit code. What does not end so is killed after 5 s."""
        code = end(self._process)
        self._reader.join(END_WITHIN_S)
        return code

    def _line_with(self, text: str) -> str | None:
        return next((line for line in list(self._lines) if text in line), None)

    def _read(self) -> None:
        for line in read_lines(self._process):
            self._lines.append(line)


def begin(command: str) -> subprocess.Popen[str]:
    """Start a line of a terminal, in a process group of its own; output and errors are one."""
    return subprocess.Popen(
        [sys.executable, "-I", "-S", str(LAUNCH), str(os.getpid()), "bash", "-c", command],
        env=_of_a_terminal(),
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        errors="replace",
        start_new_session=True,
    )


def _of_a_terminal() -> dict[str, str]:
    """Our environment, and log lines on standard error as in a terminal.

    `ros2 launch` shows that of a node, and standard output only where the launch file says so.
    """
    kept = {name: text for name, text in os.environ.items() if name != LOGS_ON_STDOUT}
    return {**kept, "PYTHONUNBUFFERED": "1"}


def read_lines(process: subprocess.Popen[str]) -> Iterator[str]:
    """What it says, line by line, until it says no more."""
    assert process.stdout is not None  # begin() asked for it
    with process.stdout:
        for line in process.stdout:
            yield line.rstrip("\n")


def end(process: subprocess.Popen[str]) -> int:
    """Ctrl-C for the whole group, then the hard way for what is left; the exit code."""
    _signal(process, signal.SIGINT)
    try:
        return process.wait(END_WITHIN_S)
    except subprocess.TimeoutExpired:
        return -signal.SIGKILL
    finally:
        _signal(process, signal.SIGKILL)
        process.wait()


def _signal(process: subprocess.Popen[str], number: signal.Signals) -> None:
    try:
        os.killpg(process.pid, number)
    except (ProcessLookupError, PermissionError):
        return  # all of it has ended


def _stop(process: subprocess.Popen[str], stopped: threading.Event) -> None:
    stopped.set()
    _signal(process, signal.SIGINT)


def terminal(command: str, *, timeout_s: float = 30.0) -> None:
    """Run a command that ends by itself, as a terminal would, and print what it says.

    One that goes on is stopped after `timeout_s`, with a word about it. Never raises for what the
    command itself does wrong: its exit code is printed.
    """
    settle_in()
    process = begin(command)
    stopped = threading.Event()
    watch = threading.Timer(timeout_s, _stop, (process, stopped))
    watch.start()
    try:
        for line in read_lines(process):
            print(line, flush=True)
        code = process.wait()
    finally:
        watch.cancel()
        end(process)
    if stopped.is_set():
        print(f"(stopped after {timeout_s:g} s: it does not end by itself)")
    elif code:
        print(f"(exit code {code})")
