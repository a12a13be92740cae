"""What any action server must make of a goal: answer it, end it, and say how.

Of one goal that was given; what a robot does meanwhile is judged elsewhere.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from roslings.capabilities.actions import faults
from roslings.capabilities.actions.reasons import NoGoal
from roslings.capabilities.actions.record import ActionsSeen, GoalLimits, GoalSeen, answer_to
from roslings.course.contract import Plain
from roslings.evidence import MessageSeen, TopicSeen
from roslings.judge.demands import require_its_time, require_steady
from roslings.judge.faults.moments import Awaited
from roslings.judge.faults.sentences import Text
from roslings.judge.values import same
from roslings.judge.views import ExperimentView, ProcessView

NO_STATE = "Goal state not set, assuming aborted"
NO_RESPONSE = "did not return a GoalResponse"
RAISED = "Error raised in execute callback: "


@dataclass(frozen=True)
class GivenGoal:
    """One goal of the grader's, and the node that it was given to."""

    goal: GoalSeen
    node: ProcessView

    @property
    def words(self) -> str:
        """The goal as a student reads it."""
        return shown(self.goal.goal)


def shown(goal: Mapping[str, float]) -> str:
    """`(x: 3, y: 5, tolerance: 0.1)`."""
    return "(" + ", ".join(f"{name}: {float(value):g}" for name, value in goal.items()) + ")"


def limits(experiment: ExperimentView) -> GoalLimits:
    """How long whoever measured waited."""
    return experiment.seen.part(ActionsSeen).limits


def require_answer(experiment: ExperimentView, given: GivenGoal) -> None:
    """Raises the fault that tells why a goal was not answered."""
    if given.goal.answered_ns is not None:
        return
    process, waited_s = given.node, limits(experiment).answer_within_s
    if process.seen.ended_by_itself:
        raise faults.EndedInsteadOfPerforming(given.words, waited_s, log=process.last_lines())
    require_steady(experiment.seen.stall_s)
    part = answer_to(given.goal.part)
    require_its_time(experiment.seen, part, waited_s, Awaited("goal_answer"))
    raise faults.GoalUnanswered(given.words, waited_s)


def require_accepted(experiment: ExperimentView, given: GivenGoal, when: Text) -> None:
    """Raises the fault that tells why a good goal was not accepted."""
    require_answer(experiment, given)
    if not given.goal.accepted:
        if any(NO_RESPONSE in text for text in given.node.texts):
            raise faults.AnswersNothing(given.words, when)
        raise faults.RefusesGoodGoal(given.words, when)


def require_refused(experiment: ExperimentView, given: GivenGoal, because: str) -> None:
    """Raises AcceptsImpossible, and what `require_answer` raises."""
    require_answer(experiment, given)
    if given.goal.accepted:
        raise faults.AcceptsImpossible(given.words, because)


def feedback_of(experiment: ExperimentView, given: GivenGoal) -> list[MessageSeen]:
    """The feedback that belongs to a goal."""
    topic: TopicSeen | None = experiment.seen.topics.get(given.goal.feedback_topic)
    messages = topic.messages if topic else []
    return [m for m in messages if m.content and m.content["goal_id"]["uuid"] == given.goal.id]


def require_no_error(given: GivenGoal) -> None:
    """Raises ExecuteFailed where the goal ended with an error of the student's code."""
    if error := error_of(given):
        raise faults.ExecuteFailed(error, log=given.node.last_lines())


def error_of(given: GivenGoal) -> str:
    """The error that ended the goal; empty where none did."""
    raised = [text for text in given.node.texts if RAISED in text]
    return raised[0].partition(RAISED)[2] if raised and given.goal.status == "aborted" else ""


def require_state(given: GivenGoal, wanted: faults.GoodEnd, when: Text) -> None:
    """Raises WrongEnd, or that nobody has set a state."""
    found = given.goal.status
    if found is None:
        raise NoGoal("no_end")
    if found != wanted:
        assumed = any(NO_STATE in text for text in given.node.texts)
        kind = faults.SucceedForgotten if assumed and found == "aborted" else faults.WrongEnd
        raise kind(when, wanted, found)


def require_result(given: GivenGoal, result: Mapping[str, Plain], when: Text) -> None:
    """Raises WrongResult where a field holds something else."""
    for name, wanted in result.items():
        found = (given.goal.result or {}).get(name)
        if not same(found, wanted):
            raise faults.WrongResult(name, when, f"{wanted}", f"{found}")
