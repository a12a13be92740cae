"""Faults in when messages come: how often, and how evenly."""

from __future__ import annotations

import statistics
from collections.abc import Sequence
from dataclasses import dataclass

from ros2_on_pip.rates import MOST_UNEVEN, STANDARD_ERRORS, Rate
from roslings.judge.faults.base import Fault

STALL = 1.5
"""A period that is longer than the usual one by this factor holds a stall."""

NEXT_TO = 0.3
"""Part of the mean period: so soon after each other, two messages belong together."""

ABOUT = 0.9
"""So few groups of messages tell their rate no better."""

STEADY = 0.1
"""Periods are steady where half of them differ from their median by less than this part of it."""

WORKS_UP_TO = 0.9
"""Work that takes longer than this part of the period is called a wrong period."""

DRIFT = 0.2
"""From the first third of the watch to the last, the period changed by more than this part."""

STRAIGHT = 0.8
"""... and the periods lie so near to a line: their correlation with their number."""


@dataclass(eq=False)
class WrongRate(Fault):
    """The rate is outside its limits."""

    topic: str
    wanted_hz: float
    within: float
    rate: Rate
    was_seen = True
    why = "Other nodes rely on the rate: a slow sensor is like a robot with closed eyes."
    expected = "{wanted_hz:g} Hz on {topic} (within {within:.0%})"

    hint = "Look at the number that you give create_timer(...). In which unit is it?"

    measured = "{rate.hz:.2f} Hz (±{sure_to_hz:.2f}), one message every {rate.period_s:.2f} s"
    mend = (
        "{wanted_hz:g} Hz means one message every {wanted_s:g} s."
        " Look at the period that you give create_timer(...)."
    )

    @property
    def sure_to_hz(self) -> float:
        """How sure the rate is."""
        return max(self.rate.uncertainty_hz, 0.01)

    @property
    def wanted_s(self) -> float:
        """The period to aim at."""
        return 1 / self.wanted_hz


@dataclass(eq=False)
class TooSlow(WrongRate):
    """Fewer messages than asked for."""


@dataclass(eq=False)
class FallsSilent(TooSlow):
    """The messages came at the rate, and then there were no more, while the node ran on."""

    count: int = 0
    silent_s: float = 0.0
    why = "Who listens waits for the next message, and nothing tells that it will not come."
    measured = "{count} messages, and then none for {silent_s:.1f} s"
    hint = "What is another in the timer's function after {count} messages?"
    mend = (
        "The timer's function must publish each time. Look for a condition, a return or a cancel()"
        " before publish(), and for what counts the messages."
    )


@dataclass(eq=False)
class TooFast(WrongRate):
    """More messages than asked for."""


@dataclass(eq=False)
class Bursts(WrongRate):
    """The number is right, but the messages come in groups."""

    why = "A robot that hears nothing for a while and then everything at once acts too late."
    hint = "How often does one call of the timer's function publish?"
    mend = "Publish one message in each call of the timer's function, not several in a loop."

    expected = "one message every {wanted_s:g} s on {topic}, evenly"
    measured = "groups: pauses from {shortest_s:.3f} s to {longest_s:.2f} s between two messages"

    @property
    def shortest_s(self) -> float:
        """The shortest interval."""
        return min(self.rate.periods_s)

    @property
    def longest_s(self) -> float:
        """The longest interval."""
        return max(self.rate.periods_s)


@dataclass(eq=False)
class SentAgain(TooFast):
    """Each message is sent several times, one right after the other."""

    why = "Who counts messages, or waits for the next one, is told the same again."
    measured = (
        "{rate.hz:.1f} messages a second: each time {times} of them, one right after the other"
    )
    hint = "The period is right, and publish() runs {times} times in it. From where is it called?"
    mend = (
        "The period is right, and publish() runs {times} times in it. Look for a second publish(),"
        " a loop around it, or a function that is called twice."
    )

    @property
    def times(self) -> int:
        """How often each comes."""
        return max(2, round(self.rate.hz / self.wanted_hz))


@dataclass(eq=False)
class SleepsAfterWorking(TooSlow):
    """Steady, and longer than asked: the work comes on top of the waiting."""

    measured = (
        "{rate.hz:.2f} Hz: one message every {rate.median_s:.2f} s, evenly,"
        " each about {work_s:.2f} s late"
    )
    hint = "Do you work for {work_s:.2f} s and then sleep for {wanted_s:g} s? The two add up."
    mend = "Use create_timer({wanted_s:g}, ...), and let its function return at once."

    @property
    def work_s(self) -> float:
        """How much of the period may be work."""
        return self.rate.median_s - self.wanted_s


@dataclass(eq=False)
class StallsNowAndThen(TooSlow):
    """The usual period is right, but now and then there is a long pause."""

    hint = "What does your node do only now and then, and takes long? Look for loops and sleep."

    measured = (
        "usually one message every {rate.median_s:.2f} s, but pauses of up to {longest_s:.2f} s"
    )

    @property
    def longest_s(self) -> float:
        """The longest interval."""
        return max(self.rate.periods_s)


@dataclass(eq=False)
class StartsLate(TooSlow):
    """The first message is alone; only after a pause the others come, at the right rate."""

    hint = "What waits between your first publish() and the timer?"
    mend = (
        "Start the timer in __init__, and publish only in its function. What waits between your"
        " first publish() and the timer?"
    )

    measured = (
        "{rate.periods_s[0]:.2f} s from the first message to the second, then one"
        " every {rate.median_s:.2f} s"
    )


@dataclass(eq=False)
class Drifts(WrongRate):
    """The period grows or shrinks from message to message."""

    why = "A rate that changes by itself ends up anywhere."
    hint = (
        "Something grows with every message: a list, a sleep, a number of timers. Is"
        " create_timer(...) called more than once?"
    )

    measured = "one message every {first_s:.2f} s at first, every {last_s:.2f} s at the end"

    @property
    def first_s(self) -> float:
        """The period at the beginning."""
        return thirds(self.rate)[0]

    @property
    def last_s(self) -> float:
        """The period at the end."""
        return thirds(self.rate)[1]


def rate_fault(rate: Rate, low_hz: float, high_hz: float) -> type[WrongRate] | None:
    """What is wrong with a rate; None where it lies within the limits and is even.

    The shape of the intervals tells the likely reason.
    """
    right = low_hz <= rate.hz <= high_hz
    if not right and _comes_again(rate, low_hz, high_hz):
        return SentAgain
    if rate.hz < low_hz and (pauses := _pauses(rate, low_hz, high_hz)):
        return pauses
    if _drifts(rate) and not right:
        return Drifts
    if rate.uneven_share() > MOST_UNEVEN:
        return Bursts
    if right:
        return None
    return TooFast if rate.hz > high_hz else _slow(rate, low_hz, high_hz)


def _comes_again(rate: Rate, low_hz: float, high_hz: float) -> bool:
    """Groups of messages, and the groups come at about the right rate."""
    next_to = [p for p in rate.periods_s if p < NEXT_TO * rate.period_s]
    groups = len(rate.periods_s) - len(next_to)
    groups_hz = groups / sum(rate.periods_s)
    return len(next_to) > 0.9 * groups and ABOUT * low_hz <= groups_hz <= high_hz / ABOUT


def _pauses(rate: Rate, low_hz: float, high_hz: float) -> type[TooSlow] | None:
    """The usual period is right, and some are long: the first, or others too."""
    longest_s = STALL * rate.median_s
    usual = [p for p in rate.periods_s if p <= longest_s]
    if len(usual) == len(rate.periods_s) or not _may_be_within(usual, low_hz, high_hz):
        return None
    return StallsNowAndThen if max(rate.periods_s[1:]) > longest_s else StartsLate


def _may_be_within(periods_s: Sequence[float], low_hz: float, high_hz: float) -> bool:
    """Their mean lies within the limits, as far as so few of them can tell."""
    mean_s = statistics.fmean(periods_s)
    sure_to_s = STANDARD_ERRORS * statistics.pstdev(periods_s) / float(len(periods_s) ** 0.5)
    return mean_s - sure_to_s <= 1 / low_hz and mean_s + sure_to_s >= 1 / high_hz


def _slow(rate: Rate, low_hz: float, high_hz: float) -> type[TooSlow]:
    wanted_s = 2 / (low_hz + high_hz)
    longer = 1 / low_hz < rate.median_s < (1 + WORKS_UP_TO) * wanted_s
    return SleepsAfterWorking if longer and _steady(rate) else TooSlow


def _steady(rate: Rate) -> bool:
    """Half of the periods or more are about the same; some may be late."""
    off_s = statistics.median(abs(p - rate.median_s) for p in rate.periods_s)
    return off_s < STEADY * rate.median_s


def thirds(rate: Rate) -> tuple[float, float]:
    """The usual period in the first third of the watch, and in the last, in seconds."""
    third = max(1, len(rate.periods_s) // 3)
    return statistics.median(rate.periods_s[:third]), statistics.median(rate.periods_s[-third:])


def _drifts(rate: Rate) -> bool:
    """The periods lie near a straight line, and it rises or falls."""
    first_s, last_s = thirds(rate)
    if abs(last_s - first_s) <= DRIFT * first_s or len(set(rate.periods_s)) < 2:
        return False
    along = statistics.correlation(range(len(rate.periods_s)), rate.periods_s)
    return abs(along) > STRAIGHT
