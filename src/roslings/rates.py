"""How often messages came, and how sure that is: pure arithmetic on what was seen.

A leaf: it imports only the evidence, so that the room that measures and the room that judges
do the same sum.
"""

from __future__ import annotations

import statistics
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

from roslings.evidence import MessageSeen

NS_PER_S = 1e9
FEWEST_INTERVALS = 4
DISAGREEMENT = 0.2
"""Stamps and arrivals may differ by this part of the watch before the stamps are not believed."""


@dataclass(frozen=True)
class Rate:
    """A measured rate: its value, its 95 % uncertainty, and the shape of the intervals."""

    hz: float
    uncertainty_hz: float
    periods_s: tuple[float, ...]
    """Seconds from message to message, lost ones counted."""
    lost: int
    """Messages that were sent and did not arrive: gaps in the sequence numbers."""
    from_stamps: bool
    """True where the publisher's own stamps were believed; else the arrival times were used."""

    @property
    def period_s(self) -> float:
        """The mean time between two messages."""
        return 1 / self.hz

    @property
    def median_s(self) -> float:
        """Half of the periods are shorter."""
        return statistics.median(self.periods_s)

    @property
    def p95_s(self) -> float:
        """95 % of the periods are shorter."""
        ordered = sorted(self.periods_s)
        return ordered[min(len(ordered) - 1, round(0.95 * len(ordered)))]

    @property
    def jitter_s(self) -> float:
        """Standard deviation of the periods."""
        return statistics.pstdev(self.periods_s)

    def uneven_share(self) -> float:
        """The part of the periods that are shorter than half or longer than one and a half."""
        odd = [p for p in self.periods_s if not 0.5 <= p * self.hz <= 1.5]
        return len(odd) / len(self.periods_s)

    def clear_of(self, limits_hz: Sequence[float]) -> bool:
        """No limit lies within the uncertainty: more messages would not change the answer."""
        return all(abs(self.hz - limit) > self.uncertainty_hz for limit in limits_hz)


def measure_rate(messages: Sequence[MessageSeen]) -> Rate | None:
    """The rate of `messages`, in the order of arrival; None where there are too few.

    The times are the publisher's, so a message that waited in a queue does not bend them. The
    count is the sequence number's, so a lost message is a loss and not slowness.
    """
    times_s, stamped = _times(messages)
    counts = _counts(messages)
    steps = [
        (later - earlier, after - before)
        for (earlier, later), (before, after) in zip(
            pairwise(times_s), pairwise(counts), strict=True
        )
        if after > before
    ]
    span_s = times_s[-1] - times_s[0] if times_s else 0.0
    if len(steps) < FEWEST_INTERVALS or span_s <= 0:
        return None
    sent = counts[-1] - counts[0]
    periods_s = tuple(duration / count for duration, count in steps)
    hz = sent / span_s
    uncertainty_hz = hz * _relative_uncertainty(times_s, counts, periods_s, span_s)
    return Rate(hz, uncertainty_hz, periods_s, sent - len(steps), stamped)


def _relative_uncertainty(
    times_s: Sequence[float], counts: Sequence[int], periods_s: Sequence[float], span_s: float
) -> float:
    """Two standard errors of the rate, as a part of it.

    A timer keeps to its grid, so only the first and the last message are uncertain; a loop that
    sleeps wanders, so the error shrinks with the root of the count. The smaller of the two holds
    for what was seen: deviations from a grid that wanders are large.
    """
    grid = statistics.linear_regression(counts, times_s)
    off_grid_s = statistics.pstdev(
        t - grid.slope * c - grid.intercept for t, c in zip(times_s, counts, strict=True)
    )
    wandering = statistics.pstdev(periods_s) * len(periods_s) ** 0.5
    return float(2 * min(off_grid_s * 2**0.5, wandering) / span_s)


def _times(messages: Sequence[MessageSeen]) -> tuple[list[float], bool]:
    """Times of sending in seconds, and whether they are the publisher's own stamps."""
    arrivals_s = [m.arrival_ns / NS_PER_S for m in messages]
    stamps_s = [m.source_ns / NS_PER_S for m in messages if m.source_ns is not None]
    if len(stamps_s) != len(arrivals_s) or not _agree(stamps_s, arrivals_s):
        return arrivals_s, False
    return stamps_s, True


def _agree(stamps_s: Sequence[float], arrivals_s: Sequence[float]) -> bool:
    """Stamps grow, and cover about the same time as the arrivals."""
    if len(stamps_s) < 2:
        return True
    rising = all(earlier <= later for earlier, later in pairwise(stamps_s))
    stamped_s, arrived_s = stamps_s[-1] - stamps_s[0], arrivals_s[-1] - arrivals_s[0]
    return rising and abs(stamped_s - arrived_s) <= DISAGREEMENT * max(stamped_s, arrived_s, 1.0)


def _counts(messages: Sequence[MessageSeen]) -> list[int]:
    """The publisher's own count where it has one that grows; else the order of arrival."""
    sequence = [m.sequence for m in messages if m.sequence is not None]
    growing = all(earlier < later for earlier, later in pairwise(sequence))
    if len(sequence) == len(messages) and growing:
        return sequence
    return list(range(len(messages)))
