"""A process that a launch has started."""

from __future__ import annotations

import ctypes
import os
import signal
import subprocess
import time
from collections.abc import Iterator, Sequence
from contextlib import suppress
from typing import Any

from ros2_on_pip.launching.context import Alarm
from ros2_on_pip.launching.events import ProcessEvent
from ros2_on_pip.launching.planned import Planned

_PR_SET_PDEATHSIG = 1
_libc = ctypes.CDLL(None)
SIGNALS = ("SIGINT", "SIGTERM", "SIGKILL")
EARLY_END_S = 5.0
READ_BYTES = 1 << 16
LONGEST_LINE_BYTES = 1 << 16
"""A process that writes more without an end of line gets one."""


class Child:
    """One run of a planned process, with the lines that it has not yet finished."""

    def __init__(self, planned: Planned) -> None:
        """Start it. Raises OSError."""
        self.planned = planned
        self.alarms: list[Alarm] = []
        self.process = subprocess.Popen(
            _command(planned),
            shell=planned.shell,
            env=planned.environment,
            cwd=planned.folder,
            start_new_session=True,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            preexec_fn=_become_child,
        )
        assert self.process.stdout and self.process.stderr
        self.streams = {
            "stdout": self.process.stdout.fileno(),
            "stderr": self.process.stderr.fileno(),
        }
        self._begun = {"stdout": b"", "stderr": b""}
        for number in self.streams.values():
            os.set_blocking(number, False)

    @property
    def name(self) -> str:
        """What it is called on the screen."""
        return self.planned.name

    @property
    def pid(self) -> int:
        """Its number."""
        return self.process.pid

    def told(self, kind: type[ProcessEvent], **more: Any) -> ProcessEvent:
        """An event about it."""
        planned = self.planned
        return kind(
            action=planned.action,
            process_name=planned.name,
            pid=self.pid,
            cmd=planned.command,
            cwd=planned.folder,
            env=planned.environment,
            **more,
        )

    def lines(self, stream: str) -> tuple[list[bytes], bool]:
        """The lines that have come, and whether more can come."""
        try:
            data = os.read(self.streams[stream], READ_BYTES)
        except BlockingIOError:
            return [], True
        except OSError:
            data = b""
        *whole, rest = (self._begun[stream] + data).split(b"\n")
        if rest and (not data or len(rest) > LONGEST_LINE_BYTES):
            whole, rest = [*whole, rest], b""
        self._begun[stream] = rest
        return whole, bool(data)

    def last_lines(self, stream: str) -> Iterator[bytes]:
        """What is left when it has ended; what a grandchild may still write is not waited for."""
        more = True
        while more:
            whole, more = self.lines(stream)
            yield from whole
            if more and not whole:
                break
        if self._begun[stream]:
            yield self._begun[stream]
            self._begun[stream] = b""

    def has_ended(self) -> bool:
        """Whether it has; until `bury` nobody else gets its number."""
        options = os.WEXITED | os.WNOHANG | os.WNOWAIT
        return os.waitid(os.P_PID, self.pid, options) is not None

    @property
    def returncode(self) -> int:
        """How it has ended, as subprocess has it: below zero for a signal."""
        how = os.waitid(os.P_PID, self.pid, os.WEXITED | os.WNOWAIT)
        assert how
        return how.si_status if how.si_code == os.CLD_EXITED else -how.si_status

    def signal(self, name: str) -> None:
        """Send a signal to it and to all that it has started."""
        with suppress(ProcessLookupError):
            os.killpg(self.pid, signal.Signals[name])

    def has_left_something(self) -> bool:
        """Whether a process that it has started still runs, once itself is waited for.

        While one does, nobody else gets the number of its group.
        """
        try:
            os.killpg(self.pid, 0)
        except ProcessLookupError:
            return False
        return True

    def bury(self) -> None:
        """Let its number go; what it has left behind ends at once."""
        self.signal("SIGKILL")
        self.process.wait()
        self.close()

    def close(self) -> None:
        """Nothing is read any more."""
        for stream in (self.process.stdout, self.process.stderr):
            if stream:
                stream.close()


def end_all(children: Sequence[Child]) -> None:
    """The hard way, for a launch that is left early; nothing of theirs is read any more."""
    for name in SIGNALS:
        for child in children:
            if not child.has_ended():
                child.signal(name)
        end_s = time.monotonic() + EARLY_END_S
        while time.monotonic() < end_s and not all(child.has_ended() for child in children):
            time.sleep(0.02)
    for child in children:
        if child.has_ended():
            child.bury()


def _command(planned: Planned) -> Any:
    return " ".join(planned.command) if planned.shell else planned.command


def _become_child() -> None:
    """Hear Ctrl-C even where we were started deaf, and end when the launch is killed."""
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    _libc.prctl(_PR_SET_PDEATHSIG, int(signal.SIGTERM), 0, 0, 0)
