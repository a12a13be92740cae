"""Faults of a launch file."""

from __future__ import annotations

from dataclasses import dataclass

from roslings.capabilities.launch.graph import Part
from roslings.judge.faults.base import Fault
from roslings.judge.faults.ends import End
from roslings.judge.faults.sentences import SentencePart, one_of, plural, some_of


@dataclass(frozen=True)
class Times(SentencePart):
    """A program that runs several times."""

    name: str
    count: int
    text = plural("count", one="{name} ({count} time)", other="{name} ({count} times)")


@dataclass(frozen=True)
class PartOfGraph(SentencePart):
    """A node, or what it does with a topic."""

    part: Part
    text = one_of(
        node="{part.node}",
        publisher="{part.node} publishes {part.topic} ({part.type})",
        subscription="{part.node} subscribes to {part.topic} ({part.type})",
    )

    @property
    def which_text(self) -> str:
        """What it is."""
        return self.part.kind or "node"


@dataclass(eq=False)
class LaunchFailed(Fault):
    """The launch itself ended with an error."""

    command: str
    end: End
    why = "A launch file starts the whole robot with one command."
    expected = "`{command}` starts its nodes, and goes on until Ctrl-C"
    measured = "it ended by itself ({end})"
    hint = "Read the last lines below, mend what they name, build again, and launch again."


@dataclass(eq=False)
class ArgumentsNotShown(LaunchFailed):
    """The file could not even be read for its arguments."""

    expected = "`{command}` shows the arguments of the launch file"
    measured = "it ended with an error ({end})"


@dataclass(eq=False)
class LaunchMissesNode(LaunchFailed):
    """Not every node is there."""

    missing: str
    found: tuple[str, ...]
    expected = "`{command}` starts {missing}"

    hint = "Compare the launch file with the card, node by node. Which one is missing?"

    measured = one_of(some="the nodes are: {found}", none="the nodes are: none")
    mend = one_of(
        python="Each node needs a line Node(package=..., executable=...) of its own. {word} is the"
        " executable of setup.py. Without name=..., a node keeps the name of its code.",
        xml="Each node needs a line <node pkg=... exec=.../> of its own. {word} is the"
        " executable of setup.py. Without name=..., a node keeps the name of its code.",
    )

    @property
    def which_measured(self) -> str:
        """Whether there are nodes."""
        return "some" if self.found else "none"

    @property
    def which_mend(self) -> str:
        """In which language the launch file is."""
        return "python" if ".launch.py" in self.command else "xml"

    @property
    def word(self) -> str:
        """The attribute that names the program, in this language."""
        return "executable" if self.which_mend == "python" else "exec"


@dataclass(eq=False)
class NodeElsewhere(LaunchMissesNode):
    """The node is there, in another namespace."""

    hint = "Which nodes stand under which namespace? Look at the groups of the launch file."

    mend = (
        "A namespace is pushed for the nodes that come after it in the same group:"
        " GroupAction([PushRosNamespace(NAME), Node(...), Node(...)])."
    )


@dataclass(eq=False)
class TopicOutside(Fault):
    """A node in a namespace uses a topic that lies outside of it."""

    node: str
    namespace: str
    topic: str
    why = "Two robots that share a topic mix their messages: both obey the command for one."
    expected = "each topic of {node} lies in {namespace}"
    measured = "it uses {topic}"
    hint = "Look at the first sign of this topic's name in your code."
    mend = (
        "A name that begins with a slash stays the same in every namespace. Write it without the"
        " slash in create_publisher and create_subscription."
    )


@dataclass(eq=False)
class NamespacesDiffer(Fault):
    """Two namespaces do not hold the same graph."""

    first: str
    second: str
    only_first: tuple[PartOfGraph, ...]
    only_second: tuple[PartOfGraph, ...]
    why = "Who has learned to know one robot must find the same things in the other one."
    expected = "the graph is the same in {first} and in {second}"
    hint = "Compare what the launch file says of the one robot with what it says of the other."
    mend = (
        "Write the nodes of one robot once, in a function or in a launch file of its own, and use"
        " it twice."
    )

    measured = some_of(
        between="; ",
        first="only in {first}: {only_first}",
        second="only in {second}: {only_second}",
    )

    @property
    def which_measured(self) -> tuple[str, ...]:
        """What one of them has alone."""
        both = {"first": self.only_first, "second": self.only_second}
        return tuple(name for name, things in both.items() if things)


@dataclass(eq=False)
class WrongValueAfterLaunch(Fault):
    """A parameter of a node that was launched has another value."""

    command: str
    node: str
    name: str
    wanted: str
    found: str | None
    """None: the node has no such parameter."""
    why = "The same programs drive every robot: only the values of the file make the difference."
    expected = "after `{command}`, {name} of {node} is {wanted}"
    measured = one_of(another="it is {found}", missing="it is not there")
    hint = "Which file does this node get, and for which names do the values in it count?"
    mend = (
        "Does the node get the file, by parameters=[...]? In the file, a value counts for nodes"
        " whose full name fits: /red/beacon for one, /** for all. Below it stands ros__parameters,"
        " and below that NAME: VALUE."
    )

    @property
    def which_measured(self) -> str:
        """Whether it has any."""
        return "missing" if self.found is None else "another"


@dataclass(eq=False)
class FileIgnored(WrongValueAfterLaunch):
    """The values are those of another file than the argument names."""

    why = "Who tries other values writes another file, and does not touch the package."
    hint = "Where does the launch file take the path of the parameters from?"
    mend = (
        "Give each node the file that the argument names: parameters=[LaunchConfiguration(NAME)]."
        " A path that is put together in Python is the same in each launch."
    )


@dataclass(eq=False)
class ArgumentIgnored(WrongValueAfterLaunch):
    """An argument does not reach the parameter that it sets."""

    why = "What somebody types is newer than what stands in a file: it wins."
    hint = (
        "Follow the argument through the launch file: which node gets it, and what comes after it?"
    )
    mend = (
        "parameters=[FILE, {{NAME: LaunchConfiguration(NAME)}}]: the later one of the list wins."
        " Does each node that has the parameter get it?"
    )


@dataclass(eq=False)
class SectionOfTheNodeWins(ArgumentIgnored):
    """The argument wins over what the file says for all nodes, and not for this one."""

    measured = one_of(
        another="it is {found}, as the file says in its section {node}", missing="it is not there"
    )
    hint = "Two places give this value. Which of them fits the node's full name better?"
    mend = (
        "In the file, the section {node} comes after /**. Give the Node its name, name=..., beside"
        " its namespace: then the dictionary in parameters=[FILE, {{NAME: ...}}] counts for this"
        " full name. Without name=... it counts for /** only."
    )


@dataclass(eq=False)
class WrongArguments(Fault):
    """An argument is missing, or has another default."""

    command: str
    wanted: str
    found: tuple[str, ...]
    why = "Nobody reads a launch file to learn what can be chosen: --show-args tells."
    expected = "`{command}` shows {wanted}"
    hint = "Compare the arguments that the launch file declares with the card: names and defaults."
    mend = (
        "DeclareLaunchArgument(NAME, default_value=TEXT, description=...), with the card's names."
    )

    measured = one_of(some="it shows {found}", none="it shows no arguments")

    @property
    def which_measured(self) -> str:
        """Whether any are shown."""
        return "some" if self.found else "none"


@dataclass(eq=False)
class StartedAllTheSame(Fault):
    """Nodes were started that an argument should have left out."""

    command: str
    found: tuple[str | Times, ...]
    why = "A robot that is not there needs no nodes."
    expected = "`{command}` starts nothing there"
    hint = "On what does it depend whether these nodes are started?"
    mend = (
        "Give the group a condition: GroupAction([...],"
        " condition=IfCondition(LaunchConfiguration(NAME)))."
    )

    measured = "the nodes are: {found}"


@dataclass(eq=False)
class NothingToKill(Fault):
    """No program of this name runs, so none can be killed."""

    executable: str
    running: tuple[str, ...]
    why = "What does not run cannot come back."
    expected = "the launch runs {executable}"
    hint = "Compare executable=... in the launch file with the names in setup.py."

    measured = one_of(some="it runs {running}", none="it runs nothing of the package")

    @property
    def which_measured(self) -> str:
        """What runs."""
        return "some" if self.running else "none"


@dataclass(eq=False)
class NotBack(Fault):
    """A node that was killed did not come back in time."""

    node: str
    within_s: float
    after_s: float | None
    why = "Programs crash. A robot whose node comes back by itself drives on."
    expected = "{node} answers again within {within_s:g} s of being killed"
    hint = "What in the launch file says that a node is to be started again?"
    mend = (
        "Node(..., respawn=True) starts it again. respawn_delay=SECONDS makes that wait;"
        " respawn_max_retries=NUMBER ends it."
    )

    measured = one_of(late="it answered again after {after_s:.1f} s", never="it did not come back")

    @property
    def which_measured(self) -> str:
        """Whether it was back at all."""
        return "never" if self.after_s is None else "late"


@dataclass(eq=False)
class LeftByTheLaunch(Fault):
    """Processes that the launch has started outlive it."""

    command: str
    count: int
    was_seen = True
    why = "A forgotten node still commands the motors, and the next launch meets it."
    expected = "after Ctrl-C, nothing that `{command}` has started still runs"
    measured = plural(
        "count",
        one="{count} process still ran after it had ended",
        other="{count} processes still ran after it had ended",
    )
    hint = "What does the launch file start besides nodes?"
    mend = (
        "Start nodes with Node(...) alone: the launch ends these. What a launch file starts with"
        " subprocess, nobody ends."
    )


@dataclass(eq=False)
class LaunchDoesNotEnd(LeftByTheLaunch):
    """Ctrl-C does not end the launch in time."""

    within_s: float
    after_s: float | None
    why = "Who cannot stop a robot's program with Ctrl-C cannot stop the robot."
    expected = "`{command}` ends within {within_s:g} s of Ctrl-C"
    hint = (
        "A launch waits for its nodes. Which one does not end? `ros2 run` and Ctrl-C tell, for each"
        " node alone."
    )

    measured = one_of(
        late="it ended after {after_s:.1f} s",
        never="it was still running and had to be killed",
    )

    @property
    def which_measured(self) -> str:
        """Whether it ended at all."""
        return "never" if self.after_s is None else "late"
