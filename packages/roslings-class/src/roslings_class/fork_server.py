"""The process that makes the processes that grade: all is imported once, then forked.

    python -m roslings_class.fork_server MODULE:FUNCTION LOCK PATIENCE

It reads one line of JSON an order on standard input, and writes one line an event:

    {"start": ORDER}  {"signal": "SIGTERM", "pid": PID}        {"pid": PID, "ended": STATUS}

An order is answered with {"pid": PID, "started": true}. FUNCTION(order) is the whole life of a
process. LOCK is held by the command as long as it lives. When the input ends, however the
command ended, all processes are ended, with PATIENCE seconds to do it in order.
"""

from __future__ import annotations

import json
import os
import select
import signal
import socket
import sys
import time
import traceback
import warnings
from collections.abc import Callable, Iterator
from contextlib import suppress
from importlib import import_module
from pathlib import Path

from roslings.arena import kernel
from roslings.experiment.run_folder import is_abandoned
from roslings_class.preload import load_all
from roslings_class.result import GradingOrder

EntryPoint = Callable[[GradingOrder], None]
KILLED_WITHIN_S = 5.0


class ForkServer:
    """Forks a process for each order, and tells how each ended."""

    def __init__(self, entry_point: EntryPoint, lock: Path, patience_s: float) -> None:
        self._entry_point, self._lock, self._patience_s = entry_point, lock, patience_s
        self._living: set[int] = set()
        self._waker, self._waked = socket.socketpair()
        for end in (self._waker, self._waked):
            end.setblocking(False)
        signal.signal(signal.SIGCHLD, lambda *_: None)
        signal.set_wakeup_fd(self._waked.fileno())

    def run(self) -> None:
        """Obey until the input ends; then end all."""
        for line in self._lines():
            self._obey(json.loads(line))
        self._end_all()

    def _lines(self) -> Iterator[bytes]:
        """The lines of the input; between them, ended processes are collected."""
        unfinished = b""
        while True:
            sources: list[int | socket.socket] = [0, self._waker]
            ready, _, _ = select.select(sources, [], [])
            if self._waker in ready:
                self._waker.recv(4096)
                self._collect()
            if 0 in ready:
                chunk = os.read(0, 65536)
                if not chunk:
                    return
                *whole, unfinished = (unfinished + chunk).split(b"\n")
                yield from whole

    def _obey(self, words: dict[str, str]) -> None:
        if "start" in words:
            self._start(GradingOrder.model_validate(words["start"]))
        elif int(words["pid"]) in self._living:
            os.kill(int(words["pid"]), signal.Signals[words["signal"]])

    def _start(self, order: GradingOrder) -> None:
        load_all(order.lab, order.hidden)
        pid = os.fork()
        if pid == 0:
            self._live(order)
        self._living.add(pid)
        _tell({"pid": pid, "started": True})

    def _live(self, order: GradingOrder) -> None:
        """In the new process, to its end."""
        status = 1
        try:
            self._let_go(order)
            if not is_abandoned(self._lock.parent):  # the command may be gone already
                self._entry_point(order)
            status = 0
        except BaseException:
            traceback.print_exc()
        finally:
            sys.stderr.flush()
            os._exit(status)

    def _let_go(self, order: GradingOrder) -> None:
        """Hold nothing of the fork server's, hear no Ctrl-C, and end with it."""
        os.setsid()
        kernel.die_with_parent()
        signal.set_wakeup_fd(-1)
        signal.signal(signal.SIGCHLD, signal.SIG_DFL)
        nothing = os.open(os.devnull, os.O_RDWR)
        errors = os.open(order.errors, os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o600)
        for number, target in ((0, nothing), (1, nothing), (2, errors)):
            os.dup2(target, number)

    def _collect(self) -> None:
        while True:
            try:
                pid, status = os.waitpid(-1, os.WNOHANG)
            except ChildProcessError:
                return
            if pid == 0:
                return
            if pid in self._living:
                self._living.remove(pid)
                self._end_orphans()
                _tell({"pid": pid, "ended": os.waitstatus_to_exitcode(status)})

    def _end_orphans(self) -> None:
        """What a grading left behind has come to us: nothing of it may stay."""
        children = Path(f"/proc/self/task/{os.getpid()}/children").read_text("ascii").split()
        for pid in set(map(int, children)) - self._living:
            os.kill(pid, signal.SIGKILL)

    def _end_all(self) -> None:
        self._end(signal.SIGTERM, self._patience_s)
        self._end(signal.SIGKILL, KILLED_WITHIN_S)
        self._end_orphans()

    def _end(self, number: signal.Signals, patience_s: float) -> None:
        for pid in self._living:
            os.kill(pid, number)
        until_s = time.monotonic() + patience_s
        while self._living and time.monotonic() < until_s:
            select.select([self._waker], [], [], 0.2)
            self._collect()


def _tell(event: dict[str, int]) -> None:
    with suppress(OSError):  # the command is gone; the input ends as well
        os.write(1, json.dumps(event).encode() + b"\n")


def main(entry_point: str, lock: str, patience_s: str) -> None:
    """Import what every process needs, and begin."""
    kernel.adopt_orphans()
    # Tracing in ROS's libraries has threads that only wait. No fork has them, or needs them.
    warnings.filterwarnings("ignore", "This process .* is multi-threaded", DeprecationWarning)
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGPIPE):
        signal.signal(number, signal.SIG_IGN)
    module, _, name = entry_point.partition(":")
    function = getattr(import_module(module), name)
    ForkServer(function, Path(lock), float(patience_s)).run()


if __name__ == "__main__":
    main(*sys.argv[1:])
