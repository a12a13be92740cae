"""Demands on the messages of a topic: how often they come, what they say, how they count."""

from __future__ import annotations

import math
from itertools import pairwise

from ros2_on_pip.rates import NS_PER_S, Rate
from roslings.capabilities.topics.faults.messages import (
    CountRepeats,
    CountRestarts,
    CountSkips,
    NoMessages,
    WrongText,
)
from roslings.capabilities.topics.faults.rhythm import (
    Bursts,
    FallsSilent,
    SentAgain,
    TooSlow,
    rate_fault,
)
from roslings.capabilities.topics.reasons import EndedInSilence, LostOnTheWay, NearTheLimits
from roslings.course import RateContract, TopicContract
from roslings.course.files import written
from roslings.judge.demands import require_believable, require_steady
from roslings.judge.views import Demand, TopicView, text_pattern
from roslings.seen.rates import in_the_watch

MOST_LOST_PART = 0.05
SILENT_PERIODS = 3.5
"""Messages that do not come for so many periods: each timer of it has run three times meanwhile."""
LATE_PERIODS = 2.0
"""Who was silent for so long at the end of a watch may have stopped in it, or speak again."""


def have_rate(contract: TopicContract) -> Demand[TopicView]:
    """The messages come at the card's rate, evenly."""
    limit = written(contract.rate, contract.topic)

    def demand(topic: TopicView) -> None:
        require_believable(topic.experiment)
        rate = topic.rate
        if rate is None:
            require_steady(topic.experiment.stall_s)
            raise NoMessages(topic.name, len(topic.messages), topic.experiment.watching_s)
        require_speaks_on(topic, rate, limit)
        kind = rate_fault(rate, limit.low_hz, limit.high_hz)
        if kind not in (Bursts, SentAgain):
            require_enough(topic, rate, limit)
        if kind:
            if topic.experiment.clock == "wall" and not rate.far_above(limit.high_hz):
                require_steady(topic.experiment.stall_s)
            if issubclass(kind, TooSlow):
                require_carried(rate)
            raise kind(topic.name, limit.hz, limit.within, rate)

    return demand


def require_speaks_on(topic: TopicView, rate: Rate, limit: RateContract) -> None:
    """It is not silent at the end of the watch. Raises FallsSilent and Inconclusive."""
    silent_s = fell_silent_s(topic)
    if silent_s > LATE_PERIODS * rate.period_s:
        require_steady(topic.experiment.stall_s)
        if silent_s <= SILENT_PERIODS * rate.period_s:
            raise EndedInSilence(silent_s, rate.period_s)
        count = len(in_the_watch(topic.messages, topic.experiment))
        raise FallsSilent(topic.name, limit.hz, limit.within, rate, count, silent_s)


def fell_silent_s(topic: TopicView) -> float:
    """So long before the end of a watch in real time came the last message; 0 where none was due.

    A node that had ended by then is told as such. What this computer may have kept from the node
    is taken away.
    """
    seen, until_ns = topic.experiment, topic.experiment.rate_until_ns
    ended = any((each.ended_ns or math.inf) < (until_ns or 0) for each in seen.processes.values())
    said = in_the_watch(topic.messages, seen)
    if until_ns is None or seen.clock != "wall" or ended or not said:
        return 0.0
    return (until_ns - said[-1].arrival_ns) / NS_PER_S - seen.stall_s - seen.cpu_wait_s


def require_enough(topic: TopicView, rate: Rate, limit: RateContract) -> None:
    """Watching longer could not turn the answer. Raises Inconclusive.

    After the longest watch, a rate at the very limit is what it was measured to be.
    """
    if not topic.heard.watched_to_bound and not rate.clear_of((limit.low_hz, limit.high_hz)):
        raise NearTheLimits(rate.hz, rate.uncertainty_hz, limit.low_hz, limit.high_hz)


def require_carried(rate: Rate) -> None:
    """Before slowness is held against a node: this computer carried what it sent.

    Who sends seldom gives a free computer no reason to lose anything. Raises Inconclusive.
    """
    sent = len(rate.periods_s) + rate.lost
    if rate.lost > MOST_LOST_PART * sent:
        raise LostOnTheWay(rate.lost, sent)


def say_something(topic: TopicView) -> None:
    """A message came.

    >>> talking.topic(CHATTER).must(say_something)
    """
    if not topic.messages:
        require_steady(topic.experiment.stall_s)
        raise NoMessages(topic.name, 0, topic.experiment.watching_s)


def say_its_text(topic: TopicView) -> None:
    """Every text is the card's, with some number."""
    template = written(topic.contract.text, topic.name)
    pattern = text_pattern(template)
    for text in topic.texts:
        if not pattern.fits(text):
            raise WrongText(template.format(n=0), text)


def count_up(topic: TopicView) -> None:
    """Each number is one more than the one before."""
    kinds = {True: CountSkips, False: CountRestarts}
    for before, after in pairwise(topic.numbers()):
        if after == before:
            raise CountRepeats(before, after)
        if after != before + 1:
            raise kinds[after > before](before, after)
