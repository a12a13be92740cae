"""Faults of a process."""

from __future__ import annotations

from dataclasses import dataclass, field

from roslings.judge.faults.base import Fault

READ_THE_LINES = (
    "Read the last lines below: the last one names the error, the one above it the place."
)


def _begin(when: str) -> str:
    """The case that is spoken of, as the beginning of a sentence."""
    return f"{when}, " if when else ""


@dataclass(eq=False)
class DidNotComeUp(Fault):
    """The process ended before its node could do anything, or never made a node."""

    executable: str
    how: str
    when: str = field(default="", kw_only=True)
    was_seen = True
    why = "A node that ends at once can neither send nor receive."

    @property
    def expected(self) -> str:
        """A running node."""
        return f"{_begin(self.when)}{self.executable} starts, makes a node and keeps running"

    @property
    def measured(self) -> str:
        """How it went."""
        return self.how

    @property
    def hint(self) -> str:
        """What to try."""
        if any(line.startswith("Traceback") for line in self.log):
            return READ_THE_LINES
        return (
            "Start it by hand with `ros2 run` and read the last line of what it prints. "
            "Without an error: what does main() do last?"
        )


@dataclass(eq=False)
class EndedWithError(Fault):
    """A program that has one task, and then ends, ended with an error before it had done it."""

    executable: str
    task: str
    status: str
    was_seen = True
    why = "An error that nobody catches ends the program at once."
    hint = READ_THE_LINES
    expected = "{executable} {task}"
    measured = "it ended with an error before that ({status})"


@dataclass(eq=False)
class StoppedByItself(Fault):
    """The node ran for a while and then ended, though nobody asked it to."""

    executable: str
    after_s: float
    how: str
    when: str = field(default="", kw_only=True)
    simulated: bool = field(default=False, kw_only=True)
    """The seconds are of simulated time, which ran faster than ours."""
    was_seen = True
    why = "A robot's node runs until somebody stops it."

    @property
    def expected(self) -> str:
        """A node that stays."""
        return f"{_begin(self.when)}{self.executable} runs until Ctrl-C"

    @property
    def measured(self) -> str:
        """When it ended, and how."""
        time = " of simulated time" if self.simulated else ""
        return f"it ended by itself after {self.after_s:.1f} s{time} ({self.how})"

    @property
    def hint(self) -> str:
        """What to try."""
        return READ_THE_LINES


@dataclass(eq=False)
class EndedInTheSoak(StoppedByItself):
    """The node did all that was asked of it, and ended later, with nobody near it."""

    blocks = False
    why = "A robot's node runs until somebody stops it, not only for the first seconds."

    @property
    def hint(self) -> str:
        """What to try."""
        if any(line.startswith("Traceback") for line in self.log):
            return READ_THE_LINES
        return (
            f"Start it by hand with `ros2 run`, and wait {self.after_s + 5:.0f} s. What counts up, "
            "fills up or runs out while it runs?"
        )


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
    measured = (
        "it wrote {lines:,} lines ({megabytes:.1f} MB) in {after_s:.1f} s and did not stop, so it"
        " was ended"
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

    @property
    def measured(self) -> str:
        """How it ended."""
        return self.how


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
    measured = "{count} process(es) still ran after it had ended"
