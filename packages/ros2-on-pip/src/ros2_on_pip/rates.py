"""How often messages came, and how sure that is: pure arithmetic on when each was sent and came."""

from __future__ import annotations

import statistics
from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import combinations, pairwise
from typing import Protocol

NS_PER_S = 1e9
FEWEST_INTERVALS = 4
STANDARD_ERRORS = 3.0
"""Three of them hold the truth in 997 of 1,000 measurements."""

CLOCKS_DIFFER = 0.01
CLOCKS_DIFFER_S = 0.005
"""Stamps are not believed where they and the arrivals differ by more: this part, and this time."""

MOST_UNEVEN = 0.25
"""A quarter of the periods may be odd: a busy machine delays single messages, not every one."""

LONGEST_STALL_S = 0.5
"""For which this computer may not even run the observer, before a time is held against a node."""

BLURS_ARRIVALS_S = 0.25
"""So long a wait for a processor, and arrivals alone do not tell whether messages are even."""

MOSTLY = 0.5
ANCHORED = 0.8
"""Below this share of a random walk's spread, the times keep to a grid."""


class MessageTimes(Protocol):
    """What is known of a message: in nanoseconds, by the sender's clock and by the receiver's."""

    @property
    def source_ns(self) -> int | None:
        """When it was sent, by the publisher's stamp."""

    @property
    def sequence(self) -> int | None:
        """The publisher's own count."""

    @property
    def arrival_ns(self) -> int:
        """When it came, by a clock that never goes back."""


@dataclass(frozen=True)
class Rate:
    """A measured rate: its value, its uncertainty, and the shape of the intervals."""

    hz: float
    uncertainty_hz: float
    periods_s: tuple[float, ...]
    """Seconds from message to message, lost ones counted."""
    lost: int
    """Messages that were sent and did not arrive: gaps in the sequence numbers."""
    from_stamps: bool
    """True where the publisher's own stamps were believed; else the arrival times were used."""
    anchored: bool = False
    """The times keep to a grid, as a timer's do: a late message makes no later one late."""
    delayed: float = 0.0
    """The part of the time for which a loop that sleeps was held up by this computer."""

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

    @property
    def held_s(self) -> float:
        """For so long this computer held the node up."""
        return self.delayed * sum(self.periods_s)

    @property
    def free_hz(self) -> float:
        """The rate on a free computer, as far as it is known what this one took."""
        return self.hz / (1 - self.delayed)

    @property
    def low_hz(self) -> float:
        """On a free computer the node is not slower than this."""
        return self.hz - self.uncertainty_hz

    @property
    def high_hz(self) -> float:
        """On a free computer the node is not faster than this."""
        return self.free_hz + self.uncertainty_hz

    def uneven_share(self) -> float:
        """The part of the periods that are shorter than half or longer than one and a half."""
        return _odd_share(self.periods_s, self.period_s)

    def made_uneven_by(self, wait_s: float) -> bool:
        """It is uneven, and so long a wait for a processor is enough to have made it so.

        A message that is late by half a period makes two periods odd, the one before it and the one
        after. What counts is how many more there are than a busy machine may delay. Arrivals that
        the stamps do not bear out are uneven from less: messages wait behind each other.
        """
        too_many = (self.uneven_share() - MOST_UNEVEN) * len(self.periods_s)
        enough_s = too_many / 2 * (self.period_s / 2)
        if not self.from_stamps:
            enough_s = min(enough_s, BLURS_ARRIVALS_S)
        return too_many > 0 and wait_s >= enough_s

    def far_above(self, limit_hz: float) -> bool:
        """Twice as often: a busy computer delays a node, and makes none faster."""
        return self.low_hz > 2 * limit_hz

    @property
    def in_groups(self) -> bool:
        """Most periods are far from the mean: no longer watch makes that even.

        One long pause alone makes no groups; what comes after it may be even.
        """
        others_s = sorted(self.periods_s)[:-1]
        return _odd_share(others_s, statistics.fmean(others_s)) > MOSTLY

    def clear_of(self, limits_hz: Sequence[float]) -> bool:
        """No limit lies within the uncertainty: more messages would not change the answer."""
        return not any(self.low_hz <= limit <= self.high_hz for limit in limits_hz)

    def settled(self, limits_hz: Sequence[float]) -> bool:
        """No longer watch would change the answer."""
        return self.clear_of(limits_hz) or self.in_groups

    def blurred(self, limits_hz: Sequence[float]) -> bool:
        """Only because this computer held the node up is it not clear on which side it is.

        Of a rate that is uncertain by itself, what was measured counts; being held up alone must
        not have brought it below a limit.
        """
        if any(self.hz < limit_hz <= self.free_hz for limit_hz in limits_hz):
            return True
        return not self.clear_of(limits_hz) and replace(self, delayed=0.0).clear_of(limits_hz)

    def held_up(self, held_s: float) -> Rate:
        """The same rate, of a node that was held up for `held_s` while it was watched.

        That makes a loop that sleeps slower than it is. Each of its waits shows in all later times,
        while a timer keeps to its grid.
        """
        if self.anchored:
            return self
        each_s = held_s / len(self.periods_s)
        return replace(self, delayed=min(0.9, each_s / self.period_s))


def _odd_share(periods_s: Sequence[float], mean_s: float) -> float:
    odd = [p for p in periods_s if not 0.5 * mean_s <= p <= 1.5 * mean_s]
    return len(odd) / len(periods_s)


def lateness_s(messages: Sequence[MessageTimes], hz: float) -> float:
    """How late a timer of `hz` was, all its turns together, in seconds.

    A loop that sleeps is slower by as much, for each of its waits shows in all later times. The
    timer's grid goes through that message for which the others are late by the least. A turn that
    was left out was late by a period.
    """
    times_s, _ = _times(messages)
    period_s = 1 / hz
    phases_s = sorted((time_s - times_s[0]) % period_s for time_s in times_s)
    # With the grid through one of them, those before it are late by nearly a period.
    late_s = sum(phases_s) + min(
        earlier * period_s - len(phases_s) * on_grid_s for earlier, on_grid_s in enumerate(phases_s)
    )
    left_out = round((times_s[-1] - times_s[0]) * hz) + 1 - len(times_s)
    return late_s + max(0, left_out) * period_s


def measure_rate(messages: Sequence[MessageTimes]) -> Rate | None:
    """The rate of `messages`, in the order of arrival; None where there are too few.

    The times are the publisher's, so a message that waited in a queue does not bend them. The
    count is the sequence number's, so a lost message is a loss and not slowness.
    """
    times_s, stamped = _times(messages)
    return rate_of(times_s, counts_of(messages), stamped)


def period_bounds_s(
    times_s: Sequence[float], counts: Sequence[int], late_s: float
) -> tuple[float, float]:
    """The shortest and the longest period of a timer that explains all times.

    Each may be late by up to `late_s`, so any two messages bound the period from both sides. Where
    no timer explains them, the shortest is longer than the longest.
    """
    pairs = [
        (times_s[j] - times_s[i], counts[j] - counts[i])
        for i, j in combinations(range(len(times_s)), 2)
        if counts[j] > counts[i]
    ]
    least_s = max(((between_s - late_s) / count for between_s, count in pairs), default=0.0)
    return least_s, min(((between_s + late_s) / count for between_s, count in pairs), default=0.0)


def rate_of(times_s: Sequence[float], counts: Sequence[int], stamped: bool) -> Rate | None:
    """The rate by times of sending and by counts; None where there are too few."""
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
    walk = _walk(periods_s)
    uncertainty_hz = hz * _relative_uncertainty(periods_s, walk, span_s)
    return Rate(hz, uncertainty_hz, periods_s, sent - len(steps), stamped, walk < ANCHORED)


def _relative_uncertainty(periods_s: Sequence[float], walk: float, span_s: float) -> float:
    """Three standard errors of the rate, as a part of it.

    What is uncertain is the time from the first message to the last. For a timer, which keeps to
    its grid, its variance is that of one period. For a loop that sleeps, which wanders, it is n
    times that. The periods' own correlation tells how much of the two it is.
    """
    times = max(1.0, len(periods_s) * walk)
    return STANDARD_ERRORS * statistics.pstdev(periods_s) * float(times**0.5) / span_s


def _walk(periods_s: Sequence[float]) -> float:
    """How fast the variance of the whole grows with the count: 0 on a grid, 1 for a random walk.

    For times that differ independently from a grid, neighbouring periods have a correlation of
    -1/2. For independent periods it is 0. So 1 + 2 r is 0 or 1. Estimated from few, r has a
    standard error of about 1 / sqrt(n), which is added to be on the safe side.
    """
    mean_s = statistics.fmean(periods_s)
    off_s = [p - mean_s for p in periods_s]
    variance = sum(o * o for o in off_s)
    if variance == 0:
        return 0.0
    correlation = sum(a * b for a, b in pairwise(off_s)) / variance
    return float(max(0.0, 1 + 2 * (correlation + len(periods_s) ** -0.5)))


def _times(messages: Sequence[MessageTimes]) -> tuple[list[float], bool]:
    """Times of sending in seconds, and whether they are the publisher's own stamps."""
    arrivals_s = [m.arrival_ns / NS_PER_S for m in messages]
    stamps_s = [m.source_ns / NS_PER_S for m in messages if m.source_ns is not None]
    if len(stamps_s) != len(arrivals_s) or not _agree(stamps_s, arrivals_s):
        return arrivals_s, False
    return stamps_s, True


def _agree(stamps_s: Sequence[float], arrivals_s: Sequence[float]) -> bool:
    """Stamps grow, and the quickest messages of the first half took as long as of the second.

    A message can be late, and many are on a busy computer. But the quickest of several shows how
    far the two clocks are apart, and that must stay.
    """
    if len(stamps_s) < 2:
        return True
    late_s = [arrival - stamp for stamp, arrival in zip(stamps_s, arrivals_s, strict=True)]
    half = len(late_s) // 2
    rising = all(earlier <= later for earlier, later in pairwise(stamps_s))
    bound_s = CLOCKS_DIFFER_S + CLOCKS_DIFFER * (arrivals_s[-1] - arrivals_s[0])
    return rising and abs(min(late_s[:half]) - min(late_s[half:])) <= bound_s


def counts_of(messages: Sequence[MessageTimes]) -> list[int]:
    """The publisher's own count where it has one that grows; else the order of arrival."""
    sequence = [m.sequence for m in messages if m.sequence is not None]
    growing = all(earlier < later for earlier, later in pairwise(sequence))
    if len(sequence) == len(messages) and growing:
        return sequence
    return list(range(len(messages)))
