"""Goals, cancels and feedback: what is held against whom."""

from __future__ import annotations

import math
from typing import Any

import pytest

from graders.actions import faults
from graders.actions.demands import (
    accept,
    accept_again,
    arrive,
    cancel_in_time,
    hear_meanwhile,
    refuse_each,
    rest_in_each_turn,
    stop_in_time,
    succeed,
    tell_the_truth,
)
from graders.actions.record import stopped_after_s
from roslings.capabilities.actions import faults as action_faults
from roslings.capabilities.actions.contract import ActionContract
from roslings.capabilities.actions.demands import perform
from roslings.capabilities.actions.record import (
    HEARS,
    ActionEnd,
    GoalSeen,
    answer_to,
    cancelled_after_s,
)
from roslings.capabilities.robot.record import CommandSeen, PoseSeen, RobotDriveSeen
from roslings.course import NodeContract, RateContract
from roslings.evidence import HeldUpSeen, LogLine, MessageSeen, ProcessSeen, TopicSeen
from roslings.experiment.own_time import PATIENCE_S
from roslings.judge import ExperimentView, Inconclusive
from roslings.judge.faults import NothingToJudge
from seen_with import seen_with

S = 10**9
FLY = ActionContract(action="/fly", type="birds/action/Fly", cancels_within_s=0.5)
NODE = NodeContract(node="/bird", executable="bird", performs=(FLY,))
NEST = {"x": 2.0, "y": 0.0, "tolerance": 0.1}
NUMBER = list(range(16))


def goal(**words: Any) -> GoalSeen:
    """A goal that was reached after two seconds, but for `words`."""
    usual: dict[str, Any] = {
        "action": "/fly",
        "type": FLY.type,
        "goal": NEST,
        "part": "first",
        "id": NUMBER,
        "sent_ns": 0,
        "answered_ns": 1,
        "accepted": True,
        "ended_ns": 2 * S,
        "status": "succeeded",
        "result": {"reached": True, "elapsed": 2.0},
        "watched_until_ns": 3 * S,
    }
    return GoalSeen(**{**usual, **words})


def cancelled(after_s: float | None, **words: Any) -> GoalSeen:
    """A goal that was cancelled at one second, and ended so much later."""
    ended_ns = None if after_s is None else round((1 + after_s) * S)
    usual: dict[str, Any] = {
        "cancel_sent_ns": S,
        "cancel_answered_ns": S + 1,
        "cancel_accepted": True,
        "ended_ns": ended_ns,
        "status": "canceled" if ended_ns else None,
        "result": {"reached": False, "elapsed": 1.0},
        "watched_until_ns": 9 * S,
    }
    return goal(**{**usual, **words})


def command(at_s: float, forward_m_s: float) -> CommandSeen:
    """One command."""
    return CommandSeen(arrival_ns=round(at_s * S), forward_m_s=forward_m_s, turn_rad_s=0.0)


STRAIGHT = [
    PoseSeen(arrival_ns=round(n * 0.05 * S), x_m=min(2.0, n * 0.05), y_m=0.0, heading_rad=0.0)
    for n in range(61)
]
"""One metre a second along x, to the nest."""

USUAL = (command(0.1, 1.0), command(1.9, 0.0))


def flight(
    *goals: GoalSeen,
    commands: tuple[CommandSeen, ...] = USUAL,
    lines: tuple[str, ...] = (),
    **words: Any,
) -> ExperimentView:
    """An experiment with these goals."""
    written = [LogLine(arrival_ns=0, text=text, source="terminal") for text in lines]
    bird = ProcessSeen(executable="bird", started_ns=0, lines=written)
    drive = RobotDriveSeen(path=STRAIGHT, commands=list(commands))
    return ExperimentView(
        seen_with(
            name="x",
            clock="wall",
            goals=list(goals),
            drive=drive,
            processes={"bird": bird},
            **words,
        )
    )


# --- times -------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("commands", "wanted_s"),
    [
        ([(0.5, 1.0), (1.3, 0.0)], 0.3),
        ([(0.5, 0.0)], 0.0),
        ([(0.5, 1.0), (1.1, 0.0), (1.2, 1.0), (1.6, 0.0)], 0.6),
        ([(0.5, 1.0)], None),
        ([(0.5, 1.0), (1.2, 0.0), (8.0, 0.4)], None),
        ([(0.5, 1.0), (1.2, 0.0), (9.5, 0.4)], 0.2),
    ],
    ids=["soon", "stood already", "twice", "never", "starts again", "the next goal's"],
)
def test_when_a_robot_was_told_to_stop(
    commands: list[tuple[float, float]], wanted_s: float | None
) -> None:
    """The first zero after which nothing else came."""
    drive = RobotDriveSeen(commands=[command(*each) for each in commands])
    found_s = stopped_after_s(cancelled(0.1), drive)
    assert found_s == (wanted_s if wanted_s is None else pytest.approx(wanted_s))


def test_a_goal_without_an_end_has_no_time() -> None:
    """Nor one that nobody cancelled."""
    assert cancelled_after_s(goal()) is None
    assert cancelled_after_s(cancelled(None)) is None
    assert cancelled_after_s(cancelled(0.25)) == 0.25


# --- cancel ------------------------------------------------------------------------------------

in_time = cancel_in_time(NODE, FLY, "first")
stops = stop_in_time(NODE, FLY, "first")


def test_a_cancel_in_time_passes() -> None:
    """Both clocks are right."""
    flight(cancelled(0.2), commands=(command(0.5, 1.0), command(1.1, 0.0))).must(in_time, stops)


@pytest.mark.parametrize(
    ("words", "kind"),
    [
        ({"cancel_accepted": False, "ended_ns": None}, action_faults.CancelRefused),
        ({"cancel_accepted": False, "ended_ns": 3 * S}, action_faults.CancelRefused),
        ({"cancel_answered_ns": None, "cancel_accepted": None}, faults.CancelUnanswered),
        ({"ended_ns": None, "status": None}, faults.GoesOnAfterCancel),
        ({"ended_ns": 3 * S, "status": "succeeded"}, faults.GoesOnAfterCancel),
        ({"ended_ns": S + 2, "status": "succeeded"}, action_faults.WrongEnd),
        ({"ended_ns": 2 * S, "status": "canceled"}, faults.CancelsLate),
        ({"result": {"reached": True, "elapsed": 1.0}}, action_faults.WrongResult),
    ],
)
def test_each_way_to_get_a_cancel_wrong_has_its_name(
    words: dict[str, Any], kind: type[Exception]
) -> None:
    """Refused, unanswered, ignored, late, with the wrong state."""
    with pytest.raises(kind):
        flight(cancelled(0.2, **words)).must(in_time)


def test_a_cancel_that_comes_after_the_end_says_nothing() -> None:
    """Nobody is to blame where the goal was quicker."""
    with pytest.raises(NothingToJudge):
        flight(cancelled(-0.1, cancel_accepted=False)).must(in_time)


@pytest.mark.parametrize("held", [{"stall_s": 0.3}, {}])
def test_a_late_cancel_is_the_nodes_fault_only_beyond_what_held_it_up(held: dict[str, Any]) -> None:
    """The observer that stood still, or the node that waited for a processor."""
    waited_s = 0.0 if held else 0.3
    with pytest.raises(Inconclusive, match="held your node"):
        flight(cancelled(0.7, cpu_wait_s=waited_s), **held).must(in_time)
    with pytest.raises(faults.CancelsLate):
        flight(cancelled(1.0, cpu_wait_s=waited_s), **held).must(in_time)


def test_a_robot_that_is_never_told_to_stop_is_told_from_a_late_one() -> None:
    """The last command decides, then its time."""
    with pytest.raises(faults.KeepsDriving):
        flight(cancelled(0.1), commands=(command(0.5, 1.0),)).must(stops)
    with pytest.raises(faults.StopsLate):
        flight(cancelled(0.1), commands=(command(0.5, 1.0), command(3.0, 0.0))).must(stops)


# --- goals -------------------------------------------------------------------------------------


def test_a_refusal_tells_why() -> None:
    """ROS's own words show a function that returned nothing."""
    refused = goal(accepted=False, ended_ns=None)
    with pytest.raises(action_faults.RefusesGoodGoal):
        flight(refused).must(accept(NODE, "first", "now"))
    words = "Goal request callback did not return a GoalResponse type. Rejecting goal."
    with pytest.raises(action_faults.AnswersNothing):
        flight(refused, lines=(words,)).must(accept(NODE, "first", "now"))
    with pytest.raises(faults.StaysBusy):
        flight(refused).must(accept_again(NODE, "first", "later"))


def test_an_impossible_goal_is_named_with_its_nan() -> None:
    """And the hint tells of comparisons."""
    wrong = goal(goal={**NEST, "x": math.nan})
    read_back = GoalSeen.model_validate_json(wrong.model_dump_json())  # JSON holds no nan
    with pytest.raises(action_faults.AcceptsImpossible) as fault:
        flight(read_back).must(refuse_each(NODE, {"first": "x is no number"}))
    assert "x: nan" in fault.value.expected
    assert "isfinite" in fault.value.mend
    flight(goal(accepted=False)).must(refuse_each(NODE, {"first": "x is no number"}))


def test_no_goal_is_no_fault() -> None:
    """Another check has said why none could be given."""
    with pytest.raises(NothingToJudge):
        flight().must(accept(NODE, "first", "now"))


def test_a_node_that_hears_nothing_is_blocked() -> None:
    """But not on a computer that stood still."""
    with pytest.raises(faults.BlocksTheNode):
        flight(goal(), stuck=["/bird"]).must(hear_meanwhile)
    with pytest.raises(Inconclusive):
        flight(goal(), stuck=["/bird"], stall_s=0.9).must(hear_meanwhile)


def test_a_client_in_place_of_the_server_is_told() -> None:
    """A slip of one word."""
    end = ActionEnd(kind="client", node="/bird", action="/fly", type=FLY.type)
    with pytest.raises(action_faults.NoAction) as fault:
        flight(actions=[end]).must(perform(FLY))
    assert "client" in fault.value.measured


# --- the end -----------------------------------------------------------------------------------

arrives = arrive(NODE, "first")


def test_a_goal_that_is_reached_passes() -> None:
    """The robot is there and was told to stop."""
    flight(goal()).must(arrives, succeed(NODE, "first"))


@pytest.mark.parametrize(
    ("words", "kind"),
    [
        ({"goal": {**NEST, "x": 2.5}}, faults.EndsTooFar),
        ({"ended_ns": S}, faults.EndsTooFar),
        ({"ended_ns": None, "status": None}, faults.NeverArrives),
    ],
)
def test_the_real_place_decides(words: dict[str, Any], kind: type[Exception]) -> None:
    """Whatever the result says."""
    with pytest.raises(kind):
        flight(goal(**words)).must(arrives)


def test_an_error_in_the_execute_function_is_shown() -> None:
    """ROS ends the goal as aborted, and writes why."""
    line = "Error raised in execute callback: no attribute 'publish_feedback'"
    with pytest.raises(action_faults.ExecuteFailed) as fault:
        flight(goal(status="aborted"), lines=(line,)).must(arrives)
    assert "goal_handle.publish_feedback" in fault.value.mend


def test_a_state_that_nobody_set_is_told_from_a_wrong_one() -> None:
    """ROS's own words tell."""
    result = succeed(NODE, "first")
    with pytest.raises(action_faults.WrongEnd):
        flight(goal(status="aborted")).must(result)
    line = "Goal state not set, assuming aborted. Goal ID: 1"
    with pytest.raises(action_faults.SucceedForgotten):
        flight(goal(status="aborted"), lines=(line,)).must(result)


def test_a_server_may_think_before_it_accepts() -> None:
    """How long is not judged; the time of its result may begin before that, or after it."""
    for elapsed_s in (1.0, 2.0):
        result = {"reached": True, "elapsed": elapsed_s}
        flight(goal(answered_ns=S, result=result)).must(succeed(NODE, "first"))


@pytest.mark.parametrize(
    ("elapsed_s", "stall_s", "right"), [(1.8, 0.0, True), (1.5, 0.0, False), (1.5, 0.3, True)]
)
def test_the_time_of_a_result_allows_for_a_busy_computer(
    elapsed_s: float, stall_s: float, right: bool
) -> None:
    """What the observer sees late, the node may have measured right."""
    view = flight(goal(result={"reached": True, "elapsed": elapsed_s}), stall_s=stall_s)
    if right:
        view.must(succeed(NODE, "first"))
    else:
        with pytest.raises(action_faults.WrongResult):
            view.must(succeed(NODE, "first"))


# --- feedback ----------------------------------------------------------------------------------


def told(**wrong: float) -> TopicSeen:
    """Feedback at 10 Hz that is a twentieth of a second old, with some fields always wrong."""
    messages = [
        MessageSeen(
            source_ns=None,
            sequence=None,
            arrival_ns=round((at_s + 0.05) * S),
            size=1,
            content={
                "goal_id": {"uuid": NUMBER},
                "feedback": {"x": at_s, "y": 0.0, "distance": 2.0 - at_s, **wrong},
            },
        )
        for at_s in (n / 10 for n in range(1, 19))
    ]
    return TopicSeen(name="/fly/_action/feedback", type="x", messages=messages)


def test_true_feedback_passes() -> None:
    """As old as a message on its way is."""
    flight(goal(), topics={"/fly/_action/feedback": told()}).must(tell_the_truth(NODE, "first"))


@pytest.mark.parametrize("wrong", [{"x": 0.0}, {"y": 0.5}, {"distance": 2.0}])
def test_feedback_that_does_not_move_is_frozen(wrong: dict[str, float]) -> None:
    """The robot does."""
    view = flight(goal(), topics={"/fly/_action/feedback": told(**wrong)})
    with pytest.raises(faults.FrozenFeedback) as fault:
        view.must(tell_the_truth(NODE, "first"))
    assert fault.value.field_name in wrong


def test_feedback_of_another_goal_is_left_aside() -> None:
    """It carries another number."""
    view = flight(goal(id=[0] * 16), topics={"/fly/_action/feedback": told()})
    with pytest.raises(NothingToJudge):
        view.must(tell_the_truth(NODE, "first"))


# --- the loop ----------------------------------------------------------------------------------


def turning(hz: float) -> ExperimentView:
    """A flight of two seconds, with a feedback in each turn of the loop."""
    content = {"goal_id": {"uuid": NUMBER}, "feedback": {}}
    told = [
        MessageSeen(
            source_ns=round(n / hz * S),
            sequence=n + 1,
            arrival_ns=round(n / hz * S),
            size=9,
            content=content,
        )
        for n in range(round(2 * hz))
    ]
    topic = goal().feedback_topic
    type_ = f"{FLY.type}_FeedbackMessage"
    return flight(
        goal(), topics={topic: TopicSeen(name=topic, type=type_, messages=told)}, stall_s=9.0
    )


def test_a_loop_without_a_pause_is_told_on_any_computer() -> None:
    """None makes a loop so fast, however busy it is; a quick one is another mistake."""
    fly = FLY.model_copy(update={"feedback": RateContract(hz=10.0, within=0.1)})
    demand = rest_in_each_turn(NODE, fly, "first")
    with pytest.raises(faults.NeverRests) as fault:
        turning(800.0).must(demand)
    assert fault.value.measured == "800 times a second: the loop never waits"
    assert "`await self.tick`" in fault.value.mend and "every 0.1 s" in fault.value.mend
    assert "time.sleep(0.1)" in fault.value.mend
    turning(20.0).must(demand)


# --- what this computer took ---------------------------------------------------------------------


def held_up(part: str, held_s: float, demand: Any, fault: type[Exception], **seen: Any) -> bool:
    """Whether the fault is told of an experiment that was held up; else nobody can tell."""
    process = ProcessSeen(executable="bird", started_ns=0)
    held = {part: HeldUpSeen(cpu_wait_s=held_s, stall_s=0.0)}
    words = {"processes": {"bird": process}, "held_up": held, **seen}
    view = ExperimentView(seen_with(name="x", clock="wall", **words))
    with pytest.raises((fault, Inconclusive)) as raised:
        view.must(demand)
    return isinstance(raised.value, fault)


@pytest.mark.parametrize(("held_s", "is_told"), [(1.0, True), (PATIENCE_S + 1, False)])
def test_a_node_that_does_not_hear(held_s: float, is_told: bool) -> None:
    """It was given time of its own, up to a bound."""
    blocks = faults.BlocksTheNode
    assert held_up(HEARS, held_s, hear_meanwhile, blocks, stuck=["/bird"]) is is_told


@pytest.mark.parametrize(("held_s", "is_told"), [(1.0, True), (6.0, False)])
def test_a_goal_without_an_answer(held_s: float, is_told: bool) -> None:
    """Five seconds were waited for it."""
    alone = goal(answered_ns=None, accepted=None, ended_ns=None, status=None, result=None)
    demand, part = accept(NODE, "first", "at first"), answer_to("first")
    fault = action_faults.GoalUnanswered
    assert held_up(part, held_s, demand, fault, goals=[alone], drive={}) is is_told
