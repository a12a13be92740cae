"""What comes late while this computer held the node up is held against nobody."""

from __future__ import annotations

from typing import Any

import pytest

from roslings.capabilities.camera.act import MISSING
from roslings.capabilities.camera.demands import tell_of_trouble
from roslings.capabilities.camera.faults import images as camera_faults
from roslings.capabilities.serial import faults as cable_faults
from roslings.capabilities.serial.demands import drive_as_told, stop_by_itself
from roslings.capabilities.serial.record import BoardMark, BoardSeen, CableLine
from roslings.capabilities.services import faults
from roslings.capabilities.services.contract import ServiceContract
from roslings.capabilities.services.demands import answer_in_time, give_up
from roslings.capabilities.services.record import CLIENT_ENDS, CallSeen
from roslings.course import NodeContract
from roslings.evidence import HeldUpSeen, ProcessSeen, StageMark
from roslings.experiment.own_time import PATIENCE_S
from roslings.judge import ExperimentView, Inconclusive
from roslings.judge.demands import require_its_time
from roslings.judge.faults import Fault, NothingToJudge
from roslings_rover.board import DriveCommand
from seen_with import seen_with

S = 10**9
LAMP = ServiceContract.model_validate(
    {
        "service": "/light",
        "type": "std_srvs/srv/SetBool",
        "within_s": 0.1,
        "answers": [{"when": "on", "request": {"data": True}, "response": {"success": True}}],
    }
)
NODE = NodeContract.model_validate(
    {
        "node": "/it",
        "executable": "it",
        "serves": [LAMP],
        "log": "Trouble: {text}",
        "gives_up": {"within_s": 2.0, "log": "nobody", "exit_code": 1},
    }
)


def view(part: str, held_s: float, ended_ns: int | None = None, **seen: Any) -> ExperimentView:
    """An experiment in which this part was held up for so long."""
    process = ProcessSeen(executable="it", started_ns=0, ended_ns=ended_ns)
    held = {part: HeldUpSeen(cpu_wait_s=held_s, stall_s=0.0)}
    words = {"processes": {"it": process}, "held_up": held, **seen}
    return ExperimentView(seen_with(name="x", clock="wall", **words))


def told(part: str, held_s: float, demand: Any, fault: type[Fault], **seen: Any) -> bool:
    """Whether the fault is told; else nobody can tell."""
    with pytest.raises((fault, Inconclusive)) as raised:
        view(part, held_s, **seen).must(demand)
    return isinstance(raised.value, fault)


def calls(took_s: float, count: int = 10) -> list[CallSeen]:
    """A row of answers."""
    return [
        CallSeen(
            service="/light",
            type=LAMP.type,
            request={"data": True},
            part="row",
            response={"success": True},
            sent_ns=0,
            answered_ns=round(took_s * S),
        )
        for _ in range(count)
    ]


@pytest.mark.parametrize(("held_s", "is_told"), [(0.0, True), (0.9, True), (1.1, False)])
def test_late_answers(held_s: float, is_told: bool) -> None:
    """Ten answers, each late by a tenth of a second: that is a second together."""
    demand = answer_in_time(NODE, LAMP, "row", "in a row", 100)
    assert told("row", held_s, demand, faults.LateAnswers, calls=calls(0.2)) is is_told


def test_another_part_excuses_nothing() -> None:
    """What was held up was something else."""
    demand = answer_in_time(NODE, LAMP, "row", "in a row", 100)
    assert told("crowd", 9.0, demand, faults.LateAnswers, calls=calls(0.2))


@pytest.mark.parametrize(("held_s", "is_told"), [(1.0, True), (8.0, False)])
def test_a_client_that_does_not_give_up(held_s: float, is_told: bool) -> None:
    """It ran for nine seconds, seven more than it had."""
    assert told(CLIENT_ENDS, held_s, give_up(NODE), faults.NeverGivesUp, ended_ns=9 * S) is is_told


def board(*, stops_at_s: float | None = None) -> BoardSeen:
    """A board whose motors were told to run, and to stop later."""
    mark = BoardMark(
        part="on", arrival_ns=0, board_s=1.0, x_m=0, y_m=0, heading_rad=0, left_pwm=9, right_pwm=9
    )
    commands = [(0.5, DriveCommand(1, 100, 100))]
    commands += [(stops_at_s, DriveCommand(2, 0, 0))] if stops_at_s else []
    heard = [
        CableLine(board_s=at, sent_ns=0, text=drive.line().decode().strip())
        for at, drive in commands
    ]
    return BoardSeen(marks=[mark], heard=heard)


@pytest.mark.parametrize(("held_s", "is_told"), [(0.1, True), (0.5, False)])
def test_a_command_that_does_not_come(held_s: float, is_told: bool) -> None:
    """After half a second without one, the board stops its motors."""
    demand = drive_as_told("on", 0.3, 0.0)
    assert told("on", held_s, demand, cable_faults.WrongDrive, board=board()) is is_told


@pytest.mark.parametrize(("held_s", "is_told"), [(0.6, True), (1.6, False)])
def test_a_node_that_sent_nothing_for_two_seconds(held_s: float, is_told: bool) -> None:
    """Who had nothing from it for so long asks for more than one late command."""
    stood = {"since_s": -1.0, "left_pwm": 0, "right_pwm": 0}
    told_long_ago = [board().marks[0].model_copy(update=stood)]
    silent = BoardSeen(marks=told_long_ago)
    demand = drive_as_told("on", 0.3, 0.0)
    assert told("on", held_s, demand, cable_faults.DoesNotDrive, board=silent) is is_told


@pytest.mark.parametrize(("held_s", "is_told"), [(0.1, True), (0.6, False)])
def test_a_late_stop(held_s: float, is_told: bool) -> None:
    """It came half a second late."""
    demand = stop_by_itself("on")
    late = board(stops_at_s=2.5)
    assert told("on", held_s, demand, cable_faults.DoesNotStop, board=late) is is_told


def test_a_stop_that_came_in_the_moment_of_the_mark() -> None:
    """The motors ran when it was set: on a busy computer the node's own stop is as early."""
    view("on", 0.0, board=board(stops_at_s=1.0)).must(stop_by_itself("on"))


def slow_board(passed_s: float) -> BoardSeen:
    """Its motors stop after 0.8 s of its own clock; for one second of it, `passed_s` passed."""
    seen = board(stops_at_s=1.8)
    end = seen.marks[0].model_copy(
        update={"part": "on, over", "board_s": 2.0, "arrival_ns": round(passed_s * S)}
    )
    return seen.model_copy(update={"marks": [*seen.marks, end]})


def test_a_stop_that_is_in_time_only_by_the_clock_of_a_slow_board() -> None:
    """1.2 s had passed for the node: nobody can tell whether it stops in time."""
    view("on", 0.0, board=slow_board(1.0)).must(stop_by_itself("on"))
    with pytest.raises(Inconclusive, match=r"1\.20 s had passed"):
        view("on", 0.0, board=slow_board(1.5)).must(stop_by_itself("on"))


@pytest.mark.parametrize(("stall_s", "is_told"), [(0.1, True), (0.9, False)])
def test_a_node_that_nobody_saw(stall_s: float, is_told: bool) -> None:
    """A client that ends soon is gone before a computer that stands still has seen it."""
    with pytest.raises((NothingToJudge, Inconclusive)) as raised:
        view("on", 0.0, stall_s=stall_s).node(NODE)
    assert isinstance(raised.value, NothingToJudge) is is_told


@pytest.mark.parametrize(("held_s", "is_told"), [(1.0, True), (PATIENCE_S + 1, False)])
def test_a_node_that_says_nothing_about_its_camera(held_s: float, is_told: bool) -> None:
    """Nor does one that had no processor."""
    demand = tell_of_trouble(NODE, "missing", "no camera", MISSING)
    stages = [StageMark(part="missing", at_ns=0)]
    silent = camera_faults.SilentAboutCamera
    assert told("missing", held_s, demand, silent, stages=stages) is is_told


def test_the_worst_of_all_parts_counts_where_none_is_named() -> None:
    """A stretch that was not held up does not hide the others."""
    seen = view("one", 0.1).seen
    seen.held_up["two"] = HeldUpSeen(cpu_wait_s=0.2, stall_s=0.3)
    require_its_time(seen, "two", 0.6, "it")
    with pytest.raises(Inconclusive, match=r"0\.50 s"):
        require_its_time(seen, None, 0.4, "it")
