"""Faults of a process."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Literal

from roslings.judge.faults.base import Fault
from roslings.judge.faults.ends import End
from roslings.judge.faults.sentences import Text, one_of, plural

READ_THE_LINES = (
    "Read the last lines below: the last one names the error, the one above it the place."
)

Does = Literal["task", "calls", "sends", "writes"]
"""What a program with one task has to do."""


def shows_error(log: Sequence[str]) -> bool:
    """The last lines of a process hold a traceback."""
    return any(line.startswith("Traceback") for line in log)


@dataclass(eq=False)
class DidNotComeUp(Fault):
    """The process ended before its node could do anything, or never made a node."""

    executable: str
    after_s: float | None = None
    """Seconds from its start until it ended; None: it runs, and has no node."""
    end: End | None = None
    when: Text = field(default="", kw_only=True)
    was_seen = True
    why = "A node that ends at once can neither send nor receive."

    expected = one_of(
        always="{executable} starts, makes a node and keeps running",
        when="{when}, {executable} starts, makes a node and keeps running",
    )
    measured = one_of(
        ended="it ended by itself after {after_s:.1f} s ({end})",
        no_node="it runs, but no node of it appeared in the graph",
    )
    hint = one_of(
        read=READ_THE_LINES,
        by_hand="Start it by hand with `ros2 run` and read the last line of what it prints. "
        "Without an error: what does main() do last?",
    )

    @property
    def which_expected(self) -> str:
        """Whether a case is spoken of."""
        return "when" if self.when else "always"

    @property
    def which_measured(self) -> str:
        """How it went."""
        return "no_node" if self.after_s is None else "ended"

    @property
    def which_hint(self) -> str:
        """Whether the last lines tell."""
        return "read" if shows_error(self.log) else "by_hand"


@dataclass(eq=False)
class EndedWithError(Fault):
    """A program that has one task, and then ends, ended with an error before it had done it."""

    executable: str
    does: Does
    """What it has to do."""
    end: End
    what: str = ""
    """What it calls, to what it sends, or what it writes."""
    when: Text = ""
    """In which case it writes that."""
    was_seen = True
    why = "An error that nobody catches ends the program at once."
    hint = READ_THE_LINES
    expected = one_of(
        task="{executable} does its task",
        calls="{executable} calls {what}",
        sends="{executable} sends a goal to {what}",
        writes="{executable} writes {what!r} {when}",
    )
    measured = "it ended with an error before that ({end})"

    @property
    def which_expected(self) -> str:
        """What it has to do."""
        return self.does


@dataclass(eq=False)
class StoppedByItself(Fault):
    """The node ran for a while and then ended, though nobody asked it to."""

    executable: str
    after_s: float
    end: End
    when: Text = field(default="", kw_only=True)
    simulated: bool = field(default=False, kw_only=True)
    """The seconds are of simulated time, which ran faster than ours."""
    was_seen = True
    why = "A robot's node runs until somebody stops it."

    hint = READ_THE_LINES
    expected = one_of(
        always="{executable} runs until Ctrl-C", when="{when}, {executable} runs until Ctrl-C"
    )
    measured = one_of(
        real="it ended by itself after {after_s:.1f} s ({end})",
        simulated="it ended by itself after {after_s:.1f} s of simulated time ({end})",
    )

    @property
    def which_expected(self) -> str:
        """Whether a case is spoken of."""
        return "when" if self.when else "always"

    @property
    def which_measured(self) -> str:
        """Whose seconds these are."""
        return "simulated" if self.simulated else "real"


@dataclass(eq=False)
class EndedInTheSoak(StoppedByItself):
    """The node did all that was asked of it, and ended later, with nobody near it."""

    blocks = False
    why = "A robot's node runs until somebody stops it, not only for the first seconds."

    hint = one_of(
        read=READ_THE_LINES,
        by_hand="Start it by hand with `ros2 run`, and wait {longer_s:.0f} s. What counts up, "
        "fills up or runs out while it runs?",
    )

    @property
    def which_hint(self) -> str:
        """Whether the last lines tell."""
        return "read" if shows_error(self.log) else "by_hand"

    @property
    def longer_s(self) -> float:
        """So long, and it will have ended."""
        return self.after_s + 5


@dataclass(eq=False)
class PrintsWithoutEnd(Fault):
    """It writes line after line without a pause, and was ended for it."""

    executable: str
    lines: int
    megabytes: float
    after_s: float
    was_seen = True
    blocks = False
    why = (
        "In a terminal that runs full nobody finds the line that matters, and what prints all the"
        " time leaves no processor to the others."
    )
    hint = (
        "Which loop prints, and what makes it wait? Print in a callback or a timer, or only when "
        "something is new."
    )
    expected = "{executable} writes a line when there is something to tell, and waits in between"
    measured = plural(
        "lines",
        one="it wrote {lines:,} line ({megabytes:.1f} MB) in {after_s:.1f} s and did not stop, so"
        " it"
        " was ended",
        other="it wrote {lines:,} lines ({megabytes:.1f} MB) in {after_s:.1f} s and did not stop,"
        " so"
        " it was ended",
    )

    @property
    def program(self) -> str:
        """Without the arguments that it was started with."""
        return " ".join(
            word for word in self.executable.split() if not (":=" in word or word.startswith("--"))
        )


@dataclass(eq=False)
class DoesNotEnd(Fault):
    """Ctrl-C does not end the node in time."""

    executable: str
    within_s: float
    after_s: float | None
    was_seen = True
    why = "Who cannot stop a robot's program with Ctrl-C cannot stop the robot."
    hint = "Does your code catch KeyboardInterrupt and go on, or wait in a loop that never ends?"
    expected = "{executable} ends within {within_s:g} s of Ctrl-C"

    measured = one_of(
        late="it ended after {after_s:.1f} s",
        never="it was still running and had to be killed",
    )

    @property
    def which_measured(self) -> str:
        """Whether it ended at all."""
        return "never" if self.after_s is None else "late"


@dataclass(eq=False)
class UncleanExit(Fault):
    """Ctrl-C ends the node with an error."""

    executable: str
    end: End
    has_traceback: bool = False
    was_seen = True
    why = (
        "Much tutorial code ends like this. It is a small thing, but other programs take the "
        "error for a crash."
    )
    hint = "What does your program do when Ctrl-C comes? The last lines below tell where it was."
    mend = (
        "Catch KeyboardInterrupt and ExternalShutdownException around rclpy.spin(), and end "
        "with rclpy.try_shutdown()."
    )
    expected = "{executable} ends after Ctrl-C with exit code 0 and no traceback"

    measured = one_of(plain="{end}", traceback="{end}, with a traceback")

    @property
    def which_measured(self) -> str:
        """What it wrote."""
        return "traceback" if self.has_traceback else "plain"


@dataclass(eq=False)
class LeavesProcesses(Fault):
    """The node ended, but processes that it started did not."""

    executable: str
    count: int
    was_seen = True
    why = "A forgotten process still sends messages, and the next start meets it."
    hint = "What does your node start besides itself, and who ends it?"
    mend = "End what your node starts (subprocess, multiprocessing) before the node itself ends."
    expected = "nothing that {executable} started outlives it"
    measured = plural(
        "count",
        one="{count} process still ran after it had ended",
        other="{count} processes still ran after it had ended",
    )
