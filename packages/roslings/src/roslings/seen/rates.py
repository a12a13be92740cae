"""Rates of what an experiment saw: in simulated time, and with what this computer took from them.

The room that measures and the room that judges do the same sum.
"""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import replace

from ros2_on_pip.rates import NS_PER_S, Rate, counts_of, lateness_s, rate_of
from roslings.evidence import ExperimentSeen, MessageSeen, Segment, Tick


def own_rate(rate: Rate | None, seen: ExperimentSeen) -> Rate | None:
    """The rate, where there is one, with what this computer may have taken from it.

    There are two witnesses. The kernel tells how long each thread waited for a processor. It does
    not tell of a lock whose holder waited, or of a virtual machine that was not run itself. The
    canary was late then too.
    """
    if rate is None:
        return None
    return rate.held_up(held_s(rate, seen))


def held_s(rate: Rate, seen: ExperimentSeen) -> float:
    """So long this computer can have held up the node whose rate this is, in seconds.

    A node that reads from a device waits for the device's stand-in, too.
    """
    waited_s = seen.cpu_wait_s + seen.devices_wait_s
    return max(waited_s, canary_late_s(seen) * len(rate.periods_s))


def canary_late_s(seen: ExperimentSeen) -> float:
    """How late the canary was in one turn, on average; 0 where another one sang, too."""
    canary = seen.canary
    if canary is None or canary.imitated or not canary.messages:
        return 0.0
    return lateness_s(canary.messages, canary.wanted_hz) / len(canary.messages)


def in_the_watch(messages: Sequence[MessageSeen], seen: ExperimentSeen) -> Sequence[MessageSeen]:
    """Those that came while a rate was watched in real time; all where none was."""
    if (until_ns := seen.rate_until_ns) is None:
        return messages
    return [message for message in messages if message.arrival_ns <= until_ns]


def measure_simulated_rate(
    messages: Sequence[MessageSeen], ticks: Sequence[Tick], segments: Sequence[Segment]
) -> Rate | None:
    """The rate in simulated time; None where there are too few messages.

    Only what was sent in the segments counts, which follow one another. Each message was sent at
    a tick, so a time is late by up to one step of the clock.
    """
    if not segments:
        return None
    begin_ns = ticks[segments[0].first].sim_ns
    placed = [m for m in messages if m.sim_ns is not None and m.sim_ns > begin_ns]
    times_s = [((m.sim_ns or 0) - begin_ns) / NS_PER_S for m in placed]  # exact: small numbers
    rate = rate_of(times_s, counts_of(placed), True)
    if rate is None:
        return None
    step_s = max(segment.step_ns for segment in segments) / NS_PER_S
    return replace(rate, uncertainty_hz=rate.hz * step_s / sum(rate.periods_s))


def place_on_ticks(messages: Sequence[MessageSeen], ticks: Sequence[Tick]) -> None:
    """Write into each message the simulated time at which it was sent.

    By the publisher's stamp, which is taken when it is sent; by the arrival where there is none.
    """
    walls_ns, monotonic_ns = [t.wall_ns for t in ticks], [t.at_ns for t in ticks]
    for message in messages:
        if message.source_ns is not None:
            passed = bisect_right(walls_ns, message.source_ns)
        else:
            passed = bisect_right(monotonic_ns, message.arrival_ns)
        message.sim_ns = ticks[passed - 1].sim_ns if passed else None


def in_segment(
    messages: Sequence[MessageSeen], ticks: Sequence[Tick], segment: Segment
) -> list[MessageSeen]:
    """The messages that were sent between the segment's first tick and its last."""
    first_ns, last_ns = ticks[segment.first].sim_ns, ticks[segment.last].sim_ns
    return [m for m in messages if m.sim_ns is not None and first_ns < m.sim_ns <= last_ns]
