"""What can be wrong with a server of goals, and with the robot that it drives to them."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from roslings.capabilities.actions.faults import CancelRefused, RefusesGoodGoal
from roslings.capabilities.topics.faults.rhythm import WrongRate
from roslings.judge.faults.base import Fault
from roslings.judge.faults.sentences import SentencePart, Text, one_of

NEARER_M = 0.05
"""A rover that never came nearer by more than this drives away, or in circles."""


@dataclass(frozen=True)
class Moment(SentencePart):
    """When it is, on the way of a goal."""

    at: Literal["there", "end", "cancelled", "refused"]
    text = one_of(
        there="when the rover is there",
        end="at the end",
        cancelled="after a cancel",
        refused="after goals that were refused",
    )

    @property
    def which_text(self) -> str:
        """Which one it is."""
        return self.at


@dataclass(frozen=True)
class About(SentencePart):
    """A time that is not asked to the last digit."""

    seconds: float
    text = "about {seconds:.1f} s"


# --- a goal is answered ------------------------------------------------------------------------


@dataclass(eq=False)
class StaysBusy(RefusesGoodGoal):
    """After one goal the server takes no other."""

    why = "A server that works only once must be started again after each goal."
    hint = (
        "What makes your server refuse a goal while it drives? It must be set back on each way out"
        " of the execute callback: after success, and after a cancel."
    )
    measured = "it was refused, though nothing was under way any more"


# --- on the way --------------------------------------------------------------------------------


@dataclass(eq=False)
class BlocksTheNode(Fault):
    """While a goal is executed, no other callback of the node runs."""

    waited_s: float
    why = (
        "A node with one thread does one thing at a time. While the execute callback loops, it"
        " hears nothing: not where the rover is, and no request to cancel."
    )
    hint = (
        "While the execute callback waits, who runs the other callbacks of the node? Look at the"
        " line of its loop that waits."
    )
    mend = (
        "Write `async def` before the execute callback, and `await self.tick` in place of"
        " time.sleep(): then the thread is free meanwhile. A loop that sleeps needs a node with"
        " several threads: rclpy.spin(node, executor=MultiThreadedExecutor(num_threads=4))."
    )
    expected = "while a goal is under way, the node's other callbacks run"
    measured = (
        "while a goal was under way, none of them ran for {waited_s:.0f} s: the execute callback"
        " blocks the node"
    )


@dataclass(eq=False)
class WrongFeedbackRate(Fault):
    """Feedback comes too often, too seldom or in groups."""

    rhythm: WrongRate
    why = "Who waits for a robot wants to see that it gets on."
    expected = (
        "feedback at {rhythm.wanted_hz:g} Hz (within {rhythm.within:.0%}) while the goal is under"
        " way"
    )

    hint = "How long does one turn of the loop take? Look at what waits in it."

    measured = "{rhythm.measured}"
    mend = (
        "{rhythm.wanted_hz:g} Hz means one feedback every {rhythm.wanted_s:g} s. Publish it in"
        " each turn of the loop, and let a turn take so long: the period of the timer whose tick"
        " the loop awaits."
    )


@dataclass(eq=False)
class NeverRests(Fault):
    """The loop of the execute callback has no pause: it turns as fast as the processor can."""

    hz: float
    wanted_hz: float
    was_seen = True
    why = (
        "A loop without a pause takes a whole processor. The node's other callbacks hardly run:"
        " it drives by old places, and hears no request to cancel in time."
    )
    expected = "feedback at {wanted_hz:g} Hz: the loop waits in each turn"
    measured = "{hz:.0f} times a second: the loop never waits"

    hint = "What makes the loop of the execute callback wait, once in each turn?"

    mend = (
        "Is there an `await self.tick` in the execute callback, and inside of its loop? The timer"
        " makes a tick every {wanted_s:g} s. A loop on a thread of its own may sleep so long:"
        " time.sleep({wanted_s:g})."
    )

    @property
    def wanted_s(self) -> float:
        """The length of a turn."""
        return 1 / self.wanted_hz


@dataclass(eq=False)
class WrongFeedback(Fault):
    """The feedback says something else than what is."""

    field_name: str
    wanted: str
    found: str
    why = "Who gave the goal sees the robot only through the feedback."
    expected = "feedback.{field_name} tells the truth: {wanted}"
    measured = "it says {found}"

    hint = (
        "Look at `feedback.{field_name} = ...`. Does it get the right value, from the newest "
        "/odom message?"
    )

    mend = one_of(distance="It is math.hypot(goal.x - x, goal.y - y).")

    @property
    def which_mend(self) -> str:
        """Of other fields there is no more to say."""
        return "distance" if self.field_name == "distance" else ""


@dataclass(eq=False)
class FrozenFeedback(WrongFeedback):
    """The robot moves, and the feedback says always the same."""

    measured = "it says {found} all the time, while the rover moves"
    hint = (
        "Look at `feedback.{field_name} = ...`. Is it set anew in each turn of the loop, from the"
        " newest /odom message?"
    )


# --- the end of a goal -------------------------------------------------------------------------


@dataclass(eq=False)
class NeverArrives(Fault):
    """The robot does not get to the goal."""

    goal: str
    nearest_m: float
    began_m: float
    moved: bool
    why = "An action that never ends keeps everybody waiting who needs the robot there."
    expected = "the rover drives to {goal}, and the goal ends"

    measured = one_of(
        stood="the goal did not end, and the rover did not move",
        moved="the goal did not end: the rover was {began_m:.2f} m away at first, and never"
        " nearer than {nearest_m:.2f} m",
    )
    hint = one_of(
        stood="Does the loop publish a command on /cmd_vel in each turn? Look with"
        " `ros2 topic echo /cmd_vel` while a goal is under way.",
        away="It does not come nearer. Watch it on the map of `./roslings rover`: in which"
        " direction does it drive, and in which one is the goal?",
        near="Watch it on the map of `./roslings rover`. Does the loop use the newest place each"
        " time, and when does it end?",
    )
    mend = one_of(
        away="The direction to the goal is atan2(goal.y - y, goal.x - x), with x and y of the"
        " newest place.",
        near="The loop ends where the distance is within goal.tolerance.",
    )

    @property
    def which_measured(self) -> str:
        """How far it got."""
        return "moved" if self.moved else "stood"

    @property
    def which_hint(self) -> str:
        """Whether it moved, and came nearer."""
        if not self.moved:
            return "stood"
        return "away" if self.nearest_m > self.began_m - NEARER_M else "near"

    @property
    def which_mend(self) -> str:
        """The direction, or the end."""
        return self.which_hint if self.moved else ""


@dataclass(eq=False)
class EndsTooFar(Fault):
    """The goal ended while the robot was not there."""

    goal: str
    tolerance_m: float
    found_m: float
    why = "Who gave the goal believes that the rover is there, and goes on from there."
    hint = "When does your loop end? Compare its condition with what the goal asks for."
    mend = (
        "Compare the distance with goal_handle.request.tolerance, not with a number of your own,"
        " and end the loop only where it is smaller."
    )
    expected = "when the goal ends, the rover is within {tolerance_m:.2f} m of {goal}"
    measured = "it was {found_m:.2f} m away"


@dataclass(eq=False)
class KeepsDriving(Fault):
    """The goal has ended, and nobody told the robot to stop."""

    when: Text
    speed_m_s: float
    turn_rad_s: float
    why = (
        "A robot does what it was told last. Without a last command of zero it drives on, until it"
        " notices that nothing comes any more."
    )
    hint = "What is the last command on /cmd_vel? Look at each way out of the loop."
    mend = (
        "After the loop, on each way out of it, publish an empty Twist(): all its speeds are zero."
    )
    expected = "{when}, the last command is zero: stand still"

    measured = (
        "the last command was {forward_m_s:.2f} m/s forward and {around_rad_s:.2f} rad/s of turn"
    )

    @property
    def forward_m_s(self) -> float:
        """The last command: forward. What is shown as 0 has no sign."""
        return round(self.speed_m_s, 2) + 0.0

    @property
    def around_rad_s(self) -> float:
        """The last command: the turn."""
        return round(self.turn_rad_s, 2) + 0.0


@dataclass(eq=False)
class StopsLate(Fault):
    """The robot was told to stop, but too late."""

    KNOWN_AS = "StopsLateAfterCancel"

    limit_s: float
    found_s: float
    why = "Perhaps a child stands in the robot's way. Then each tenth of a second counts."
    hint = "How often does your loop look whether it is to stop?"
    mend = "Look at goal_handle.is_cancel_requested in each turn of the loop, and wait shortly."
    expected = "the rover is told to stand still within {limit_s:g} s of the cancel"
    measured = "that took {found_s:.2f} s"


# --- cancel ------------------------------------------------------------------------------------


@dataclass(eq=False)
class CancelUnanswered(CancelRefused):
    """The request to cancel was not answered."""

    waited_s: float
    hint = "Does your cancel callback return at once? It only says CancelResponse.ACCEPT."
    measured = "no answer came within {waited_s:.0f} s"


@dataclass(eq=False)
class GoesOnAfterCancel(Fault):
    """The cancel was accepted, and the goal went on."""

    waited_s: float
    why = "Accepting a cancel is a promise. The execute callback must keep it."
    hint = "ROS does not stop your loop. Where does the loop learn that somebody has cancelled?"
    mend = (
        "ROS does not stop your loop. In each turn, look at goal_handle.is_cancel_requested; where"
        " it is True, leave the loop and call goal_handle.canceled()."
    )
    expected = "after an accepted cancel, the goal ends"
    measured = "{waited_s:.1f} s later it was still under way"


@dataclass(eq=False)
class CancelsLate(Fault):
    """The goal ended too late after the request to cancel."""

    limit_s: float
    found_s: float
    why = "Perhaps a child stands in the robot's way. Then each tenth of a second counts."
    hint = "How long does one turn of the loop take, and where in it do you look for a cancel?"
    mend = (
        "Look at goal_handle.is_cancel_requested in each turn of the loop. Let a turn take 0.1 s,"
        " and do not sleep in the cancel callback."
    )
    expected = "the goal ends within {limit_s:g} s of the request to cancel"
    measured = "it ended after {found_s:.2f} s"


# --- two goals at once -------------------------------------------------------------------------


@dataclass(eq=False)
class TakesSecondGoal(Fault):
    """A second goal is accepted while the first is under way."""

    why = "Two loops then drive one rover, each to another place."
    hint = "How does the goal callback know that the rover has work already?"
    mend = (
        "Note in the goal callback that the rover has work (self.busy = True), and refuse a goal"
        " while it has."
    )
    expected = "while the rover drives, another goal is refused"
    measured = "it was accepted"


@dataclass(eq=False)
class FirstGoalDisturbed(Fault):
    """The second goal was refused, and the first did not come to its end."""

    state: str | None
    """In which the first goal ended; None: it did not."""
    why = "A goal that was refused must not change anything."
    hint = "What does the goal callback change before it refuses a goal?"
    mend = "Let the goal callback change nothing where it returns GoalResponse.REJECT."
    expected = "after another goal was refused, the first one goes on, and the rover gets there"

    measured = one_of(
        ended="the rover did not get there; state of the first goal: {state}",
        no_end="the rover did not get there; state of the first goal: no end of it came",
    )

    @property
    def which_measured(self) -> str:
        """Whether it ended."""
        return "ended" if self.state else "no_end"
