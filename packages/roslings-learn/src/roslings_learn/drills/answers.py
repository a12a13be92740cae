"""What a student foretells: read from the file before it runs, and compared with what it showed."""

from __future__ import annotations

import ast
from typing import Any

from roslings.capabilities.actions.record import ActionsSeen
from roslings.course.contract import NUMBERS_WITHIN
from roslings.evidence import ExperimentSeen
from roslings.judge import ExperimentView
from roslings.judge.values import same
from roslings_learn.drills.card import PROGRAM, DrillCard, Prediction
from roslings_learn.drills.faults import NoAnswerYet, ProgramChanged, WrongPrediction
from roslings_learn.drills.reasons import FewShown, NothingShown

NAME = "ANSWER"


def answer_in(source: str) -> Any:
    """The value of `ANSWER = ...`, without running anything; None where there is none to read."""
    for node in ast.parse(source).body:
        if _is_answer(node):
            try:
                return ast.literal_eval(node.value)  # type: ignore[attr-defined]  # an Assign
            except ValueError:
                return None
    return None


def require_answer(source: str, starter: str, answer: Prediction) -> Any:
    """The student's answer. Raises NoAnswerYet, and ProgramChanged where more was changed."""
    _require_the_same(source, starter)
    found = answer_in(source)
    if found is None:
        raise NoAnswerYet(answer.question)
    return found


def _is_answer(node: ast.stmt) -> bool:
    return isinstance(node, ast.Assign) and [ast.unparse(t) for t in node.targets] == [NAME]


def _require_the_same(source: str, starter: str) -> None:
    ours, theirs = (
        [node for node in ast.parse(text).body if not _is_answer(node)]
        for text in (starter, source)
    )
    for at_first, now in zip(ours, theirs, strict=False):
        if ast.dump(at_first) != ast.dump(now):
            raise ProgramChanged(now.lineno)
    if len(ours) != len(theirs):
        raise ProgramChanged(theirs[-1].lineno if len(theirs) > len(ours) else 1)


def compare(said: Any, card: DrillCard, view: ExperimentView) -> None:
    """Hold what was said against what was seen. Raises WrongPrediction."""
    assert card.answer
    shown = seen_of(card.answer, card, view)
    if not _is_right(said, shown, card.answer.within):
        raise WrongPrediction(said, shown, card.answer.because)


def _is_right(said: Any, shown: Any, within: float) -> bool:
    """Of one kind, and the same; a text may have spaces around it, and 4.0 is 4."""
    if _kind(said) is not _kind(shown):
        return False
    if isinstance(said, str):
        return said.strip() == str(shown).strip()
    return same(said, shown, max(within, NUMBERS_WITHIN))


def _kind(value: Any) -> type:
    return float if isinstance(value, int) and not isinstance(value, bool) else type(value)


def seen_of(answer: Prediction, card: DrillCard, view: ExperimentView) -> Any:
    """What the run showed. Raises NothingToJudge where it showed nothing of the kind."""
    if answer.shows in ("line", "lines"):
        lines = [text for text in _terminal(view.seen) if answer.holding in text]
        return len(lines) if answer.shows == "lines" else _number(lines, answer.number)
    if answer.shows == "node":
        return _number(view.seen.graph.nodes, answer.number)
    if answer.shows == "state":
        return _number([goal.status for goal in view.seen.part(ActionsSeen).goals], answer.number)
    if answer.shows == "rate_hz":
        return _rate_hz(card, view)
    return _of_topic(answer, card, view)


def _of_topic(answer: Prediction, card: DrillCard, view: ExperimentView) -> Any:
    topic = view.topic(card.nodes[0].publishes[0])
    if answer.shows == "topic":
        return topic.name
    if answer.shows == "type":
        return topic.type
    contents = [m.content["data"] for m in topic.messages if isinstance(m.content, dict)]
    return len(contents) if answer.shows == "messages" else _number(contents, answer.number)


def _rate_hz(card: DrillCard, view: ExperimentView) -> float:
    rate = view.topic(card.nodes[0].publishes[0]).rate
    if rate is None:
        raise NothingShown("no_rate")
    return rate.hz


def _terminal(seen: ExperimentSeen) -> list[str]:
    lines = seen.processes[PROGRAM].lines if PROGRAM in seen.processes else []
    return [line.plain for line in lines if line.text.strip()]


def _number(found: list[Any], number: int) -> Any:
    if len(found) < number:
        raise FewShown(len(found), number)
    return found[number - 1]
