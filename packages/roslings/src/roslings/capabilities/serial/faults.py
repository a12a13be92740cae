"""Faults of a node that stands between ROS and a board on a serial cable."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

from roslings.judge.faults.base import Fault
from roslings.judge.faults.sentences import SentencePart, Text, one_of, plural
from roslings_rover.models.board_lines import Badness

LINE_CHARACTERS = 40
"""So much of a line is shown."""


def without_minus(number: float) -> float:
    """With the digits that are shown; what is shown as 0 has no sign."""
    return round(number, 2) + 0.0


# --- parts of sentences ------------------------------------------------------------------------


@dataclass(frozen=True)
class Way(SentencePart):
    """A way on the floor, seen from where it began."""

    ahead_m: float
    left_m: float
    turn_deg: float
    text = one_of(
        ahead_left_left="{ahead:.2f} m ahead, {aside:.2f} m left, turned {turn:.0f} degrees left",
        ahead_left_right="{ahead:.2f} m ahead, {aside:.2f} m left, turned {turn:.0f} degrees right",
        ahead_left_none="{ahead:.2f} m ahead, {aside:.2f} m left, not turned",
        ahead_right_left="{ahead:.2f} m ahead, {aside:.2f} m right, turned {turn:.0f} degrees left",
        ahead_right_right="{ahead:.2f} m ahead, {aside:.2f} m right, turned {turn:.0f} degrees"
        " right",
        ahead_right_none="{ahead:.2f} m ahead, {aside:.2f} m right, not turned",
        back_left_left="{ahead:.2f} m back, {aside:.2f} m left, turned {turn:.0f} degrees left",
        back_left_right="{ahead:.2f} m back, {aside:.2f} m left, turned {turn:.0f} degrees right",
        back_left_none="{ahead:.2f} m back, {aside:.2f} m left, not turned",
        back_right_left="{ahead:.2f} m back, {aside:.2f} m right, turned {turn:.0f} degrees left",
        back_right_right="{ahead:.2f} m back, {aside:.2f} m right, turned {turn:.0f} degrees right",
        back_right_none="{ahead:.2f} m back, {aside:.2f} m right, not turned",
    )

    @property
    def which_text(self) -> str:
        """The directions, after rounding."""
        ahead = "back" if without_minus(self.ahead_m) < 0 else "ahead"
        side = "right" if without_minus(self.left_m) < 0 else "left"
        turn = without_minus(self.turn_deg)
        turned = "none" if abs(turn) < 1 else "right" if turn < 0 else "left"
        return f"{ahead}_{side}_{turned}"

    @property
    def ahead(self) -> float:
        """In metres, without its direction."""
        return abs(without_minus(self.ahead_m))

    @property
    def aside(self) -> float:
        """In metres, without its direction."""
        return abs(without_minus(self.left_m))

    @property
    def turn(self) -> float:
        """In degrees, without its direction."""
        return abs(without_minus(self.turn_deg))


@dataclass(frozen=True)
class Trouble(SentencePart):
    """What a node has to outlast."""

    kind: Literal["noise", "silence"]
    seconds: float = 0.0
    text = one_of(noise="the noise on the cable", silence="{seconds:g} s of silence")

    @property
    def which_text(self) -> str:
        """Which one it was."""
        return self.kind


@dataclass(frozen=True)
class TwoNumbers(SentencePart):
    """What a velocity holds."""

    text = "two numbers"


@dataclass(frozen=True)
class Rejection(SentencePart):
    """Why the board cannot use a line."""

    kind: Badness | Literal["no_beginning", "no_end", "two_beginnings"]
    checksum: str = ""
    """The right one."""
    text = one_of(
        no_beginning="it does not begin with $",
        no_end="no new line (\\n) ends the first command",
        two_beginnings="it begins twice",
        no_line="this is no line",
        checksum="the checksum should be {checksum}",
        no_command="this is no command",
        too_large="a number is too large",
        no_speeds="these are no speeds",
    )

    @property
    def which_text(self) -> str:
        """What is wrong with it."""
        return self.kind


# --- the faults --------------------------------------------------------------------------------


@dataclass(eq=False)
class LinesAndMessagesDiffer(Fault):
    """Lines of the board have no message, or some have two."""

    topic: str
    lines: int
    messages: int
    why = "A robot that misses lines of its wheels does not know how far it went."
    expected = plural(
        "lines",
        one="one message on {topic} for each line of the board ({lines} line)",
        other="one message on {topic} for each line of the board ({lines} lines)",
    )
    measured = plural("messages", one="{messages} message", other="{messages} messages")

    hint = "Count both: how many lines come, and how often do you publish?"

    mend = one_of(
        few="Read all bytes that wait, and handle every whole line in them, not only one."
        " A line may come in two pieces: keep the first piece.",
        many="Publish once for each line that begins with W, and for no other line.",
    )

    @property
    def which_mend(self) -> str:
        """Too few, or too many."""
        return "few" if self.messages < self.lines else "many"


@dataclass(eq=False)
class WrongSpeeds(Fault):
    """The board never told these wheel speeds."""

    left: float
    right: float
    why = "Everything that the robot knows of its own way comes from these two numbers."
    hint = "Which parts of the line are the speeds, and in which unit are they?"
    mend = (
        "In W,SEQ,MS,LEFT,RIGHT the speeds are the last two numbers, in mrad/s."
        " Divide both by 1000."
    )
    expected = "velocity: [left, right] in rad/s, as the board told them"
    measured = "[{left:.3f}, {right:.3f}], and the board never told that"


@dataclass(eq=False)
class SpeedsSwapped(WrongSpeeds):
    """Left and right are the wrong way round."""

    hint = "Which wheel comes first in the board's line, and which in your message?"
    mend = "The board tells the left wheel first. Your velocity has the right wheel first."
    measured = "[{left:.3f}, {right:.3f}]: left and right are exchanged"


@dataclass(eq=False)
class SpeedsInMilliradians(WrongSpeeds):
    """Not divided by 1000."""

    hint = "In which unit does the board tell its speeds, and which one does ROS want?"
    mend = "The board tells mrad/s; ROS wants rad/s (REP 103). Divide by 1000."
    measured = "[{left:.3f}, {right:.3f}]: these are mrad/s"


@dataclass(eq=False)
class BadLineUsed(Fault):
    """A spoilt line became a message."""

    left: float
    right: float
    why = "Cables pick up noise. One wrong number sends the robot, on its map, through a wall."
    hint = "What does your code look at before it uses a line?"
    mend = (
        "Compute the checksum of what stands between $ and *, and compare it with the four"
        " digits after *. Use the line only when both are equal."
    )
    expected = "on a noisy cable, only lines with the right checksum are used"
    measured = "wheel speeds [{left:.3f}, {right:.3f}] that the board never told"


@dataclass(eq=False)
class SilentAfter(Fault):
    """It lives, and nothing comes any more."""

    what: Text
    topic: str
    why = "Plugs come loose on a robot that drives. Nobody is there to start the node again."
    hint = "What does your node do after a read or a write had an error?"
    mend = (
        "When a read or a write raises an error, close the port, and try from a timer to open"
        " it again. Keep no half line from before."
    )
    expected = "after {what}, messages come on {topic}"
    measured = "none came"


@dataclass(eq=False)
class GaveUpInSilence(SilentAfter):
    """The board was silent for long, and the node stopped to listen."""

    why = "A board that starts anew, or works for long, says nothing. Its next line counts again."
    hint = "What does your code do when a read gives nothing?"
    mend = "An empty read is no error: go on reading. Close the port only when read() raises one."


@dataclass(eq=False)
class WrongOdometry(Fault):
    """The odometry and the rover went different ways."""

    part: Text
    really: tuple[float, float, float]
    told: tuple[float, float, float]
    why = "Odometry is how the robot knows where it is between two looks at the world."

    hint = (
        "Let it drive one simple way, and reckon by hand: how far, and how much of a turn? "
        "Then compare."
    )

    expected = "on the {part}, the rover went {way_really}"
    measured = "/odom says {way_told}"
    mend = one_of(
        wrong_way="It turns the wrong way. Turn = (right - left) x radius / separation.",
        turn="Turn = (right - left) x radius / separation, times the seconds since before.",
        direction="The length of the way is right, its direction is not. Add forward x seconds x"
        " cos(heading) to x, and forward x seconds x sin(heading) to y.",
        stays="It stays at its start. Add forward x seconds x cos(heading) to x, sin to y.",
        forward="Forward = (left + right) / 2 x radius. Times the seconds from one line to the"
        " next,"
        " by the board's clock (MS), in the direction of the heading.",
    )

    @property
    def which_mend(self) -> str:
        """The likeliest cause."""
        turn, length_m = self.really[2], math.hypot(*self.really[:2])
        told_x, told_y, told_turn = self.told
        if abs(told_turn + turn) < 0.2 * abs(turn):
            return "wrong_way"
        if abs(told_turn - turn) > 0.05 * abs(turn) + 3:
            return "turn"
        if abs(math.hypot(told_x, told_y) - length_m) < 0.2 * length_m:
            return "direction"
        return "stays" if abs(told_x) + abs(told_y) < 0.02 else "forward"

    @property
    def way_really(self) -> Way:
        """The true way."""
        return Way(*self.really)

    @property
    def way_told(self) -> Way:
        """The way that was told."""
        return Way(*self.told)


@dataclass(eq=False)
class WrongTwist(Fault):
    """The odometry says another speed than the wheels have."""

    topic: str
    really: tuple[float, float]
    """Forward, in m/s, and turn, in rad/s."""
    told: tuple[float, float]
    why = "Who plans the way needs both: where the robot is, and how fast it moves there."
    hint = "What goes into twist.twist.linear.x, and what into angular.z? Reckon one case by hand."
    mend = (
        "Forward = (left + right) / 2 x radius goes into twist.twist.linear.x, and"
        " turn = (right - left) x radius / separation into twist.twist.angular.z."
    )

    expected = (
        "on the arc, the twist of {topic} says {really_m_s:.2f} m/s forward,"
        " {really_rad_s:.2f} rad/s"
    )
    measured = "it says {told_m_s:.2f} m/s forward, {told_rad_s:.2f} rad/s"

    @property
    def really_m_s(self) -> float:
        """Of the wheels: forward."""
        return without_minus(self.really[0])

    @property
    def really_rad_s(self) -> float:
        """Of the wheels: the turn."""
        return without_minus(self.really[1])

    @property
    def told_m_s(self) -> float:
        """What the node says: forward."""
        return without_minus(self.told[0])

    @property
    def told_rad_s(self) -> float:
        """What the node says: the turn."""
        return without_minus(self.told[1])


@dataclass(eq=False)
class WrongDrive(Fault):
    """The motors get something else than the command asks for."""

    motion: tuple[float, float]
    wanted: tuple[int, int]
    got: tuple[int, int]
    why = "The robot must do what it is told: this fast, and this way round."
    hint = "Take one command, and reckon both wheels by hand. Then compare with what you send."
    mend = (
        "Left wheel = (forward - turn x separation / 2) / radius; the right wheel has + in place"
        " of -. PWM = wheel speed / max_wheel_speed x 255, rounded."
    )

    expected = (
        "for {motion[0]:g} m/s and {motion[1]:g} rad/s, PWM left {wanted[0]} and right {wanted[1]}"
    )
    measured = "the motors had PWM left {got[0]} and right {got[1]}"


@dataclass(eq=False)
class DoesNotDrive(WrongDrive):
    """The motors stand."""

    hint = "Which line does your node send to the board, and how often?"
    mend = (
        "Send $M,SEQ,LEFT,RIGHT*CRC and a new line. Repeat it faster than twice a second:"
        " without a command the board stops its motors after half a second."
    )


@dataclass(eq=False)
class WheelsSwapped(WrongDrive):
    """Left and right are the wrong way round."""

    hint = "To which side does a positive angular.z turn, and which wheel is then the faster one?"
    mend = "A positive angular.z turns left: the right wheel is then the faster one."


@dataclass(eq=False)
class MovesUntold(Fault):
    """The motors run, and nobody has said anything yet."""

    got: tuple[int, int]
    expected = "before the first command, the motors stand still"
    why = "A robot that drives off when it is switched on runs over what lies before it."
    hint = "What does your node publish before the first message has come?"
    mend = "Until the first message comes, the motion is zero: 0.0 forward and 0.0 turn."

    measured = "nobody had said anything, and the motors had PWM {got[0]} and {got[1]}"


@dataclass(eq=False)
class SettingIgnored(WrongDrive):
    """The node has the parameter, and drives as if nobody had set it."""

    name: str
    why = "The next robot has other wheels: who uses your node changes a parameter, not your code."
    hint = "Follow the parameter: where is it read, and what is reckoned with its value?"
    mend = (
        "Read the parameter with self.get_parameter(NAME).value, and reckon with that value."
        " Does main() say rclpy.init(args=args)?"
    )

    measured = (
        "PWM left {got[0]} and right {got[1]}: right for the default of"
        " {name!r}, and the node was started with another value"
    )


@dataclass(eq=False)
class TooFast(WrongDrive):
    """A command beyond what the wheels can do."""

    KNOWN_AS = "TooFastForTheWheels"

    sent: str
    why = "A PWM beyond 255 is no command: the board refuses it, and the robot stops on its way."
    hint = "What does your code do where a wheel would need more than 255?"
    mend = "Where a wheel would need more than 255, make both PWM smaller by the same factor."

    measured = one_of(
        sent="the motors had PWM left {got[0]} and right {got[1]}; the last line was {line!r}",
        silent="the motors had PWM left {got[0]} and right {got[1]}",
    )

    @property
    def which_measured(self) -> str:
        """Whether any line was sent."""
        return "sent" if self.sent else "silent"

    @property
    def line(self) -> str:
        """The beginning of the line that was sent."""
        return self.sent[:LINE_CHARACTERS]


@dataclass(eq=False)
class OtherOdometry(WrongOdometry):
    """The odometry does not reckon with the parameters."""

    settings: str
    hint = "With which numbers does your odometry reckon?"
    mend = "The odometry needs the values of the parameters, too: not the numbers of the card."

    expected = "started with {settings}: on the {part}, the rover went {way_really}"


@dataclass(eq=False)
class PortNotOpened(Fault):
    """Nobody has opened the port that the parameter names."""

    name: str
    why = "The board has another name on each computer: /dev/ttyACM0 here, /dev/ttyUSB0 there."
    expected = "started with `-p {name}:=PORT`, the node opens this port"
    measured = "nobody opened it, and no message came from it"
    hint = "Which port does your code open? Follow the parameter {name}."
    mend = (
        "Give self.get_parameter({name!r}).value to serial.Serial(). Does main() say"
        " rclpy.init(args=args)?"
    )


@dataclass(eq=False)
class WrongSpeedOfPort(Fault):
    """The port has another speed than the board."""

    name: str
    wanted: int
    found: int | None
    why = "Nothing on a cable tells its speed: where the two ends differ, each reads nonsense."
    expected = "with {name} {wanted}, the port is opened with {wanted} bits a second"
    hint = "Which baud rate does serial.Serial() get?"
    mend = "Give self.get_parameter({name!r}).value to serial.Serial() as the baud rate."

    measured = one_of(another="it has {found}", none="it has no speed that anybody has set")

    @property
    def which_measured(self) -> str:
        """Its own."""
        return "another" if self.found else "none"


@dataclass(eq=False)
class DoesNotStop(Fault):
    """It goes on with an old command."""

    KNOWN_AS = "DoesNotStopWithoutCommands"

    within_s: float
    after_s: float | None
    why = "When the program that steers has crashed, the robot must not drive on."
    hint = "What does your node send when no command comes any more?"
    mend = (
        "Remember when the last command came. In the timer that sends to the board, send zero"
        " once that is more than half a second ago."
    )
    expected = "M,SEQ,0,0 within {within_s:g} s of the last command on /cmd_vel"

    measured = one_of(late="it was sent after {after_s:.1f} s", never="no such line was sent")

    @property
    def which_measured(self) -> str:
        """When it came."""
        return "never" if self.after_s is None else "late"


@dataclass(eq=False)
class RejectedLine(Fault):
    """The board refused a line."""

    line: str
    reason: Rejection
    why = "The board obeys only what it can trust: a whole line with the right checksum."
    hint = "Compare your line with the expected one, sign by sign."
    mend = (
        "$BODY*CRC and a new line. CRC is binascii.crc_hqx(BODY, 0) as four capital"
        " hexadecimal digits: '%04X'. PWM is a whole number from -255 to 255."
    )
    expected = "every line to the board is one that it can use, like $M,1,100,-100*7AC2"

    measured = "{beginning!r}: {reason}"

    @property
    def beginning(self) -> str:
        """Of the first that is not."""
        return self.line[:LINE_CHARACTERS]


@dataclass(eq=False)
class FollowedNonsense(Fault):
    """A command that is no number moved the motors."""

    got: tuple[int, int]
    why = "Software has faults: a program divides by zero, and sends its result to your robot."
    hint = "What does your code do with a number that is no number (nan)?"
    mend = "Look at each number with math.isfinite() before you use it."
    expected = "after a command with NaN the motors stand, and the node goes on"

    measured = "the motors had PWM left {got[0]} and right {got[1]}"


@dataclass(eq=False)
class DeafAfterNonsense(FollowedNonsense):
    """It lives, and follows no command any more."""

    why = "One wrong message must not end the work of the day."
    hint = "What of the bad command does your code remember?"
    mend = "Leave the command aside, and nothing else: keep no NaN in what you remember."
    expected = "after commands with NaN and infinity, the node follows the next good one"
    measured = "the motors stood"
