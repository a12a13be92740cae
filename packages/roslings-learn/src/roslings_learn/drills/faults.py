"""The faults that only a drill has; all others are those of the labs."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from roslings.capabilities.services.faults import ClientStays, WrongExitCode
from roslings.judge.faults import Fault
from roslings.judge.faults.moments import When
from roslings.judge.faults.processes import READ_THE_LINES, DidNotComeUp, shows_error
from roslings.judge.faults.sentences import one_of

AT_ITS_END = When("done")


@dataclass(eq=False)
class NoAnswerYet(Fault):
    """The student has not said what will happen."""

    question: str
    why = "Who says first what will happen, and then looks, remembers it."
    measured = "ANSWER is still None: the file holds no answer yet"
    expected = "your answer to: {question}"
    hint = "Write your answer behind ANSWER = , then save. Texts stand in quotes, numbers not."


@dataclass(eq=False)
class WrongPrediction(Fault):
    """The run showed something else."""

    UNTOLD = ("log", "shown", "because")
    said: Any
    shown: Any
    because: str
    why = "Now you know it, and next time you see it before it happens."
    expected = "{said!r}, as you said"
    measured = "the run did not show {said!r}"
    hint = "Read the program once more, line by line, as the computer does. Then answer again."


@dataclass(eq=False)
class ProgramChanged(Fault):
    """More than the answer was changed."""

    line: int
    why = "The question is about this program, not about another one."
    expected = "the program as it was; only the line with ANSWER is yours"
    hint = (
        "Undo your changes but the one to ANSWER. For a fresh file, delete yours and start again."
    )
    measured = "line {line} is not as it was"


@dataclass(eq=False)
class NeverSpins(Fault):
    """The node is there, and runs none of its callbacks."""

    node: str
    expected = "a node that runs its callbacks: timers, subscriptions, services"
    why = "ROS puts what comes into a queue. Only spinning takes it out and calls your function."
    hint = "What keeps main() busy, and does a callback wait or loop?"
    mend = "What keeps main() busy? It must be rclpy.spin(node), and no callback may wait or loop."
    measured = "{node} is there, but it runs no callback"


@dataclass(eq=False)
class ScriptMakesNoNode(DidNotComeUp):
    """A script ended before its node could do anything, or no node of it can be found."""

    hint = one_of(
        hidden="It runs, but nobody finds it. Which line says who may find it, and where?",
        by_hand="Run it by hand with `bash`, and read from the top. Compare each name by its"
        " letters.",
    )

    @property
    def which_hint(self) -> str:
        """What to look at in a script."""
        return "hidden" if self.after_s is None else "by_hand"


@dataclass(eq=False)
class NotPrinted(Fault):
    """A text that should stand in the output does not."""

    wanted: str
    found: str | None
    why = "What a program prints is all that you see of it in a terminal."
    expected = "the output holds {wanted!r}"

    measured = one_of(another="it printed {found!r}", nothing="it printed nothing")
    hint = one_of(
        read=READ_THE_LINES,
        by_hand="Run the file by hand in a terminal, and read what it prints from the top.",
    )

    @property
    def which_measured(self) -> str:
        """The nearest line or the first one, or that there is none."""
        return "another" if self.found else "nothing"

    @property
    def which_hint(self) -> str:
        """Read its last words, or run it by hand."""
        return "read" if shows_error(self.log) else "by_hand"


@dataclass(eq=False)
class PrintedAnyway(NotPrinted):
    """A text stands in the output that should not."""

    was_seen = True
    expected = "the output does not hold {wanted!r}"
    measured = "it printed {found!r}"


@dataclass(eq=False)
class RunsOn(ClientStays):
    """A program that has one task did not end."""

    why = "Who starts it waits until it ends."
    hint = "What does it wait for, after its task is done?"
    mend = "What does it wait for? Does it spin for ever, where it should spin until it is done?"


@dataclass(eq=False)
class OtherExitCode(WrongExitCode):
    """A program that makes no node ended with another exit code."""

    hint = READ_THE_LINES
    was_seen = True


@dataclass(eq=False)
class CancelUnheard(Fault):
    """The goal was over before the server looked at the request to cancel it."""

    expected = "a request to cancel is heard while the goal is under way"
    measured = "nobody heard the request to cancel: the goal was over before"
    why = "A robot that hears Stop only when it has arrived does not stop."
    hint = "Who hears a request to cancel, while the execute callback works?"
    mend = (
        "Who hears it while the execute callback works? Let the loop await a tick, so that it does"
        " not keep the thread; or give the node a second thread."
    )


@dataclass(eq=False)
class WrongGoal(Fault):
    """A goal that the program gives holds something else."""

    action: str
    wanted: str
    found: str
    why = "A robot does what the goal says, and not what you meant."
    hint = "Look where the goal is made: which field gets which value? A field left out is 0."
    was_seen = True
    expected = "{action} gets the goal {wanted}"
    measured = "{action} got the goal {found}"
