"""Faults in what a node makes of the way it is started: parameters, other names."""

from __future__ import annotations

from dataclasses import dataclass

from roslings.judge.faults.base import Fault


@dataclass(eq=False)
class NoParameter(Fault):
    """The node has no parameter of the name that the card gives."""

    node: str
    wanted: str
    found: tuple[str, ...]
    near: str | None
    why = "ROS gives a node only those parameters that its code has declared."
    expected = "{node} has a parameter {wanted!r}"
    hint = (
        "Look at declare_parameter(NAME, DEFAULT) in __init__. Check with `ros2 param list` while"
        " the node runs."
    )

    @property
    def measured(self) -> str:
        """What it has."""
        if self.near:
            return f"it has no {self.wanted!r}, but {self.near!r}: a spelling mistake?"
        return f"its own parameters are: {', '.join(self.found) or 'none'}"


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
    hint = (
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
    wanted: str
    found: str
    why = "A parameter lets others change the node without changing its code."
    expected = "with `--ros-args -p {name}:={value}`: {wanted}"
    measured = "{found}, as if the parameter were not there"
    hint = (
        "Read it with self.get_parameter('{name}').value, after declare_parameter, and give that"
        " value to create_timer. Does main() say rclpy.init(args=args)?"
    )


@dataclass(eq=False)
class ParameterMisread(ParameterIgnored):
    """The value changes something, but not as the card says."""

    about: str
    why = "Who sets a parameter relies on what it means, and in which unit."
    hint = "The value of {name} is {about}. What does your code make of it?"

    @property
    def measured(self) -> str:  # type: ignore[override]
        """What happened."""
        return self.found


@dataclass(eq=False)
class NameStays(Fault):
    """A node was started under another name, and keeps its own."""

    wanted: str
    found: tuple[str, ...]
    why = "A robot with two wheels starts one program twice. Each node then needs its own name."
    hint = (
        "The words after --ros-args reach the node through rclpy.init(args=args). Does main() give"
        " it a list of its own, or does the node say use_global_arguments=False?"
    )

    @property
    def expected(self) -> str:
        """The name that it was given."""
        space, _, name = self.wanted.rpartition("/")
        return f"with `-r __node:={name} -r __ns:={space}` the node is {self.wanted}"

    @property
    def measured(self) -> str:
        """The names that are there."""
        return f"the nodes are: {', '.join(self.found) or 'none'}"


@dataclass(eq=False)
class TopicStays(Fault):
    """A node was started in another namespace, and its topic did not follow."""

    node: str
    wanted: str
    found: tuple[str, ...]
    why = "Two nodes that publish on one topic mix their messages: nobody knows who said what."
    expected = "the node {node} publishes on {wanted}"
    hint = (
        "A topic's name that begins with a slash stays the same in every namespace. Write the name"
        " in create_publisher without the slash."
    )

    @property
    def measured(self) -> str:
        """The topic that it uses."""
        return f"it publishes on {', '.join(self.found) or 'no topic'}"
