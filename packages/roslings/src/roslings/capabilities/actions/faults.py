"""Faults of actions: who performs them, what becomes of a goal, and how soon."""

from __future__ import annotations

from dataclasses import dataclass

from ros2_on_pip.near_names import Near
from roslings.capabilities.topics.faults.rhythm import WrongRate
from roslings.judge.faults.base import Fault
from roslings.judge.faults.graph import guess

NEARER_M = 0.05
"""A rover that never came nearer by more than this drives away, or in circles."""

# --- who performs what -------------------------------------------------------------------------


@dataclass(eq=False)
class NoAction(Fault):
    """No node performs an action of this name, or of one like it."""

    action: str
    is_client: bool
    why = "Without an action server nobody takes a goal."
    expected = "a node that performs {action}"
    hint = (
        "Does your class make an action server in __init__? `ros2 action list` tells, while "
        "the node runs."
    )
    mend = (
        "Create ActionServer(self, TYPE, NAME, FUNCTION) in __init__ of your class, and keep it in"
        " self. Check with `ros2 action list` while the node runs."
    )

    @property
    def measured(self) -> str:
        """What there is."""
        if self.is_client:
            return f"the node is a client of {self.action}, and nobody performs it"
        return f"no node performs {self.action}, or a name like it"


@dataclass(eq=False)
class WrongAction(Fault):
    """The action is there under another name."""

    near: Near
    why = "Client and server meet only when both use the very same name."
    hint = "Look at the name in ActionServer(...). Check with `ros2 action list`."
    expected = "an action called {near.wanted}"

    @property
    def measured(self) -> str:
        """The name that is there, and the likely slip."""
        return f"it is called {self.near.found}{guess(self.near)}"


@dataclass(eq=False)
class WrongActionType(Fault):
    """The action has another type."""

    action: str
    wanted: str
    found: str
    why = "The type says what goal, feedback and result hold. Both sides need the same."
    hint = "The type stands in ActionServer(...) before the name, and comes from an import line."
    expected = "{action} has the type {wanted}"
    measured = "its type is {found}"


# --- a goal is answered ------------------------------------------------------------------------


@dataclass(eq=False)
class GoalUnanswered(Fault):
    """A goal was neither accepted nor refused."""

    goal: str
    waited_s: float
    why = "Who gives a goal must hear at once whether it is taken."
    hint = (
        "The goal callback only looks at the goal and returns GoalResponse.ACCEPT or"
        " GoalResponse.REJECT. Driving belongs into the execute callback."
    )
    expected = "the goal {goal} is accepted or refused"
    measured = "no answer came within {waited_s:.0f} s"


@dataclass(eq=False)
class EndedInsteadOfPerforming(GoalUnanswered):
    """The node ended while it had a goal."""

    why = "An error in a callback can end the whole node, and nobody gets an answer."
    hint = "Read the last lines below: the last one names the error, the one above it the place."
    measured = "the node ended"


@dataclass(eq=False)
class RefusesGoodGoal(Fault):
    """A goal that can be reached is refused."""

    goal: str
    when: str
    why = "A server that refuses what it can do is of no use."
    hint = (
        "Look at the conditions before GoalResponse.REJECT in the goal callback. Are the numbers"
        " those of the card?"
    )
    expected = "{when}, the goal {goal} is accepted"
    measured = "it was refused"


@dataclass(eq=False)
class AnswersNothing(RefusesGoodGoal):
    """The goal callback returns nothing, which ROS takes for a refusal."""

    hint = "What does the goal callback give back, on each way through it?"
    mend = (
        "Let the goal callback end with `return GoalResponse.ACCEPT`, on each way through it"
        " that is to accept. Without a return it gives back None."
    )
    measured = "it was refused: your goal callback did not return a GoalResponse"


@dataclass(eq=False)
class StaysBusy(RefusesGoodGoal):
    """After one goal the server takes no other."""

    why = "A server that works only once must be started again after each goal."
    hint = (
        "What makes your server refuse a goal while it drives? It must be set back on each way out"
        " of the execute callback: after success, and after a cancel."
    )
    measured = "it was refused, though nothing was under way any more"


@dataclass(eq=False)
class AcceptsImpossible(Fault):
    """A goal that cannot be reached is accepted."""

    goal: str
    because: str
    why = "A robot that takes an impossible goal drives on for ever, or against the wall."
    expected = "the goal {goal} is refused: {because}"
    measured = "it was accepted"

    hint = (
        "Which line of the goal callback should refuse this goal? Go through it with these numbers."
    )

    @property
    def mend(self) -> str:
        """The trap of nan."""
        if "nan" in self.goal:
            return (
                "Each comparison with nan is False. So ask what is right, not what is wrong:"
                " `if not (WEST <= goal.x <= EAST): return GoalResponse.REJECT`. Or use"
                " math.isfinite(NUMBER)."
            )
        return (
            "In the goal callback, compare each number of the goal with the card, before"
            " GoalResponse.ACCEPT."
        )


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
        "While the execute callback works, who runs the other callbacks of the node? Look at "
        "how main() spins."
    )
    mend = (
        "Give the node several threads:"
        " rclpy.spin(node, executor=MultiThreadedExecutor(num_threads=4)). The threads are what"
        " counts: a callback group alone changes nothing."
    )
    expected = "while a goal is under way, the node's other callbacks run"
    measured = (
        "while a goal was under way, none of them ran for {waited_s:.0f} s: the execute callback"
        " blocks the node"
    )


@dataclass(eq=False)
class ExecuteFailed(Fault):
    """The execute callback ended with an error."""

    error: str
    why = "An error in the execute callback ends the goal: ROS calls that aborted."
    expected = "the execute callback runs to its end"
    measured = "it raised an error: {error}"

    hint = "The lines below show the place: the last one names the error."

    @property
    def mend(self) -> str:
        """Where to look."""
        if "publish_feedback" in self.error:
            return (
                "Feedback belongs to one goal: call goal_handle.publish_feedback(feedback), with"
                " the goal_handle that the execute callback gets."
            )
        return "The lines below show the place: the last one names the error."


@dataclass(eq=False)
class NoFeedback(Fault):
    """A goal was under way, and no feedback came."""

    seconds: float
    why = "Who waits for a robot wants to see that it gets on."
    hint = "What becomes of the feedback in each turn of the loop? Look at the execute callback."
    mend = (
        "In the loop of the execute callback: fill TYPE.Feedback(), and call"
        " goal_handle.publish_feedback(feedback)."
    )
    expected = "feedback while the goal is under way"
    measured = "none came in {seconds:.1f} s"


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

    @property
    def measured(self) -> str:
        """The rate, or the shape of the intervals."""
        return self.rhythm.measured

    @property
    def mend(self) -> str:
        """The length of a turn."""
        period_s = 1 / self.rhythm.wanted_hz
        return (
            f"{self.rhythm.wanted_hz:g} Hz means one feedback every {period_s:g} s. Publish it in"
            f" each turn of the loop, and let a turn take so long: time.sleep({period_s:g})."
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

    @property
    def mend(self) -> str:
        """The missing line."""
        period_s = 1 / self.wanted_hz
        return (
            f"Is there a time.sleep({period_s:g}) in the execute callback, and inside of its loop?"
            " It is the last line of each turn."
        )


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

    @property
    def mend(self) -> str:
        """Where it is set."""
        return "It is math.hypot(goal.x - x, goal.y - y)." if self.field_name == "distance" else ""


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

    @property
    def measured(self) -> str:
        """How far it got."""
        if not self.moved:
            return "the goal did not end, and the rover did not move"
        return (
            f"the goal did not end: the rover was {self.began_m:.2f} m away at first, and never"
            f" nearer than {self.nearest_m:.2f} m"
        )

    @property
    def hint(self) -> str:
        """What to look at."""
        if not self.moved:
            return (
                "Does the loop publish a command on /cmd_vel in each turn? Look with"
                " `ros2 topic echo /cmd_vel` while a goal is under way."
            )
        if self.nearest_m > self.began_m - NEARER_M:
            return (
                "It does not come nearer. Watch it on the map of `./roslings rover`: in which"
                " direction does it drive, and in which one is the goal?"
            )
        return (
            "Watch it on the map of `./roslings rover`. Does the loop use the newest place each"
            " time, and when does it end?"
        )

    @property
    def mend(self) -> str:
        """The direction, or the end."""
        if self.moved and self.nearest_m > self.began_m - NEARER_M:
            return (
                "The direction to the goal is atan2(goal.y - y, goal.x - x), with x and y of the"
                " newest place."
            )
        return "The loop ends where the distance is within goal.tolerance." if self.moved else ""


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

    when: str
    speed_m_s: float
    turn_rad_s: float
    why = "A robot does what it was told last. Without a last command of zero it drives on."
    hint = "What is the last command on /cmd_vel? Look at each way out of the loop."
    mend = (
        "After the loop, on each way out of it, publish an empty Twist(): all its speeds are zero."
    )
    expected = "{when}, the last command is zero: stand still"

    @property
    def measured(self) -> str:
        """The last command."""
        forward, turn = (round(speed, 2) + 0.0 for speed in (self.speed_m_s, self.turn_rad_s))
        return f"the last command was {forward:.2f} m/s forward and {turn:.2f} rad/s of turn"


@dataclass(eq=False)
class StopsLate(Fault):
    """The robot was told to stop, but too late."""

    limit_s: float
    found_s: float
    why = "Perhaps a child stands in the robot's way. Then each tenth of a second counts."
    hint = "How often does your loop look whether it is to stop?"
    mend = "Look at goal_handle.is_cancel_requested in each turn of the loop, and sleep shortly."
    expected = "the rover is told to stand still within {limit_s:g} s of the cancel"
    measured = "that took {found_s:.2f} s"


@dataclass(eq=False)
class WrongEnd(Fault):
    """The goal ended in another state than it should."""

    when: str
    wanted: str
    found: str
    why = "Success, cancelled and aborted are the last word of a goal. Others act on it."
    expected = "{when}, the goal's state is {wanted!r}"
    measured = "it is {found!r}"

    hint = "Which call says how the goal has ended? Look at this way through the function."

    @property
    def mend(self) -> str:
        """The call that sets it."""
        call = {"succeeded": "succeed", "canceled": "canceled", "aborted": "abort"}[self.wanted]
        return (
            f"Call goal_handle.{call}() before you return the result. The last call decides, and"
            " each way through the function needs its own."
        )


@dataclass(eq=False)
class SucceedForgotten(WrongEnd):
    """No state was set, so ROS took the goal for aborted."""

    measured = "it is {found!r}: your execute callback set no state, and ROS assumes that"


@dataclass(eq=False)
class NoResult(Fault):
    """The execute callback has ended, and the result did not come."""

    why = "Who waits for the result waits for ever."
    hint = "What does the execute callback give back, on each way through it?"
    mend = (
        "The execute callback must end with `return result`, where result = TYPE.Result(). Without"
        " a return it gives back None, and ROS cannot send that."
    )
    expected = "the goal ends with a result"
    measured = "the execute callback returned nothing, and no result could be sent"


@dataclass(eq=False)
class WrongResult(Fault):
    """A field of the result is not what it should be."""

    field_name: str
    when: str
    wanted: str
    found: str
    why = "Who gave the goal reads in the result what came of it."
    expected = "{when}, result.{field_name} is {wanted}"
    measured = "it is {found}"

    hint = "Look at `result.{field_name} = ...`, on each way through the function."

    @property
    def mend(self) -> str:
        """How long it took."""
        if self.field_name != "elapsed":
            return ""
        return (
            "Note time.monotonic() at the start of the execute callback. At the end, subtract"
            " it from the new one: seconds."
        )


# --- cancel ------------------------------------------------------------------------------------


@dataclass(eq=False)
class CancelRefused(Fault):
    """The request to cancel was refused."""

    why = "Who cannot cancel must wait, or pull the plug."
    hint = (
        "Who answers a request to cancel? Look at what ActionServer(...) gets, and what that "
        "function returns."
    )
    mend = (
        "ROS refuses each cancel where ActionServer(...) has no cancel_callback=FUNCTION, and where"
        " that function ends without `return CancelResponse.ACCEPT`. Which is it?"
    )
    expected = "a request to cancel is accepted while the rover drives"
    measured = "it was refused"


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

    found: str
    why = "A goal that was refused must not change anything."
    hint = "What does the goal callback change before it refuses a goal?"
    mend = "Let the goal callback change nothing where it returns GoalResponse.REJECT."
    expected = "after another goal was refused, the first one goes on, and the rover gets there"

    @property
    def measured(self) -> str:
        """How it ended."""
        return self.found


# --- clients -----------------------------------------------------------------------------------


@dataclass(eq=False)
class SentNoGoal(Fault):
    """A server was there, and the client sent no goal."""

    executable: str
    action: str
    how: str
    why = "The server was ready. A client that sends no goal moves nothing."
    hint = (
        "Does your code wait for the server (wait_for_server), and then come to"
        " send_goal_async(goal)? Write a line to the log right before it, and see."
    )
    expected = "{executable} sends a goal to {action}"
    measured = "no goal came; {how}"


@dataclass(eq=False)
class SendsElsewhere(WrongAction):
    """The client sends its goal to an action of another name."""

    hint = "Look at the name in ActionClient(...). Check with `ros2 action list`."
    expected = "a client of {near.wanted}"

    @property
    def measured(self) -> str:
        """The name that it uses, and the likely slip."""
        return f"it is a client of {self.near.found}{guess(self.near)}"


@dataclass(eq=False)
class SentAnotherGoal(Fault):
    """The goal does not hold what the parameters say."""

    executable: str
    field_name: str
    wanted: str
    found: str
    why = "The rover drives where the goal says, and not where you meant."
    expected = (
        "where the parameter {field_name} is {wanted}, by -p or by its default, {executable} sends"
        " a goal with {field_name} {wanted}"
    )
    measured = "the goal had {field_name} {found}"
    hint = "Where does the value of goal.{field_name} come from? Look at the line that fills it."
    mend = (
        "Declare the parameter '{field_name}' in __init__, and set goal.{field_name} ="
        " self.get_parameter('{field_name}').value"
    )


@dataclass(eq=False)
class GoalSentAgain(Fault):
    """One goal was asked for, and more came."""

    executable: str
    action: str
    count: int
    why = "A second goal is another journey: the server refuses it, or the rover drives twice."
    hint = "How often is send_goal_async(goal) reached? Look for a loop, or a timer that goes on."
    expected = "{executable} sends one goal to {action}"
    measured = "it sent {count} goals"
