"""A part of a Dask cluster: it runs until somebody wants it to end, and never longer."""

from __future__ import annotations

import signal
import subprocess
import sys
from collections.abc import Sequence
from types import FrameType

from roslings.arena import kernel

ENDS_WITHIN_S = 30.0
"""A worker of Dask ends in order, with few exceptions: then it waits for a task of its own."""
ASKS = (signal.SIGINT, signal.SIGTERM)


class EndRequested(BaseException):
    """Somebody wants this command to end."""


def run_part(part: str, options: Sequence[str]) -> int:
    """Run Dask's scheduler or worker, in this environment; its exit code."""
    return run_until_asked([sys.executable, "-m", "dask", part, *options], ENDS_WITHIN_S)


def run_until_asked(command: Sequence[str], ends_within_s: float) -> int:
    """Run a command until it ends, or we are asked to; it gets its time to end in order.

    It has a session of its own, so that it hears one signal only: of two, Dask ends at once.
    """
    signal.pthread_sigmask(signal.SIG_BLOCK, ASKS)  # until we can end what we have started
    for number in ASKS:
        signal.signal(number, _ask)
    with subprocess.Popen(command, start_new_session=True, preexec_fn=_begin) as process:
        try:
            signal.pthread_sigmask(signal.SIG_UNBLOCK, ASKS)
            return abs(process.wait())
        except EndRequested:
            _end(process, ends_within_s)
            return 0


def _begin() -> None:
    kernel.die_with_parent()
    signal.pthread_sigmask(signal.SIG_UNBLOCK, ASKS)


def _ask(number: int, frame: FrameType | None) -> None:
    raise EndRequested


def _end(process: subprocess.Popen[bytes], within_s: float) -> None:
    """In order; at once where that takes too long, or somebody asks again."""
    try:
        process.terminate()
        process.wait(within_s)
    except (subprocess.TimeoutExpired, EndRequested):
        process.kill()
        process.wait()
