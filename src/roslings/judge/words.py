"""Small phrases that several faults share."""

from __future__ import annotations

import signal


def describe_status(status: int | None) -> str:
    """A process's status in words: `exit code 1`, or `ended by SIGSEGV`."""
    if status is None:
        return "status unknown"
    return f"ended by {signal.Signals(-status).name}" if status < 0 else f"exit code {status}"
