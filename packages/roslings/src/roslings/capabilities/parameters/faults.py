"""Faults in what a node makes of the way it is started: parameters, other names."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from roslings.judge.faults.base import Fault
from roslings.judge.faults.sentences import SentencePart, Text, one_of, plural

# --- parts of sentences ------------------------------------------------------------------------


@dataclass(frozen=True)
class Asked(SentencePart):
    """Values that were asked for, as `low = 1` is written."""

    values: tuple[str, ...]
    together: bool = False
    """In one request."""
    text = one_of(
        one="{values}",
        two="{values[0]} and {values[1]}",
        more="{values}",
        one_at_once="{values} at once",
        two_at_once="{values[0]} and {values[1]} at once",
        more_at_once="{values} at once",
    )

    @property
    def which_text(self) -> str:
        """How many there are."""
        many = {1: "one", 2: "two"}.get(len(self.values), "more")
        return f"{many}_at_once" if self.together else many


@dataclass(frozen=True)
class Rule(SentencePart):
    """What the card says of a parameter."""

    says: Literal["fixed", "type", "span", "not_above"]
    name: str
    what: str = ""
    """The type, or the parameter that it is not above."""
    least: float = 0.0
    most: float = 0.0
    text = one_of(
        fixed="{name} cannot be changed while the node runs",
        type="{name} is of type {what}",
        span="{name} is {least:g} to {most:g}",
        not_above="{name} is never above {what}",
    )

    @property
    def which_text(self) -> str:
        """Which rule it is."""
        return self.says


@dataclass(frozen=True)
class AfterSet(SentencePart):
    """When a node's deeds are looked at."""

    asked: Asked | None
    """None: before anybody asked for anything."""
    was_taken: bool = True
    text = one_of(
        defaults="with the defaults",
        taken="after {asked} was set",
        refused="after {asked} was refused",
    )

    @property
    def which_text(self) -> str:
        """What came of it."""
        return "defaults" if self.asked is None else "taken" if self.was_taken else "refused"


@dataclass(frozen=True)
class Deed(SentencePart):
    """What a node shows when it hears something."""

    heard: Text
    field: str
    value: str
    topic: str
    text = "{heard} gives {field} {value} on {topic}"


@dataclass(frozen=True)
class Pace(SentencePart):
    """How often messages come on a topic."""

    hz: float
    topic: str
    text = "{hz:g} messages a second on {topic}"


@dataclass(frozen=True)
class PaceFound(SentencePart):
    """How often they came."""

    hz: float | None
    text = one_of(some="{hz:.1f} a second", none="hardly any message came")

    @property
    def which_text(self) -> str:
        """Whether there were enough to tell."""
        return "none" if self.hz is None else "some"


@dataclass(frozen=True)
class NoMessageCame(SentencePart):
    """Where a value is asked for."""

    text = "no message came"


# --- the faults --------------------------------------------------------------------------------


@dataclass(eq=False)
class NoParameter(Fault):
    """The node has no parameter of the name that the card gives."""

    node: str
    wanted: str
    found: tuple[str, ...]
    near: str | None
    why = "ROS gives a node only those parameters that its code has declared."
    expected = "{node} has a parameter {wanted!r}"
    hint = "Which parameters has the node? `ros2 param list` tells, while it runs."
    mend = (
        "Look at declare_parameter(NAME, DEFAULT) in __init__. Check with `ros2 param list` while"
        " the node runs."
    )

    measured = one_of(
        near="it has no {wanted!r}, but {near!r}: a spelling mistake?",
        others="its own parameters are: {found}",
        none="its own parameters are: none",
    )

    @property
    def which_measured(self) -> str:
        """What it has."""
        return "near" if self.near else "others" if self.found else "none"


@dataclass(eq=False)
class WrongParameterType(Fault):
    """The parameter takes values of another type."""

    node: str
    name: str
    wanted: str
    found: str
    was_seen = True
    why = "A parameter takes values of the type of its default, and refuses all others."
    expected = "the parameter {name!r} of {node} is of type {wanted}"
    measured = "it is of type {found}"
    hint = "Look at the default in declare_parameter('{name}', ...). Of which type is it?"
    mend = (
        "Look at the default in declare_parameter('{name}', ...): 1 is an integer, 1.0 a double,"
        " '1' a string, True a bool."
    )


@dataclass(eq=False)
class WrongDefault(WrongParameterType):
    """The parameter has another value where nobody set one."""

    why = "Who starts the node without a word relies on the defaults of the card."
    expected = "the parameter {name!r} of {node} is {wanted} when nobody sets it"
    measured = "it is {found}"
    hint = "Compare declare_parameter('{name}', DEFAULT) with the card."


@dataclass(eq=False)
class ParameterIgnored(Fault):
    """The node has the parameter, and its value changes nothing."""

    name: str
    value: str
    asked_hz: float
    hz: float | None
    """The rate that was measured; None: too few messages came to speak of one."""
    count: int
    seconds: float
    """So many messages came in so long a time."""
    why = "A parameter lets others change the node without changing its code."
    expected = "with `--ros-args -p {name}:={value}`: {asked_hz:g} messages a second"
    measured = one_of(
        rate="{hz:.2f} messages a second, as if the parameter were not there",
        few=plural(
            "count",
            one="{count} message in {seconds:.1f} s, as if the parameter were not there",
            other="{count} messages in {seconds:.1f} s, as if the parameter were not there",
        ),
    )
    hint = "Follow the parameter {name}: where is it read, and what is done with its value?"
    mend = (
        "Read it with self.get_parameter('{name}').value, after declare_parameter, and give that"
        " value to create_timer. Does main() say rclpy.init(args=args)?"
    )

    @property
    def which_measured(self) -> str:
        """Whether there is a rate to speak of."""
        return "few" if self.hz is None else "rate"


@dataclass(eq=False)
class ParameterMisread(ParameterIgnored):
    """The value changes something, but not as the card says."""

    about: str
    why = "Who sets a parameter relies on what it means, and in which unit."
    hint = "The value of {name} is {about}. What does your code make of it?"

    measured = one_of(
        rate="{hz:.2f} messages a second",
        few=plural(
            "count",
            one="{count} message in {seconds:.1f} s",
            other="{count} messages in {seconds:.1f} s",
        ),
    )


@dataclass(eq=False)
class NameStays(Fault):
    """A node was started under another name, and keeps its own."""

    wanted: str
    found: tuple[str, ...]
    why = "A robot with two wheels starts one program twice. Each node then needs its own name."
    hint = "What does main() hand on to rclpy.init(...), and what does the node get?"
    mend = (
        "The words after --ros-args reach the node through rclpy.init(args=args). Does main() give"
        " it a list of its own, or does the node say use_global_arguments=False?"
    )

    expected = "with `-r __node:={name} -r __ns:={space}` the node is {wanted}"
    measured = one_of(some="the nodes are: {found}", none="the nodes are: none")

    @property
    def which_measured(self) -> str:
        """The names that are there."""
        return "some" if self.found else "none"

    @property
    def name(self) -> str:
        """The name that it was given."""
        return self.wanted.rpartition("/")[2]

    @property
    def space(self) -> str:
        """The namespace that it was given."""
        return self.wanted.rpartition("/")[0]


@dataclass(eq=False)
class TopicStays(Fault):
    """A node was started in another namespace, and its topic did not follow."""

    node: str
    wanted: str
    found: tuple[str, ...]
    why = "Two nodes that publish on one topic mix their messages: nobody knows who said what."
    expected = "the node {node} publishes on {wanted}"
    hint = "Look at the first sign of the topic's name in your code."
    mend = (
        "A topic's name that begins with a slash stays the same in every namespace. Write the name"
        " in create_publisher without the slash."
    )

    measured = one_of(some="it publishes on {found}", none="it publishes on no topic")

    @property
    def which_measured(self) -> str:
        """The topic that it uses."""
        return "some" if self.found else "none"


@dataclass(eq=False)
class SetRefused(Fault):
    """A good value was refused."""

    node: str
    asked: Asked
    reason: str
    why = "Who sets a good value expects that it counts."
    expected = "{node} takes {asked}"

    measured = one_of(reason="it refuses: {reason}", no_reason="it refuses, and says no reason")
    hint = (
        "Compare the limits in your code with the card: the limit itself is a good value. What"
        " does the function of add_on_set_parameters_callback return for good values?"
    )

    @property
    def which_measured(self) -> str:
        """Whether the node said why."""
        return "reason" if self.reason else "no_reason"


@dataclass(eq=False)
class RefusedTogether(SetRefused):
    """Two values that fit together were refused."""

    hint = "With which values does your function compare? Somebody may set both at once."

    mend = (
        "The function of add_on_set_parameters_callback gets all new values in one list."
        " Compare them with each other; the old value counts only for what is not in the list."
    )


@dataclass(eq=False)
class SetUnanswered(SetRefused):
    """The node gives no answer to who sets a parameter."""

    reason = ""
    why = "Who sets a parameter waits for the answer."
    measured = "it does not answer"
    hint = "Does a function of your node wait for something, or loop, so that it never returns?"


@dataclass(eq=False)
class EndedBySet(SetUnanswered):
    """The node ended when somebody set a parameter."""

    was_seen = True
    why = "A wrong value from somebody else must not end a robot's program."
    expected = "{node} answers to {asked}"
    measured = "the node ended with an error"
    hint = "Read the last lines below: the last one names the error, the one above it the place."


@dataclass(eq=False)
class SetHasNoEffect(Fault):
    """A value was taken, and the parameter has another one."""

    node: str
    asked: Asked
    name: str
    found: str
    why = "Who sets a parameter and reads it back must find the value there."
    expected = "after {node} took {asked}, `ros2 param get` says the same"
    measured = "{name} is {found}"
    hint = "Does your code set the parameter itself, when somebody else sets it?"


@dataclass(eq=False)
class RefusedAndChanged(SetHasNoEffect):
    """A value was refused, and something is changed all the same."""

    why = "All at once or none: half of a change is worse than no change."
    expected = "after {node} refused {asked}, all parameters are as before"
    hint = "What does your function change before it says no?"
    mend = "Set no parameter in the function of add_on_set_parameters_callback: it says yes or no."


@dataclass(eq=False)
class WrongValueTaken(Fault):
    """A value was taken that no parameter of the card can have."""

    node: str
    asked: Asked
    rule: Rule
    was_seen = True
    why = "A value that nobody checks reaches the motors."
    expected = "{node} refuses {asked} ({rule})"
    measured = "the value was taken"
    hint = "Who refuses a value that the card does not allow? Look at what declare_parameter gets."
    mend = (
        "Give declare_parameter a third argument, a ParameterDescriptor with floating_point_range"
        " or integer_range (rcl_interfaces.msg)."
    )


@dataclass(eq=False)
class NoNumberTaken(WrongValueTaken):
    """NaN was taken for a number within limits."""

    why = "With a limit of nan nothing is too fast: each comparison with nan is False."
    hint = "Compare nan with some numbers in Python. Which of your comparisons lets it through?"
    mend = (
        "Ask what is right, and not what is wrong: least <= value <= most is False for nan. A"
        " ParameterDescriptor with floating_point_range (rcl_interfaces.msg) asks so."
    )


@dataclass(eq=False)
class WrongTypeTaken(WrongValueTaken):
    """A value of another type was taken."""

    why = "A text where a number should be ends the node at the next calculation."
    hint = "Which type has the default, and what does the descriptor say of other types?"
    mend = (
        "A parameter keeps the type of its default, where its descriptor does not say"
        " dynamic_typing=True. Give it a default of the type that the card says."
    )


@dataclass(eq=False)
class RuleBroken(WrongValueTaken):
    """Two values were taken that do not fit together."""

    why = "A range looks at one parameter alone. What two must keep between them, your code checks."
    hint = "Which function sees both values before they are set, and what does it answer?"
    mend = (
        "Compare both in the function that you give to add_on_set_parameters_callback, and return"
        " SetParametersResult(successful=False, reason=...). What is not in the list keeps the"
        " value that get_parameter says."
    )


@dataclass(eq=False)
class ReadOnlyChanged(WrongValueTaken):
    """A parameter was changed that is chosen at the start."""

    why = "Others have read this value already, and do not ask again."
    hint = "What tells ROS that nobody may change this parameter?"
    mend = "Give declare_parameter a third argument: ParameterDescriptor(read_only=True)."


@dataclass(eq=False)
class ActsOtherwise(Fault):
    """The node does not do what its parameters say."""

    when: AfterSet
    wanted: SentencePart
    found: Text
    why = "Who sets a parameter believes that the robot now does what it says."
    expected = "{when}: {wanted}"
    measured = "{found}"
    hint = "When does your code read the parameter?"
    mend = (
        "Read a parameter where you use it: self.get_parameter(NAME).value. A value that __init__"
        " has kept is the one of the start."
    )


@dataclass(eq=False)
class ActsOnRefused(ActsOtherwise):
    """The node acts on a value that it has refused."""

    why = "A value that is refused changes nothing, also not inside of the node."
    hint = "What does your function keep before it is known that all values are taken?"
    mend = (
        "The function of add_on_set_parameters_callback only says yes or no: another value of its"
        " list may still be refused. Keep nothing there. Read the parameter where you use it, or"
        " act in add_post_set_parameters_callback."
    )
