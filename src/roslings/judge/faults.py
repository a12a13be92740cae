"""The kinds of fault that a check can find, each with its own sentences.

A fault says what was expected, what was measured, why it matters and what to try. The words are
for somebody on the third day of ROS. The class name is the `fault` of the verdict.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import ClassVar

from roslings.evidence import Qos
from roslings.near import Near
from roslings.rates import Rate


@dataclass(eq=False)
class Fault(Exception):
    """A failed check. Subclasses carry the numbers and write the sentences."""

    why: ClassVar[str] = ""
    log: tuple[str, ...] = field(default=(), kw_only=True)

    @property
    def expected(self) -> str:
        """What the contract asks for."""
        raise NotImplementedError

    @property
    def measured(self) -> str:
        """What was seen instead."""
        raise NotImplementedError

    @property
    def hint(self) -> str:
        """What to try."""
        raise NotImplementedError

    def __str__(self) -> str:
        return f"expected {self.expected}; measured {self.measured}"


class Inconclusive(Exception):
    """The machine, not the student, is at fault: no verdict, and the reason."""


class NothingToJudge(Exception):
    """What this check looks at is not there, and another check has already said so."""


# --- the package's own files -------------------------------------------------------------------


@dataclass(eq=False)
class InvalidPackageXml(Fault):
    """package.xml does not hold what every package.xml holds."""

    problem: str
    why = "ROS tools read package.xml first. If it is not valid, they do not see a ROS package."
    hint = "Open package.xml and mend the line named above. Compare with the lesson's example."

    @property
    def expected(self) -> str:
        """A valid file."""
        return "a valid package.xml"

    @property
    def measured(self) -> str:
        """The first problem."""
        return self.problem


@dataclass(eq=False)
class WrongBuildType(Fault):
    """The package is not of the kind that the lab asks for."""

    wanted: str
    found: str
    why = "colcon looks at the build type to know how to build the package."

    @property
    def expected(self) -> str:
        """The wanted kind."""
        return f"the build type {self.wanted}"

    @property
    def measured(self) -> str:
        """The kind that is there."""
        return f"the build type {self.found}" if self.found else "no build type in package.xml"

    @property
    def hint(self) -> str:
        """The line to write."""
        return "Look at <build_type> inside <export> at the end of package.xml."


@dataclass(eq=False)
class MissingFile(Fault):
    """A file that every ament_python package has is not there."""

    path: str
    why = "Each of these files tells ROS one thing: where the code is, and what it is called."

    @property
    def expected(self) -> str:
        """The file."""
        return f"the file {self.path}"

    @property
    def measured(self) -> str:
        """That it is missing."""
        return f"there is no {self.path} in the package"

    @property
    def hint(self) -> str:
        """Where it comes from."""
        return (
            "`ros2 pkg create` makes this file. Make a package beside yours and see what it holds."
        )


@dataclass(eq=False)
class SyntaxErrorInCode(Fault):
    """Python cannot read one of the files."""

    place: str
    why = "Python reads a whole file before it runs one line of it."
    hint = "Look at that line and the one above it: a missing colon, bracket or quotation mark?"

    @property
    def expected(self) -> str:
        """Readable code."""
        return "Python code that Python can read"

    @property
    def measured(self) -> str:
        """File, line and Python's words."""
        return self.place


@dataclass(eq=False)
class UnlistedDependency(Fault):
    """The code imports a ROS package that package.xml does not name."""

    package: str
    place: str
    why = (
        "On another machine ROS installs only what package.xml names. There, your node would stop."
    )

    @property
    def expected(self) -> str:
        """The package in package.xml."""
        return f"{self.package} in package.xml, because {self.place} imports it"

    @property
    def measured(self) -> str:
        """That it is not named."""
        return f"package.xml does not name {self.package}"

    @property
    def hint(self) -> str:
        """Where to look."""
        return "Look at the <depend> lines in package.xml: one for each ROS package you import."


@dataclass(eq=False)
class BuildFailed(Fault):
    """colcon did not build the package."""

    seconds: float
    why = "What is not built cannot be run with `ros2 run`."
    hint = "Run `colcon build` in your workspace. Read the first error, not the last one."

    @property
    def expected(self) -> str:
        """A build."""
        return "`colcon build` ends without an error"

    @property
    def measured(self) -> str:
        """That it failed."""
        return f"`colcon build` failed after {self.seconds:.1f} s"


@dataclass(eq=False)
class NotAnAmentPackage(Fault):
    """colcon built it, but as plain Python that ROS does not see."""

    found: str | None
    why = "colcon built it as plain Python. ROS does not find such a package."
    hint = "Mend package.xml: name, e-mail and <build_type>ament_python</build_type>."

    @property
    def expected(self) -> str:
        """A ROS package."""
        return "colcon takes it for a ROS package (ros.ament_python)"

    @property
    def measured(self) -> str:
        """What colcon took it for."""
        return f"colcon took it for {self.found or 'nothing that it knows'}"


@dataclass(eq=False)
class NoExecutable(Fault):
    """An executable of the contract is not installed."""

    wanted: str
    found: tuple[str, ...]
    package: str
    why = "`ros2 run` starts what setup.py lists under console_scripts, and nothing else."

    @property
    def expected(self) -> str:
        """The executable."""
        return f"`ros2 run {self.package} {self.wanted}` finds an executable"

    @property
    def measured(self) -> str:
        """What there is."""
        there = ", ".join(self.found) if self.found else "none"
        return f"the package has these executables: {there}"

    @property
    def hint(self) -> str:
        """Where to look."""
        return "Look at entry_points in setup.py: one text 'name = module:function' for each node."


# --- a process ---------------------------------------------------------------------------------


@dataclass(eq=False)
class DidNotComeUp(Fault):
    """The process ended before its node could do anything, or never made a node."""

    executable: str
    how: str
    why = "A node that ends at once can neither send nor receive."

    @property
    def expected(self) -> str:
        """A running node."""
        return f"{self.executable} starts, makes a node and keeps running"

    @property
    def measured(self) -> str:
        """How it went."""
        return self.how

    @property
    def hint(self) -> str:
        """What to try."""
        return (
            "Start it by hand with `ros2 run` and read the last line of what it prints. "
            "Without an error: does main() call rclpy.spin(node)?"
        )


@dataclass(eq=False)
class StoppedByItself(Fault):
    """The node ran for a while and then ended, though nobody asked it to."""

    executable: str
    after_s: float
    how: str
    why = "A robot's node runs until somebody stops it."
    hint = "Read the last lines below: the last one names the error, the one above it the place."

    @property
    def expected(self) -> str:
        """A node that stays."""
        return f"{self.executable} runs until Ctrl-C"

    @property
    def measured(self) -> str:
        """When it ended, and how."""
        return f"it ended by itself after {self.after_s:.1f} s ({self.how})"


@dataclass(eq=False)
class DoesNotEnd(Fault):
    """Ctrl-C does not end the node in time."""

    executable: str
    within_s: float
    after_s: float | None
    why = "Who cannot stop a robot's program with Ctrl-C cannot stop the robot."
    hint = "Does your code catch KeyboardInterrupt and go on, or wait in a loop that never ends?"

    @property
    def expected(self) -> str:
        """The time that it has."""
        return f"{self.executable} ends within {self.within_s:g} s of Ctrl-C"

    @property
    def measured(self) -> str:
        """The time that it took."""
        if self.after_s is None:
            return "it was still running and had to be killed"
        return f"it ended after {self.after_s:.1f} s"


@dataclass(eq=False)
class UncleanExit(Fault):
    """Ctrl-C ends the node with an error."""

    executable: str
    how: str
    why = (
        "Much tutorial code ends like this. It is a small thing, but other programs take the "
        "error for a crash."
    )
    hint = (
        "Catch KeyboardInterrupt and ExternalShutdownException around rclpy.spin(), and end "
        "with rclpy.try_shutdown()."
    )

    @property
    def expected(self) -> str:
        """A clean end."""
        return f"{self.executable} ends after Ctrl-C with exit code 0 and no traceback"

    @property
    def measured(self) -> str:
        """How it ended."""
        return self.how


@dataclass(eq=False)
class LeavesProcesses(Fault):
    """The node ended, but processes that it started did not."""

    executable: str
    count: int
    why = "A forgotten process still sends messages, and the next start meets it."
    hint = "End what your node starts (subprocess, multiprocessing) before the node itself ends."

    @property
    def expected(self) -> str:
        """Nothing left."""
        return f"nothing that {self.executable} started outlives it"

    @property
    def measured(self) -> str:
        """How many were left."""
        return f"{self.count} process(es) still ran after it had ended"


# --- the graph ---------------------------------------------------------------------------------


@dataclass(eq=False)
class WrongNodeName(Fault):
    """The node is there, under another name."""

    near: Near
    why = "Other nodes and tools find a node by its name."

    @property
    def expected(self) -> str:
        """The full name."""
        return f"a node {self.near.wanted}"

    @property
    def measured(self) -> str:
        """The name that is there."""
        return (
            f"there is no {self.near.wanted}, but {self.near.found} is running{_guess(self.near)}"
        )

    @property
    def hint(self) -> str:
        """Where the name is given."""
        if self.near.how == "namespace":
            return "Look for namespace= where your class calls super().__init__(...)."
        return "The name is the first text in super().__init__(...) of your class."


@dataclass(eq=False)
class WrongTopic(Fault):
    """The node uses a topic, but under another name."""

    near: Near
    verb: str
    type: str
    why = "Publisher and subscription meet only when both use the very same name."

    @property
    def expected(self) -> str:
        """The topic."""
        return f"a node that {self.verb} {self.near.wanted}"

    @property
    def measured(self) -> str:
        """The topic that is there, and the likely slip."""
        return (
            f"there is no {self.near.wanted}, but {self.near.found} carries"
            f" {self.type}{_guess(self.near)}"
        )

    @property
    def hint(self) -> str:
        """Where the name is given."""
        call = "create_publisher" if self.verb.startswith("publishes") else "create_subscription"
        return f"Look at the text in {call}(...). Check with `ros2 topic list`."


@dataclass(eq=False)
class NoTopic(Fault):
    """The node uses no topic of this kind at all."""

    topic: str
    verb: str
    why = "Without a topic, no message can go from one node to another."

    @property
    def expected(self) -> str:
        """The topic."""
        return f"a node that {self.verb} {self.topic}"

    @property
    def measured(self) -> str:
        """That there is none."""
        return f"it {self.verb} no topic of its own"

    @property
    def hint(self) -> str:
        """Which call is missing."""
        call = "create_publisher" if self.verb.startswith("publishes") else "create_subscription"
        return (
            f"Call self.{call}(...) in __init__ of your class, and see that main() makes the node."
        )


@dataclass(eq=False)
class WrongType(Fault):
    """The topic carries another kind of message."""

    topic: str
    wanted: str
    found: str
    why = "A topic carries one type of message. Other types are not delivered, without an error."

    @property
    def expected(self) -> str:
        """The type."""
        return f"{self.topic} carries {self.wanted}"

    @property
    def measured(self) -> str:
        """The type that is there."""
        return f"it carries {self.found}"

    @property
    def hint(self) -> str:
        """Where the type is given."""
        return "The type is the first word in create_publisher(...) or create_subscription(...)."


@dataclass(eq=False)
class QosCannotMatch(Fault):
    """The quality of service keeps publisher and subscription apart."""

    topic: str
    policy: str
    wanted: str
    found: str
    why = "If one side asks for more than the other offers, no message is delivered."

    @property
    def expected(self) -> str:
        """What the other side uses."""
        return f"a QoS on {self.topic} that works with {self.policy} {self.wanted}"

    @property
    def measured(self) -> str:
        """What is there."""
        return f"{self.policy} is {self.found}: the two can never be joined"

    @property
    def hint(self) -> str:
        """The simple way."""
        return "Give the number 10 in place of the QoS profile: that is the usual, reliable one."


@dataclass(eq=False)
class TwoPublishers(Fault):
    """One publisher was asked for, more are there."""

    topic: str
    nodes: tuple[str, ...]
    why = "Two publishers on one topic mix their messages, and the counting seems to jump."
    hint = "Count the calls of create_publisher in your code. One for each topic is enough."

    @property
    def expected(self) -> str:
        """One."""
        return f"one publisher on {self.topic}"

    @property
    def measured(self) -> str:
        """How many."""
        return f"{len(self.nodes)} publishers, from {', '.join(self.nodes)}"


@dataclass(eq=False)
class NotTheAskedGraph(Fault):
    """With both nodes running, the graph has something missing or something too much."""

    wanted: tuple[str, ...]
    found: tuple[str, ...]
    what: str
    why = "The graph is the plan of the robot's program. Each part in it must be there on purpose."
    hint = "Run both nodes and look: `./roslings graph`. Does one name appear twice?"

    @property
    def expected(self) -> str:
        """The asked graph."""
        return f"just {', '.join(self.wanted)}"

    @property
    def measured(self) -> str:
        """What is there instead."""
        return f"{self.what}: {', '.join(self.found) or 'nothing'}"


# --- messages ----------------------------------------------------------------------------------


@dataclass(eq=False)
class NoMessages(Fault):
    """The topic is there and too little comes on it to speak of a rate."""

    topic: str
    count: int
    seconds: float
    why = "A publisher sends nothing by itself: something must call publish() again and again."
    hint = "Is there a timer (create_timer) whose function calls publish()?"

    @property
    def expected(self) -> str:
        """Messages."""
        return f"messages on {self.topic} all the time"

    @property
    def measured(self) -> str:
        """How many came."""
        return f"{self.count} message(s) in {self.seconds:.1f} s"


@dataclass(eq=False)
class WrongRate(Fault):
    """The rate is outside its limits."""

    topic: str
    wanted_hz: float
    within: float
    rate: Rate
    why = "Other nodes rely on the rate: a slow sensor is like a robot with closed eyes."

    @property
    def expected(self) -> str:
        """The rate and its tolerance."""
        return f"{self.wanted_hz:g} Hz on {self.topic} (within {self.within:.0%})"

    @property
    def measured(self) -> str:
        """The rate, how sure it is, and the period."""
        return (
            f"{self.rate.hz:.2f} Hz (±{max(self.rate.uncertainty_hz, 0.01):.2f}),"
            f" one message every {self.rate.period_s:.2f} s"
        )

    @property
    def hint(self) -> str:
        """The period to aim at."""
        return (
            f"{self.wanted_hz:g} Hz means one message every {1 / self.wanted_hz:g} s."
            " Look at the period that you give create_timer(...)."
        )


@dataclass(eq=False)
class TooSlow(WrongRate):
    """Fewer messages than asked for."""


@dataclass(eq=False)
class TooFast(WrongRate):
    """More messages than asked for."""


@dataclass(eq=False)
class Bursts(WrongRate):
    """The number is right, but the messages come in groups."""

    why = "A robot that hears nothing for a while and then everything at once acts too late."
    hint = "Publish one message in each call of the timer's function, not several in a loop."

    @property
    def expected(self) -> str:
        """Even spacing."""
        return f"one message every {1 / self.wanted_hz:g} s on {self.topic}, evenly"

    @property
    def measured(self) -> str:
        """The shape of the intervals."""
        shortest, longest = min(self.rate.periods_s), max(self.rate.periods_s)
        return f"groups: pauses from {shortest:.3f} s to {longest:.2f} s between two messages"


@dataclass(eq=False)
class WrongText(Fault):
    """A message says something else."""

    wanted: str
    found: str
    why = "Who reads these messages expects exactly this text."
    hint = "Compare letter by letter: capitals, spaces, and the number at the end."

    @property
    def expected(self) -> str:
        """The text."""
        return f"texts like {self.wanted!r}"

    @property
    def measured(self) -> str:
        """The first text that differs."""
        return f"{self.found!r}"


@dataclass(eq=False)
class WrongCount(Fault):
    """The number in the messages does not go up by one."""

    before: int
    after: int
    why = "With a number that goes up by one, a lost message is noticed."

    @property
    def expected(self) -> str:
        """The next number."""
        return f"{self.before + 1} after {self.before}"

    @property
    def measured(self) -> str:
        """The number that came."""
        return f"{self.after} after {self.before}"

    @property
    def hint(self) -> str:
        """Where to look."""
        return "Add 1 to your counter once for each message, right after publish()."


@dataclass(eq=False)
class CountSkips(WrongCount):
    """A number is left out."""


@dataclass(eq=False)
class CountRepeats(WrongCount):
    """A number comes twice."""


@dataclass(eq=False)
class CountRestarts(WrongCount):
    """The counting jumps back."""


# --- what a node writes ------------------------------------------------------------------------


@dataclass(eq=False)
class NotLogged(Fault):
    """The node does not write the line that it should."""

    executable: str
    wanted: str
    found: str | None
    why = "The log is the first place to look when a robot does something strange."

    @property
    def expected(self) -> str:
        """The line."""
        return f"{self.executable} writes {self.wanted!r}"

    @property
    def measured(self) -> str:
        """The most similar line."""
        return f"the nearest line is {self.found!r}" if self.found else "it wrote nothing"

    @property
    def hint(self) -> str:
        """How to write a line."""
        return "Write it with self.get_logger().info(...) in the function that has the message."


@dataclass(eq=False)
class DoesNotRepeat(Fault):
    """The listener got a message and wrote nothing about it."""

    template: str
    said: str
    wrote: str | None
    why = "A subscription only helps when its callback does something with the message."
    hint = "Is the callback the one given to create_subscription? Does it log msg.data?"

    @property
    def expected(self) -> str:
        """The echo."""
        return f"it writes {self.template.format(text=self.said)!r}"

    @property
    def measured(self) -> str:
        """What it wrote."""
        return f"it wrote {self.wrote!r}" if self.wrote else "it wrote nothing"


@dataclass(eq=False)
class FixedText(DoesNotRepeat):
    """The listener writes a text of its own, whatever it receives."""

    why = "The listener must write what it hears. This text is always the same."
    hint = "Put the message's own text into the line: its field is msg.data."


@dataclass(eq=False)
class AlmostRepeats(DoesNotRepeat):
    """The listener repeats the message inside a different sentence."""

    why = "The message arrives. Only the words around it are not the ones asked for."
    hint = "Compare the line letter by letter with the one expected."


# --- pictures ----------------------------------------------------------------------------------


@dataclass(eq=False)
class BadPicture(Fault):
    """The picture is missing, or is none."""

    path: str
    wanted: str
    found: str
    why = "The picture shows that you have looked at your own graph."

    @property
    def expected(self) -> str:
        """The picture."""
        return f"{self.path}: {self.wanted}"

    @property
    def measured(self) -> str:
        """What is there."""
        return self.found

    @property
    def hint(self) -> str:
        """How to make it."""
        return f"Run both nodes. In the package: ./roslings graph --save {self.path}"


@dataclass(eq=False)
class NoPicture(BadPicture):
    """There is no such file."""


@dataclass(eq=False)
class NotAPicture(BadPicture):
    """The file is no image of the asked kind."""


@dataclass(eq=False)
class PictureTooSmall(BadPicture):
    """The image has too few pixels."""


@dataclass(eq=False)
class OneColour(BadPicture):
    """The image shows nothing."""


@dataclass(eq=False)
class Unmet(Fault):
    """A bare `assert` of a grader did not hold."""

    sentence: str
    why = ""
    hint = "Read the lab's card again and compare."

    @property
    def expected(self) -> str:
        """The check's own sentence."""
        return self.sentence

    @property
    def measured(self) -> str:
        """That it does not hold."""
        return "it is not so"


def qos_conflict(
    kind: str, qos: Qos, reliability: str, durability: str
) -> tuple[str, str, str] | None:
    """Policy, asked, found where an endpoint cannot be joined with the contract's other side.

    DDS joins a publisher and a subscription where the publisher offers at least what the
    subscription asks for (OMG DDS 1.4, 2.2.3; the same rule as rclpy's
    qos_check_compatible).
    """
    for policy, asked, found, weak in (
        ("reliability", reliability, qos.reliability, "best_effort"),
        ("durability", durability, qos.durability, "volatile"),
    ):
        offered, requested = (found, asked) if kind == "publisher" else (asked, found)
        if offered == weak and requested != weak:
            return policy, asked, found
    return None


def _guess(near: Near) -> str:
    sentences = {
        "namespace": ": another namespace?",
        "case": ": capital letters?",
        "spelling": ": a spelling?",
    }
    return sentences.get(near.how, "")
