"""What a cell cannot do, said in words that name the next step."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from importlib.util import find_spec


class NotebookTrouble(Exception):
    """A cell cannot go on. Its text is all that the student needs to see."""


class NoRos(NotebookTrouble):
    """This kernel's Python has no rclpy."""

    def __init__(self) -> None:
        super().__init__(
            "This notebook's kernel has no ROS 2. Close JupyterLab."
            " Then type in a terminal, in the roslings folder: ./roslings lab"
        )


def require_ros() -> None:
    """Raises NoRos where this Python has no rclpy."""
    if find_spec("rclpy") is None:
        raise NoRos


class NoSession(NotebookTrouble):
    """Something that needs a session was asked for outside of one."""

    def __init__(self, what: str) -> None:
        super().__init__(f"{what} needs a session. Put it inside: with session() as ros:")


class SessionEnded(NotebookTrouble):
    """The session is over, or ROS was shut down in it."""

    def __init__(self) -> None:
        super().__init__(
            "This session is over: its nodes have ended. Begin a new one: with session() as ros:"
        )


class StillWaiting(NotebookTrouble):
    """A condition did not come true in time."""

    def __init__(self, what: str, seconds: float, hint: str = "") -> None:
        after = f" {hint}" if hint else ""
        super().__init__(f"Waited {seconds:g} s for {what}. It did not come.{after}")


class NothingHeard(NotebookTrouble):
    """Fewer messages came than were asked for."""

    def __init__(self, topic: str, came: int, wanted: int, seconds: float, hint: str) -> None:
        self.topic, self.came, self.wanted, self.seconds = topic, came, wanted, seconds
        super().__init__(f"{came} of {wanted} messages on {topic} in {seconds:g} s. {hint}")


class OtherType(NotebookTrouble):
    """A topic is used with two types."""

    def __init__(self, topic: str, wanted: str, there: Iterable[str]) -> None:
        super().__init__(
            f"{topic} has the type {listed(there)} here, and {wanted} was given."
            " A topic has one type: use the same on both sides."
        )


class NobodyListens(NotebookTrouble):
    """A message has no subscription to go to."""

    def __init__(self, topic: str, type_name: str, seconds: float, hint: str) -> None:
        super().__init__(
            f"In {seconds:g} s no node subscribed to {topic} with the type {type_name}. {hint}"
        )


class NoInit(NotebookTrouble):
    """A node's class did not reach rclpy's Node in the usual way."""

    def __init__(self, kind: str) -> None:
        super().__init__(
            f"{kind} took no ros_args. Its __init__ needs the line: super().__init__('a_name')"
        )


class NotANode(NotebookTrouble):
    """Something else than a class of nodes was given."""

    def __init__(self, given: object) -> None:
        name = getattr(given, "__name__", type(given).__name__)
        super().__init__(
            f"{name} is no class of nodes. Give the class itself, without brackets:"
            " ros.start(Talker)"
        )


class ProgramEnded(NotebookTrouble):
    """A program ended before it said what was awaited."""

    def __init__(self, command: str, code: int, text: str, lines: Sequence[str]) -> None:
        said = "\n".join(lines[-5:]) or "(nothing)"
        super().__init__(
            f"'{command}' ended with exit code {code}, and never said {text!r}."
            f" Its last lines:\n{said}"
        )


class NeverSaid(NotebookTrouble):
    """A program goes on, and does not say what is awaited."""

    def __init__(self, command: str, text: str, seconds: float, lines: Sequence[str]) -> None:
        said = "\n".join(lines[-5:]) or "(nothing)"
        super().__init__(
            f"In {seconds:g} s '{command}' did not say {text!r}. Its last lines:\n{said}"
        )


def listed(names: Iterable[str]) -> str:
    """`/a, /b`, or the word `none`."""
    return ", ".join(sorted(names)) or "none"
