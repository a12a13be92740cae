"""What stands around the nodes that are judged: operators, buttons and motors, each a process."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import threading
from collections.abc import Callable, Mapping, Sequence
from contextlib import nullcontext, suppress
from pathlib import Path
from typing import Any

from roslings.arena import Host

SCRIPT = Path(__file__).with_name("player.py")
ENDS_WITHIN_S = 5.0
ASKS = 5
"""So often it is asked to end meanwhile."""

MOST_EVENTS = 50_000
Plan = Mapping[str, Any]


class Companion:
    """A process of ours beside the student's nodes. Leaving the `with` block ends it.

    It can freeze, and be killed, as a student's program can.
    """

    def __init__(
        self,
        name: str,
        domain_id: int,
        plan: Plan,
        changed: Callable[[], None],
        host: Host | None = None,
    ) -> None:
        """`plan` is what it plays (see player.py); `changed` is called when it told something."""
        self._plan = {"name": name, **plan}
        self._domain_id, self._changed, self._host = domain_id, changed, host
        self.events: list[dict[str, Any]] = []
        """What it told, in its order."""

    def __enter__(self) -> Companion:
        host = self._host
        environment = {
            **os.environ,
            **(host.environment if host else {}),
            "ROS_STATIC_PEERS": "",  # a node that must reach us on another host is told, not we
            "ROS_DOMAIN_ID": str(self._domain_id),
        }
        with host.entered() if host else nullcontext():
            self._process = subprocess.Popen(
                [sys.executable, str(SCRIPT), json.dumps(self._plan)], env=environment,
                stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                text=True,
            )  # fmt: skip
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()
        return self

    def __exit__(self, *error: object) -> None:
        self.kill()
        self._reader.join(ENDS_WITHIN_S)
        for pipe in (self._process.stdin, self._process.stdout):
            with suppress(OSError):
                pipe.close()  # type: ignore[union-attr]  # both are pipes

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
        """Its node is there."""
        return bool(self.told("ready"))

    def freeze(self) -> None:
        """It hangs: nothing of it runs any more, and nobody is told."""
        self._process.send_signal(signal.SIGSTOP)

    def thaw(self) -> None:
        """It runs on."""
        self._process.send_signal(signal.SIGCONT)

    def leave(self) -> None:
        """It ends in order: the middleware says goodbye for it."""
        for _ in range(ASKS):
            self._process.send_signal(signal.SIGINT)
            with suppress(subprocess.TimeoutExpired):
                self._process.wait(ENDS_WITHIN_S / ASKS)

    def kill(self) -> None:
        """It is gone at once, and nobody is told."""
        self._process.kill()
        self._process.wait()

    def _read(self) -> None:
        """In a thread: take what it tells, to its end."""
        with suppress(ValueError):
            for line in self._process.stdout or ():
                if len(self.events) < MOST_EVENTS:
                    self.events.append(json.loads(line))
                self._changed()
