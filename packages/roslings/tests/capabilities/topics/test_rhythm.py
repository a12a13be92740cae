"""The likely reason of a wrong rate, told from the shape of the intervals on a busy machine.

The times are made here: a node of a known kind, each of whose messages is late by chance. They
are watched for as long as the graders watch in real time.
"""

from __future__ import annotations

import random
from collections.abc import Callable, Iterator, Sequence
from contextlib import nullcontext
from functools import partial
from itertools import accumulate

import pytest

from judge_messages import messages
from ros2_on_pip.rates import Rate, measure_rate
from roslings.capabilities.topics.demands import require_carried
from roslings.capabilities.topics.faults import rhythm as faults
from roslings.experiment.on_the_wall import LONGEST_PERIODS, SHORTEST_PERIODS
from roslings.judge.faults import Inconclusive

LIMITS_HZ = (1.9, 2.1)
SHORTEST_MS, LONGEST_MS = SHORTEST_PERIODS * 500, LONGEST_PERIODS * 500
SEEDS = range(100)

Late = Callable[[], float]
"""By how many milliseconds the next message is late."""


def all_late(chance: random.Random) -> float:
    """A busy machine: each message waits a little."""
    return chance.uniform(0, 80)


def some_late(chance: random.Random) -> float:
    """A machine with other things to do now and then: three of ten messages wait long."""
    return chance.uniform(0, 250) if chance.random() < 0.3 else 0.0


def timer(late: Late, period_ms: float, first_ms: float = 0.0) -> Iterator[float]:
    """A timer keeps to its grid: no message makes a later one late."""
    return (first_ms + n * period_ms + late() for n in range(100))


def loop(late: Late, periods_ms: Sequence[float]) -> Iterator[float]:
    """A loop that sleeps: each wait shows in all later times."""
    return accumulate(period_ms + late() for period_ms in periods_ms)


def starts_late(late: Late) -> list[float]:
    """One message at once, and the timer only six seconds later."""
    return [0.0, *timer(late, 500, first_ms=6_500)]


def stalls(late: Late) -> list[float]:
    """Every seventh message takes 0.6 s more, and the timer goes on at its grid."""
    stalled = [n for n in range(100) if n % 8 != 7]
    return [500 * n + (600 if n % 8 == 6 else 0) + late() for n in stalled]


def bursts(late: Late) -> list[float]:
    """Four messages at once, every two seconds."""
    return [begin + n for begin in timer(late, 2_000) for n in range(4)]


def sent_again(times: int) -> Callable[[Late], list[float]]:
    """A right timer, each of whose messages is sent several times."""
    return lambda late: [begin + n for begin in timer(late, 500) for n in range(times)]


Kind = type[faults.WrongRate] | None
SHAPES: dict[str, tuple[Callable[[Late], Sequence[float]], Kind]] = {
    "good": (lambda late: list(timer(late, 500)), None),
    "slow": (lambda late: list(timer(late, 1_000)), faults.TooSlow),
    "fast": (lambda late: list(timer(late, 250)), faults.TooFast),
    "starts late": (starts_late, faults.StartsLate),
    "stalls": (stalls, faults.StallsNowAndThen),
    "bursts": (bursts, faults.Bursts),
    "sent twice": (sent_again(2), faults.SentAgain),
    "sent three times": (sent_again(3), faults.SentAgain),
    "works and sleeps": (lambda late: list(loop(late, [610] * 60)), faults.SleepsAfterWorking),
    "grows": (
        lambda late: list(loop(lambda: late() / 3, [500 + 30 * n for n in range(60)])),
        faults.Drifts,
    ),
}


def watch(times_ms: Sequence[float]) -> Rate:
    """The rate when a grader stops watching: it is sure, or the bound is met."""
    seen = messages(times_ms)
    for count in range(5, len(seen) + 1):
        rate, watched_ms = measure_rate(seen[:count]), times_ms[count - 1] - times_ms[0]
        if rate is None or watched_ms < SHORTEST_MS:
            continue
        if rate.settled(LIMITS_HZ) or watched_ms > LONGEST_MS:
            return rate
    raise AssertionError("more times are needed")


def kinds(shape: str, lateness: Callable[[random.Random], float]) -> list[Kind]:
    """What a node of this shape is said to do, under many chances."""
    make, _ = SHAPES[shape]
    chances = [partial(lateness, random.Random(seed)) for seed in SEEDS]
    rates = [watch(sorted(make(late))) for late in chances]
    return [faults.rate_fault(rate, *LIMITS_HZ) for rate in rates]


@pytest.mark.parametrize("shape", SHAPES)
def test_a_busy_machine_changes_no_diagnosis(shape: str) -> None:
    """Every message is late by up to 80 ms: the same words, each time."""
    assert set(kinds(shape, all_late)) == {SHAPES[shape][1]}


@pytest.mark.parametrize("shape", ["good", "stalls", "bursts"])
def test_what_has_long_pauses_is_told_on_a_very_busy_machine(shape: str) -> None:
    """Some messages are late by up to half a period: the same words, each time."""
    assert set(kinds(shape, some_late)) == {SHAPES[shape][1]}


@pytest.mark.parametrize("shape", ["slow", "starts late", "works and sleeps", "grows"])
def test_what_is_slow_is_told_nearly_always_on_a_very_busy_machine(shape: str) -> None:
    """Never is it right; the likely reason may be another one in one of twenty."""
    told = kinds(shape, some_late)
    assert None not in told
    assert told.count(SHAPES[shape][1]) >= 0.95 * len(told)


def test_what_is_sent_again_is_told_in_numbers() -> None:
    """How many come at once, and where to look."""
    fault = faults.SentAgain("/chatter", 2.0, 0.05, watch(sent_again(2)(lambda: 0.0)))
    assert "each time 2 of them, one right after the other" in fault.measured
    assert "publish() runs 2 times" in fault.hint


@pytest.mark.parametrize(("lost", "tells"), [(2, True), (20, False)])
def test_who_is_slow_on_a_computer_that_loses_messages_is_not_judged(
    lost: int, tells: bool
) -> None:
    """A sender that is seldom gives no reason to lose any."""
    rate = Rate(hz=7.0, uncertainty_hz=0.5, periods_s=(1 / 7,) * 40, lost=lost, from_stamps=True)
    with nullcontext() if tells else pytest.raises(Inconclusive):
        require_carried(rate)
