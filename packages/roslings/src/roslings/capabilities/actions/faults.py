"""Faults of actions: who performs them, what becomes of a goal, and how soon."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from roslings.judge.faults.base import Fault
from roslings.judge.faults.ends import Went
from roslings.judge.faults.graph import NearlyNamed, with_guess
from roslings.judge.faults.sentences import Text, one_of, plural

GoodEnd = Literal["succeeded", "canceled", "aborted"]
"""States in which a goal may be asked to end."""

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

    measured = one_of(
        client="the node is a client of {action}, and nobody performs it",
        nobody="no node performs {action}, or a name like it",
    )

    @property
    def which_measured(self) -> str:
        """What there is."""
        return "client" if self.is_client else "nobody"


@dataclass(eq=False)
class WrongAction(NearlyNamed):
    """The action is there under another name."""

    why = "Client and server meet only when both use the very same name."
    hint = "Look at the name in ActionServer(...). Check with `ros2 action list`."
    expected = "an action called {near.wanted}"

    measured = with_guess("it is called {near.found}")


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
    when: Text
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

    mend = one_of(
        nan="Each comparison with nan is False. So ask what is right, not what is wrong:"
        " `if not (WEST <= goal.x <= EAST): return GoalResponse.REJECT`. Or use"
        " math.isfinite(NUMBER).",
        number="In the goal callback, compare each number of the goal with the card, before"
        " GoalResponse.ACCEPT.",
    )

    @property
    def which_mend(self) -> str:
        """The trap of nan, or another number."""
        return "nan" if "nan" in self.goal else "number"


# --- on the way --------------------------------------------------------------------------------


@dataclass(eq=False)
class ExecuteFailed(Fault):
    """The execute callback ended with an error."""

    error: str
    why = "An error in the execute callback ends the goal: ROS calls that aborted."
    expected = "the execute callback runs to its end"
    measured = "it raised an error: {error}"

    hint = "The lines below show the place: the last one names the error."

    mend = one_of(
        feedback="Feedback belongs to one goal: call goal_handle.publish_feedback(feedback), with"
        " the goal_handle that the execute callback gets.",
        read="The lines below show the place: the last one names the error.",
    )

    @property
    def which_mend(self) -> str:
        """What Python says of it."""
        return "feedback" if "publish_feedback" in self.error else "read"


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


# --- the end of a goal -------------------------------------------------------------------------


@dataclass(eq=False)
class WrongEnd(Fault):
    """The goal ended in another state than it should."""

    when: Text
    wanted: GoodEnd
    found: str
    why = "Success, cancelled and aborted are the last word of a goal. Others act on it."
    expected = "{when}, the goal's state is {wanted!r}"
    measured = "it is {found!r}"

    hint = "Which call says how the goal has ended? Look at this way through the function."

    mend = (
        "Call goal_handle.{call}() before you return the result. The last call decides, and"
        " each way through the function needs its own."
    )

    @property
    def call(self) -> str:
        """The call that sets it."""
        return {"succeeded": "succeed", "canceled": "canceled", "aborted": "abort"}[self.wanted]


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
    when: Text
    wanted: Text
    found: str
    why = "Who gave the goal reads in the result what came of it."
    expected = "{when}, result.{field_name} is {wanted}"
    measured = "it is {found}"

    hint = "Look at `result.{field_name} = ...`, on each way through the function."

    mend = one_of(
        elapsed="Note the time at the start of the execute callback, by self.get_clock().now()."
        " At the end, subtract it from the new one: .nanoseconds / 1e9 of that are the seconds."
    )

    @property
    def which_mend(self) -> str:
        """How long it took; of other fields there is no more to say."""
        return "elapsed" if self.field_name == "elapsed" else ""


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


# --- clients -----------------------------------------------------------------------------------


@dataclass(eq=False)
class SentNoGoal(Fault):
    """A server was there, and the client sent no goal."""

    executable: str
    action: str
    went: Went
    why = "The server was ready. A client that sends no goal moves nothing."
    hint = (
        "Does your code wait for the server (wait_for_server), and then come to"
        " send_goal_async(goal)? Write a line to the log right before it, and see."
    )
    expected = "{executable} sends a goal to {action}"
    measured = "no goal came; {went}"


@dataclass(eq=False)
class SendsElsewhere(WrongAction):
    """The client sends its goal to an action of another name."""

    hint = "Look at the name in ActionClient(...). Check with `ros2 action list`."
    expected = "a client of {near.wanted}"

    measured = with_guess("it is a client of {near.found}")


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
    measured = plural("count", one="it sent {count} goal", other="it sent {count} goals")
