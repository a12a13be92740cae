"""A program of a grader's own that stands beside the student's nodes: an operator, a button.

It is a process, so that it can freeze and be killed as a student's program can, or run on another
host. It is started with its plan, JSON, as its only word. Then it is told what to do by lines of
JSON on standard input. It tells what it sees in the same way on standard output. Where there is a
sandbox it stands in one: it hears what strangers' nodes say, and sees of the course its own file
alone.
"""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import threading
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import ExitStack, contextmanager, nullcontext, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from roslings.arena.environment import HERE
from roslings.arena.hosts import Host
from roslings.arena.sandbox import Sandbox

BEGIN = HERE / "companion_begin.py"
"""What begins it. It needs a module that each sandbox shows."""
ENDS_WITHIN_S = 5.0
ASKS = 5
"""So often it is asked to end meanwhile."""

MOST_EVENTS = 50_000
Plan = Mapping[str, Any]


@dataclass(frozen=True)
class Surroundings:
    """What stands around a companion: its whole environment, its walls, its host."""

    environment: Mapping[str, str]
    sandbox: Sandbox | None = None
    host: Host | None = None


class Companion:
    """A process of ours beside the student's nodes. Leaving the `with` block ends it."""

    def __init__(
        self, program: Path, plan: Plan, around: Surroundings, changed: Callable[[], None]
    ) -> None:
        """`changed` is called when it told something."""
        self._program, self._plan, self._surroundings = program, plan, around
        self._changed = changed
        self.pid = 0
        """Where signals go: a sandbox stands between its process and what we have begun."""
        self._around = ExitStack()
        self.events: list[dict[str, Any]] = []
        """What it told, in its order."""

    def __enter__(self) -> Companion:
        host = self._surroundings.host
        inner = [sys.executable, str(BEGIN), str(self._program), json.dumps(self._plan)]
        with host.entered() if host else nullcontext():
            self._around.enter_context(self._begun(inner))
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()
        return self

    def __exit__(self, *error: object) -> None:
        self.kill()
        self._reader.join(ENDS_WITHIN_S)
        for pipe in (self._process.stdin, self._process.stdout):
            with suppress(OSError):
                pipe.close()  # type: ignore[union-attr]  # both are pipes
        self._around.close()

    def tell(self, **words: object) -> None:
        """Tell it what to do; one that is gone does nothing."""
        with suppress(OSError, ValueError):
            self._process.stdin.write(json.dumps(words) + "\n")  # type: ignore[union-attr]
            self._process.stdin.flush()  # type: ignore[union-attr]

    def told(self, kind: str) -> Sequence[dict[str, Any]]:
        """All events of a kind so far."""
        return [event for event in list(self.events) if kind in event]

    @property
    def ready(self) -> bool:
        """It has told that it is there."""
        return bool(self.told("ready"))

    def freeze(self) -> None:
        """It hangs: nothing of it runs any more, and nobody is told."""
        self._send(signal.SIGSTOP)

    def thaw(self) -> None:
        """It runs on."""
        self._send(signal.SIGCONT)

    def leave(self) -> None:
        """It ends in order: the middleware says goodbye for it."""
        for _ in range(ASKS):
            self._send(signal.SIGINT)
            with suppress(subprocess.TimeoutExpired):
                self._process.wait(ENDS_WITHIN_S / ASKS)

    def kill(self) -> None:
        """It is gone at once, and nobody is told."""
        self._send(signal.SIGKILL)
        with suppress(subprocess.TimeoutExpired):
            self._process.wait(ENDS_WITHIN_S)
        self._process.kill()
        self._process.wait()

    def _send(self, number: signal.Signals) -> None:
        if self._process.poll() is None:
            with suppress(ProcessLookupError):
                os.kill(self.pid, number)

    @contextmanager
    def _begun(self, inner: list[str]) -> Iterator[None]:
        """Begin its process, in a sandbox where there is one."""
        sandbox = self._surroundings.sandbox
        if sandbox is None:
            self._process = self._popen(inner)
            self.pid = self._process.pid
            yield
            return
        told, tells = os.pipe()
        with os.fdopen(told, "rb") as told_by, sandbox.around(inner, tells) as (command, _):
            try:
                self._process = self._popen(command, tells)
            finally:
                os.close(tells)
            self.pid = _pid_of(told_by.read(), self._process)
            yield

    def _popen(self, command: Sequence[str], *kept: int) -> subprocess.Popen[str]:
        return subprocess.Popen(
            command,
            env=dict(self._surroundings.environment),
            pass_fds=kept,
            text=True,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
        )

    def _read(self) -> None:
        """In a thread: take what it tells, to its end."""
        with suppress(ValueError):
            for line in self._process.stdout or ():
                if len(self.events) < MOST_EVENTS:
                    self.events.append(json.loads(line))
                self._changed()


def _pid_of(told: bytes, process: subprocess.Popen[str]) -> int:
    """Of the process in the sandbox, as bubblewrap tells it; its own where it could not begin."""
    return int(json.loads(told)["child-pid"]) if told else process.pid
