"""Demands on what messages hold, and on what a node makes of the values that it is told."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass

from ros2_on_pip.rates import NS_PER_S
from roslings.capabilities.topics.faults import relay as faults
from roslings.capabilities.topics.reasons import NothingCame
from roslings.capabilities.topics.record import TOLD
from roslings.course import NodeContract, TopicContract
from roslings.course.contract import Plain
from roslings.course.files import written
from roslings.evidence import MessageSeen, Spoken
from roslings.judge.demands import insist_on_at_most, most_similar
from roslings.judge.faults import NotLogged
from roslings.judge.faults.reasons import StoodStill
from roslings.judge.values import (
    Fields,
    as_number,
    field_of,
    looks_of,
    number_of,
    same,
    shown,
)
from roslings.judge.views import Demand, ExperimentView, ProcessView, TopicView
from roslings.seen.matching import nearest_endpoint

FRESH_S = 1.0
NOT_FINITE = ("NaN", "Infinity", "-Infinity")
"""What stands in kept evidence for numbers that JSON has not."""
LONGEST_PAUSE_S = 0.1

Wanted = Callable[[int, Fields], Plain | None]
"""What is to be shown after the n-th value, from n and the value; None where it is not asked."""


# --- what each message holds -------------------------------------------------------------------


def hold_its_fields(topic: TopicView) -> None:
    """Each message holds what the card says."""
    for content in _contents(topic):
        for name, wanted in topic.contract.fields.items():
            found = field_of(content, name)
            if not same(found, wanted, topic.contract.numbers_within):
                looks = looks_of(found, wanted)
                raise faults.WrongField(topic.name, name, shown(wanted), shown(found), looks)


def leave_at_zero(*filled: str) -> Demand[TopicView]:
    """Each number of a message is 0, but for fields that are `filled`, by their names with dots.

    A field stands for all that is in it. Lists, as those of a covariance, and whole numbers are not
    looked at. Where no message came, there is nothing wrong in one.

    >>> driving.topic(CMD_VEL).must(leave_at_zero("linear.x", "angular.z"))
    """

    def demand(topic: TopicView) -> None:
        for content in (m.content for m in topic.messages if isinstance(m.content, dict)):
            for name, found in _numbers_in(content):
                if found != 0 and not any(f"{name}.".startswith(f"{each}.") for each in filled):
                    raise faults.WrongField(topic.name, name, shown(0.0), shown(found))

    return demand


def _numbers_in(content: Fields, before: str = "") -> Iterator[tuple[str, object]]:
    """Each field of floating point with its value; kept evidence has texts for NaN and infinity."""
    for name, value in content.items():
        if isinstance(value, float) or value in NOT_FINITE:
            yield before + name, value
        elif isinstance(value, dict):
            yield from _numbers_in(value, f"{before}{name}.")


def carry_its_time(topic: TopicView) -> None:
    """Each message's stamp is the time at which it was sent."""
    for message in topic.messages:
        stamp = field_of(message.content, "header.stamp")
        if stamp is None:
            raise NothingCame("no_stamp")
        stamp_s = number_of(stamp, "sec") + number_of(stamp, "nanosec") / NS_PER_S
        if stamp_s == 0:
            raise faults.NoStamp(topic.name)
        if message.source_ns and abs(message.source_ns / NS_PER_S - stamp_s) > FRESH_S:
            raise faults.OldStamp(topic.name, message.source_ns / NS_PER_S - stamp_s)


def _contents(topic: TopicView) -> list[Fields]:
    if topic.type != topic.contract.type:
        raise NothingCame("another_type", topic.name)
    contents: list[Fields] = [m.content for m in topic.messages if isinstance(m.content, dict)]
    if not contents:
        raise NothingCame("nothing", topic.name)
    return contents


# --- what a node makes of a value --------------------------------------------------------------


@dataclass(frozen=True)
class RelayTurn:
    """One value that the node was told, and the last message that came before the next one."""

    number: int
    spoken: Spoken
    before: Spoken | None
    message: MessageSeen | None
    settled: bool
    """Its effect, and that of each value before it, came in time."""

    def heard(self, name: str, with_the_one_before: bool) -> faults.Heard:
        """The value, and the one before it, where the node must remember that."""
        told = [self.before, self.spoken] if with_the_one_before else [self.spoken]
        values = tuple(shown(field_of(each.content, name)) for each in told if each)
        return faults.Heard(name, values, self.spoken.topic)


@dataclass(frozen=True)
class RelayedValue:
    """Where a node hears, and where it shows what it makes of that."""

    node: NodeContract
    heard: str
    """The field of the messages that it is told."""
    topic: TopicContract
    name: str
    """The field of the messages that it publishes."""
    remembers: bool = False
    """What it shows depends on the value before, too."""


def show(place: RelayedValue, wanted: Wanted) -> Demand[ExperimentView]:
    """After each value, the place shows what is wanted."""

    def demand(experiment: ExperimentView) -> None:
        process = experiment.process(place.node)
        judged = 0
        for turn in turns(experiment, place.topic):
            value = wanted(turn.number, turn.spoken.content)
            if value is not None:
                judged += 1
                _judge(process, turn, place, value)
        if not judged:  # the topic or the subscription is missing, and another check says so
            raise NothingCame("not_told_this", place.node.executable)

    return demand


def show_at_first(place: RelayedValue, wanted: Plain) -> Demand[ExperimentView]:
    """Before the first value is told, the place shows this."""

    def demand(experiment: ExperimentView) -> None:
        began_ns = [stage.at_ns for stage in experiment.seen.stages if stage.part == TOLD]
        heard = experiment.topic(place.topic)
        if not began_ns or heard.type != place.topic.type:
            raise NothingCame("not_told", place.node.executable)
        for message in heard.messages:
            found = field_of(message.content, place.name)
            right = same(found, wanted, place.topic.numbers_within)
            if message.arrival_ns < began_ns[0] and not right:
                words = (place.topic.topic, place.name, "", shown(wanted), shown(found))
                raise faults.WrongAtFirst(*words)

    return demand


def answer_each_once(place: RelayedValue) -> Demand[ExperimentView]:
    """No more messages than values were told.

    The first value is told once before it counts. Too few are the fault of another check.
    """

    def demand(experiment: ExperimentView) -> None:
        told = len(experiment.seen.spoken)
        came = len(experiment.topic(place.topic).before_ctrl_c)
        if not told:
            raise NothingCame("not_told", place.node.executable)
        if came > told + 1:
            raise faults.MoreThanAsked(place.topic.topic, told, came)

    return demand


def _judge(process: ProcessView, turn: RelayTurn, place: RelayedValue, wanted: Plain) -> None:
    found = field_of(turn.message.content if turn.message else None, place.name)
    if same(found, wanted, place.topic.numbers_within):
        return
    heard = turn.heard(place.heard, place.remembers)
    words = (place.topic.topic, place.name, heard, shown(wanted))
    if process.seen.ended_by_itself and turn.message is None:
        raise faults.EndedWhileHearing(*words, None, log=process.last_lines())
    if not turn.settled:
        _require_calm(process.experiment.stall_s)
    if turn.message is None:
        raise faults.DoesNotReact(*words, None)
    kind = faults.NotInfinite if _should_be_infinite(found, wanted) else faults.WrongReaction
    raise kind(*words, shown(found), looks_of(found, wanted))


def _require_calm(stall_s: float) -> None:
    """Where an effect did not come in time, a pause may be why. Raises Inconclusive.

    A message that was under way meanwhile is taken for the next value's, so that even a wrong
    value then says nothing.
    """
    if stall_s > LONGEST_PAUSE_S:
        raise StoodStill(stall_s)


def turns(experiment: ExperimentView, topic: TopicContract) -> Iterator[RelayTurn]:
    """Each value that was told, with what the topic said last before the next value."""
    spoken = experiment.seen.spoken
    publisher = nearest_endpoint(experiment.seen.graph, "publisher", topic.topic, topic.type)
    if publisher is None or publisher.type != topic.type:
        raise NothingCame("not_published", topic.topic)
    heard = experiment.seen.topics.get(publisher.topic)
    for number, each in enumerate(spoken):
        last = number + 1 == len(spoken)
        until_ns = None if last else spoken[number + 1].sent_ns
        said = [
            message
            for message in (heard.messages if heard else [])
            if each.sent_ns < message.arrival_ns and (last or message.arrival_ns <= (until_ns or 0))
        ]
        before = spoken[number - 1] if number else None
        settled = all(earlier.settled for earlier in spoken[: number + 1])
        yield RelayTurn(number, each, before, said[-1] if said else None, settled)


def _should_be_infinite(found: object, wanted: Plain) -> bool:
    goal, number = as_number(wanted), as_number(found)
    return goal is not None and not math.isfinite(goal) and number is not None


# --- what a node writes of a value -------------------------------------------------------------


def write_each(node: NodeContract, texts: Callable[[Fields], list[str]]) -> Demand[ExperimentView]:
    """For each value, it writes the card's line with one of `texts(value)`; none: not asked."""
    template = written(node.log, node.node)

    def demand(experiment: ExperimentView) -> None:
        process = experiment.process(node)
        asked = [allowed for s in experiment.seen.spoken if (allowed := texts(s.content))]
        if not asked:
            raise NothingCame("nothing_to_write")
        for allowed in asked:
            lines = [template.format(text=text) for text in allowed]
            if not any(line in text for line in lines for text in process.texts):
                near = most_similar(lines[0], process.texts)
                raise NotLogged(node.executable, lines[0], near)
        every = [template.format(text=text) for allowed in asked for text in allowed]
        insist_on_at_most(process, every, len(asked) + 1)  # the first is told once before

    return demand
