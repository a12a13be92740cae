"""The arithmetic of rates, on messages whose times are known."""

from __future__ import annotations

import random
from itertools import accumulate

import pytest

from judge_messages import EPOCH_NS, MS, messages
from ros2_on_pip.rates import Rate, lateness_s, measure_rate
from roslings.evidence import CanarySeen, ExperimentSeen, ProcessSeen, Segment, Tick
from roslings.seen.rates import in_the_watch, measure_simulated_rate, own_rate, place_on_ticks


def grid(period_ms: float, count: int) -> list[float]:
    """Times of a perfect timer."""
    return [n * period_ms for n in range(count)]


def test_a_perfect_timer_is_measured_exactly() -> None:
    """2 Hz is 2 Hz, and nothing is uncertain."""
    rate = measure_rate(messages(grid(500, 11)))
    assert rate is not None
    assert rate.hz == pytest.approx(2.0)
    assert rate.uncertainty_hz < 1e-6
    assert rate.lost == 0
    assert rate.from_stamps


def test_a_lost_message_is_a_loss_and_not_slowness() -> None:
    """Gaps in the sequence count as sent."""
    kept = [n for n in range(21) if n % 3 != 1]
    rate = measure_rate(messages([n * 100 for n in kept], [n + 1 for n in kept]))
    assert rate is not None
    assert rate.hz == pytest.approx(10.0)
    assert rate.lost == 21 - len(kept)
    assert rate.uneven_share() == 0


def test_a_queue_does_not_bend_the_rate() -> None:
    """Everything arrives late and at once: the publisher's stamps still tell 10 Hz."""
    seen = messages(grid(100, 21))
    for message in seen[5:10]:
        message.arrival_ns = seen[10].arrival_ns
    rate = measure_rate(seen)
    assert rate is not None
    assert rate.hz == pytest.approx(10.0)


def test_stamps_that_disagree_with_arrival_are_not_believed() -> None:
    """A publisher whose clock runs twice as fast does not make its rate half as high."""
    seen = messages(grid(100, 21))
    for n, message in enumerate(seen):
        message.source_ns = 1_700_000_000_000_000_000 + n * 200 * MS
    rate = measure_rate(seen)
    assert rate is not None
    assert not rate.from_stamps
    assert rate.hz == pytest.approx(10.0)


@pytest.mark.parametrize("count", range(5))
def test_few_messages_have_no_rate(count: int) -> None:
    """Fewer than four intervals say nothing."""
    assert (measure_rate(messages(grid(500, count))) is None) == (count < 5)


def test_bursts_are_uneven_though_their_mean_is_right() -> None:
    """Four messages at once, every two seconds."""
    times = [start + n for start in range(0, 12_000, 2000) for n in range(4)]
    rate = measure_rate(messages([float(t) for t in times]))
    assert rate is not None
    assert rate.uneven_share() > 0.9


@pytest.mark.parametrize("seed", range(20))
def test_the_uncertainty_covers_the_error_of_a_jittering_timer(seed: int) -> None:
    """A timer that keeps its grid and is late by up to 40 ms: three standard errors hold it."""
    late = random.Random(seed)
    rate = measure_rate(messages([t + late.uniform(0, 40) for t in grid(500, 11)]))
    assert rate is not None
    assert abs(rate.hz - 2.0) < 1.5 * rate.uncertainty_hz


def test_an_answer_that_more_messages_could_change_is_not_clear() -> None:
    """The limit lies within the uncertainty, or it does not."""
    late = random.Random(1)
    rate = measure_rate(messages([t + late.uniform(0, 40) for t in grid(500, 11)]))
    assert rate is not None
    assert rate.clear_of([1.5, 2.5])
    assert not rate.clear_of([rate.hz])


@pytest.mark.parametrize("count", [10, 40])
def test_the_uncertainty_covers_the_error_of_a_loop_that_sleeps(count: int) -> None:
    """Each delay makes all later messages late: still 97 of 100 times the truth is inside."""
    inside = 0
    for seed in range(200):
        late = random.Random(seed)
        times = list(accumulate(500 + late.uniform(0, 40) for _ in range(count + 1)))
        rate = measure_rate(messages(times))
        assert rate is not None
        inside += abs(rate.hz - 1 / 0.52) <= rate.uncertainty_hz
    assert inside >= 194


def test_a_timer_is_told_from_a_loop_that_sleeps() -> None:
    """By the correlation of neighbouring periods."""
    late = random.Random(1)
    timer = measure_rate(messages([t + late.uniform(0, 40) for t in grid(500, 60)]))
    loop = measure_rate(messages(list(accumulate(500 + late.uniform(0, 40) for _ in range(60)))))
    assert timer is not None
    assert loop is not None
    assert timer.anchored
    assert not loop.anchored


def test_waiting_for_a_processor_makes_a_loop_slower_but_not_a_timer() -> None:
    """So what was measured is only the lower bound of the loop's own rate."""
    late = random.Random(1)
    timer = measure_rate(messages([t + late.uniform(0, 40) for t in grid(500, 60)]))
    loop = measure_rate(messages(list(accumulate(500 + late.uniform(0, 40) for _ in range(60)))))
    assert timer is not None
    assert loop is not None
    assert timer.held_up(1.0) == timer
    slowed = loop.held_up(1.2)
    assert slowed.low_hz == loop.low_hz
    assert slowed.high_hz == pytest.approx(loop.hz / (1 - 1.2 / 31.2) + loop.uncertainty_hz, 0.01)


def test_a_backlog_of_the_observer_is_no_reason_to_doubt_the_stamps() -> None:
    """Only the time of the quickest message counts, in each half."""
    seen = messages(grid(100, 21))
    for message in seen[3:9]:
        message.arrival_ns += 400 * MS
    rate = measure_rate(seen)
    assert rate is not None
    assert rate.from_stamps


def test_simulated_time_is_that_of_the_tick() -> None:
    """However the ticks are spread in real time."""
    jumpy = random.Random(7)
    walls = list(accumulate(jumpy.randrange(1, 90) for _ in range(100)))
    ticks = [
        Tick(sim_ns=n * 100 * MS, wall_ns=EPOCH_NS + w * MS, at_ns=w * MS, kept_up=True)
        for n, w in enumerate(walls)
    ]
    seen = messages([w + 0.5 for w in walls[::5]])
    place_on_ticks(seen, ticks)
    whole = Segment(first=0, last=99, step_ns=100 * MS, speed=20.0)
    rate = measure_simulated_rate(seen, ticks, [whole])
    assert rate is not None
    assert rate.hz == pytest.approx(2.0)
    assert rate.uncertainty_hz == pytest.approx(2.0 * 0.1 / 9.0)


@pytest.mark.parametrize("seed", range(20))
def test_a_late_timer_tells_how_much_a_loop_that_sleeps_was_held_up(seed: int) -> None:
    """All its turns together, with the turns that it left out; from the quickest one on."""
    chance = random.Random(seed)
    late = [chance.uniform(0, 90) if chance.random() < 0.4 else 0.0 for _ in range(40)]
    kept = [n for n in range(40) if n % 20 != 10]
    told_s = lateness_s(messages([500 * n + late[n] for n in kept]), hz=2.0)
    assert told_s == pytest.approx((sum(late[n] for n in kept) + 2 * 500) / 1000, abs=0.001)


@pytest.mark.parametrize("count", [1, 2, 40])
def test_a_timer_that_keeps_its_time_is_not_late(count: int) -> None:
    """Whether it sang once or often."""
    assert lateness_s(messages(grid(500, count)), hz=2.0) == pytest.approx(0, abs=1e-5)


@pytest.mark.parametrize(("imitated", "held_s"), [(False, 1.0), (True, 0.3)])
def test_a_late_canary_speaks_for_the_node_beside_it(imitated: bool, held_s: float) -> None:
    """Also where the kernel has seen no waiting; but not where somebody else sang, too.

    It sang 40 times, and was late by 50 ms on average; the node has 20 periods.
    """
    song = messages([500 * n + (100 if n % 2 else 0) for n in range(40)])
    canary = CanarySeen(wanted_hz=2.0, messages=song, imitated=imitated)
    node = ProcessSeen(executable="it", started_ns=0, cpu_wait_s=0.3)
    seen = ExperimentSeen(name="alone", clock="wall", canary=canary, processes={"it": node})
    rate = Rate(2.0, 0.1, (0.5,) * 20, 0, True)
    own = own_rate(rate, seen)
    assert own is not None
    assert own.held_s == pytest.approx(held_s, abs=1e-3)


@pytest.mark.parametrize(("held_s", "told"), [(0.0, False), (0.02, False), (0.5, True)])
def test_an_uncertain_rate_that_was_held_up_below_a_limit_is_blurred(
    held_s: float, told: bool
) -> None:
    """Its own unevenness, which a busy machine makes too, is no reason to believe it."""
    periods_s = (0.1, 0.1, 0.1, 0.1, 0.23) * 6
    rate = Rate(1 / 0.126, 2.0, periods_s, 0, True)
    assert rate.held_up(held_s).blurred([8.0, 12.0]) is told


def test_what_comes_after_the_watch_is_not_in_the_rate() -> None:
    """Nobody noted what the computer took from it."""
    heard = [*messages(grid(500, 21)), *messages([10_500, 14_000, 14_010, 14_020])]
    seen = ExperimentSeen(name="alone", clock="wall")
    assert in_the_watch(heard, seen) == heard
    seen.rate_until_ns = heard[20].arrival_ns
    rate = measure_rate(in_the_watch(heard, seen))
    assert rate is not None
    assert rate.hz == pytest.approx(2.0)
