"""Small phrases that several faults share."""

from __future__ import annotations

import signal

from roslings.evidence import ProcessSeen

BOUNDS = {
    "memory": "it took more memory than it may",
    "files": "it made more files than it may",
    "output": "it printed without end",
    "pids": "it started more processes and threads than it may",
    "cpu_s": "its processes took more time of the processor than they may",
}


def describe_end(seen: ProcessSeen) -> str:
    """How a process ended, in words: `exit code 1`, or which bound of its sandbox it met."""
    met = [BOUNDS[name] for name in seen.bounds_met]
    return "; ".join([describe_status(seen.status), *met])


def how_it_went(seen: ProcessSeen) -> str:
    """Of a program that has one task: whether it ended, and how."""
    if seen.ended_by_itself:
        return f"the program ended ({describe_end(seen)})"
    return "the program ran on"


def describe_status(status: int | None) -> str:
    """A process's status in words: `exit code 1`, or `ended by SIGSEGV`."""
    if status is None:
        return "status unknown"
    return f"ended by {signal.Signals(-status).name}" if status < 0 else f"exit code {status}"
