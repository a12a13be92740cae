"""Demands on a server of goals, and on the robot that it drives to them."""

from __future__ import annotations

import math
from bisect import bisect_left
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from graders.actions import faults
from graders.actions.faults import Moment
from graders.actions.reasons import CancelHeldUp, GoalUnseen, SecondTooLate
from graders.actions.record import stopped_after_s
from ros2_on_pip.rates import measure_rate
from roslings.capabilities.actions import faults as action_faults
from roslings.capabilities.actions.contract import RESTLESS, ActionContract
from roslings.capabilities.actions.handling import (
    GivenGoal,
    error_of,
    feedback_of,
    limits,
    require_accepted,
    require_answer,
    require_no_error,
    require_refused,
    require_state,
)
from roslings.capabilities.actions.record import (
    HEARS,
    ActionsSeen,
    GoalSeen,
    cancelled_after_s,
)
from roslings.capabilities.robot.record import PoseSeen, RobotDriveSeen, RobotSeen
from roslings.capabilities.topics.faults.messages import NoMessages
from roslings.capabilities.topics.faults.rhythm import rate_fault
from roslings.course import NodeContract, RateContract
from roslings.course.files import written
from roslings.evidence import MessageSeen
from roslings.judge.demands import require_believable, require_its_time, require_steady
from roslings.judge.faults.moments import Awaited
from roslings.judge.faults.sentences import Text
from roslings.judge.views import Demand, ExperimentView, ProcessView

PLACE_M = 0.03
"""A place in a feedback may be wrong by so much, beside what the robot moved meanwhile."""

OLD_S = 0.25
"""A feedback may tell a place that is so old: a message of /odom, a turn of the loop."""

ELAPSED_S = 0.3
MOSTLY = 0.9
FEWEST_FEEDBACKS = 5


# --- a goal ------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Trip(GivenGoal):
    """One goal of the grader's, with the robot's way meanwhile."""

    drive: RobotDriveSeen

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
        raise GoalUnseen("not_given")
    return Trip(goal, experiment.process(node), drive)


def accept(node: NodeContract, part: str, when: str) -> Demand[ExperimentView]:
    """The goal of this part is accepted."""

    def demand(experiment: ExperimentView) -> None:
        require_accepted(experiment, trip(experiment, node, part), when)

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


def _accepted_again(
    experiment: ExperimentView, node: NodeContract, part: str, before: Text
) -> Trip:
    """The goal of this part. Raises the fault that tells why it was not accepted."""
    given = trip(experiment, node, part)
    require_answer(experiment, given)
    if not given.goal.accepted:
        raise faults.StaysBusy(given.words, before)
    return given


def hear_meanwhile(experiment: ExperimentView) -> None:
    """While a goal is under way, the node's other callbacks run."""
    if experiment.seen.stuck:
        require_steady(experiment.seen.stall_s)
        require_its_time(experiment.seen, HEARS, None, Awaited("node_answer"))
        raise faults.BlocksTheNode(limits(experiment).hears_within_s)


def refuse_each(node: NodeContract, impossible: Mapping[str, str]) -> Demand[ExperimentView]:
    """Each impossible goal is refused; `impossible` says why, part by part."""

    def demand(experiment: ExperimentView) -> None:
        for part, because in impossible.items():
            require_refused(experiment, trip(experiment, node, part), because)

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
            raise action_faults.NoFeedback(min(end_ns - given.goal.sent_ns, 60e9) / 1e9)
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


def tell_the_truth(node: NodeContract, part: str) -> Demand[ExperimentView]:
    """The feedback tells where the robot is, and how far it still is; that shrinks."""

    def demand(experiment: ExperimentView) -> None:
        given = trip(experiment, node, part)
        heard = feedback_of(experiment, given)
        if len(heard) < FEWEST_FEEDBACKS:
            raise GoalUnseen("feedback")
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
    require_no_error(given)
    if goal.ended_ns is None:
        _raise_no_end(experiment, given)
    tolerance_m = float(goal.goal["tolerance"])
    end_ns = goal.ended_ns or 0
    at_the_end = given.way(end_ns - _slack_ns(experiment), end_ns)
    nearest_m = min(given.distance_m(pose) for pose in at_the_end)
    if nearest_m > tolerance_m + PLACE_M / 3:
        raise faults.EndsTooFar(given.words, tolerance_m, nearest_m)
    _require_stop(given, Moment("there"))


def _slack_ns(experiment: ExperimentView) -> float:
    """So long before its result came, the goal may have ended."""
    return (0.1 + experiment.seen.stall_s) * 1e9


def _raise_no_end(experiment: ExperimentView, given: Trip) -> None:
    process = given.node
    if _returned_nothing(process):
        raise action_faults.NoResult(log=process.last_lines())
    if process.seen.ended_by_itself:
        raise action_faults.EndedInsteadOfPerforming(given.words, 0.0, log=process.last_lines())
    way = given.way(given.goal.sent_ns, given.until_ns)
    distances = [given.distance_m(pose) for pose in way]
    nearest_m = min(distances, default=math.inf)
    require_steady(experiment.seen.stall_s)
    idle_s = limits(experiment).idle_s
    require_its_time(experiment.seen, given.goal.part, idle_s, Awaited("goal_end"))
    moved = bool(distances) and max(distances) - nearest_m > PLACE_M
    raise faults.NeverArrives(given.words, nearest_m, distances[0] if distances else 0.0, moved)


def _returned_nothing(process: ProcessView) -> bool:
    """ROS tried to send a result that is None."""
    sending = any("in _send_result_response" in text for text in process.texts)
    return sending and any("NoneType" in text for text in process.texts)


def _leave_error_to_another(given: Trip) -> None:
    """An error of the student's code is told once, where the robot is to arrive."""
    if error_of(given) or given.node.seen.ended_by_itself:
        raise GoalUnseen("error")


def _require_stop(given: Trip, when: Text) -> None:
    """The last command while it was watched says: stand still."""
    told = [c for c in given.drive.commands if c.arrival_ns <= given.until_ns]
    if told and (told[-1].forward_m_s or told[-1].turn_rad_s):
        raise faults.KeepsDriving(when, told[-1].forward_m_s, told[-1].turn_rad_s)


def succeed(node: NodeContract, part: str) -> Demand[ExperimentView]:
    """The goal succeeds, and its result says so, and how long it took."""

    def demand(experiment: ExperimentView) -> None:
        given = trip(experiment, node, part)
        require_state(given, "succeeded", Moment("there"))
        result = given.goal.result
        if not result["reached"]:
            raise action_faults.WrongResult("reached", Moment("there"), "true", "false")
        ended_ns, sent_ns = given.goal.ended_ns or 0, given.goal.sent_ns
        took_s = (ended_ns - sent_ns) / 1e9
        worked_s = (ended_ns - (given.goal.answered_ns or sent_ns)) / 1e9  # after it had thought
        slack_s = ELAPSED_S + experiment.seen.stall_s + experiment.seen.cpu_wait_s
        elapsed_s = float(result["elapsed"])
        if not worked_s - slack_s <= elapsed_s <= took_s + ELAPSED_S:
            wanted, found = faults.About(took_s), f"{elapsed_s:.2f} s"
            raise action_faults.WrongResult("elapsed", Moment("end"), wanted, found)

    return demand


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
            raise GoalUnseen("no_cancel")
        _require_cancelled(experiment, given)
        took_s = cancelled_after_s(goal) or 0.0
        if took_s > limit_s:
            require_not_held_up(experiment, goal, took_s - limit_s)
            raise faults.CancelsLate(limit_s, took_s)
        if goal.result["reached"]:
            raise action_faults.WrongResult("reached", Moment("cancelled"), "false", "true")

    return demand


def _require_cancelled(experiment: ExperimentView, given: Trip) -> None:
    goal = given.goal
    require_no_error(given)
    process, waited_s = given.node, limits(experiment).cancels_within_s
    if process.seen.ended_by_itself:
        raise action_faults.EndedInsteadOfPerforming(given.words, 0.0, log=process.last_lines())
    if goal.cancel_answered_ns is None:
        require_steady(experiment.seen.stall_s)
        require_its_time(experiment.seen, goal.part, waited_s, Awaited("cancel_answer"))
        raise faults.CancelUnanswered(waited_s=waited_s)
    if not goal.cancel_accepted and (goal.ended_ns or math.inf) > goal.cancel_answered_ns:
        raise action_faults.CancelRefused
    if not goal.cancel_accepted:
        raise GoalUnseen("ended")
    if goal.ended_ns is None or _went_on_to_the_goal(given):
        require_steady(experiment.seen.stall_s)
        require_its_time(experiment.seen, goal.part, waited_s, Awaited("goal_end"))
        raise faults.GoesOnAfterCancel(cancelled_after_s(goal) or waited_s)
    require_state(given, "canceled", Moment("cancelled"))


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
            _require_stop(given, Moment("cancelled"))
        elif took_s > limit_s:
            require_not_held_up(experiment, given.goal, took_s - limit_s)
            raise faults.StopsLate(limit_s, took_s)

    return demand


def require_not_held_up(experiment: ExperimentView, goal: GoalSeen, late_s: float) -> None:
    """A late end may be this computer's doing. Raises Inconclusive."""
    require_believable(experiment.seen)
    held_s = experiment.seen.stall_s + goal.cpu_wait_s
    if late_s <= held_s:
        raise CancelHeldUp(late_s, held_s)


# --- two goals at once -------------------------------------------------------------------------


def keep_to_the_first(node: NodeContract, part: str) -> Demand[ExperimentView]:
    """A second goal is refused while the first is under way, which is then reached."""

    def demand(experiment: ExperimentView) -> None:
        first = _accepted_again(experiment, node, part, Moment("refused"))
        second = trip(experiment, node, f"{part}: another")
        require_answer(experiment, second)
        if second.goal.accepted:
            _require_under_way(first, second)
            raise faults.TakesSecondGoal
        if not _is_there(first):
            require_steady(experiment.seen.stall_s)
            raise faults.FirstGoalDisturbed(first.goal.status)

    return demand


def _require_under_way(first: Trip, second: Trip) -> None:
    """The first goal had not been reached when the second was answered. Raises Inconclusive."""
    ended_ns, answered_ns = first.goal.ended_ns, second.goal.answered_ns
    if first.goal.status == "succeeded" and ended_ns and answered_ns and ended_ns <= answered_ns:
        raise SecondTooLate
