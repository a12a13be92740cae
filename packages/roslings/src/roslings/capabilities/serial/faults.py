"""Faults of a node that stands between ROS and a board on a serial cable."""

from __future__ import annotations

import math
from dataclasses import dataclass

from roslings.judge.faults.base import Fault


@dataclass(eq=False)
class LinesAndMessagesDiffer(Fault):
    """Lines of the board have no message, or some have two."""

    topic: str
    lines: int
    messages: int
    why = "A robot that misses lines of its wheels does not know how far it went."
    expected = "one message on {topic} for each line of the board ({lines} lines)"
    measured = "{messages} messages"

    hint = "Count both: how many lines come, and how often do you publish?"

    @property
    def mend(self) -> str:
        """Too few, or too many."""
        if self.messages < self.lines:
            return (
                "Read all bytes that wait, and handle every whole line in them, not only one."
                " A line may come in two pieces: keep the first piece."
            )
        return "Publish once for each line that begins with W, and for no other line."


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

    what: str
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

    part: str
    really: tuple[float, float, float]
    told: tuple[float, float, float]
    why = "Odometry is how the robot knows where it is between two looks at the world."

    hint = (
        "Let it drive one simple way, and reckon by hand: how far, and how much of a turn? "
        "Then compare."
    )

    @property
    def expected(self) -> str:
        """The true way."""
        return f"on the {self.part}, the rover went {_way(self.really)}"

    @property
    def measured(self) -> str:
        """The way that was told."""
        return f"/odom says {_way(self.told)}"

    @property
    def mend(self) -> str:
        """The likeliest cause."""
        turn, length_m = self.really[2], math.hypot(*self.really[:2])
        told_x, told_y, told_turn = self.told
        if abs(told_turn + turn) < 0.2 * abs(turn):
            return "It turns the wrong way. Turn = (right - left) x radius / separation."
        if abs(told_turn - turn) > 0.05 * abs(turn) + 3:
            return "Turn = (right - left) x radius / separation, times the seconds since before."
        if abs(math.hypot(told_x, told_y) - length_m) < 0.2 * length_m:
            return (
                "The length of the way is right, its direction is not. Add forward x seconds x"
                " cos(heading) to x, and forward x seconds x sin(heading) to y."
            )
        if abs(told_x) + abs(told_y) < 0.02:
            return "It stays at its start. Add forward x seconds x cos(heading) to x, sin to y."
        return (
            "Forward = (left + right) / 2 x radius. Times the seconds from one line to the next,"
            " by the board's clock (MS), in the direction of the heading."
        )


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

    @property
    def expected(self) -> str:
        """The motion of the wheels."""
        return f"on the arc, the twist of {self.topic} says {_motion(self.really)}"

    @property
    def measured(self) -> str:
        """What it says."""
        return f"it says {_motion(self.told)}"


def _motion(motion: tuple[float, float]) -> str:
    forward, turn = (round(part, 2) + 0.0 for part in motion)
    return f"{forward:.2f} m/s forward, {turn:.2f} rad/s"


def _way(way: tuple[float, float, float]) -> str:
    ahead, left, turn = (round(part, 2) + 0.0 for part in way)
    side, way_round = ("right" if part < 0 else "left" for part in (left, turn))
    along = f"{abs(ahead):.2f} m {'back' if ahead < 0 else 'ahead'}, {abs(left):.2f} m {side}"
    turned = f"turned {abs(turn):.0f} degrees {way_round}" if abs(turn) >= 1 else "not turned"
    return f"{along}, {turned}"


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

    @property
    def expected(self) -> str:
        """The PWM of this motion."""
        forward, turn = self.motion
        return (
            f"for {forward:g} m/s and {turn:g} rad/s, PWM left {self.wanted[0]}"
            f" and right {self.wanted[1]}"
        )

    @property
    def measured(self) -> str:
        """What reached the motors."""
        return f"the motors had PWM left {self.got[0]} and right {self.got[1]}"


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

    @property
    def measured(self) -> str:
        """What reached the motors."""
        return f"nobody had said anything, and the motors had PWM {self.got[0]} and {self.got[1]}"


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

    @property
    def measured(self) -> str:
        """What reached the motors, and what that means."""
        return (
            f"PWM left {self.got[0]} and right {self.got[1]}: right for the default of"
            f" {self.name!r}, and the node was started with another value"
        )


@dataclass(eq=False)
class TooFast(WrongDrive):
    """A command beyond what the wheels can do."""

    sent: str
    why = "A PWM beyond 255 is no command: the board refuses it, and the robot stops on its way."
    hint = "What does your code do where a wheel would need more than 255?"
    mend = "Where a wheel would need more than 255, make both PWM smaller by the same factor."

    @property
    def measured(self) -> str:
        """What reached the motors, and the line that was sent."""
        sent = f"; the last line was {self.sent[:40]!r}" if self.sent else ""
        return f"the motors had PWM left {self.got[0]} and right {self.got[1]}{sent}"


@dataclass(eq=False)
class OtherOdometry(WrongOdometry):
    """The odometry does not reckon with the parameters."""

    settings: str
    hint = "With which numbers does your odometry reckon?"
    mend = "The odometry needs the values of the parameters, too: not the numbers of the card."

    @property
    def expected(self) -> str:
        """The true way, of a rover with these measures."""
        return f"started with {self.settings}: {super().expected}"


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

    @property
    def measured(self) -> str:
        """Its own."""
        return f"it has {self.found or 'no speed that anybody has set'}"


@dataclass(eq=False)
class DoesNotStop(Fault):
    """It goes on with an old command."""

    within_s: float
    after_s: float | None
    why = "When the program that steers has crashed, the robot must not drive on."
    hint = "What does your node send when no command comes any more?"
    mend = (
        "Remember when the last command came. In the timer that sends to the board, send zero"
        " once that is more than half a second ago."
    )
    expected = "M,SEQ,0,0 within {within_s:g} s of the last command on /cmd_vel"

    @property
    def measured(self) -> str:
        """When it came."""
        if self.after_s is None:
            return "no such line was sent"
        return f"it was sent after {self.after_s:.1f} s"


@dataclass(eq=False)
class RejectedLine(Fault):
    """The board refused a line."""

    line: str
    reason: str
    why = "The board obeys only what it can trust: a whole line with the right checksum."
    hint = "Compare your line with the expected one, sign by sign."
    mend = (
        "$BODY*CRC and a new line. CRC is binascii.crc_hqx(BODY, 0) as four capital"
        " hexadecimal digits: '%04X'. PWM is a whole number from -255 to 255."
    )
    expected = "every line to the board is one that it can use, like $M,1,100,-100*7AC2"

    @property
    def measured(self) -> str:
        """The first that is not."""
        return f"{self.line[:40]!r}: {self.reason}"


@dataclass(eq=False)
class FollowedNonsense(Fault):
    """A command that is no number moved the motors."""

    got: tuple[int, int]
    why = "Software has faults: a program divides by zero, and sends its result to your robot."
    hint = "What does your code do with a number that is no number (nan)?"
    mend = "Look at each number with math.isfinite() before you use it."
    expected = "after a command with NaN the motors stand, and the node goes on"

    @property
    def measured(self) -> str:
        """What happened."""
        return f"the motors had PWM left {self.got[0]} and right {self.got[1]}"


@dataclass(eq=False)
class DeafAfterNonsense(FollowedNonsense):
    """It lives, and follows no command any more."""

    why = "One wrong message must not end the work of the day."
    hint = "What of the bad command does your code remember?"
    mend = "Leave the command aside, and nothing else: keep no NaN in what you remember."
    expected = "after commands with NaN and infinity, the node follows the next good one"
    measured = "the motors stood"
