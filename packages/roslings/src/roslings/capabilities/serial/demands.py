"""Demands on a node that stands between ROS and a board on a serial cable."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ros2_on_pip.rates import NS_PER_S
from roslings.capabilities.serial import faults as cable_faults
from roslings.capabilities.serial.reasons import BoardUnused, LinesLost, SlowBoard
from roslings.capabilities.serial.record import BoardMark, BoardSeen, CableLine, SerialSeen
from roslings.capabilities.topics.faults.messages import NoMessages
from roslings.capabilities.topics.faults.relay import WrongField
from roslings.course import TopicContract
from roslings.evidence import MessageSeen, TopicSeen
from roslings.judge.demands import require_its_time, require_steady
from roslings.judge.faults.moments import Awaited, Nothing
from roslings.judge.views import Demand, ExperimentView, TopicView
from roslings_rover.models.board_lines import BadLine, DriveCommand, Speeds, checksum, unframed
from roslings_rover.models.differential_drive import Body, Motion, Wheels

MOST_LINES_LOST = 0.15
"""Part of the board's lines that may be without a message: those that a busy node still works on
when the watch ends. A node that leaves lines out, or doubles them, is off by more."""

MOST_LINES_WAITING = 150
"""A node that is slow to begin finds so many lines in the cable's buffer, of 4096 bytes."""

SPEED_EXACT_RAD_S = 0.002
PLACE_WITHIN_M = 0.05
HEADING_WITHIN_RAD = math.radians(4)
MOTION_WITHIN_M_S, MOTION_WITHIN_RAD_S = 0.02, 0.1
LINES_OF_NOW = 12
"""A message may tell of a line that is so many behind the last one: a quarter of a second."""

LAG_S = 0.25
"""What is told of a rover that does not stand comes a little after what it tells of."""
FASTEST_M_S, FASTEST_RAD_S = 0.3, 1.2
PWM_WITHIN = 3
FULL_PWM = 255
STOPS_WITHIN_S = 1.0
BOARD_STOPS_S = 0.5
"""After so long without a command the board stops its motors: STOPS_AFTER_MS of its sketch."""

LATE_COMMAND_S = 0.4
"""A node that is held up for so long may let the board stop by itself."""

FEWEST = 10


# --- what the node makes of the board's lines --------------------------------------------------


def hold_its_fields(contract: TopicContract) -> Demand[TopicView]:
    """Every message holds what the card says."""

    def demand(topic: TopicView) -> None:
        for message in _contents(topic):
            for field, wanted in contract.fields.items():
                found = _written(_field(message, field))
                if found != str(wanted):
                    raise WrongField(topic.name, field, str(wanted), found or Nothing("text"))

    return demand


def tell_every_line(experiment: ExperimentView) -> Demand[TopicView]:
    """As many messages as the board sent lines while the node was listening."""

    def demand(topic: TopicView) -> None:
        if len(topic.messages) < FEWEST:
            raise NoMessages(topic.name, len(topic.messages), topic.experiment.watching_s)
        waited, lines = _lines_before_and_between(experiment, topic.messages)
        published, lost = _published(topic.messages), max(FEWEST, MOST_LINES_LOST * lines)
        if not lines - lost <= published <= lines + lost + min(waited, MOST_LINES_WAITING):
            require_steady(topic.experiment.stall_s)
            raise cable_faults.LinesAndMessagesDiffer(topic.name, lines, published)

    return demand


def tell_the_speeds(experiment: ExperimentView) -> Demand[TopicView]:
    """Each pair of velocities is one that the board told, in rad/s, left wheel first."""

    def demand(topic: TopicView) -> None:
        told = _told(_board(experiment))
        for left, right in _velocities(topic):
            if not _is_among(left, right, told):
                raise _speed_fault(left, right, told)
        if not any(abs(left) > 1 for left, _ in _velocities(topic)):
            raise BoardUnused("wheels")

    return demand


def tell_nothing_else(experiment: ExperimentView) -> Demand[TopicView]:
    """On a bad cable: what was published was told by the board, and the node lived through it."""

    def demand(topic: TopicView) -> None:
        told = _told(_board(experiment))
        for left, right in _velocities(topic):
            if not _is_among(left, right, told):
                raise cable_faults.BadLineUsed(left, right)
        if not _went_on(experiment, topic, "good again"):
            raise cable_faults.SilentAfter(cable_faults.Trouble("noise"), topic.name)

    return demand


def outlast_silence(experiment: ExperimentView, part: str, silence_s: float) -> Demand[TopicView]:
    """Messages come after the mark `part`, at which a silence of the board was over."""

    def demand(topic: TopicView) -> None:
        if not _went_on(experiment, topic, part):
            silence = cable_faults.Trouble("silence", silence_s)
            raise cable_faults.GaveUpInSilence(silence, topic.name)

    return demand


def come_back(part: str, after: str, topic: TopicContract) -> Demand[ExperimentView]:
    """Messages come again; `part` is the mark that was set when they did."""

    def demand(experiment: ExperimentView) -> None:
        if not any(mark.part == part for mark in _board(experiment).marks):
            require_steady(experiment.seen.stall_s)
            require_its_time(experiment.seen, part, None, Awaited("first_message"))
            raise cable_faults.SilentAfter(after, topic.topic)

    return demand


# --- odometry ----------------------------------------------------------------------------------


def know_the_way(experiment: ExperimentView, before: str, after: str) -> Demand[TopicView]:
    """Between two marks, the odometry moved as the rover really did."""

    def demand(topic: TopicView) -> None:
        marks = {mark.part: mark for mark in _board(experiment).marks}
        if before not in marks or after not in marks:
            raise BoardUnused("not_driven")
        really = _moved(_true_place(marks[before]), _true_place(marks[after]))
        if math.hypot(really.x_m, really.y_m) < 0.02 and abs(really.turn_rad) < 0.1:
            raise BoardUnused("stood")
        told = _moved(_told_place(topic, marks[before]), _told_place(topic, marks[after]))
        moving = any(m.left_pwm or m.right_pwm for m in (marks[before], marks[after]))
        fault = _difference(after, really, told, LAG_S if moving else 0.0)
        if fault:
            require_steady(topic.experiment.stall_s)
            _require_whole(_board(experiment))
            raise fault

    return demand


def tell_the_motion(experiment: ExperimentView, part: str, body: Body) -> Demand[TopicView]:
    """At the mark `part`, the odometry's twist was the motion of the wheels that the board told."""

    def demand(topic: TopicView) -> None:
        mark = _mark(experiment, part)
        before = [m for m in topic.messages if m.arrival_ns <= mark.arrival_ns and m.content]
        really = _motions_at(experiment, mark, body)
        if not before or not any(abs(each.forward_m_s) > MOTION_WITHIN_M_S for each in really):
            _require_its_command(experiment, part, _runs)
            raise BoardUnused("wheels")
        twist = before[-1].content["twist"]["twist"]
        told = Motion(_number(twist["linear"]["x"]), _number(twist["angular"]["z"]))
        if not any(_is_motion(told, each) for each in really):
            require_steady(topic.experiment.stall_s)
            raise cable_faults.WrongTwist(
                topic.name,
                (really[-1].forward_m_s, really[-1].turn_rad_s),
                (told.forward_m_s, told.turn_rad_s),
            )

    return demand


def _motions_at(experiment: ExperimentView, mark: BoardMark, body: Body) -> list[Motion]:
    """The motions of the last lines that the board told before a mark, in their order."""
    lines = [line for line in _speed_lines(_board(experiment)) if line.sent_ns <= mark.arrival_ns]
    found = map(_speeds_of, lines[-LINES_OF_NOW:])
    return [
        body.motion_of(Wheels(each.left_mrad_s / 1000, each.right_mrad_s / 1000)) for each in found
    ]


def _is_motion(told: Motion, really: Motion) -> bool:
    off_m_s = abs(told.forward_m_s - really.forward_m_s)
    off_rad_s = abs(told.turn_rad_s - really.turn_rad_s)
    return off_m_s <= MOTION_WITHIN_M_S and off_rad_s <= MOTION_WITHIN_RAD_S


@dataclass(frozen=True)
class FloorPose:
    """A place on the floor, or a way seen from where it began."""

    x_m: float
    y_m: float
    turn_rad: float


def _moved(begin: FloorPose, end: FloorPose) -> FloorPose:
    """The way, seen by the rover at its beginning: earlier mistakes do not count again."""
    dx, dy = end.x_m - begin.x_m, end.y_m - begin.y_m
    cos, sin = math.cos(begin.turn_rad), math.sin(begin.turn_rad)
    turn = math.remainder(end.turn_rad - begin.turn_rad, 2 * math.pi)
    return FloorPose(dx * cos + dy * sin, dy * cos - dx * sin, turn)


def _difference(
    part: str, really: FloorPose, told: FloorPose, lag_s: float
) -> cable_faults.WrongOdometry | None:
    """What is said of a rover that moves may be late by `lag_s`."""
    off_m = math.hypot(told.x_m - really.x_m, told.y_m - really.y_m)
    off_rad = abs(math.remainder(told.turn_rad - really.turn_rad, 2 * math.pi))
    length_m = math.hypot(really.x_m, really.y_m)
    place_within_m = PLACE_WITHIN_M + 0.05 * length_m + lag_s * FASTEST_M_S
    if off_m <= place_within_m and off_rad <= HEADING_WITHIN_RAD + lag_s * FASTEST_RAD_S:
        return None
    ways = [(way.x_m, way.y_m, math.degrees(way.turn_rad)) for way in (really, told)]
    return cable_faults.WrongOdometry(part, *ways)


def _require_whole(board: BoardSeen) -> None:
    """Before a way is held against the student: no line was lost between board and node."""
    if board.lost_bytes:
        raise LinesLost


def _true_place(mark: BoardMark) -> FloorPose:
    return FloorPose(mark.x_m, mark.y_m, mark.heading_rad)


def _told_place(topic: TopicView, mark: BoardMark) -> FloorPose:
    """The last place that was published before a mark; the origin where none was."""
    before = [m for m in topic.messages if m.arrival_ns <= mark.arrival_ns and m.content]
    if not before:
        return FloorPose(0.0, 0.0, 0.0)
    pose = before[-1].content["pose"]["pose"]
    at, turned = pose["position"], pose["orientation"]
    z, w = _number(turned["z"]), _number(turned["w"])
    return FloorPose(_number(at["x"]), _number(at["y"]), 2 * math.atan2(z, w))


# --- what the node makes of commands -----------------------------------------------------------


def drive_as_told(
    part: str, forward_m_s: float, turn_rad_s: float, body: Body | None = None
) -> Demand[ExperimentView]:
    """At the mark `part`, the motors had the PWM of this motion."""
    wanted = pwm_for(body or Body(), forward_m_s, turn_rad_s)

    def demand(experiment: ExperimentView) -> None:
        got = _pwm_at(experiment, part)
        if not _alike(got, wanted):
            _require_its_command(experiment, part, _makes(wanted))
            raise _drive_fault((forward_m_s, turn_rad_s), wanted, got)

    return demand


def drive_by_its_settings(
    part: str, forward_m_s: float, turn_rad_s: float, body: Body, without: Mapping[str, Body]
) -> Demand[ExperimentView]:
    """The same, of a node that was started with the measures of `body`.

    `without` is parameter's name to the rover that a node has in mind which does not read it.
    """
    drive = drive_as_told(part, forward_m_s, turn_rad_s, body)

    def demand(experiment: ExperimentView) -> None:
        try:
            drive(experiment)
        except cable_faults.WrongDrive as fault:
            for name, other in without.items():
                if _alike(fault.got, pwm_for(other, forward_m_s, turn_rad_s)):
                    raise cable_faults.SettingIgnored(
                        fault.motion, fault.wanted, fault.got, name
                    ) from fault
            raise

    return demand


def drive_at_most(part: str, forward_m_s: float, turn_rad_s: float) -> Demand[ExperimentView]:
    """At the mark `part`, both motors had full PWM: the motion is too fast, on both sides alike."""
    wanted = pwm_for(Body(), forward_m_s, turn_rad_s)

    def demand(experiment: ExperimentView) -> None:
        got = _pwm_at(experiment, part)
        if not _alike(got, wanted):
            _require_its_command(experiment, part, _makes(wanted))
            sent = _last_sent(experiment, _mark(experiment, part))
            raise cable_faults.TooFast((forward_m_s, turn_rad_s), wanted, got, sent)

    return demand


def pwm_for(body: Body, forward_m_s: float, turn_rad_s: float) -> tuple[int, int]:
    """The PWM, left and right, with which such a rover makes this motion."""
    wheels = body.wheels_for(Motion(forward_m_s, turn_rad_s))
    full = FULL_PWM / body.fastest_wheel_rad_s
    return round(wheels.left_rad_s * full), round(wheels.right_rad_s * full)


def _pwm_at(experiment: ExperimentView, part: str) -> tuple[int, int]:
    mark = _mark(experiment, part)
    return mark.left_pwm, mark.right_pwm


def _alike(got: tuple[int, int], wanted: tuple[int, int]) -> bool:
    return max(abs(g - w) for g, w in zip(got, wanted, strict=True)) <= PWM_WITHIN


def _require_its_command(
    experiment: ExperimentView, part: str, follows: Callable[[DriveCommand], bool]
) -> None:
    """Before the motors are held against the student: this computer did not hold it up.

    `follows` says whether a command is one that the node was told to send.
    """
    require_steady(experiment.seen.stall_s)
    late_s = _without_command_s(experiment, _mark(experiment, part), follows) - BOARD_STOPS_S
    require_its_time(experiment.seen, part, max(LATE_COMMAND_S, late_s), Awaited("command"))


def _without_command_s(
    experiment: ExperimentView, mark: BoardMark, follows: Callable[[DriveCommand], bool]
) -> float:
    """How long before a mark the node had sent nothing that follows, by the board's clock."""
    begin_s = mark.board_s if mark.since_s is None else mark.since_s
    sent = (at for at, drive in _commands(experiment) if at <= mark.board_s and follows(drive))
    return mark.board_s - max((begin_s, *sent))


def _makes(wanted: tuple[int, int]) -> Callable[[DriveCommand], bool]:
    """Whether a command makes the motors run with this PWM."""
    return lambda drive: _alike((drive.left_pwm, drive.right_pwm), wanted)


def _last_sent(experiment: ExperimentView, mark: BoardMark) -> str:
    """The last line that the node sent before a mark, good or not."""
    before = [line.text for line in _board(experiment).heard if line.board_s <= mark.board_s]
    return before[-1] if before else ""


def _drive_fault(
    motion: tuple[float, float], wanted: tuple[int, int], got: tuple[int, int]
) -> cable_faults.WrongDrive:
    if got == (0, 0):
        return cable_faults.DoesNotDrive(motion, wanted, got)
    swapped = max(abs(got[0] - wanted[1]), abs(got[1] - wanted[0])) <= PWM_WITHIN
    kind = cable_faults.WheelsSwapped if swapped else cable_faults.WrongDrive
    return kind(motion, wanted, got)


def stand_until_told(part: str) -> Demand[ExperimentView]:
    """At the mark `part`, before the first command, the motors stood still."""

    def demand(experiment: ExperimentView) -> None:
        got = _pwm_at(experiment, part)
        if not _alike(got, (0, 0)):
            raise cable_faults.MovesUntold(got)

    return demand


def stop_by_itself(after: str) -> Demand[ExperimentView]:
    """After the mark `after`, when nobody commands any more, it sends a stop of its own."""

    def demand(experiment: ExperimentView) -> None:
        if not any(_pwm_at(experiment, after)):
            raise BoardUnused("motors")
        begun_s = _mark(experiment, after).board_s
        stop_s = _first_stop_s(experiment, begun_s)
        if stop_s is not None and stop_s - begun_s <= STOPS_WITHIN_S:
            _require_real_time(experiment, begun_s, stop_s)
        else:
            require_steady(experiment.seen.stall_s)
            waited_s = experiment.seen.part(SerialSeen).limits.stands_within_s
            late_s = (stop_s - begun_s if stop_s else waited_s) - STOPS_WITHIN_S
            require_its_time(experiment.seen, None, late_s, Awaited("stop"))
            raise cable_faults.DoesNotStop(STOPS_WITHIN_S, stop_s and stop_s - begun_s)

    return demand


def _first_stop_s(experiment: ExperimentView, after_s: float) -> float | None:
    """When the node sent the stop that ended the motion of this moment, by the board's clock.

    It may have reached the board in that very moment, just before the motors heard of it.
    """
    commands = _commands(experiment)
    ran = (n for n, (at, each) in enumerate(commands) if at <= after_s and _runs(each))
    later = commands[max(ran, default=-1) + 1 :]
    return next((at for at, each in later if not _runs(each)), None)


def _require_real_time(experiment: ExperimentView, from_s: float, to_s: float) -> None:
    """A stop in time by the board's clock was so by the node's, too. Raises Inconclusive.

    Where this computer has no time for the board, its clock runs slower than the node's.
    """
    took_s = _real_s(experiment, to_s) - _real_s(experiment, from_s)
    if took_s > STOPS_WITHIN_S:
        raise SlowBoard(took_s)


def _real_s(experiment: ExperimentView, board_s: float) -> float:
    """When it was, in seconds of the observer, that the board's clock showed this.

    Between two marks in proportion; before the first and after the last as if the clock ran true.
    """
    marks = sorted(_board(experiment).marks, key=lambda mark: mark.board_s)
    before = [mark for mark in marks if mark.board_s <= board_s] or marks[:1]
    after = [mark for mark in marks if mark.board_s > board_s] or marks[-1:]
    begin, end = before[-1], after[0]
    passed_s, way_s = (end.arrival_ns - begin.arrival_ns) / NS_PER_S, end.board_s - begin.board_s
    speed = passed_s / way_s if way_s > 0 else 1.0
    return begin.arrival_ns / NS_PER_S + (board_s - begin.board_s) * speed


def send_good_lines(experiment: ExperimentView) -> None:
    """The board refused nothing that the node sent over a good cable."""
    board = _board(experiment)
    if not board.heard:
        raise BoardUnused("unheard")
    for line in board.heard:
        if _command(line) is None:
            raise cable_faults.RejectedLine(line.text, _why_rejected(line.text))


def keep_still(part: str) -> Demand[ExperimentView]:
    """From the mark `part` until that of its end, the motors did not run."""

    def demand(experiment: ExperimentView) -> None:
        begin_s, end_s = (_mark(experiment, each).board_s for each in (part, f"{part}, over"))
        for motors in _board(experiment).motors:
            runs = motors.left_pwm or motors.right_pwm
            if runs and begin_s < motors.board_s < end_s:
                raise cable_faults.FollowedNonsense((motors.left_pwm, motors.right_pwm))

    return demand


def drive_again(part: str, after: str) -> Demand[ExperimentView]:
    """After the end of the part `after`, the motors ran: in the part `part`, it was told to."""

    def demand(experiment: ExperimentView) -> None:
        _mark(experiment, part)
        begin_s = _mark(experiment, f"{after}, over").board_s
        later = [each for each in _board(experiment).motors if each.board_s >= begin_s]
        if not any(each.left_pwm or each.right_pwm for each in later):
            _require_its_command(experiment, part, _runs)
            raise cable_faults.DeafAfterNonsense((0, 0))

    return demand


def come_so_far(part: str) -> Demand[ExperimentView]:
    """The experiment has the mark `part`; else what happened before it is told elsewhere."""

    def demand(experiment: ExperimentView) -> None:
        _mark(experiment, part)

    return demand


# --- how the node is started -------------------------------------------------------------------


def open_its_port(name: str, topic: TopicContract) -> Demand[ExperimentView]:
    """The node has opened the port that its parameter `name` gives it."""

    def demand(experiment: ExperimentView) -> None:
        board = _board(experiment)
        told = any(seen.messages for seen in _heard_on(experiment, topic))
        if not (board.heard or told or board.host_bits_s):
            require_steady(experiment.seen.stall_s)
            raise cable_faults.PortNotOpened(name)

    return demand


def _heard_on(experiment: ExperimentView, topic: TopicContract) -> Iterable[TopicSeen]:
    return (seen for seen in experiment.seen.topics.values() if seen.type == topic.type)


def set_its_speed(name: str, bits_s: int) -> Demand[ExperimentView]:
    """The node has set the port to the speed that its parameter `name` gives, or to its default."""

    def demand(experiment: ExperimentView) -> None:
        found = _board(experiment).host_bits_s
        if found != bits_s:
            raise cable_faults.WrongSpeedOfPort(name, bits_s, found)

    return demand


def reckon_by_its_settings(
    experiment: ExperimentView, before: str, after: str, settings: Mapping[str, object]
) -> Demand[TopicView]:
    """As `know_the_way`, of a node that was started with these settings."""
    know = know_the_way(experiment, before, after)

    def demand(topic: TopicView) -> None:
        try:
            know(topic)
        except cable_faults.WrongOdometry as fault:
            words = " ".join(f"-p {name}:={value}" for name, value in settings.items())
            raise cable_faults.OtherOdometry(fault.part, fault.really, fault.told, words) from fault

    return demand


# --- reading the evidence ----------------------------------------------------------------------


def _board(experiment: ExperimentView) -> BoardSeen:
    board = experiment.seen.part(SerialSeen).board
    if board is None:
        raise BoardUnused("no_board")
    return board


def _mark(experiment: ExperimentView, part: str) -> BoardMark:
    for mark in _board(experiment).marks:
        if mark.part == part:
            return mark
    require_steady(experiment.seen.stall_s)
    raise BoardUnused("not_so_far")


def _commands(experiment: ExperimentView) -> list[tuple[float, DriveCommand]]:
    lines = _board(experiment).heard
    found = ((line.board_s, _command(line)) for line in lines)
    return [(at, drive) for at, drive in found if drive]


def _command(line: CableLine) -> DriveCommand | None:
    try:
        return DriveCommand.read(unframed(line.text.lstrip("$").encode("latin-1")))
    except BadLine:
        return None


def _why_rejected(text: str) -> cable_faults.Rejection:
    if not text.startswith("$"):
        return cable_faults.Rejection("no_beginning")
    if "$" in text.lstrip("$"):
        return cable_faults.Rejection("no_end")
    line = text[1:].encode("latin-1")
    try:
        DriveCommand.read(unframed(line))
    except BadLine as error:
        return cable_faults.Rejection(error.kind, f"{checksum(line.partition(b'*')[0]):04X}")
    return cable_faults.Rejection("two_beginnings")


def _runs(drive: DriveCommand) -> bool:
    return bool(drive.left_pwm or drive.right_pwm)


def _told(board: BoardSeen) -> set[tuple[int, int]]:
    """The pairs of wheel speeds that the board told, in mrad/s."""
    found = map(_speeds_of, _speed_lines(board))
    return {(each.left_mrad_s, each.right_mrad_s) for each in found}


def _speed_lines(board: BoardSeen) -> list[CableLine]:
    """What the board told of its wheels' speeds."""
    return [line for line in board.told if line.text.startswith("$W,")]


def _speeds_of(line: CableLine) -> Speeds:
    return Speeds.read(unframed(line.text[1:].encode("latin-1")))


def _is_among(left: float, right: float, told: set[tuple[int, int]]) -> bool:
    if not (math.isfinite(left) and math.isfinite(right)):
        return False
    if (round(1000 * left), round(1000 * right)) in told:
        return True
    off = SPEED_EXACT_RAD_S * 1000
    return any(abs(le - 1000 * left) <= off and abs(ri - 1000 * right) <= off for le, ri in told)


def _speed_fault(left: float, right: float, told: set[tuple[int, int]]) -> cable_faults.WrongSpeeds:
    if _is_among(right, left, told):
        return cable_faults.SpeedsSwapped(left, right)
    if _is_among(left / 1000, right / 1000, told):
        return cable_faults.SpeedsInMilliradians(left, right)
    return cable_faults.WrongSpeeds(left, right)


def _velocities(topic: TopicView) -> list[tuple[float, float]]:
    pairs = [content.get("velocity") or [] for content in _contents(topic)]
    if any(len(pair) != 2 for pair in pairs):
        raise WrongField(topic.name, "velocity", cable_faults.TwoNumbers(), f"{pairs[0]}")
    return [(_number(left), _number(right)) for left, right in pairs]


def _contents(topic: TopicView) -> list[dict[str, Any]]:
    found = [m.content for m in topic.messages if isinstance(m.content, dict)]
    if not found:
        raise NoMessages(topic.name, len(topic.messages), topic.experiment.watching_s)
    return found


def _field(message: Any, path: str) -> Any:
    for name in path.split("."):
        message = message.get(name) if isinstance(message, dict) else None
    return message


def _written(value: Any) -> str:
    return ", ".join(map(str, value)) if isinstance(value, list) else str(value)


def _number(value: Any) -> float:
    """Evidence that was saved holds NaN and Infinity as texts."""
    return float(value)


def _lines_before_and_between(
    experiment: ExperimentView, messages: Iterable[MessageSeen]
) -> tuple[int, int]:
    """How many lines of speeds the board told before the first of these messages, and until now."""
    arrivals = [m.arrival_ns for m in messages]
    begin, end = min(arrivals), max(arrivals)
    told = [line.sent_ns for line in _speed_lines(_board(experiment))]
    return sum(at < begin for at in told), sum(begin <= at <= end for at in told)


def _published(messages: Sequence[MessageSeen]) -> int:
    """How many messages left the node, by the middleware's own count; some may not have arrived."""
    first, last = messages[0].sequence, messages[-1].sequence
    return len(messages) if first is None or last is None else last - first + 1


def _went_on(experiment: ExperimentView, topic: TopicView, part: str) -> bool:
    marks = [m for m in _board(experiment).marks if m.part == part]
    return bool(marks) and any(m.arrival_ns > marks[0].arrival_ns for m in topic.messages)
