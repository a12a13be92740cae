"""Faults of a program that reads bags, and of a diagnosis."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from graders.black_box.diagnosis import Entry, Problem
from roslings.judge.faults.base import Fault
from roslings.judge.faults.ends import End
from roslings.judge.faults.processes import READ_THE_LINES, shows_error
from roslings.judge.faults.sentences import SentencePart, Text, one_of, plural, some_of

COMPARE = "Compare your line with this one, letter by letter; a path is written in full."
RETURN = "main() returns the exit code: `return {exit_code}`."


@dataclass(frozen=True)
class WhenRead(SentencePart):
    """When a program that reads something has done it."""

    of: str
    text = "when it has read {of}"


@dataclass(frozen=True)
class Where(SentencePart):
    """The case that a card speaks of, in its words."""

    case: str
    text = "where {case}"


@dataclass(frozen=True)
class Number(SentencePart):
    """What a number tells."""

    of: Literal["duration", "distance", "top_speed", "count", "rate"]
    topic: str = ""
    text = one_of(
        duration="duration",
        distance="distance",
        top_speed="top speed",
        count="messages on {topic}",
        rate="rate of {topic} in Hz",
    )

    @property
    def which_text(self) -> str:
        """Which number it is."""
        return self.of


@dataclass(eq=False)
class ReadingFails(Fault):
    """The program ends with an error, or with another exit code."""

    executable: str
    end: End
    of: str
    why = "Who starts a program in a script sees by its exit code whether all went well."
    expected = "{executable} reads {of}, and ends by itself with exit code 0"
    measured = "it ended with {end}"
    hint = (
        "Read the last lines below: they name the file, the line and the mistake. A type that is"
        " not installed belongs to a topic whose messages need not be deserialized."
    )


@dataclass(eq=False)
class ReadingNeverEnds(Fault):
    """The program is still there when all is read."""

    executable: str
    seconds: float
    when: Text
    why = "A program that tells about a file has one task, and ends after it."
    expected = "{executable} ends by itself {when}"
    measured = "after {seconds:.0f} s it was still running"
    hint = "Is there a spin() in it, or a loop in which has_next() is never asked again?"


@dataclass(eq=False)
class TellsNothing(Fault):
    """The program ends well, and has written nothing."""

    executable: str
    of: str
    why = "Nobody can see what a silent program has read."
    expected = "{executable} reads {of}, and writes lines about it"
    measured = "it ended with exit code 0, and wrote no line"
    hint = (
        "Does main() call the function that reads the bag, and is there a print()? Begin with the"
        " first line of the card."
    )


@dataclass(eq=False)
class LineMissing(Fault):
    """No line of the program is like the one of the card."""

    line: str
    near: str | None
    wrote: int
    why = "Other programs read these lines, so each letter of them counts."
    expected = "a line `{line}`"
    hint = "Compare the text that you write with the card: blanks, colons and units, too."

    measured = one_of(
        near="it wrote `{near}`",
        some=plural(
            "wrote",
            one="its only line is not like it",
            other="none of its {wrote} lines is like it",
        ),
        none="it wrote no line",
    )

    @property
    def which_measured(self) -> str:
        """The line that is nearest to it."""
        if self.near is not None:
            return "near"
        return "some" if self.wrote else "none"


@dataclass(eq=False)
class LineTwice(Fault):
    """The same thing is told twice."""

    line: str
    times: int
    was_seen = True
    why = "Of two lines about one thing, nobody knows which one is right."
    expected = "one line `{line}`"
    measured = plural("times", one="it wrote {times} of them", other="it wrote {times} of them")
    hint = "Does what writes it stand inside of the loop over all messages?"


@dataclass(eq=False)
class WrongNumber(Fault):
    """A number is not what the bag holds."""

    what: Number
    wanted: str
    found: str
    about: str
    was_seen = True
    why = "The bag was made a moment ago, so the truth about it is known."
    expected = "{what}: {wanted}"
    measured = "it says {found}"
    hint = "The card says: {about}. Which messages, and which time, does your code take?"


@dataclass(eq=False)
class UnknownTopicTold(Fault):
    """A topic is told that the bag does not have."""

    topic: str
    there: tuple[str, ...]
    was_seen = True
    why = "Who looks for a fault must be able to rely on what is there."
    measured = "it tells of {topic}, which the bag does not have"
    hint = "Where does your code take the names of the topics from?"
    mend = "get_all_topics_and_types() of the reader gives the topics of this bag."

    expected = "lines about the topics of the bag: {there}"


@dataclass(eq=False)
class GapMissed(Fault):
    """A gap is not told, or with other numbers."""

    wanted: str
    topic: str
    told: tuple[str, ...]
    """Lines about this topic that fit no gap, or are not written as the card says."""
    right: tuple[str, ...]
    """Those of other gaps of this topic."""
    limit: float
    why = "A gap is often the first sign of a fault: a cable, a node that hung, a full computer."
    expected = "`{wanted}`"
    hint = (
        "A gap is longer than {limit:g} usual periods of its own topic. START is the time of the"
        " message before the gap."
    )

    measured = one_of(
        told="it wrote {quoted}",
        right="of the gaps of {topic} it wrote only {quoted}",
        none="it wrote no line about a gap of {topic}",
    )

    @property
    def which_measured(self) -> str:
        """What is told of this topic."""
        return "told" if self.told else "right" if self.right else "none"

    @property
    def quoted(self) -> tuple[str, ...]:
        """The lines about this topic."""
        return tuple(f"`{line}`" for line in self.told or self.right)


@dataclass(eq=False)
class NoGap(Fault):
    """A gap is told where there is none."""

    told: str
    limit: float
    periods: float | None
    was_seen = True
    why = "A warning that comes for nothing is soon read by nobody."
    expected = "a line for each time of more than {limit:g} usual periods, and no other"
    hint = "Which period does your code compare this time with?"
    mend = "Compare each time with the usual period (median) of its own topic, times {limit:g}."

    measured = one_of(
        no_pause="it wrote `{told}`; the bag has no such pause",
        pause="it wrote `{told}`, which is {periods:.1f} usual periods",
    )

    @property
    def which_measured(self) -> str:
        """Whether there is a pause at all."""
        return "no_pause" if self.periods is None else "pause"


@dataclass(eq=False)
class RefusalMissing(Fault):
    """The program does not say what it cannot read."""

    when: str
    line: str
    exit_code: int
    near: str | None
    """The line that is nearest to it; None where there is none."""
    is_told: bool
    end: End
    why = "A program that cannot do its task says why, and its exit code says so, too."
    expected = "where {when}: the line `{line}`, and exit code {exit_code}"

    measured = one_of(
        told="it wrote the line, and ended with {end}",
        near="it wrote `{near}`; it ended with {end}",
        none="there is no such line; it ended with {end}",
    )

    hint = one_of(cure=READ_THE_LINES, compare=COMPARE, code=RETURN)

    @property
    def which_measured(self) -> str:
        """Its line, or the nearest one."""
        return "told" if self.is_told else "near" if self.near else "none"

    @property
    def which_hint(self) -> str:
        """What is wrong: an error, the line or the exit code."""
        if shows_error(self.log):
            return "cure"
        return "code" if self.is_told else "compare"


@dataclass(eq=False)
class NoBagNotTold(RefusalMissing):
    """There is no bag, and the program does not say so."""

    hint = one_of(
        cure="A bag that cannot be opened is a RuntimeError of reader.open(). Catch it around this"
        " one line, write what the card says, and return the exit code.",
        compare=COMPARE,
        code=RETURN,
    )


@dataclass(eq=False)
class NoDriveNotTold(RefusalMissing):
    """No message tells of the drive, and the program does not say so."""

    hint = one_of(
        cure="Without a message of the drive, your list of them is empty. Look at that before you"
        " reckon with its first element.",
        compare=COMPARE,
        code=RETURN,
    )


# --- the diagnosis -----------------------------------------------------------------------------


@dataclass(eq=False)
class NoDiagnosis(Fault):
    """The file is not there."""

    path: str
    why = "The diagnosis is handed in with the package."
    expected = "the file {path}, beside package.xml"
    measured = "there is no such file"
    hint = "`./roslings diff` shows what the starter has. Put the file there again."


@dataclass(eq=False)
class UnreadableDiagnosis(Fault):
    """The file says something that nobody can judge."""

    path: str
    problem: Problem
    why = "A program reads the diagnosis, so its form counts."
    expected = "{path} with `name`, and under `faults` entries with `fault`, `topic` and `number`"
    measured = "{problem}"
    hint = "Step 6 of the task shows an entry. Look at the blanks before each line, and at colons."


@dataclass(eq=False)
class OtherRover(Fault):
    """The diagnosis is about the rover of somebody else."""

    name: str
    handed_in_as: str
    was_seen = True
    why = "Each name has a rover with faults of its own."
    expected = "a diagnosis of the rover of who handed it in ({handed_in_as})"
    measured = "it is about the rover of {name}"
    hint = (
        "Make your own bag: ./roslings rover --sick --name NAME, with the name under which you"
        " hand in. Write this name into the diagnosis."
    )


@dataclass(eq=False)
class TooFewFound(Fault):
    """Too few entries are right, or too many are wrong."""

    wanted: int
    right: int
    wrong: int
    near: tuple[Entry, ...]
    again: tuple[Entry, ...]
    """Entries about what an earlier one is about."""
    why = "On a robot, a wrong diagnosis costs as much time as a right one saves."

    expected = "right entries less wrong ones: at least {wanted}"
    measured = some_of(
        between="; ",
        right="{right} right",
        wrong="{wrong} with a fault that its topic does not have",
        again="made a second time: {again}",
        near="the number alone is wrong in: {near}",
    )
    hint = one_of(
        again="Take out the second entry: it costs as much as a right one gives.",
        near="Measure again what the table of step 6 asks for: which messages, which unit?",
        wrong="Take out what you have no proof for: it costs as much as a right one gives.",
        missing="Go on in the order of step 6: what is there, how often, until when, who offers"
        " what.",
    )

    @property
    def which_measured(self) -> tuple[str, ...]:
        """What was counted."""
        counted = {"wrong": self.wrong, "again": self.again, "near": self.near}
        return "right", *(name for name, found in counted.items() if found)

    @property
    def which_hint(self) -> str:
        """What to do about it first."""
        if self.again:
            return "again"
        return "near" if self.near else "wrong" if self.wrong else "missing"
