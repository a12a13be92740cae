"""From message to message: how long it took, and how many were lost on the way."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

from ros2_on_pip.rates import NS_PER_S, Rate, measure_rate, period_bounds_s
from roslings.evidence import Evidence, ExperimentSeen, MessageSeen, TopicSeen
from roslings.seen.matching import nearest_endpoint, own_endpoints
from roslings.seen.rates import in_the_watch, measure_simulated_rate

MOST_COMPARED = 1000
"""Each message is compared with each other one."""
ROUNDING_S = 1e-6


@dataclass(frozen=True)
class RequiredRate:
    """The rate that a lab asks for on a topic, and the limits that still count."""

    topic: str
    type: str
    hz: float
    low_hz: float
    high_hz: float


@dataclass(frozen=True)
class Interval:
    """The time between two messages that came one after the other."""

    end_s: float
    """When the later one was sent, in seconds since the first message."""
    period_s: float
    """Seconds for one message; where some were lost, the time is shared among them."""
    lost: int


@dataclass(frozen=True)
class TopicIntervals:
    """One topic in one experiment."""

    experiment: ExperimentSeen
    seen: TopicSeen
    asked: RequiredRate | None
    rate: Rate | None
    """None where there were too few messages to tell."""
    intervals: tuple[Interval, ...]
    step_s: float | None = None
    """One step of the simulated clock: so late each time can be. None in real time."""
    within_steps: bool = False
    """One period explains all times; what they differ by are the clock's steps."""


def watched(evidence: Evidence, asked: Sequence[RequiredRate]) -> list[TopicIntervals]:
    """Every topic that was heard, in each experiment; those with an asked rate first."""
    found = [
        _watched(experiment, topic, asked)
        for experiment in evidence.experiments.values()
        for topic in _heard(experiment)
    ]
    return sorted(found, key=lambda each: each.asked is None or each.rate is None)


def _heard(experiment: ExperimentSeen) -> Iterator[TopicSeen]:
    return (topic for topic in experiment.topics.values() if topic.messages)


def _watched(
    experiment: ExperimentSeen, topic: TopicSeen, asked: Sequence[RequiredRate]
) -> TopicIntervals:
    meant = next((each for each in asked if _is_meant(experiment, topic, each)), None)
    if experiment.clock == "sim":
        return _simulated(experiment, topic, meant)
    messages = in_the_watch(topic.messages, experiment)
    rate = measure_rate(messages)
    stamped = rate is not None and rate.from_stamps
    intervals = intervals_of(messages, _source_ns if stamped else _arrival_ns)
    return TopicIntervals(experiment, topic, meant, rate, tuple(intervals) if rate else ())


def _simulated(
    experiment: ExperimentSeen, topic: TopicSeen, asked: RequiredRate | None
) -> TopicIntervals:
    """A message is sent at a tick: a perfect timer of 0.435 s has periods of 0.4 and 0.5 s then.

    Where one period explains all times, that is what is shown; the rest is the clock's.
    """
    rate = measure_simulated_rate(topic.messages, experiment.ticks, experiment.segments)
    messages = _in_segments(experiment, topic)
    intervals = tuple(intervals_of(messages, _sim_ns)) if rate else ()
    step_s = max((each.step_ns for each in experiment.segments), default=0) / NS_PER_S
    period_s = _one_period_s(rate, messages, step_s) if rate else None
    if rate and period_s:
        intervals = tuple(_evenly(intervals, period_s))
        rate = replace(rate, periods_s=(period_s,) * len(rate.periods_s))
    return TopicIntervals(experiment, topic, asked, rate, intervals, step_s, period_s is not None)


def _evenly(intervals: Sequence[Interval], period_s: float) -> Iterator[Interval]:
    """The same intervals, where a timer of this period ends them."""
    periods = 0
    for each in intervals:
        periods += 1 + each.lost
        yield replace(each, end_s=periods * period_s, period_s=period_s)


def _one_period_s(rate: Rate, messages: Sequence[MessageSeen], step_s: float) -> float | None:
    """The period that explains all times, as near as possible to the mean; None where none does."""
    if len(messages) > MOST_COMPARED:
        return None
    times_s = [(_sim_ns(message) - _sim_ns(messages[0])) / NS_PER_S for message in messages]
    least_s, most_s = period_bounds_s(times_s, _counts(messages), step_s + ROUNDING_S)
    return min(max(rate.period_s, least_s), most_s) if least_s <= most_s else None


def _in_segments(experiment: ExperimentSeen, topic: TopicSeen) -> list[MessageSeen]:
    """The messages that a simulated rate counts: those since the first segment began."""
    if not experiment.segments:
        return []
    begin_ns = experiment.ticks[experiment.segments[0].first].sim_ns
    return [m for m in topic.messages if m.sim_ns is not None and m.sim_ns > begin_ns]


def _sim_ns(message: MessageSeen) -> int:
    return message.sim_ns or 0


def _source_ns(message: MessageSeen) -> int:
    return message.source_ns or 0


def _arrival_ns(message: MessageSeen) -> int:
    return message.arrival_ns


def _is_meant(experiment: ExperimentSeen, topic: TopicSeen, asked: RequiredRate) -> bool:
    """The topic is the one that was asked for, or the nearest to it that is there."""
    end = nearest_endpoint(experiment.graph, "publisher", asked.topic, asked.type)
    return end is not None and end.topic == topic.name


def unheard(evidence: Evidence) -> list[tuple[str, str, str]]:
    """Experiment, topic and type of what was published and not heard."""
    return sorted(
        {
            (experiment.name, end.topic, end.type)
            for experiment in evidence.experiments.values()
            for end in own_endpoints(experiment.graph)
            if end.kind == "publisher" and not _has_messages(experiment, end.topic)
        }
    )


def _has_messages(experiment: ExperimentSeen, topic: str) -> bool:
    heard = experiment.topics.get(topic)
    return bool(heard and heard.messages)


def intervals_of(
    messages: Sequence[MessageSeen], time_ns: Callable[[MessageSeen], int]
) -> Iterator[Interval]:
    """The intervals behind a rate, when it was measured by the clock `time_ns`."""
    begin_ns = time_ns(messages[0]) if messages else 0
    times_s = [(time_ns(message) - begin_ns) / NS_PER_S for message in messages]
    for (earlier, before), (later, after) in pairwise(zip(times_s, _counts(messages), strict=True)):
        if after > before:
            steps = after - before
            yield Interval(later, (later - earlier) / steps, steps - 1)


def _counts(messages: Sequence[MessageSeen]) -> list[int]:
    """The publisher's own count where it has one that grows; else the order of arrival."""
    sequence = [m.sequence for m in messages if m.sequence is not None]
    growing = all(before < after for before, after in pairwise(sequence))
    if growing and len(sequence) == len(messages):
        return sequence
    return list(range(len(messages)))
