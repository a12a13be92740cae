"""The processes that grade, each one submission: started, waited for, bounded, ended."""

from __future__ import annotations

import json
import os
import select
import shutil
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ros2_on_pip.errors import INCONCLUSIVE, RoslingsError
from roslings_class.result import GradingOrder, GradingResult, broken

ENDS_WITHIN_S = 10.0
NO_THREADS = {"OPENBLAS_NUM_THREADS": "1"}
"""What is forked must have no threads; numpy, which some messages need, would start some."""
GRADING = "roslings_class.grading:main"


@dataclass(frozen=True)
class GradingLimits:
    """What one grading may take."""

    seconds: float = 900.0
    """A build has 180 s and each experiment its own bound; nothing honest comes near this."""
    ending_s: float = 40.0
    """To end its nodes in order; longer than the measuring process gets for the same."""


@dataclass(frozen=True)
class EndedGrading:
    """One grading that is over."""

    order: GradingOrder
    result: GradingResult
    evidence: bytes | None


class ForkServerGone(RoslingsError):
    """The process that forks the gradings has ended: killed from outside, or no memory is left."""

    exit_status = INCONCLUSIVE

    def __init__(self) -> None:
        super().__init__(
            "The gradings broke off: a process of roslings was ended from outside.\n"
            "The same command goes on from here. Is memory short? Then add: --jobs 1"
        )


@dataclass
class Worker:
    """One process, and its order."""

    order: GradingOrder
    pid: int
    began_s: float
    stopped_s: float | None = None
    """When it was asked to end; None where it was not."""

    @property
    def seconds(self) -> float:
        """Since it began."""
        return time.monotonic() - self.began_s


class WorkerPool:
    """Those that grade now."""

    def __init__(self, fork_server: subprocess.Popen[bytes], limits: GradingLimits) -> None:
        self.workers: list[Worker] = []
        self._fork_server, self._limits = fork_server, limits
        self._unfinished = b""

    @property
    def soaking(self) -> int:
        """How many of the workers only wait until their nodes have run for long enough."""
        return sum(worker.order.soaking.exists() for worker in self.workers)

    def start(self, order: GradingOrder) -> None:
        """Begin to grade one more. Raises ForkServerGone."""
        order.room.mkdir(mode=0o700, parents=True)
        self._send({"start": order.model_dump(mode="json")})
        self.workers.append(Worker(order, 0, time.monotonic()))

    def wait(self, most_s: float) -> Iterator[EndedGrading]:
        """Those that end within `most_s`, as soon as there is one. Raises ForkServerGone."""
        for worker in self.workers:
            self._insist_on_limits(worker)
        for event in self._events(most_s):
            if "started" in event:
                next(worker for worker in self.workers if not worker.pid).pid = event["pid"]
            else:
                worker = next(worker for worker in self.workers if worker.pid == event["pid"])
                self.workers.remove(worker)
                yield self._ended(worker, event["ended"])

    def _events(self, most_s: float) -> Iterator[dict[str, Any]]:
        assert self._fork_server.stdout is not None
        ready, _, _ = select.select([self._fork_server.stdout], [], [], most_s)
        if ready:
            chunk = self._fork_server.stdout.read1(65536)  # type: ignore[attr-defined]
            if not chunk:
                raise ForkServerGone
            *whole, self._unfinished = (self._unfinished + chunk).split(b"\n")
            yield from map(json.loads, whole)

    def _send(self, words: dict[str, Any]) -> None:
        assert self._fork_server.stdin is not None
        try:
            self._fork_server.stdin.write(json.dumps(words).encode() + b"\n")
            self._fork_server.stdin.flush()
        except OSError as error:
            raise ForkServerGone from error

    def _insist_on_limits(self, worker: Worker) -> None:
        now_s = time.monotonic()
        if worker.stopped_s is not None:
            if now_s - worker.stopped_s > self._limits.ending_s:
                self._send({"signal": "SIGKILL", "pid": worker.pid})
        elif worker.pid and worker.seconds > self._limits.seconds:
            worker.stopped_s = now_s
            self._send({"signal": "SIGTERM", "pid": worker.pid})

    def _ended(self, worker: Worker, status: int) -> EndedGrading:
        """The answer in its room, else why there is none; the room goes."""
        order = worker.order
        try:
            result = GradingResult.model_validate_json(order.answer.read_bytes())
            evidence = order.evidence.read_bytes() if order.evidence.is_file() else None
        except (OSError, ValueError):
            result, evidence = broken(order, self._why(worker, status), worker.seconds), None
        shutil.rmtree(order.room, ignore_errors=True)
        return EndedGrading(order, result, evidence)

    def _why(self, worker: Worker, status: int) -> str:
        if worker.stopped_s is not None:
            return f"The grading did not end within {self._limits.seconds:g} s."
        with suppress(OSError):
            if words := worker.order.errors.read_text("utf-8", "replace").strip():
                return f"The grading broke off: {words.splitlines()[-1]}"
        return f"The grading broke off (status {status})."


@contextmanager
def worker_pool(
    lock: Path, limits: GradingLimits, entry_point: str = GRADING
) -> Iterator[WorkerPool]:
    """A pool that has ended when the block ends: each process, and all that it started."""
    command = [sys.executable, "-m", "roslings_class.fork_server", entry_point]
    words = [str(lock), str(limits.ending_s)]
    with subprocess.Popen(
        [*command, *words],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        start_new_session=True,
        cwd=lock.parent,
        env={**os.environ, **NO_THREADS},
    ) as fork_server:
        made = WorkerPool(fork_server, limits)
        try:
            yield made
        finally:
            _end(fork_server, limits.ending_s + ENDS_WITHIN_S)


def _end(fork_server: subprocess.Popen[bytes], within_s: float) -> None:
    """When its input ends, it ends all in order; the kernel ends them where it cannot."""
    assert fork_server.stdin is not None
    with suppress(OSError):
        fork_server.stdin.close()
    try:
        fork_server.wait(within_s)
    except BaseException:  # a second Ctrl-C does not wait
        fork_server.kill()
        raise
