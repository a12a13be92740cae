"""How a process ended, as faults have it."""

from __future__ import annotations

from roslings.evidence import ProcessSeen
from roslings.judge.faults.ends import End, Went


def end_of(seen: ProcessSeen) -> End:
    """Its status, and which bounds of its sandbox it met."""
    return End(seen.status, tuple(seen.bounds_met))


def how_it_went(seen: ProcessSeen) -> Went:
    """Of a program that has one task: whether it ended, and how."""
    return Went(end_of(seen) if seen.ended_by_itself else None)
