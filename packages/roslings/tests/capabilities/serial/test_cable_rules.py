"""Lines of the board and messages of the node: what is a loss, and what only waited."""

from __future__ import annotations

import binascii

import pytest

from roslings.capabilities.serial.demands import (
    come_so_far,
    drive_again,
    drive_at_most,
    drive_by_its_settings,
    keep_still,
    open_its_port,
    set_its_speed,
    tell_every_line,
    tell_the_motion,
)
from roslings.capabilities.serial.faults import (
    DeafAfterNonsense,
    FollowedNonsense,
    LinesAndMessagesDiffer,
    PortNotOpened,
    SettingIgnored,
    TooFast,
    WrongDrive,
    WrongOdometry,
    WrongSpeedOfPort,
    WrongTwist,
)
from roslings.capabilities.serial.record import BoardMark, BoardSeen, CableLine, MotorsSeen
from roslings.course import TopicContract
from roslings.evidence import MessageSeen, TopicSeen
from roslings.judge import ExperimentView, NothingToJudge
from roslings.judge.faults import Inconclusive
from roslings.judge.views import TopicView
from roslings_rover.rover import Body
from seen_with import seen_with

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
    seen = seen_with(name="x", clock="wall", board=BoardSeen(told=told))
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
    assert "its direction is not" in fault.mend
    assert WrongOdometry("x", (1.0, 0.0, 0.0), (2.0, 0.0, 0.0)).measured.endswith("not turned")


# --- other settings, and commands that nobody can follow -----------------------------------------


def mark(part: str, board_s: float = 1.0, pwm: tuple[int, int] = (0, 0)) -> BoardMark:
    """How things stood at a moment; the rover is where it began."""
    return BoardMark(
        part=part,
        arrival_ns=0,
        board_s=board_s,
        x_m=0,
        y_m=0,
        heading_rad=0,
        left_pwm=pwm[0],
        right_pwm=pwm[1],
    )


def seen(board: BoardSeen) -> ExperimentView:
    """An experiment with this board."""
    return ExperimentView(seen_with(name="x", clock="wall", board=board))


HALF, ASKED = Body(wheel_radius_m=0.05), Body(wheel_radius_m=0.1)
"""Rovers that drive straight on with 0.5 m/s at PWM 150, and at PWM 75."""


@pytest.mark.parametrize(
    ("pwm", "fault"), [((75, 75), None), ((150, 150), SettingIgnored), ((99, 99), WrongDrive)]
)
def test_a_setting_that_is_ignored_is_named(
    pwm: tuple[int, int], fault: type[WrongDrive] | None
) -> None:
    """By the PWM that would be right for its default."""
    demand = drive_by_its_settings("on", 0.5, 0.0, ASKED, {"wheel_radius": HALF})
    view = seen(BoardSeen(marks=[mark("on", pwm=pwm)]))
    if fault is None:
        demand(view)
        return
    with pytest.raises(WrongDrive) as found:
        demand(view)
    assert type(found.value) is fault
    assert ("wheel_radius" in f"{found.value}{found.value.hint}") is (fault is SettingIgnored)


def test_a_command_that_is_too_fast_gets_full_pwm() -> None:
    """The line that was sent is told; a refused one leaves the motors without power."""
    line = CableLine(board_s=0.9, sent_ns=0, text="$M,7,1020,1020*ABCD")
    drive_at_most("on", 2.0, 0.0)(seen(BoardSeen(marks=[mark("on", pwm=(255, 255))])))
    with pytest.raises(TooFast, match="M,7,1020,1020"):
        drive_at_most("on", 2.0, 0.0)(seen(BoardSeen(marks=[mark("on")], heard=[line])))


def test_nonsense_moves_nothing_and_what_follows_does() -> None:
    """Between the two marks, and after them."""
    begin, end = mark("odd", 1.0), mark("odd, over", 3.0)
    before, after = (MotorsSeen(board_s=at, left_pwm=9, right_pwm=9) for at in (0.5, 3.5))
    during = MotorsSeen(board_s=2.0, left_pwm=0, right_pwm=-9)
    keep_still("odd")(seen(BoardSeen(marks=[begin, end], motors=[before, after])))
    with pytest.raises(FollowedNonsense):
        keep_still("odd")(seen(BoardSeen(marks=[begin, end], motors=[during])))
    marks = [begin, end, mark("on", 4.0)]
    drive_again("on", "odd")(seen(BoardSeen(marks=marks, motors=[before, after])))
    with pytest.raises(DeafAfterNonsense):
        drive_again("on", "odd")(seen(BoardSeen(marks=marks, motors=[before])))
    with pytest.raises(NothingToJudge):
        come_so_far("odd")(seen(BoardSeen()))


def test_a_port_is_open_where_anything_shows_it() -> None:
    """A line, a speed, or a message; and its speed is that of the parameter."""
    line = CableLine(board_s=0.0, sent_ns=0, text="M")
    for board in (BoardSeen(heard=[line]), BoardSeen(host_bits_s=9600)):
        open_its_port("port", TOPIC)(seen(board))
    with pytest.raises(PortNotOpened):
        open_its_port("port", TOPIC)(seen(BoardSeen()))
    set_its_speed("baud", 9600)(seen(BoardSeen(host_bits_s=9600)))
    for speed in (115200, None):
        with pytest.raises(WrongSpeedOfPort):
            set_its_speed("baud", 9600)(seen(BoardSeen(host_bits_s=speed)))


# --- how fast it moves -------------------------------------------------------------------------

WHEELS = (4800, 9500)  # mrad/s: 0.25 m/s forward, and a turn to the left of about 1 rad/s


def say_the_motion(
    forward_m_s: float, turn_rad_s: float, wheels: tuple[int, int] = WHEELS, stall_s: float = 0.0
) -> None:
    """The board tells the same wheels again and again; the node's last message has this twist."""
    body = f"W,1,2,{wheels[0]},{wheels[1]}"
    text = f"${body}*{binascii.crc_hqx(body.encode(), 0):04X}"
    told = [CableLine(board_s=0.0, sent_ns=n * EVERY_MS * MS, text=text) for n in range(20)]
    twist = {"linear": {"x": forward_m_s}, "angular": {"z": turn_rad_s}}
    message = MessageSeen(
        source_ns=None, sequence=1, arrival_ns=390 * MS, size=1, content={"twist": {"twist": twist}}
    )
    mark = BoardMark(
        part="arc",
        arrival_ns=400 * MS,
        board_s=0.4,
        x_m=0.0,
        y_m=0.0,
        heading_rad=0.0,
        left_pwm=0,
        right_pwm=0,
    )
    board = BoardSeen(told=told, marks=[mark])
    seen = seen_with(name="x", clock="wall", board=board, stall_s=stall_s)
    topic = TopicSeen(name="/odom", type=TOPIC.type, messages=[message])
    view = TopicView(TOPIC, "/odom", TOPIC.type, topic, seen)
    tell_the_motion(ExperimentView(seen), "arc", Body())(view)


def test_a_twist_is_the_motion_of_the_wheels() -> None:
    """Forward and turn, each as good as the wheels' speeds are."""
    say_the_motion(0.25, 1.03)
    for twist in ((0.0, 0.0), (0.25, 59.0), (0.5, 1.03), (0.25, -1.03)):
        with pytest.raises(WrongTwist):
            say_the_motion(*twist)


def test_wheels_that_stand_tell_nothing() -> None:
    """Where this computer stood still meanwhile, that is why."""
    with pytest.raises(NothingToJudge):
        say_the_motion(0.0, 0.0, wheels=(0, 0))
    with pytest.raises(Inconclusive):
        say_the_motion(0.0, 0.0, wheels=(0, 0), stall_s=5.0)


def test_what_was_not_done_on_a_busy_computer_is_no_skipped_check() -> None:
    """A skipped check costs its points."""
    seen = seen_with(name="x", clock="wall", board=BoardSeen(), stall_s=5.0)
    with pytest.raises(Inconclusive):
        ExperimentView(seen).must(come_so_far("nonsense"))
