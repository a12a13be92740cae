"""Faults of a launch file."""

from __future__ import annotations

from dataclasses import dataclass

from roslings.judge.faults.base import Fault


@dataclass(eq=False)
class LaunchFailed(Fault):
    """The launch itself ended with an error."""

    command: str
    how: str
    why = "A launch file starts the whole robot with one command."
    expected = "`{command}` starts its nodes, and goes on until Ctrl-C"
    measured = "it ended by itself ({how})"
    hint = "Read the last lines below, mend what they name, build again, and launch again."


@dataclass(eq=False)
class ArgumentsNotShown(LaunchFailed):
    """The file could not even be read for its arguments."""

    expected = "`{command}` shows the arguments of the launch file"
    measured = "it ended with an error ({how})"


@dataclass(eq=False)
class LaunchMissesNode(LaunchFailed):
    """Not every node is there."""

    missing: str
    found: tuple[str, ...]
    expected = "`{command}` starts {missing}"

    hint = "Compare the launch file with the card, node by node. Which one is missing?"

    @property
    def measured(self) -> str:  # type: ignore[override]
        """The nodes that are there."""
        return f"the nodes are: {', '.join(self.found) or 'none'}"

    @property
    def mend(self) -> str:
        """What to compare."""
        line = "<node pkg=... exec=.../>"
        word = "exec"
        if ".launch.py" in self.command:
            line, word = "Node(package=..., executable=...)", "executable"
        return (
            f"Each node needs a line {line} of its own. {word} is the executable of setup.py."
            " Without name=..., a node keeps the name of its code."
        )


@dataclass(eq=False)
class NodeElsewhere(LaunchMissesNode):
    """The node is there, in another namespace."""

    hint = "Which nodes stand under which namespace? Look at the groups of the launch file."

    @property
    def mend(self) -> str:
        """What makes a namespace."""
        return (
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
    only_first: tuple[str, ...]
    only_second: tuple[str, ...]
    why = "Who has learned to know one robot must find the same things in the other one."
    expected = "the graph is the same in {first} and in {second}"
    hint = "Compare what the launch file says of the one robot with what it says of the other."
    mend = (
        "Write the nodes of one robot once, in a function or in a launch file of its own, and use"
        " it twice."
    )

    @property
    def measured(self) -> str:
        """What one of them has alone."""
        both = ((self.first, self.only_first), (self.second, self.only_second))
        return "; ".join(f"only in {name}: {', '.join(things)}" for name, things in both if things)


@dataclass(eq=False)
class WrongValueAfterLaunch(Fault):
    """A parameter of a node that was launched has another value."""

    command: str
    node: str
    name: str
    wanted: str
    found: str
    why = "The same programs drive every robot: only the values of the file make the difference."
    expected = "after `{command}`, {name} of {node} is {wanted}"
    measured = "it is {found}"
    hint = "Which file does this node get, and for which names do the values in it count?"
    mend = (
        "Does the node get the file, by parameters=[...]? In the file, a value counts for nodes"
        " whose full name fits: /red/beacon for one, /** for all. Below it stands ros__parameters,"
        " and below that NAME: VALUE."
    )


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

    measured = "it is {found}, as the file says in its section {node}"
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

    @property
    def measured(self) -> str:
        """The arguments that are shown."""
        return f"it shows {', '.join(self.found) or 'no arguments'}"


@dataclass(eq=False)
class StartedAllTheSame(Fault):
    """Nodes were started that an argument should have left out."""

    command: str
    found: tuple[str, ...]
    why = "A robot that is not there needs no nodes."
    expected = "`{command}` starts nothing there"
    hint = "On what does it depend whether these nodes are started?"
    mend = (
        "Give the group a condition: GroupAction([...],"
        " condition=IfCondition(LaunchConfiguration(NAME)))."
    )

    @property
    def measured(self) -> str:
        """What is there."""
        return f"the nodes are: {', '.join(self.found)}"


@dataclass(eq=False)
class NothingToKill(Fault):
    """No program of this name runs, so none can be killed."""

    executable: str
    running: tuple[str, ...]
    why = "What does not run cannot come back."
    expected = "the launch runs {executable}"
    hint = "Compare executable=... in the launch file with the names in setup.py."

    @property
    def measured(self) -> str:
        """What runs."""
        return f"it runs {', '.join(self.running) or 'nothing of the package'}"


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

    @property
    def measured(self) -> str:
        """When it was back."""
        if self.after_s is None:
            return "it did not come back"
        return f"it answered again after {self.after_s:.1f} s"


@dataclass(eq=False)
class LeftByTheLaunch(Fault):
    """Processes that the launch has started outlive it."""

    command: str
    count: int
    was_seen = True
    why = "A forgotten node still commands the motors, and the next launch meets it."
    expected = "after Ctrl-C, nothing that `{command}` has started still runs"
    measured = "{count} process(es) still ran after it had ended"
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

    @property
    def measured(self) -> str:  # type: ignore[override]
        """The time that it took."""
        if self.after_s is None:
            return "it was still running and had to be killed"
        return f"it ended after {self.after_s:.1f} s"
