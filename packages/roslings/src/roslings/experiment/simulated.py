"""Watching a node in simulated time, and whether what was seen there may be believed.

A node that follows /clock is as fast as the clock. 20 s of its time cost less than one, and no load
bends its rate. But the clock lies about a node that sleeps or has a thread of its own. It lies,
too, about one that works longer than it has time for. So the same stretch is watched twice, with
other steps and at another speed: what really follows the clock does the same both times.
"""

from __future__ import annotations

import time
from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass

from ros2_on_pip.rates import FEWEST_INTERVALS, NS_PER_S
from roslings.course import RateContract
from roslings.evidence import ExperimentSeen, MessageSeen, Segment
from roslings.probe import Probe
from roslings.probe.clock import Barrier, SimClock
from roslings.seen.rates import in_segment, measure_simulated_rate, place_on_ticks

FIRST_PERIODS, SECOND_PERIODS = 14, 10
FIRST_STEPS, SECOND_STEPS = 5, 8
"""Steps of the clock in one asked period: two numbers, neither a multiple of the other."""

REFINED_STEPS = 8
MOST_MORE = 4
SHORTEST_STEP_NS = 1_000_000
SLOWER = 2.0
"""The second stretch is watched at the speed of the first, divided by this."""

FEWEST_TIMES_SLOWER = 1.5
LARGEST_GROUP = 8
"""Messages that come so many at a time are counted for so much longer."""

COUNTS_TELL = 0.4
"""A rate may be uncertain by this part, from counting, for two of them to be compared."""

LEAST_SPEED = 2.0
"""A node that can be twice as fast as real time can keep up with real time."""

FOLLOWS_WITHIN_S = 3.0
TICK_WITHIN_S = 1.0
SETTLES_S = 1.5
FIRST_MESSAGE_WITHIN_S = 10.0
"""Of simulated time."""


class NotBelieved(Exception):
    """Simulated time says nothing about this node; the text is the reason."""


class SaysNothing(NotBelieved):
    """The node let much simulated time go by, and no message came."""


@dataclass
class SimulatedWatch:
    """One topic, watched in simulated time."""

    probe: Probe
    clock: SimClock
    barrier: Barrier
    topic: str
    limit: RateContract | None

    @property
    def period_s(self) -> float:
        """The asked period; where none is asked, a second."""
        return 1 / self.limit.hz if self.limit else 1.0

    def watch(self) -> None:
        """Watch two stretches. Raises NotBelieved."""
        self.clock.grid_ns = round(self.period_s * NS_PER_S)
        self._until_first_message()
        step_ns = round(self.period_s / FIRST_STEPS * NS_PER_S)
        first = self._stretch(step_ns, FIRST_PERIODS * self.period_s)
        while self._too_coarse(first):
            first = self._again(first)
        if self._too_few(first):
            first = self._for_slow(first)
        if 1 < (group := self._largest_group(first)) <= LARGEST_GROUP:
            self.probe.seen.segments.clear()
            first = self._stretch(first.step_ns, group * self._length_s(first))
        self._require_speed(first)
        length_s = self._length_s(first) * SECOND_PERIODS / FIRST_PERIODS
        step_ns = round(first.step_ns * FIRST_STEPS / SECOND_STEPS)
        second = self._stretch(step_ns, length_s, first.speed / SLOWER)
        self._require_agreement(first, second)
        self._until_sure(second)

    def _until_sure(self, latest: Segment) -> None:
        """Go on, up to a bound, while the rate is too near to a limit to tell."""
        for _ in range(MOST_MORE):
            if self._is_sure():
                return
            latest = self._stretch(latest.step_ns, self._length_s(latest))
        self.probe.note_longest_watch(self.topic)

    def _is_sure(self) -> bool:
        limit, segments = self.limit, self.probe.seen.segments
        rate = measure_simulated_rate(self._placed(), self.clock.ticks, segments)
        limits_hz = (limit.low_hz, limit.high_hz) if limit else ()
        return rate is None or rate.settled(limits_hz)

    def _until_first_message(self) -> None:
        step_ns = round(self.period_s / FIRST_STEPS * NS_PER_S)
        began_s, ticks = time.monotonic(), 0
        while self._count() == 0 or self._between_periods():
            self._tick(step_ns)
            ticks += 1
            robot_s = ticks * step_ns / NS_PER_S
            if robot_s > FIRST_MESSAGE_WITHIN_S + self.period_s:
                raise SaysNothing(f"no message came in {robot_s:.0f} s of simulated time")
            self._require_keeping_up(began_s, robot_s)

    def _between_periods(self) -> bool:
        """The clock stands beside its grid: the first stretch begins where a timer is due."""
        return (len(self.clock.ticks) - 1) % FIRST_STEPS != 0

    def _stretch(self, step_ns: int, length_s: float, speed: float | None = None) -> Segment:
        """Let `length_s` of simulated time go by, not faster than `speed`. Raises NotBelieved."""
        began_s, first = time.monotonic(), len(self.clock.ticks) - 1
        for number in range(1, round(length_s * NS_PER_S / step_ns) + 1):
            self._tick(step_ns)
            robot_s = number * step_ns / NS_PER_S
            if speed:
                self._pace(began_s + robot_s / speed)
            self._require_keeping_up(began_s, robot_s)
        seen = self.probe.seen
        seen.segments.append(
            Segment(
                first=first,
                last=len(self.clock.ticks) - 1,
                step_ns=step_ns,
                speed=robot_s / (time.monotonic() - began_s),
            )
        )
        return seen.segments[-1]

    def _tick(self, step_ns: int) -> None:
        if not self.clock.tick(step_ns, self.barrier, TICK_WITHIN_S):
            raise NotBelieved("it did not handle a step of the clock in time")

    def _pace(self, until_s: float) -> None:
        time.sleep(max(0.0, until_s - time.monotonic()))

    def _require_keeping_up(self, began_s: float, robot_s: float) -> None:
        real_s = time.monotonic() - began_s
        if real_s > SETTLES_S and real_s > robot_s:
            raise NotBelieved("it is slower than real time")

    def _require_speed(self, segment: Segment) -> None:
        if segment.speed < LEAST_SPEED:
            raise NotBelieved(f"it ran at no more than {segment.speed:.1f} times real time")

    def _too_coarse(self, segment: Segment) -> bool:
        """More than one message in four steps: steps this long can swallow some."""
        return 4 * self._heard(segment) > segment.last - segment.first

    def _too_few(self, segment: Segment) -> bool:
        """It is slower than asked: the shorter second stretch could not tell its rate."""
        return 0 < self._heard(segment) * SECOND_PERIODS <= FEWEST_INTERVALS * FIRST_PERIODS

    def _for_slow(self, segment: Segment) -> Segment:
        """A first stretch as long as for a node of which this rate is asked."""
        hz = self._hz(segment)
        self.probe.seen.segments.clear()
        return self._stretch(round(NS_PER_S / hz / FIRST_STEPS), FIRST_PERIODS / hz)

    def _again(self, segment: Segment) -> Segment:
        """A first stretch with shorter steps."""
        hz = self._hz(segment)
        step_ns = round(NS_PER_S / hz / REFINED_STEPS)
        if step_ns < SHORTEST_STEP_NS:
            raise NotBelieved(f"{hz:.0f} messages a second are too many for simulated time")
        self.probe.seen.segments.clear()
        return self._stretch(step_ns, FIRST_PERIODS / hz)

    def _require_agreement(self, first: Segment, second: Segment) -> None:
        """The same rate at both speeds, as far as counting can tell. Raises NotBelieved."""
        if first.speed < FEWEST_TIMES_SLOWER * second.speed:
            raise NotBelieved("the clock could not be run at two speeds")
        counts = [self._heard(first), self._heard(second)]
        if min(counts) < FEWEST_INTERVALS:
            raise NotBelieved("it sends too little while the clock runs fast")
        lengths_s = [self._length_s(first), self._length_s(second)]
        rates_hz = [count / length_s for count, length_s in zip(counts, lengths_s, strict=True)]
        group = max(self._largest_group(first), self._largest_group(second))
        counting_hz = sum(1.01 * group / length_s for length_s in lengths_s)
        if counting_hz > COUNTS_TELL * min(rates_hz):
            raise NotBelieved("its messages come in groups")
        if abs(rates_hz[0] - rates_hz[1]) > counting_hz:
            raise NotBelieved(
                f"it sends {rates_hz[0]:.2f} or {rates_hz[1]:.2f} messages a second,"
                " as fast as the clock runs"
            )

    def _largest_group(self, segment: Segment) -> int:
        """The most messages that came at one tick."""
        return max(Counter(m.sim_ns for m in self._in(segment)).values(), default=0)

    def _length_s(self, segment: Segment) -> float:
        return (segment.last - segment.first) * segment.step_ns / NS_PER_S

    def _hz(self, segment: Segment) -> float:
        return self._heard(segment) / self._length_s(segment)

    def _heard(self, segment: Segment) -> int:
        return len(self._in(segment))

    def _in(self, segment: Segment) -> list[MessageSeen]:
        return in_segment(self._placed(), self.clock.ticks, segment)

    def _placed(self) -> list[MessageSeen]:
        messages = self.probe.messages(self.topic)
        place_on_ticks(messages, self.clock.ticks)
        return messages

    def _count(self) -> int:
        return self.probe.count(self.topic)


@contextmanager
def followed_clock(probe: Probe, node_names: Sequence[str]) -> Iterator[tuple[SimClock, Barrier]]:
    """A simulated clock that all these nodes listen to. Raises NotBelieved where they do not."""
    with ExitStack() as stack:
        clock = probe.clock()
        barrier = stack.enter_context(probe.barrier(node_names))
        if not probe.until(lambda: _all_follow(probe.seen, node_names, clock), FOLLOWS_WITHIN_S):
            raise NotBelieved("it does not listen to /clock")
        if not probe.until(lambda: barrier.ready, FOLLOWS_WITHIN_S):
            raise NotBelieved("it has no parameter services, which show that it keeps up")
        if others := clock_publishers(probe.seen):
            raise NotBelieved(f"{others[0]} publishes on /clock itself")
        yield clock, barrier


def let_pass(clock: SimClock, barrier: Barrier, length_s: float) -> None:
    """Let simulated time go by in a few steps. Raises NotBelieved."""
    for _ in range(FIRST_STEPS):
        if not clock.tick(round(length_s / FIRST_STEPS * NS_PER_S), barrier, TICK_WITHIN_S):
            raise NotBelieved("it did not handle a step of the clock in time")


def clock_publishers(seen: ExperimentSeen) -> list[str]:
    """The student's nodes that publish simulated time."""
    ends = seen.graph.endpoints
    return [e.node for e in ends if e.topic == "/clock" and e.kind == "publisher"]


def _all_follow(seen: ExperimentSeen, node_names: Sequence[str], clock: SimClock) -> bool:
    ends = seen.graph.endpoints
    subscribers = {e.node for e in ends if e.topic == "/clock" and e.kind == "subscription"}
    return subscribers >= set(node_names) and clock.listeners >= len(set(node_names))
