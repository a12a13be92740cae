"""Demands on parameters that are set while a node runs: what is taken, refused, and done then."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

from roslings.capabilities.parameters import faults
from roslings.capabilities.parameters.contract import ParameterContract, ParameterWords
from roslings.capabilities.parameters.demands import has_parameter
from roslings.capabilities.parameters.reasons import ParametersUnknown
from roslings.capabilities.parameters.record import ParametersSeen, ParameterTrial, Values
from roslings.capabilities.topics.relay import NOT_FINITE, RelayedValue, RelayTurn, turns
from roslings.course import NodeContract, TopicContract
from roslings.course.contract import Plain, as_typed
from roslings.judge.demands import require_its_time, require_steady
from roslings.judge.faults import Fault
from roslings.judge.faults.moments import Awaited
from roslings.judge.faults.sentences import Text
from roslings.judge.values import Fields, field_of, same, shown
from roslings.judge.views import Demand, ExperimentView
from roslings.seen.matching import nearest_endpoint

TYPES: Mapping[type, str] = {bool: "bool", int: "integer", float: "double", str: "string"}
FIRST = "first"
"""The part of an experiment before anything was set."""
"""How evidence writes numbers that JSON has none for."""
BESIDE_PACE = 0.15
"""So far from the asked time the time of some messages may be, as a part of it."""

FEWEST_BEATS = 4
Wanted = Callable[[Values, Fields], Plain | None]
"""What a node shows, from its parameters and what it was told; None where that is not known."""


# --- which values a node takes -----------------------------------------------------------------


@dataclass(frozen=True)
class RefusalRule:
    """Why the card wants a request to be refused, and the fault where it is not."""

    words: faults.Rule
    broken: type[faults.WrongValueTaken]


def take_what_its_card_allows(node: NodeContract, part: str) -> Demand[ExperimentView]:
    """Each request of this part is taken or refused as the card says, and as a whole."""

    def demand(experiment: ExperimentView) -> None:
        for trial in trials_of(experiment, part):
            _insist_on_its_parameters(experiment, node, trial)
            _require_answer(experiment, node, trial)
            rule = rule_against(node, trial)
            if rule:
                _insist_on_refusal(trial, rule)
            else:
                _insist_on_taking(trial)

    return demand


def trials_of(experiment: ExperimentView, part: str) -> list[ParameterTrial]:
    """The requests of a part. Raises NothingToJudge where there were none."""
    found = [each for each in _trials(experiment) if each.part == part]
    if not found:
        raise ParametersUnknown("not_set")
    return found


def _trials(experiment: ExperimentView) -> list[ParameterTrial]:
    """All requests. In kept evidence NaN and the infinities are texts, and here numbers again."""
    return [_with_numbers(each) for each in experiment.seen.part(ParametersSeen).trials]


def _with_numbers(trial: ParameterTrial) -> ParameterTrial:
    asked, before = _numbers_again(trial.asked), _numbers_again(trial.before)
    after = _numbers_again(trial.after)
    return trial.model_copy(update={"asked": asked, "before": before, "after": after})


def _numbers_again(values: Mapping[str, Any]) -> dict[str, Any]:
    """No grader asks for such a text."""
    return {
        name: float(value) if isinstance(value, str) and value in NOT_FINITE else value
        for name, value in values.items()
    }


def rule_against(node: NodeContract, trial: ParameterTrial) -> RefusalRule | None:
    """The card's words that forbid a request; None where it is to be taken."""
    said = node.of(ParameterWords)
    alone = (_forbidden(said.parameter(name), value) for name, value in trial.asked.items())
    return next(filter(None, alone), None) or _unfitting(said, {**trial.before, **trial.asked})


def _forbidden(parameter: ParameterContract, value: Plain) -> RefusalRule | None:
    name = parameter.name
    if parameter.read_only:
        return RefusalRule(faults.Rule("fixed", name), faults.ReadOnlyChanged)
    if TYPES[type(value)] != parameter.type:
        return RefusalRule(faults.Rule("type", name, parameter.type), faults.WrongTypeTaken)
    if not parameter.allows(value):
        least, most = (float(limit or 0) for limit in (parameter.least, parameter.most))
        broken = faults.NoNumberTaken if math.isnan(float(value)) else faults.WrongValueTaken
        return RefusalRule(faults.Rule("span", name, least=least, most=most), broken)
    return None


def _unfitting(said: ParameterWords, values: Mapping[str, Any]) -> RefusalRule | None:
    for parameter in said.parameters:
        lower, upper = values.get(parameter.name), values.get(parameter.not_above or "")
        if lower is not None and upper is not None and lower > upper:
            words = faults.Rule("not_above", parameter.name, parameter.not_above or "")
            return RefusalRule(words, faults.RuleBroken)
    return None


def _insist_on_its_parameters(
    experiment: ExperimentView, node: NodeContract, trial: ParameterTrial
) -> None:
    """Raises NoParameter: a node refuses what it does not have, and that proves nothing."""
    if experiment.seen.part(ParametersSeen).names.get(trial.node):
        for name in trial.asked:
            experiment.must(has_parameter(node, node.of(ParameterWords).parameter(name)))


def _require_answer(experiment: ExperimentView, node: NodeContract, trial: ParameterTrial) -> None:
    """Raises EndedBySet or SetUnanswered where there is none."""
    if trial.answered_ns is not None:
        return
    process = experiment.process(node)
    if process.seen.ended_by_itself:
        raise faults.EndedBySet(trial.node, asked_of(trial), "", log=process.last_lines())
    require_steady(experiment.seen.stall_s)
    raise faults.SetUnanswered(trial.node, asked_of(trial), "")


def _insist_on_refusal(trial: ParameterTrial, rule: RefusalRule) -> None:
    if trial.accepted:
        raise rule.broken(trial.node, asked_of(trial), rule.words)
    _insist_on(trial, trial.before, faults.RefusedAndChanged)


def _insist_on_taking(trial: ParameterTrial) -> None:
    if not trial.accepted:
        kind = faults.RefusedTogether if trial.together else faults.SetRefused
        raise kind(trial.node, asked_of(trial), trial.reason)
    _insist_on(trial, trial.asked, faults.SetHasNoEffect)


def _insist_on(
    trial: ParameterTrial, values: Mapping[str, Any], kind: type[faults.SetHasNoEffect]
) -> None:
    """Raises the fault where the node did not say these values afterwards."""
    for name, value in values.items():
        found = trial.after.get(name)
        if not same(found, value):
            raise kind(trial.node, asked_of(trial), name, shown(found))


def asked_of(trial: ParameterTrial) -> faults.Asked:
    """What was asked for."""
    values = tuple(f"{name} = {_typed(value)}" for name, value in trial.asked.items())
    return faults.Asked(values, trial.together)


def _typed(value: Plain) -> str:
    return repr(value) if isinstance(value, str) else as_typed(value)


# --- what it does then -------------------------------------------------------------------------


def act_by_its_values(place: RelayedValue, part: str, wanted: Wanted) -> Demand[ExperimentView]:
    """After each request of this part, the node does what its parameters, as it says them, ask for.

    So a value that was wrongly taken, or refused, is the fault of another demand.
    """

    def demand(experiment: ExperimentView) -> None:
        judged = 0
        for turn, trial, values in _turns_with_values(experiment, place.topic):
            if part == (trial.part if trial else FIRST):
                value = wanted(values, turn.spoken.content)
                judged += value is not None
                _insist_on_deed(experiment, place, turn, trial, value)
        if not judged:
            raise ParametersUnknown("not_told", place.node.executable)

    return demand


def _turns_with_values(
    experiment: ExperimentView, topic: TopicContract
) -> Iterator[tuple[RelayTurn, ParameterTrial | None, Values]]:
    """What the node was told, the last request before that, and its parameters then."""
    trials = _trials(experiment)
    if not trials:
        raise ParametersUnknown("before")
    for turn in turns(experiment, topic):
        before = [each for each in trials if each.asked_ns < turn.spoken.sent_ns]
        last = before[-1] if before else None
        yield turn, last, last.after if last else trials[0].before


def _insist_on_deed(
    experiment: ExperimentView,
    place: RelayedValue,
    turn: RelayTurn,
    trial: ParameterTrial | None,
    wanted: Plain | None,
) -> None:
    found = field_of(turn.message.content if turn.message else None, place.name)
    if wanted is None or same(found, wanted, place.topic.numbers_within):
        return
    if not turn.settled:
        require_steady(experiment.seen.stall_s)
    heard = turn.heard(place.heard, False)
    deed = faults.Deed(heard, place.name, shown(wanted), place.topic.topic)
    raise _deed_fault(trial, deed, shown(found) if turn.message else faults.NoMessageCame())


def _deed_fault(trial: ParameterTrial | None, wanted: faults.Deed, found: Text) -> Fault:
    if trial is None:
        return faults.ActsOtherwise(faults.AfterSet(None), wanted, found)
    when = faults.AfterSet(asked_of(trial), trial.accepted)
    return (faults.ActsOtherwise if trial.accepted else faults.ActsOnRefused)(when, wanted, found)


def beat_by_its_value(topic: TopicContract, name: str, part: str) -> Demand[ExperimentView]:
    """After each request of this part that was taken, messages come so often as `name` says."""

    def demand(experiment: ExperimentView) -> None:
        judged = [
            _insist_on_pace(experiment, topic, name, trial, end_ns)
            for trial, end_ns in _with_ends(trials_of(experiment, part), experiment)
            if trial.accepted
        ]
        if not any(judged):
            raise ParametersUnknown("not_taken")

    return demand


def _with_ends(
    trials: Sequence[ParameterTrial], experiment: ExperimentView
) -> Iterator[tuple[ParameterTrial, float]]:
    """Each with the time of the next request, of whichever part."""
    starts = [each.asked_ns for each in experiment.seen.part(ParametersSeen).trials]
    for trial in trials:
        yield trial, min((at for at in starts if at > trial.asked_ns), default=float("inf"))


def _insist_on_pace(
    experiment: ExperimentView,
    topic: TopicContract,
    name: str,
    trial: ParameterTrial,
    end_ns: float,
) -> bool:
    """Whether it could be judged: nobody waits for messages after each request."""
    beat = trial.after.get(name)
    if trial.part not in experiment.seen.held_up or not isinstance(beat, int | float) or beat <= 0:
        return False
    gaps = _gaps_s(experiment, topic, trial.answered_ns or 0, end_ns)
    found_s = sum(gaps) / len(gaps) if len(gaps) >= FEWEST_BEATS else None
    if found_s is None or abs(found_s * beat - 1) > BESIDE_PACE:
        late_s = None if found_s is None else abs(found_s - 1 / beat) * len(gaps)
        require_its_time(experiment.seen, trial.part, late_s, Awaited("topic", topic.topic))
        found = faults.PaceFound(None if found_s is None else 1 / found_s)
        when = faults.AfterSet(asked_of(trial))
        raise faults.ActsOtherwise(when, faults.Pace(beat, topic.topic), found)
    return True


def _gaps_s(
    experiment: ExperimentView, topic: TopicContract, begin_ns: float, end_ns: float
) -> list[float]:
    """From message to message between two moments, by when they were sent.

    The first one may have been under way before.
    """
    publisher = nearest_endpoint(experiment.seen.graph, "publisher", topic.topic, topic.type)
    heard = experiment.seen.topics.get(publisher.topic) if publisher else None
    sent = [
        each.source_ns or each.arrival_ns
        for each in (heard.messages if heard else [])
        if begin_ns < each.arrival_ns < end_ns
    ]
    return [(after - before) / 1e9 for before, after in pairwise(sent[1:])]
