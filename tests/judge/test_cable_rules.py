"""Lines of the board and messages of the node: what is a loss, and what only waited."""

from __future__ import annotations

import pytest

from roslings.course import TopicContract
from roslings.evidence import BoardSeen, CableLine, ExperimentSeen, MessageSeen, TopicSeen
from roslings.judge import ExperimentView
from roslings.judge.cable import tell_every_line
from roslings.judge.faults.cable import LinesAndMessagesDiffer, WrongOdometry
from roslings.judge.views import TopicView

TOPIC = TopicContract(topic="/speed", type="sensor_msgs/msg/JointState")
MS = 10**6
EVERY_MS, LINES = 20, 400


def judge(first_line: int, messages: int) -> None:
    """The board tells 400 lines; the node's messages begin at `first_line`, till the last line."""
    at = [n * EVERY_MS * MS for n in range(LINES)]
    told = [CableLine(board_s=0.0, sent_ns=ns, text="$W,1,2,3,4*0000") for ns in at]
    begin, end = at[first_line], at[-1]
    step = (end - begin) // (messages - 1)
    heard = [
        MessageSeen(source_ns=None, sequence=n, arrival_ns=begin + n * step, size=1)
        for n in range(messages)
    ]
    seen = ExperimentSeen(name="x", clock="wall", board=BoardSeen(told=told))
    topic = TopicSeen(name="/speed", type=TOPIC.type, messages=heard)
    tell_every_line(ExperimentView(seen))(TopicView(TOPIC, "/speed", TOPIC.type, topic, seen))


@pytest.mark.parametrize(("first_line", "messages"), [(0, 400), (50, 350), (80, 400)])
def test_lines_that_waited_for_a_slow_start_are_no_fault(first_line: int, messages: int) -> None:
    """The port was open, the node not yet ready: it then reads what the cable kept for it."""
    judge(first_line, messages)


@pytest.mark.parametrize(("first_line", "messages"), [(0, 200), (0, 800), (50, 700)])
def test_each_line_twice_and_every_second_line_are_faults(first_line: int, messages: int) -> None:
    """With and without lines that nobody read."""
    with pytest.raises(LinesAndMessagesDiffer):
        judge(first_line, messages)


def test_a_way_is_told_in_words() -> None:
    """Back, right, not turned; the right length in a wrong direction."""
    fault = WrongOdometry("arc", (0.3, -0.3, -90.0), (-0.3, -0.3, -90.0))
    assert fault.expected.endswith("0.30 m ahead, 0.30 m right, turned 90 degrees right")
    assert fault.measured == "/odom says 0.30 m back, 0.30 m right, turned 90 degrees right"
    assert "its direction is not" in fault.hint
    assert WrongOdometry("x", (1.0, 0.0, 0.0), (2.0, 0.0, 0.0)).measured.endswith("not turned")
