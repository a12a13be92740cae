"""Drills with actions: goals that are given to the program, and goals that it gives."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from typing import Any

from ros2_on_pip.near_names import nearest
from roslings.arena import Process
from roslings.capabilities.actions import faults
from roslings.capabilities.actions.act import await_action
from roslings.capabilities.actions.contract import ActionContract
from roslings.capabilities.actions.demands import (
    NO_RESPONSE,
    NO_STATE,
    RAISED,
    perform,
    perform_its_type,
    shown,
)
from roslings.capabilities.actions.goals import Goal, GoalGiver, GoalTaker, read_actions
from roslings.capabilities.actions.record import ActionsSeen, GoalSeen
from roslings.experiment import Scene
from roslings.experiment.on_the_wall import FIRST_MESSAGE_WITHIN_S
from roslings.judge import ExperimentView, NothingToJudge
from roslings.judge.demands import require_steady
from roslings.judge.words import describe_end
from roslings_learn.drills.card import PROGRAM, DrillCard, Give, Take
from roslings_learn.drills.faults import CancelUnheard, WrongGoal
from roslings_learn.drills.same import same

ANSWER_WITHIN_S, ENDS_WITHIN_S = 1.0, 2.0
"""Of the node's own time: a drill's goal is over in less."""
FEEDBACK_BEFORE_CANCEL = 1
ASKS_WITHIN_S, READS_WITHIN_S = 1.5, 1.0


# --- experiments -------------------------------------------------------------------------------


def give_goals(card: DrillCard, scene: Scene, process: Process) -> None:
    """Give each goal of the card, one after the other."""
    if card.gives:
        await_action(scene)
    for number, give in enumerate(card.gives):
        if any(end.kind == "server" and end.action == give.action and end.type == give.type
               for end in scene.seen.part(ActionsSeen).ends):  # fmt: skip
            _give(give, f"{number}", scene, process)


def _give(give: Give, part: str, scene: Scene, process: Process) -> None:
    with GoalGiver(scene.probe, give.action, give.type) as giver:
        if not scene.until(lambda: giver.ready, FIRST_MESSAGE_WITHIN_S):
            return
        goal = giver.give(dict(give.goal), part)
        if not goal.await_answer(ANSWER_WITHIN_S, lambda: process.alive):
            return
        if give.cancel:
            _cancel(goal, scene)
        scene.until_own(lambda: goal.ended, ENDS_WITHIN_S)


def _cancel(goal: Goal, scene: Scene) -> None:
    """When it is on its way, as its feedback shows."""
    topic = goal.seen.feedback_topic
    told = scene.probe.count(topic) + FEEDBACK_BEFORE_CANCEL
    scene.until_own(lambda: goal.ended or scene.probe.count(topic) >= told, ENDS_WITHIN_S)
    goal.cancel()


def take_goal(take: Take, scene: Scene, process: Process) -> None:
    """Be the server of the program's one goal, tell feedback, and end it."""
    scene.until(lambda: _clients_noted(scene), FIRST_MESSAGE_WITHIN_S)
    with GoalTaker(scene.probe, take.action, take.type, take.accepts) as taker:
        scene.until_own(lambda: bool(scene.seen.part(ActionsSeen).orders), ASKS_WITHIN_S)
        if not scene.until(lambda: taker.has_goal, ANSWER_WITHIN_S if take.accepts else 0.0):
            _let_read(take, scene, process)
            return
        for each in take.feedback:
            taker.tell(each)
        taker.end(take.ends, take.result)
        _let_read(take, scene, process)


def _clients_noted(scene: Scene) -> bool:
    """Whether the program has a client, of whatever action; a slip in its name is told."""
    ends = read_actions(scene.probe.eye, scene.seen.graph.nodes)
    scene.seen.recording(ActionsSeen).ends = ends or scene.seen.part(ActionsSeen).ends
    return any(end.kind == "client" for end in ends)


def _let_read(take: Take, scene: Scene, process: Process) -> None:
    """The server stays until the program has had its answer."""
    if scene.seen.part(ActionsSeen).orders:
        scene.until_own(lambda: not process.alive, READS_WITHIN_S)


# --- demands -----------------------------------------------------------------------------------

Named = tuple[str, str, Callable[[ExperimentView], None]]


def demands_of(card: DrillCard) -> Iterator[Named]:
    """Name, title and demand of each step."""
    for action, type_ in dict.fromkeys((give.action, give.type) for give in card.gives):
        contract = ActionContract(action=action, type=type_)
        yield "action", f"It performs {action}, type {type_}.", _performs(contract)
    for number, give in enumerate(card.gives):
        title = f"The goal {shown(give.goal)} is handled as it must be."
        yield "goal", title, _handles(give, number)
    for take in card.takes:
        yield "sends", f"It gives the goal {shown(take.goal)} to {take.action}.", _sends(take)


def _performs(action: ActionContract) -> Callable[[ExperimentView], None]:
    return lambda view: view.must(perform(action), perform_its_type(action))


def _handles(give: Give, number: int) -> Callable[[ExperimentView], None]:
    def demand(view: ExperimentView) -> None:
        goal = next((g for g in view.seen.part(ActionsSeen).goals if g.part == f"{number}"), None)
        if goal is None:
            raise NothingToJudge(f"no goal could be given to {give.action}")
        _require_answer(view, give, goal)
        if give.accepted:
            _require_end(view, give, goal)

    return demand


def _require_answer(view: ExperimentView, give: Give, goal: GoalSeen) -> None:
    words, process = shown(goal.goal), view.labelled(PROGRAM)
    if goal.answered_ns is None:
        if process.seen.ended_by_itself:
            raise faults.EndedInsteadOfPerforming(words, ANSWER_WITHIN_S, log=process.last_lines())
        require_steady(view.seen.stall_s)
        raise faults.GoalUnanswered(words, ANSWER_WITHIN_S)
    if goal.accepted and not give.accepted:
        raise faults.AcceptsImpossible(words, give.because)
    if give.accepted and not goal.accepted:
        nothing = any(NO_RESPONSE in text for text in process.texts)
        raise (faults.AnswersNothing if nothing else faults.RefusesGoodGoal)(words, give.when)


def _require_end(view: ExperimentView, give: Give, goal: GoalSeen) -> None:
    texts = view.labelled(PROGRAM).texts
    if error := next((text for text in texts if RAISED in text), None):
        lines = view.labelled(PROGRAM).last_lines()
        raise faults.ExecuteFailed(error.partition(RAISED)[2], log=lines)
    if _feedback(view, goal) < give.feedback:
        end_ns = goal.ended_ns or goal.sent_ns
        raise faults.NoFeedback((end_ns - goal.sent_ns) / 1e9)
    if give.cancel:
        _require_cancel(goal)
    if goal.ended_ns is None:
        require_steady(view.seen.stall_s)
        raise faults.NoResult
    if goal.status != give.status:
        kind = faults.SucceedForgotten if any(NO_STATE in t for t in texts) else faults.WrongEnd
        raise kind(give.when, give.status, f"{goal.status}")
    _require_result(give, goal)


def _require_cancel(goal: GoalSeen) -> None:
    """Raises CancelUnheard where it was over before anybody took the request from the queue.

    Who refuses it answers at once, and works on. Else answer and result come one after the other,
    in either order.
    """
    if goal.cancel_accepted or goal.cancel_sent_ns is None:
        return
    if goal.cancel_answered_ns is None:
        raise CancelUnheard
    waited_ns = goal.cancel_answered_ns - goal.cancel_sent_ns
    if waited_ns > ((goal.ended_ns or math.inf) - goal.cancel_sent_ns) / 2:
        raise CancelUnheard
    raise faults.CancelRefused


def _feedback(view: ExperimentView, goal: GoalSeen) -> int:
    topic = view.seen.topics.get(goal.feedback_topic)
    return len(topic.messages) if topic else 0


def _require_result(give: Give, goal: GoalSeen) -> None:
    for name, wanted in give.result.items():
        found: Any = (goal.result or {}).get(name)
        if not same(found, wanted):
            raise faults.WrongResult(name, give.when, f"{wanted}", f"{found}")


def _require_no_slip(view: ExperimentView, take: Take) -> None:
    """Raises SendsElsewhere where it is a client of an action of another name."""
    clients = (end.action for end in view.seen.part(ActionsSeen).ends if end.kind == "client")
    near = nearest(take.action, clients)
    if near and not near.exact:
        raise faults.SendsElsewhere(near)


def _sends(take: Take) -> Callable[[ExperimentView], None]:
    def demand(view: ExperimentView) -> None:
        if not view.seen.part(ActionsSeen).orders:
            require_steady(view.seen.stall_s)
            _require_no_slip(view, take)
            process = view.labelled(PROGRAM)
            ended = f"the program ended ({describe_end(process.seen)})"
            how = ended if process.seen.ended_by_itself else "the program ran on"
            raise faults.SentNoGoal(PROGRAM, take.action, how, log=process.last_lines(6))
        found = view.seen.part(ActionsSeen).orders[0].goal
        if not all(same(found.get(name), value) for name, value in take.goal.items()):
            raise WrongGoal(take.action, shown(take.goal), shown(found))

    return demand
