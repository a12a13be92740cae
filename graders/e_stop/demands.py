"""Demands on a button and a guard: what a press leads to, who is reached, how soon all stops."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise

from graders.e_stop import faults
from graders.e_stop.contract import StopContract
from graders.e_stop.reasons import LateCommand, NotWatched
from graders.e_stop.record import (
    DriveSeen,
    EStopSeen,
    HostsSeen,
    MoveSeen,
    PressSeen,
    StopSeen,
)
from ros2_on_pip.rates import NS_PER_S
from roslings.capabilities.qos.demands import values_told
from roslings.capabilities.services.contract import ServiceContract
from roslings.capabilities.services.record import ServicesSeen
from roslings.course import NodeContract, TopicContract
from roslings.course.contract import as_typed
from roslings.course.files import written
from roslings.judge.demands import most_similar, require_its_time, require_steady
from roslings.judge.faults import Inconclusive
from roslings.judge.faults.moments import Awaited
from roslings.judge.faults.sentences import Text
from roslings.judge.lines import texts_of, times
from roslings.judge.values import field_of
from roslings.judge.views import Demand, ExperimentView, ProcessView

DROVE_NS = 1_000_000_000
"""So shortly before a reason to stop it must have driven."""

AFTER_S = 0.5
"""So long after a stop was undone its line may still come."""

LONGEST_PAUSE_S = 0.5
"""Ten turns of a timer: whoever leaves out so many is held up by itself."""

LINK_REPAIRS_S = 4.0
"""On a link that loses packets, what finds each other is told again after seconds. Who gets no
processor for longer than this needs several times as long."""

MOST_LATE_PART = 0.75
"""Of a deadline: where a command of our own was so late, the guard may have heard of it."""


# --- a button ----------------------------------------------------------------------------------


def tell_each_press(service: ServiceContract, topic: TopicContract) -> Demand[ExperimentView]:
    """Each call leads to one message with the card's state, and nothing else is said."""

    def demand(experiment: ExperimentView) -> None:
        presses = experiment.seen.part(EStopSeen).presses
        if not presses:
            raise NotWatched("uncalled", service.service)
        messages = experiment.topic(topic).before_ctrl_c
        for press in presses:
            answer = next(each for each in service.answers if each.request == press.asked)
            said = [
                field_of(message.content, "data")
                for message in messages
                if press.began_ns <= message.arrival_ns <= press.until_ns
            ]
            if said != [answer.state]:
                require_steady(experiment.seen.stall_s)
                asked = ", ".join(f"{name}: {as_typed(it)}" for name, it in press.asked.items())
                words = (asked, as_typed(answer.state), values_told(said))
                raise faults.OtherThanPressed(topic.topic, *words)
        most = 1 + len(experiment.seen.part(ServicesSeen).calls)
        if len(messages) > most:
            raise faults.SaysMore(topic.topic, most, len(messages))

    return demand


def tell_at_once(service: ServiceContract, topic: TopicContract) -> Demand[ExperimentView]:
    """What a call leads to is said within the service's time after the answer.

    The quickest of all calls is judged: a busy computer holds up some, a button that waits is late
    with each.
    """
    within_s = written(service.within_s, service.service)

    def demand(experiment: ExperimentView) -> None:
        presses = experiment.seen.part(EStopSeen).presses
        late_s = [late for each in presses for late in _told_after_s(experiment, topic, each)]
        if late_s and min(late_s) > within_s:
            require_steady(experiment.seen.stall_s)
            raise faults.ToldLate(topic.topic, service.service, within_s, min(late_s))

    return demand


def _told_after_s(
    experiment: ExperimentView, topic: TopicContract, press: PressSeen
) -> Iterator[float]:
    """From the answer to the message; below 0 where the message came first."""
    inside = range(press.began_ns, press.until_ns + 1)
    came_ns = [m.arrival_ns for m in experiment.topic(topic).messages if m.arrival_ns in inside]
    for call in experiment.seen.part(ServicesSeen).calls:
        if call.sent_ns in inside and call.answered_ns and came_ns:
            yield (came_ns[0] - call.answered_ns) / NS_PER_S


# --- a guard -----------------------------------------------------------------------------------


def stand(topic: TopicContract, part: str) -> Demand[ExperimentView]:
    """In this part nobody has released the stop, and the motors are told zero."""

    def demand(experiment: ExperimentView) -> None:
        for stop in _stops_in(experiment, part):
            moves = moves_between(experiment, stop.began_ns, stop.until_ns)
            if not moves:
                require_steady(experiment.seen.stall_s)
                raise faults.TellsTheMotorsNothing(topic.topic, stop.cause)
            for move in moves:
                if move.fields:
                    raise faults.DrivesUnasked(topic.topic, stop.cause, fields_told(move.fields))

    return demand


def drive(
    topic: TopicContract,
    *parts: str,
    deadline_s: float,
    again: bool = False,
    steadily: bool = True,
) -> Demand[ExperimentView]:
    """In these parts the motors are told what the operator wants.

    `again`: they stood before, for a reason that is gone. `steadily`: they never stop in between;
    across a link that loses signs of life, they may.
    """

    def demand(experiment: ExperimentView) -> None:
        drives = [each for each in experiment.seen.part(EStopSeen).drives if each.part in parts]
        if not drives:
            raise NotWatched("not_driven")
        for each in drives:
            judge_drive(experiment, topic.topic, each, deadline_s, again, steadily)

    return demand


def judge_drive(
    experiment: ExperimentView,
    topic: str,
    seen: DriveSeen,
    deadline_s: float,
    again: bool = True,
    steadily: bool = True,
) -> None:
    """One stretch in which it should drive; the words are those of `drive`."""
    waits_s = None if steadily else LINK_REPAIRS_S
    _judge_drive(experiment, topic, seen, deadline_s, again, waits_s)
    if steadily:
        _judge_steadiness(experiment, topic, seen, deadline_s)


def _judge_drive(
    experiment: ExperimentView,
    topic: str,
    seen: DriveSeen,
    deadline_s: float,
    again: bool,
    waits_s: float | None,
) -> None:
    """Who was held up for `waits_s` is not judged; None: for as long as was waited."""
    moves = moves_between(experiment, seen.began_ns, seen.until_ns)
    if not moves:
        require_steady(experiment.seen.stall_s)
        raise faults.TellsTheMotorsNothing(topic, faults.in_words(seen.after))
    first = next((n for n, move in enumerate(moves) if move.fields == seen.command), None)
    words = (topic, seen.after, fields_told(seen.command))
    if first is None:
        _require_commands(experiment, seen, deadline_s)
        require_its_time(experiment.seen, seen.part, waits_s, Awaited("operator"))
        if any(move.fields for move in moves[len(moves) // 2 :]):
            raise faults.OtherCommand(*words, fields_told(moves[-1].fields))
        raise (faults.DoesNotGoOn if again else faults.StandsStill)(*words)
    for move in moves[:first]:
        if _is_partly(move.fields, seen.command):
            raise faults.OtherCommand(*words, fields_told(move.fields))
    for move in moves[first:]:
        if move.fields not in ({}, seen.command):
            raise faults.OtherCommand(*words, fields_told(move.fields))


def _is_partly(told: Mapping[str, float], command: Mapping[str, float]) -> bool:
    """It is of two commands: some fields are of the new one, which nobody could know before."""
    new = sum(told.get(name) == value for name, value in command.items())
    return 0 < new < len(command)


def _judge_steadiness(
    experiment: ExperimentView, topic: str, seen: DriveSeen, deadline_s: float
) -> None:
    """From the first command that came through, none is left out."""
    moves = moves_between(experiment, seen.began_ns, seen.until_ns)
    first = next(n for n, move in enumerate(moves) if move.fields)
    if not all(move.fields for move in moves[first:]):
        _require_commands(experiment, seen, deadline_s)
        require_its_time(experiment.seen, seen.part, deadline_s / 2, Awaited("command"))
        raise faults.Stutters(topic, faults.in_words(seen.after), _longest_gap_s(experiment, seen))


def _require_commands(
    experiment: ExperimentView, seen: DriveSeen | StopSeen, deadline_s: float
) -> None:
    """Before a stop is held against the guard: the operator kept up. Raises Inconclusive."""
    gap_s = _longest_gap_s(experiment, seen)
    if gap_s > MOST_LATE_PART * deadline_s:
        raise LateCommand(gap_s)


def _longest_gap_s(experiment: ExperimentView, seen: DriveSeen | StopSeen) -> float:
    """From one command of the operator to the next, in this stretch."""
    sent = experiment.seen.part(EStopSeen).sent_ns
    inside = [at_ns for at_ns in sent if seen.began_ns <= at_ns <= seen.until_ns]
    return max((later - one for one, later in pairwise(inside)), default=0) / NS_PER_S


def stop_for(topic: TopicContract, reason: str, within_s: float) -> Demand[ExperimentView]:
    """Each time that there is this reason, the motors are told zero in time, and stay so."""

    def demand(experiment: ExperimentView) -> None:
        for stop in _stops_in(experiment, reason):
            _judge_stop(experiment, topic.topic, stop, within_s)

    return demand


def _judge_stop(experiment: ExperimentView, topic: str, stop: StopSeen, within_s: float) -> None:
    everything = experiment.seen.part(EStopSeen).moves
    since_ns = stop.began_ns - DROVE_NS
    if not any(move.fields for move in everything if since_ns <= move.at_ns <= stop.began_ns):
        raise NotWatched("did_not_drive")
    moves = moves_between(experiment, stop.began_ns, stop.until_ns)
    if not moves:
        require_steady(experiment.seen.stall_s)
        raise faults.TellsTheMotorsNothing(topic, faults.After(stop.cause))
    driven = [move.at_ns for move in moves if move.fields]
    late_s = (max(driven, default=stop.began_ns) - stop.began_ns) / NS_PER_S
    if late_s <= within_s and not moves[-1].fields:
        _judge_pauses(experiment, topic, stop, moves)
        return
    if moves[-1].fields:
        watched_s = (stop.until_ns - stop.began_ns) / NS_PER_S
        require_its_time(experiment.seen, stop.part, watched_s - within_s, Awaited("stop"))
        raise faults.DoesNotStop(topic, stop.cause, within_s, watched_s)
    require_its_time(experiment.seen, stop.part, late_s - within_s, Awaited("stop"))
    raise faults.StopsLate(topic, stop.cause, within_s, late_s)


def _judge_pauses(
    experiment: ExperimentView, topic: str, stop: StopSeen, moves: Sequence[MoveSeen]
) -> None:
    """Whoever tells the motors zero tells it all the time.

    Judged where the operator's commands show that who watches was not held up itself.
    """
    if not (watched_s := _longest_gap_s(experiment, stop)):
        return
    pause_s = max((later.at_ns - one.at_ns for one, later in pairwise(moves)), default=0) / NS_PER_S
    if pause_s > LONGEST_PAUSE_S + watched_s:
        require_its_time(experiment.seen, stop.part, pause_s - LONGEST_PAUSE_S, Awaited("message"))
        raise faults.SilentMeanwhile(topic, stop.cause, LONGEST_PAUSE_S, pause_s)


def tell_why(
    node: NodeContract, stops: Mapping[str, StopContract], deadline_s: float
) -> Demand[ExperimentView]:
    """For each stop, the card's line with its reason, once.

    Where the operator's commands were late meanwhile, there was a second reason: Inconclusive.
    """
    template = written(node.log, node.node)

    def demand(experiment: ExperimentView) -> None:
        process = experiment.process(node)
        seen = [stop for stop in experiment.seen.part(EStopSeen).stops if stop.reason in stops]
        if not seen:
            raise NotWatched("no_reason")
        for stop in seen:
            line = template.format(text=stops[stop.reason].says)
            try:
                _judge_line(process, line, stop)
            except faults.ReasonNotTold:
                _require_commands(experiment, stop, deadline_s)
                raise
            except faults.ReasonToldAgain:
                require_its_time(experiment.seen, stop.part, deadline_s / 2, Awaited("event"))
                raise

    return demand


def _judge_line(process: ProcessView, line: str, stop: StopSeen) -> None:
    until_ns = stop.until_ns + int(AFTER_S * NS_PER_S)
    inside = [each for each in process.lines if stop.began_ns <= each.arrival_ns <= until_ns]
    found = times(each for each in inside if line in each.plain)
    if found == 0:
        near = most_similar(line, list(texts_of(inside)))
        raise faults.ReasonNotTold(line, stop.cause, near)
    if found > 1:
        raise faults.ReasonToldAgain(line, stop.cause, found)


def _stops_in(experiment: ExperimentView, part: str) -> list[StopSeen]:
    """Raises NothingToJudge where there are none."""
    stops = [stop for stop in experiment.seen.part(EStopSeen).stops if stop.part == part]
    if not stops:
        raise NotWatched("not_so_far")
    return stops


def moves_between(experiment: ExperimentView, from_ns: int, to_ns: int) -> Sequence[MoveSeen]:
    """What the motors were told then."""
    moves = experiment.seen.part(EStopSeen).moves
    return [move for move in moves if from_ns < move.at_ns <= to_ns]


def fields_told(fields: Mapping[str, float]) -> Text:
    """A command in words."""
    return ", ".join(f"{name}: {value:g}" for name, value in fields.items()) or faults.Zero()


# --- two computers -----------------------------------------------------------------------------


def _hosts(experiment: ExperimentView) -> HostsSeen:
    """Raises Inconclusive where this computer could not play two."""
    hosts = experiment.seen.part(EStopSeen).hosts
    if hosts is None:
        raise NotWatched("one_computer")
    if hosts.refused:
        raise Inconclusive(hosts.refused)
    return hosts


def be_reached(service: ServiceContract, topic: TopicContract) -> Demand[ExperimentView]:
    """What is published on one computer is heard on the other, without multicast."""

    def demand(experiment: ExperimentView) -> None:
        hosts = _hosts(experiment)
        if not hosts.served:
            require_steady(experiment.seen.stall_s)
            raise faults.NotReached("service", service.service)
        if not hosts.heard:
            require_steady(experiment.seen.stall_s)
            raise faults.NotReached("topic", topic.topic)

    return demand


def hear_from_afar(topic: TopicContract) -> Demand[ExperimentView]:
    """What is said on the other computer is heard, without multicast."""

    def demand(experiment: ExperimentView) -> None:
        if not _hosts(experiment).matched:
            require_steady(experiment.seen.stall_s)
            raise faults.NotReached("guard", topic.topic)

    return demand


def on_two_computers(*demands: Demand[ExperimentView]) -> Demand[ExperimentView]:
    """These demands, where there are two computers. Else Inconclusive, with the reason.

    >>> apart.must(on_two_computers(stop_for(CMD_VEL, "far", HOSTS.stops_within_s)))
    """

    def demand(experiment: ExperimentView) -> None:
        _hosts(experiment)
        experiment.must(*demands)

    return demand
