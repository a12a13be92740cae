"""Drills with actions: goals that are given to the program, and goals that it gives."""

from __future__ import annotations

import math
from collections.abc import Iterator

from roslings.arena import Process
from roslings.capabilities.actions import faults
from roslings.capabilities.actions.act import await_action, await_client, lead, taking
from roslings.capabilities.actions.contract import ActionContract
from roslings.capabilities.actions.demands import perform, perform_its_type, send_goal
from roslings.capabilities.actions.goals import Goal, GoalGiver
from roslings.capabilities.actions.handling import (
    GivenGoal,
    feedback_of,
    require_accepted,
    require_no_error,
    require_refused,
    require_result,
    require_state,
    shown,
)
from roslings.capabilities.actions.record import ActionsSeen, GoalLimits, GoalSeen
from roslings.course import NodeContract
from roslings.experiment import Scene
from roslings.experiment.on_the_wall import FIRST_MESSAGE_WITHIN_S
from roslings.judge import ExperimentView
from roslings.judge.demands import require_steady
from roslings.judge.values import same
from roslings_learn.drills.card import DrillCard, Give, Take
from roslings_learn.drills.faults import CancelUnheard, WrongGoal
from roslings_learn.drills.reasons import NothingShown
from roslings_learn.drills.terminal import Look

ANSWER_WITHIN_S, ENDS_WITHIN_S = 1.0, 2.0
"""Of the node's own time: a drill's goal is over in less."""
FEEDBACK_BEFORE_CANCEL = 1
TELLS_WITHIN_S = 0.3


# --- experiments -------------------------------------------------------------------------------


def give_goals(card: DrillCard, scene: Scene, process: Process) -> None:
    """Give each goal of the card, one after the other."""
    if card.gives:
        scene.seen.recording(ActionsSeen).limits = GoalLimits(answer_within_s=ANSWER_WITHIN_S)
        await_action(scene)
    for number, give in enumerate(card.gives):
        if any(
            end.kind == "server" and end.action == give.action and end.type == give.type
            for end in scene.seen.part(ActionsSeen).ends
        ):
            _give(give, f"{number}", scene, process)


def _give(give: Give, part: str, scene: Scene, process: Process) -> None:
    with GoalGiver(scene.probe, give.action, give.type) as giver:
        if not scene.until(lambda: giver.ready, FIRST_MESSAGE_WITHIN_S):
            return
        goal = giver.give(dict(give.goal), part)
        told = scene.probe.count(goal.seen.feedback_topic)
        if not goal.await_answer(ANSWER_WITHIN_S, lambda: process.alive):
            return
        if give.cancel:
            _cancel(goal, scene)
        scene.until_own(lambda: goal.ended, ENDS_WITHIN_S)
        _await_feedback(goal, told + give.feedback, scene)


def _await_feedback(goal: Goal, count: int, scene: Scene) -> None:
    """What was told before the end may come after it."""
    topic = goal.seen.feedback_topic
    scene.until_own(lambda: scene.probe.count(topic) >= count, TELLS_WITHIN_S)


def _cancel(goal: Goal, scene: Scene) -> None:
    """When it is on its way, as its feedback shows."""
    topic = goal.seen.feedback_topic
    told = scene.probe.count(topic) + FEEDBACK_BEFORE_CANCEL
    scene.until_own(lambda: goal.ended or scene.probe.count(topic) >= told, ENDS_WITHIN_S)
    goal.cancel()


def take_goal(take: Take, node: NodeContract, scene: Scene, process: Process) -> None:
    """Be the server of the program's one goal, and end it."""
    with taking(scene, take.contract, take.accepts) as taker:
        lead(scene, process, taker, (), (), take.ends, take.result)
        await_client(scene, process, node)


# --- demands -----------------------------------------------------------------------------------

Named = tuple[str, str, Look]


def demands_of(card: DrillCard) -> Iterator[Named]:
    """Name, title and demand of each step."""
    for action, type_ in dict.fromkeys((give.action, give.type) for give in card.gives):
        contract = ActionContract(action=action, type=type_)
        yield "action", f"It performs {action}, type {type_}.", _performs(contract)
    for number, give in enumerate(card.gives):
        title = f"The goal {shown(give.goal)} is handled as it must be."
        yield "goal", title, _handles(card.nodes[0], give, number)
    for take in card.takes:
        title = f"It gives the goal {shown(take.goal)} to {take.action}."
        yield "sends", title, _sends(card.nodes[0], take)


def _performs(action: ActionContract) -> Look:
    return lambda view: view.must(perform(action), perform_its_type(action))


def _handles(node: NodeContract, give: Give, number: int) -> Look:
    def demand(view: ExperimentView) -> None:
        goal = next((g for g in view.seen.part(ActionsSeen).goals if g.part == f"{number}"), None)
        if goal is None:
            raise NothingShown("no_goal", give.action)
        given = GivenGoal(goal, view.process(node))
        if give.accepted:
            require_accepted(view, given, give.when)
            _require_end(view, give, given)
        else:
            require_refused(view, given, give.because)

    return demand


def _require_end(view: ExperimentView, give: Give, given: GivenGoal) -> None:
    goal = given.goal
    require_no_error(given)
    if len(feedback_of(view, given)) < give.feedback:
        end_ns = goal.ended_ns or goal.sent_ns
        raise faults.NoFeedback((end_ns - goal.sent_ns) / 1e9)
    if give.cancel:
        _require_cancel(goal)
    if goal.ended_ns is None:
        require_steady(view.seen.stall_s)
        raise faults.NoResult
    require_state(given, give.status, give.when)
    require_result(given, give.result, give.when)


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


def _sends(node: NodeContract, take: Take) -> Look:
    def demand(view: ExperimentView) -> None:
        view.must(send_goal(node, take.contract, {}))
        found = view.seen.part(ActionsSeen).orders[0].goal
        if not all(same(found.get(name), value) for name, value in take.goal.items()):
            raise WrongGoal(take.action, shown(take.goal), shown(found))

    return demand
