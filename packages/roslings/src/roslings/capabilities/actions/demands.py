"""Demands on actions: names, goals, feedback, where the robot really is, cancel and refusal."""

from __future__ import annotations

import math
from bisect import bisect_left
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ros2_on_pip.near_names import nearest
from ros2_on_pip.rates import measure_rate
from roslings.capabilities.actions import faults
from roslings.capabilities.actions.contract import RESTLESS, ActionContract
from roslings.capabilities.actions.record import (
    HEARS,
    ActionEnd,
    ActionsSeen,
    GoalLimits,
    GoalSeen,
    answer_to,
    cancelled_after_s,
    stopped_after_s,
)
from roslings.capabilities.robot.record import DriveSeen, PoseSeen, RobotSeen
from roslings.capabilities.services import demands as services
from roslings.capabilities.services.demands import end_by_itself, require_code, require_no_crash
from roslings.capabilities.topics.faults.messages import NoMessages
from roslings.capabilities.topics.faults.rhythm import rate_fault
from roslings.course import NodeContract, OutcomeContract, RateContract
from roslings.course.files import written
from roslings.evidence import ExperimentSeen, MessageSeen, TopicSeen
from roslings.judge.demands import (
    insist_on_at_most,
    most_similar,
    require_believable,
    require_its_time,
    require_steady,
)
from roslings.judge.faults import Inconclusive, NothingToJudge, NotLogged
from roslings.judge.views import Demand, ExperimentView, ProcessView
from roslings.judge.words import describe_end

PLACE_M = 0.03
"""A place in a feedback may be wrong by so much, beside what the robot moved meanwhile."""

OLD_S = 0.25
"""A feedback may tell a place that is so old: a message of /odom, a turn of the loop."""

ELAPSED_S = 0.3
MOSTLY = 0.9
FEWEST_FEEDBACKS = 5
NO_STATE = "Goal state not set, assuming aborted"
NO_RESPONSE = "did not return a GoalResponse"
RAISED = "Error raised in execute callback: "


# --- who performs what -------------------------------------------------------------------------


def perform(action: ActionContract) -> Demand[ExperimentView]:
    """A node performs it under its very name."""

    def demand(experiment: ExperimentView) -> None:
        end = _server(experiment, action)
        if end is None:
            clients = (each.action for each in _ends(experiment, "client"))
            raise faults.NoAction(action.action, action.action in clients)
        near = nearest(action.action, [end.action])
        if near and not near.exact:
            raise faults.WrongAction(near)

    return demand


def perform_its_type(action: ActionContract) -> Demand[ExperimentView]:
    """The action has the card's type. Of one that is missing no type was seen."""

    def demand(experiment: ExperimentView) -> None:
        end = _server(experiment, action)
        if end is None:
            raise NothingToJudge(f"nobody performs {action.action}, so it has no type")
        if end.type != action.type:
            raise faults.WrongActionType(end.action, action.type, end.type)

    return demand


def _ends(experiment: ExperimentView, kind: str) -> list[ActionEnd]:
    return [end for end in experiment.seen.part(ActionsSeen).ends if end.kind == kind]


def _server(experiment: ExperimentView, action: ActionContract) -> ActionEnd | None:
    """The server that is meant: the very name, else the nearest one, the right type first."""
    servers = _ends(experiment, "server")
    exact = [end for end in servers if end.action == action.action]
    pool = exact or [end for end in servers if end.type == action.type] or servers
    near = nearest(action.action, (end.action for end in pool))
    return next((end for end in pool if near and end.action == near.found), None)


# --- a goal ------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Trip:
    """One goal of the grader's, with the robot's way meanwhile."""

    goal: GoalSeen
    drive: DriveSeen
    node: ProcessView

    @property
    def words(self) -> str:
        """The goal as a student reads it."""
        return shown(self.goal.goal)

    @property
    def until_ns(self) -> float:
        """When the robot was watched for the last time."""
        return self.goal.watched_until_ns or self.goal.ended_ns or math.inf

    def distance_m(self, pose: PoseSeen) -> float:
        """How far a place is from the goal."""
        goal = self.goal.goal
        return math.hypot(float(goal["x"]) - pose.x_m, float(goal["y"]) - pose.y_m)

    def way(self, from_ns: float, to_ns: float) -> Sequence[PoseSeen]:
        """Where the robot was between two moments, and just around them."""
        times = [pose.arrival_ns for pose in self.drive.path]
        first, last = bisect_left(times, from_ns), bisect_left(times, to_ns)
        return self.drive.path[max(0, first - 1) : last + 1]


def trip(experiment: ExperimentView, node: NodeContract, part: str) -> Trip:
    """The goal of a part of the experiment. Raises NothingToJudge where it was not given."""
    seen = experiment.seen
    goal = next((each for each in seen.part(ActionsSeen).goals if each.part == part), None)
    drive = seen.part(RobotSeen).drive
    if goal is None or drive is None:
        raise NothingToJudge("no goal could be given")
    return Trip(goal, drive, experiment.process(node))


def shown(goal: Mapping[str, float]) -> str:
    """`(x: 3, y: 5, tolerance: 0.1)`."""
    return "(" + ", ".join(f"{name}: {float(value):g}" for name, value in goal.items()) + ")"


def accept(node: NodeContract, part: str, when: str) -> Demand[ExperimentView]:
    """The goal of this part is accepted."""

    def demand(experiment: ExperimentView) -> None:
        given = trip(experiment, node, part)
        require_answer(experiment, given)
        if not given.goal.accepted:
            if any(NO_RESPONSE in text for text in given.node.texts):
                raise faults.AnswersNothing(given.words, when)
            raise faults.RefusesGoodGoal(given.words, when)

    return demand


def accept_again(node: NodeContract, part: str, before: str) -> Demand[ExperimentView]:
    """After an earlier goal has ended, the next one is accepted, and reached."""

    def demand(experiment: ExperimentView) -> None:
        _arrive(experiment, _accepted_again(experiment, node, part, before))

    return demand


def cancel_each(node: NodeContract, parts: Sequence[str], before: str) -> Demand[ExperimentView]:
    """One after the other, the goals of these parts are accepted, and end as cancelled."""

    def demand(experiment: ExperimentView) -> None:
        for part in parts:
            _require_cancelled(experiment, _accepted_again(experiment, node, part, before))

    return demand


def _accepted_again(experiment: ExperimentView, node: NodeContract, part: str, before: str) -> Trip:
    """The goal of this part. Raises the fault that tells why it was not accepted."""
    given = trip(experiment, node, part)
    require_answer(experiment, given)
    if not given.goal.accepted:
        raise faults.StaysBusy(given.words, before)
    return given


def require_answer(experiment: ExperimentView, given: Trip) -> None:
    """Raises the fault that tells why a goal was not answered."""
    if given.goal.answered_ns is not None:
        return
    process, waited_s = given.node, _limits(experiment).answer_within_s
    if process.seen.ended_by_itself:
        raise faults.EndedInsteadOfPerforming(given.words, waited_s, log=process.last_lines())
    require_steady(experiment.seen.stall_s)
    part = answer_to(given.goal.part)
    require_its_time(experiment.seen, part, waited_s, "the answer to a goal")
    raise faults.GoalUnanswered(given.words, waited_s)


def _limits(experiment: ExperimentView) -> GoalLimits:
    """How long whoever measured waited."""
    return experiment.seen.part(ActionsSeen).limits


def hear_meanwhile(experiment: ExperimentView) -> None:
    """While a goal is under way, the node's other callbacks run."""
    if experiment.seen.stuck:
        require_steady(experiment.seen.stall_s)
        require_its_time(experiment.seen, HEARS, None, "an answer of the node")
        raise faults.BlocksTheNode(_limits(experiment).hears_within_s)


def refuse_each(node: NodeContract, impossible: Mapping[str, str]) -> Demand[ExperimentView]:
    """Each impossible goal is refused; `impossible` says why, part by part."""

    def demand(experiment: ExperimentView) -> None:
        for part, because in impossible.items():
            given = trip(experiment, node, part)
            require_answer(experiment, given)
            if given.goal.accepted:
                raise faults.AcceptsImpossible(given.words, because)

    return demand


# --- feedback ----------------------------------------------------------------------------------


def rest_in_each_turn(
    node: NodeContract, action: ActionContract, part: str
) -> Demand[ExperimentView]:
    """The loop that tells feedback has a pause: no computer makes one so much faster."""
    limit: RateContract = written(action.feedback, action.action)

    def demand(experiment: ExperimentView) -> None:
        rate = measure_rate(feedback_of(experiment, trip(experiment, node, part)))
        if rate and rate.hz > RESTLESS * limit.high_hz:
            raise faults.NeverRests(rate.hz, limit.hz)

    return demand


def tell_at_its_rate(
    node: NodeContract, action: ActionContract, part: str
) -> Demand[ExperimentView]:
    """Feedback comes at the card's rate while the goal is under way."""
    limit: RateContract = written(action.feedback, action.action)

    def demand(experiment: ExperimentView) -> None:
        given = trip(experiment, node, part)
        heard = feedback_of(experiment, given)
        if not heard:
            _leave_error_to_another(given)
            end_ns = given.goal.ended_ns or given.until_ns
            raise faults.NoFeedback(min(end_ns - given.goal.sent_ns, 60e9) / 1e9)
        require_believable(experiment.seen)
        rate = measure_rate(heard)
        topic = given.goal.feedback_topic
        if rate is None:
            _leave_error_to_another(given)
            require_steady(experiment.seen.stall_s)
            raise NoMessages(topic, len(heard), experiment.seen.watching_s)
        kind = rate_fault(rate, limit.low_hz, limit.high_hz)
        if kind:
            require_steady(experiment.seen.stall_s)
            raise faults.WrongFeedbackRate(kind(topic, limit.hz, limit.within, rate))

    return demand


def feedback_of(experiment: ExperimentView, given: Trip) -> list[MessageSeen]:
    """The feedback that belongs to a goal."""
    topic: TopicSeen | None = experiment.seen.topics.get(given.goal.feedback_topic)
    messages = topic.messages if topic else []
    return [m for m in messages if m.content and m.content["goal_id"]["uuid"] == given.goal.id]


def tell_the_truth(node: NodeContract, part: str) -> Demand[ExperimentView]:
    """The feedback tells where the robot is, and how far it still is; that shrinks."""

    def demand(experiment: ExperimentView) -> None:
        given = trip(experiment, node, part)
        heard = feedback_of(experiment, given)
        if len(heard) < FEWEST_FEEDBACKS:
            raise NothingToJudge("there was too little feedback to compare")
        for name in ("x", "y", "distance"):
            _compare(experiment, given, heard, name)

    return demand


def _compare(
    experiment: ExperimentView, given: Trip, heard: Sequence[MessageSeen], name: str
) -> None:
    """Each value of one field against where the robot was a moment ago."""
    old_ns = (OLD_S + experiment.seen.stall_s + experiment.seen.cpu_wait_s) * 1e9
    off = 0
    worst: tuple[float, float] = (0.0, 0.0)
    for message in heard:
        truth = [
            _truth(given, pose, name)
            for pose in given.way(message.arrival_ns - old_ns, message.arrival_ns)
        ]
        said = float(message.content["feedback"][name])
        if not min(truth) - PLACE_M <= said <= max(truth) + PLACE_M:
            off, worst = off + 1, (truth[-1], said)
    if off > (1 - MOSTLY) * len(heard):
        values = {float(m.content["feedback"][name]) for m in heard}
        kind = faults.FrozenFeedback if len(values) == 1 else faults.WrongFeedback
        raise kind(name, f"{worst[0]:.2f} m", f"{worst[1]:.2f} m")


def _truth(given: Trip, pose: PoseSeen, name: str) -> float:
    return {"x": pose.x_m, "y": pose.y_m, "distance": given.distance_m(pose)}[name]


# --- the end -----------------------------------------------------------------------------------


def arrive(node: NodeContract, part: str) -> Demand[ExperimentView]:
    """At the goal's end the robot is there, and told to stand still."""

    def demand(experiment: ExperimentView) -> None:
        _arrive(experiment, trip(experiment, node, part))

    return demand


def _arrive(experiment: ExperimentView, given: Trip) -> None:
    goal = given.goal
    _require_no_error(given)
    if goal.ended_ns is None:
        _raise_no_end(experiment, given)
    tolerance_m = float(goal.goal["tolerance"])
    end_ns = goal.ended_ns or 0
    at_the_end = given.way(end_ns - _slack_ns(experiment), end_ns)
    nearest_m = min(given.distance_m(pose) for pose in at_the_end)
    if nearest_m > tolerance_m + PLACE_M / 3:
        raise faults.EndsTooFar(given.words, tolerance_m, nearest_m)
    _require_stop(given, "when the rover is there")


def _slack_ns(experiment: ExperimentView) -> float:
    """So long before its result came, the goal may have ended."""
    return (0.1 + experiment.seen.stall_s) * 1e9


def _raise_no_end(experiment: ExperimentView, given: Trip) -> None:
    process = given.node
    if _returned_nothing(process):
        raise faults.NoResult(log=process.last_lines())
    if process.seen.ended_by_itself:
        raise faults.EndedInsteadOfPerforming(given.words, 0.0, log=process.last_lines())
    way = given.way(given.goal.sent_ns, given.until_ns)
    distances = [given.distance_m(pose) for pose in way]
    nearest_m = min(distances, default=math.inf)
    require_steady(experiment.seen.stall_s)
    idle_s = _limits(experiment).idle_s
    require_its_time(experiment.seen, given.goal.part, idle_s, "the end of a goal")
    moved = bool(distances) and max(distances) - nearest_m > PLACE_M
    raise faults.NeverArrives(given.words, nearest_m, distances[0] if distances else 0.0, moved)


def _returned_nothing(process: ProcessView) -> bool:
    """ROS tried to send a result that is None."""
    sending = any("in _send_result_response" in text for text in process.texts)
    return sending and any("NoneType" in text for text in process.texts)


def _require_no_error(given: Trip) -> None:
    """Raises ExecuteFailed where the goal ended with an error of the student's code."""
    if error := _error(given):
        raise faults.ExecuteFailed(error, log=given.node.last_lines())


def _error(given: Trip) -> str:
    raised = [text for text in given.node.texts if RAISED in text]
    return raised[0].partition(RAISED)[2] if raised and given.goal.status == "aborted" else ""


def _leave_error_to_another(given: Trip) -> None:
    """An error of the student's code is told once, where the robot is to arrive."""
    if _error(given) or given.node.seen.ended_by_itself:
        raise NothingToJudge("the execute callback ended with an error: mend that first")


def _require_stop(given: Trip, when: str) -> None:
    """The last command while it was watched says: stand still."""
    told = [c for c in given.drive.commands if c.arrival_ns <= given.until_ns]
    if told and (told[-1].forward_m_s or told[-1].turn_rad_s):
        raise faults.KeepsDriving(when, told[-1].forward_m_s, told[-1].turn_rad_s)


def succeed(node: NodeContract, part: str) -> Demand[ExperimentView]:
    """The goal succeeds, and its result says so, and how long it took."""

    def demand(experiment: ExperimentView) -> None:
        given = trip(experiment, node, part)
        _require_state(given, "succeeded", "when the rover is there")
        result = given.goal.result
        if not result["reached"]:
            raise faults.WrongResult("reached", "when the rover is there", "true", "false")
        ended_ns, sent_ns = given.goal.ended_ns or 0, given.goal.sent_ns
        took_s = (ended_ns - sent_ns) / 1e9
        worked_s = (ended_ns - (given.goal.answered_ns or sent_ns)) / 1e9  # after it had thought
        slack_s = ELAPSED_S + experiment.seen.stall_s + experiment.seen.cpu_wait_s
        elapsed_s = float(result["elapsed"])
        if not worked_s - slack_s <= elapsed_s <= took_s + ELAPSED_S:
            wanted, found = f"about {took_s:.1f} s", f"{elapsed_s:.2f} s"
            raise faults.WrongResult("elapsed", "at the end", wanted, found)

    return demand


def _require_state(given: Trip, wanted: str, when: str) -> None:
    found = given.goal.status
    if found is None:
        raise NothingToJudge("the goal did not end")
    if found != wanted:
        assumed = any(NO_STATE in text for text in given.node.texts)
        kind = faults.SucceedForgotten if assumed and found == "aborted" else faults.WrongEnd
        raise kind(when, wanted, found)


# --- cancel ------------------------------------------------------------------------------------


def cancel_in_time(
    node: NodeContract, action: ActionContract, part: str, undisturbed: Trip | None = None
) -> Demand[ExperimentView]:
    """A cancel is accepted, and the goal ends as cancelled, within the card's time.

    `undisturbed` is a goal that nobody cancelled: what went wrong there is told there.
    """
    limit_s = written(action.cancels_within_s, action.action)

    def demand(experiment: ExperimentView) -> None:
        given = trip(experiment, node, part)
        require_answer(experiment, given)
        goal = given.goal
        if undisturbed:
            _leave_error_to_another(undisturbed)
        if not goal.accepted or goal.cancel_sent_ns is None:
            raise NothingToJudge("there was no goal to cancel")
        _require_cancelled(experiment, given)
        took_s = cancelled_after_s(goal) or 0.0
        if took_s > limit_s:
            require_not_held_up(experiment, goal, took_s - limit_s)
            raise faults.CancelsLate(limit_s, took_s)
        if goal.result["reached"]:
            raise faults.WrongResult("reached", "after a cancel", "false", "true")

    return demand


def _require_cancelled(experiment: ExperimentView, given: Trip) -> None:
    goal = given.goal
    _require_no_error(given)
    process, waited_s = given.node, _limits(experiment).cancels_within_s
    if process.seen.ended_by_itself:
        raise faults.EndedInsteadOfPerforming(given.words, 0.0, log=process.last_lines())
    if goal.cancel_answered_ns is None:
        require_steady(experiment.seen.stall_s)
        require_its_time(experiment.seen, goal.part, waited_s, "the answer to a cancel")
        raise faults.CancelUnanswered(waited_s=waited_s)
    if not goal.cancel_accepted and (goal.ended_ns or math.inf) > goal.cancel_answered_ns:
        raise faults.CancelRefused
    if not goal.cancel_accepted:
        raise NothingToJudge("the goal ended before it could be cancelled")
    if goal.ended_ns is None or _went_on_to_the_goal(given):
        require_steady(experiment.seen.stall_s)
        require_its_time(experiment.seen, goal.part, waited_s, "the end of a goal")
        raise faults.GoesOnAfterCancel(cancelled_after_s(goal) or waited_s)
    _require_state(given, "canceled", "after a cancel")


def _went_on_to_the_goal(given: Trip) -> bool:
    """It succeeded, and the robot is really there."""
    return given.goal.status == "succeeded" and _is_there(given)


def _is_there(given: Trip) -> bool:
    """At the goal's end the robot is within the tolerance of it."""
    end_ns = given.goal.ended_ns
    last = given.way(end_ns, end_ns)[-1:] if end_ns else ()
    within_m = float(given.goal.goal["tolerance"]) + PLACE_M / 3
    return any(given.distance_m(pose) <= within_m for pose in last)


def stop_in_time(node: NodeContract, action: ActionContract, part: str) -> Demand[ExperimentView]:
    """After a cancel the robot is told to stand still, in time, and stays so."""
    limit_s = written(action.cancels_within_s, action.action)

    def demand(experiment: ExperimentView) -> None:
        given = trip(experiment, node, part)
        took_s = stopped_after_s(given.goal, given.drive)
        if took_s is None:
            _require_stop(given, "after a cancel")
        elif took_s > limit_s:
            require_not_held_up(experiment, given.goal, took_s - limit_s)
            raise faults.StopsLate(limit_s, took_s)

    return demand


def require_not_held_up(experiment: ExperimentView, goal: GoalSeen, late_s: float) -> None:
    """A late end may be this computer's doing. Raises Inconclusive."""
    require_believable(experiment.seen)
    held_s = experiment.seen.stall_s + goal.cpu_wait_s
    if late_s <= held_s:
        raise Inconclusive(
            f"a cancel was late by {late_s:.2f} s, but this computer held your node or the check up"
            f" for {held_s:.2f} s; close other programs and check again"
        )


# --- two goals at once -------------------------------------------------------------------------


def keep_to_the_first(node: NodeContract, part: str) -> Demand[ExperimentView]:
    """A second goal is refused while the first is under way, which is then reached."""

    def demand(experiment: ExperimentView) -> None:
        first = _accepted_again(experiment, node, part, "after goals that were refused")
        second = trip(experiment, node, f"{part}: another")
        require_answer(experiment, second)
        if second.goal.accepted:
            _require_under_way(first, second)
            raise faults.TakesSecondGoal
        if not _is_there(first):
            require_steady(experiment.seen.stall_s)
            end = first.goal.status or "no end of it came"
            raise faults.FirstGoalDisturbed(
                f"the rover did not get there; state of the first goal: {end}"
            )

    return demand


def _require_under_way(first: Trip, second: Trip) -> None:
    """The first goal had not been reached when the second was answered. Raises Inconclusive."""
    ended_ns, answered_ns = first.goal.ended_ns, second.goal.answered_ns
    if first.goal.status == "succeeded" and ended_ns and answered_ns and ended_ns <= answered_ns:
        raise Inconclusive(
            "this computer was so slow that the first goal ended before the second was given; close"
            " other programs and check again"
        )


# --- clients -----------------------------------------------------------------------------------


def send_goal(
    node: NodeContract, action: ActionContract, goal: Mapping[str, Any]
) -> Demand[ExperimentView]:
    """The client sends its goal to the server, as its parameters say."""

    def demand(experiment: ExperimentView) -> None:
        process = experiment.process(node)
        if not experiment.seen.part(ActionsSeen).orders:
            require_no_crash(process, f"sends a goal to {action.action}")
            near = nearest(action.action, (e.action for e in _ends(experiment, "client")))
            if near and not near.exact:
                raise faults.SendsElsewhere(near)
            raise faults.SentNoGoal(
                node.executable, action.action, _how_it_went(process), log=process.last_lines(6)
            )
        found = experiment.seen.part(ActionsSeen).orders[0].goal
        for name, wanted in goal.items():
            if (sent := float(found[name])) != wanted:
                raise faults.SentAnotherGoal(node.executable, name, f"{wanted:g}", f"{sent:g}")
        if len(experiment.seen.part(ActionsSeen).orders) > 1:
            raise faults.GoalSentAgain(
                node.executable, action.action, len(experiment.seen.part(ActionsSeen).orders)
            )

    return demand


def _how_it_went(process: ProcessView) -> str:
    if process.seen.ended_by_itself:
        return f"the program ended ({describe_end(process.seen)})"
    return "the program ran on"


def show_each(node: NodeContract, texts: Sequence[str]) -> Demand[ExperimentView]:
    """The client writes the card's line for each feedback; one may be lost on the way."""
    template = written(node.log, node.node)

    def demand(experiment: ExperimentView) -> None:
        process = experiment.process(node)
        lines = {text: template.format(text=text) for text in texts}
        missing = [
            text for text, line in lines.items()
            if not any(line in found for found in process.texts)
        ]  # fmt: skip
        if len(missing) > 1:
            line = lines[missing[0]]
            raise NotLogged(
                node.executable, line, most_similar(line, process.texts),
                when=f"when the feedback says {missing[0]}",
                place="in the function that you give as feedback_callback",
            )  # fmt: skip
        for line in lines.values():
            insist_on_at_most(process, [line], 1)

    return demand


def end_so(node: NodeContract, outcome: OutcomeContract, text: str = "") -> Demand[ExperimentView]:
    """The client ends by itself, writes the card's line, and its exit code tells how it went."""

    def demand(experiment: ExperimentView) -> None:
        process = experiment.process(node)
        line, case = outcome.log.format(text=text), outcome.when.removeprefix("when ")
        experiment.must(end_by_itself(node, None, f"when {case}", _answered))
        require_no_crash(process, f"writes {line!r} when {case}")
        if not any(line in found for found in process.texts):
            raise NotLogged(
                node.executable, line, most_similar(line, process.texts), when=f"when {case}",
                place=f"where your code learns that {case}",
            )  # fmt: skip
        insist_on_at_most(process, [line], 1)
        require_code(process, outcome.exit_code, f"when {case}")

    return demand


def _answered(seen: ExperimentSeen) -> bool:
    """A goal of the client came to the grader's server, which answers at once."""
    return bool(seen.part(ActionsSeen).orders)


def give_up(node: NodeContract) -> Demand[ExperimentView]:
    """Without a server the client ends in time, says why, and its exit code says so, too."""
    return services.give_up(node, wait="wait_for_server")
