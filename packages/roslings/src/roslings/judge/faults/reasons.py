"""Why a check says neither yes nor no: this computer was in its way, or there is nothing to see."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from roslings.judge.faults.base import Inconclusive, NothingToJudge
from roslings.judge.faults.sentences import SentencePart, Text, one_of, plural

# --- it cannot be told -------------------------------------------------------------------------


@dataclass(eq=False)
class StoodStill(Inconclusive):
    """This computer did not even run the observer."""

    seconds: float
    node_is_missing: bool = False
    """A node that ends soon may be gone before it is seen."""
    text = one_of(
        meanwhile="this computer stood still for {seconds:.1f} s while your nodes ran;"
        " close other programs and check again",
        missing="no node was seen, and this computer stood still for {seconds:.1f} s;"
        " close other programs and check again",
    )

    @property
    def which_text(self) -> str:
        """What that may explain."""
        return "missing" if self.node_is_missing else "meanwhile"


@dataclass(eq=False)
class NoProcessor(Inconclusive):
    """A process ended late, and got no processor."""

    executable: str
    waited_s: float
    text = (
        "{executable} ended late, but its threads waited for a processor for {waited_s:.1f} s"
        " meanwhile; close other programs and check again"
    )


@dataclass(eq=False)
class HeldUp(Inconclusive):
    """Something came late, and this computer may have made it so."""

    what: Text
    held_s: float
    text = (
        "{what} came late, but this computer held your node or the check up for {held_s:.2f} s"
        " meanwhile; close other programs and check again"
    )


@dataclass(eq=False)
class NotBuilt(Inconclusive):
    """No build was tried."""

    text = "colcon was not run"


@dataclass(eq=False)
class EndNotKept(Inconclusive):
    """What a process wrote at its end found no room in the evidence."""

    executable: str
    bytes: int
    text = plural(
        "bytes",
        one="too much to keep: {bytes} byte that {executable} wrote had no room in the evidence,"
        " some from after Ctrl-C; let it write less, then check again",
        other="too much to keep: {bytes} bytes that {executable} wrote had no room in the"
        " evidence, some from after Ctrl-C; let it write less, then check again",
    )


@dataclass(eq=False)
class EndNotSeen(Inconclusive):
    """Ctrl-C came in a moment in which rclpy itself does not hear it."""

    executable: str
    text = (
        "Ctrl-C met {executable} while rclpy itself was at work, and what it does at its end was"
        " not seen; check again"
    )


@dataclass(eq=False)
class RunsDiffer(Inconclusive):
    """It ended badly, and in another run it did not."""

    executable: str
    ended: Literal["late", "with_error"]
    text = one_of(
        late="{executable} ended late in one of two runs, and in the other it did not; check again",
        with_error="{executable} ended with an error in one of two runs, and in the other it did"
        " not; check again",
    )

    @property
    def which_text(self) -> str:
        """How it ended."""
        return self.ended


@dataclass(eq=False)
class TimesNotBelieved(Inconclusive):
    """The evidence itself says that its times tell nothing."""

    reason: str
    """In the words of the evidence."""
    simulated: bool = False
    text = one_of(
        real="{reason}; close other programs and check again",
        simulated="in simulated time, {reason}; check again with `--clock auto`",
    )

    @property
    def which_text(self) -> str:
        """Which clock it was."""
        return "simulated" if self.simulated else "real"


@dataclass(eq=False)
class NotRecorded(Inconclusive):
    """A grader asks for an experiment that old evidence does not have."""

    name: str
    text = "too little evidence: {name!r} was not recorded then; check the package again"


@dataclass(eq=False)
class NewerPart(Inconclusive):
    """A part of the evidence was written by a newer capability than the one that is here."""

    name: str
    version: int
    text = (
        "the evidence of {name} has version {version}, which this roslings cannot read;"
        " bring roslings up to date"
    )


@dataclass(frozen=True)
class Dropped(SentencePart):
    """Something of which a part found no room in the evidence."""

    kind: Literal[
        "rosout", "graph", "requests", "topics", "messages", "some_messages", "content", "output"
    ]
    count: int
    of: str
    """The experiment, the topic, or the executable."""
    text = one_of(
        rosout=plural(
            "count",
            one="{count} line in /rosout of {of!r}",
            other="{count} lines in /rosout of {of!r}",
        ),
        graph=plural(
            "count",
            one="{count} name, publisher or subscription in the graph of {of!r}",
            other="{count} names, publishers and subscriptions in the graph of {of!r}",
        ),
        requests=plural(
            "count",
            one="{count} request to the grader of {of!r}",
            other="{count} requests to the grader of {of!r}",
        ),
        topics=plural("count", one="{count} topic of {of!r}", other="{count} topics of {of!r}"),
        messages=plural("count", one="{count} message on {of}", other="{count} messages on {of}"),
        some_messages="some messages on {of}",
        content=plural(
            "count",
            one="what {count} message on {of} holds",
            other="what {count} messages on {of} hold",
        ),
        output=plural(
            "count",
            one="{count} byte that {of} wrote",
            other="{count} bytes that {of} wrote",
        ),
    )

    @property
    def which_text(self) -> str:
        """What it is."""
        return self.kind


@dataclass(eq=False)
class TooMuchToKeep(Inconclusive):
    """A check rests on what found no room in the evidence."""

    dropped: tuple[Dropped, ...]
    text = one_of(
        one="too much to keep: {dropped} had no room in the evidence, so this cannot be told;"
        " let your package send and write less, then check again",
        two="too much to keep: {dropped[0]} and {dropped[1]} had no room in the evidence, so this"
        " cannot be told; let your package send and write less, then check again",
        more="too much to keep: {dropped} had no room in the evidence, so this cannot be told;"
        " let your package send and write less, then check again",
    )

    @property
    def which_text(self) -> str:
        """How many kinds of thing."""
        return {1: "one", 2: "two"}.get(len(self.dropped), "more")


@dataclass(eq=False)
class CheckAgain(Inconclusive):
    """There was nothing to look at, and no other check says why."""

    reason: NothingToJudge
    text = "{reason}; check again"


# --- there is nothing to look at ---------------------------------------------------------------


@dataclass(eq=False)
class FirstMend(NothingToJudge):
    """Another check found why."""

    title: str
    """The other check's."""
    text = "first mend: {title}"


@dataclass(eq=False)
class NothingSeen(NothingToJudge):
    """What this check looks at is not there."""

    what: Literal[
        "endpoint",
        "texts",
        "numbers",
        "process",
        "node",
        "topic",
        "messages",
        "spoken",
        "end",
        "clean_end",
    ]
    name: str = ""
    """Of `process` the executable, of `endpoint` its kind."""
    text = one_of(
        publisher="there is no publisher to look at",
        subscription="there is no subscription to look at",
        texts="the messages hold no text",
        numbers="no number can be read from the texts",
        process="{name} was not started",
        node="no node was seen in the graph",
        topic="no topic was published",
        messages="there was no message to write about",
        spoken="nothing could be said to it",
        end="it ended before it was asked to",
        clean_end="it did not end after Ctrl-C",
    )

    @property
    def which_text(self) -> str:
        """What it is."""
        return self.name if self.what == "endpoint" else self.what


# --- a check that passes -----------------------------------------------------------------------


@dataclass(frozen=True)
class Ran(SentencePart):
    """How long a process ran, and by which clock."""

    seconds: float
    how: Literal["real", "simulated", "alone"] = "real"
    text = one_of(
        real="ran {seconds:.0f} s",
        simulated="ran {seconds:.0f} s simulated",
        alone="{seconds:.0f} s left alone",
    )

    @property
    def which_text(self) -> str:
        """By which clock, and with whom."""
        return self.how


# --- a grader that is wrong itself -------------------------------------------------------------


@dataclass(frozen=True)
class GraderFailed(SentencePart):
    """What a check says that cannot tell since the grader broke off."""

    mistake: str = ""
    """Where it is, and what Python says; empty where that is not known."""
    text = one_of(
        unknown="the grader itself failed here: tell your instructor",
        mistake="the grader itself failed here: {mistake}. Who writes the lab mends this line; who"
        " does the lab tells the instructor",
    )

    @property
    def which_text(self) -> str:
        """Whether it is known."""
        return "mistake" if self.mistake else "unknown"
