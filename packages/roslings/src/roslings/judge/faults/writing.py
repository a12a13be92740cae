"""Faults in what a node writes."""

from __future__ import annotations

import difflib
from dataclasses import dataclass, field
from typing import Literal

from roslings.judge.faults.base import Fault
from roslings.judge.faults.sentences import SentencePart, Text, one_of, plural

ALIKE = 0.6
"""Lines that have so much in common are meant to be the same."""


@dataclass(frozen=True)
class PlaceInCode(SentencePart):
    """Where a line of a node's code stands."""

    place: Literal["message", "answer", "feedback", "no_server", "case"]
    case: str = ""
    """Of `case`, in the card's words."""
    text = one_of(
        message="in the function that has the message",
        answer="where your code has the answer",
        feedback="in the function that you give as feedback_callback",
        no_server="where the wait for the server gave back False",
        case="where your code learns that {case}",
    )

    @property
    def which_text(self) -> str:
        """Which one it is."""
        return self.place


@dataclass(eq=False)
class NotLogged(Fault):
    """The node does not write the line that it should."""

    executable: str
    wanted: str
    found: str | None
    when: Text = field(default="", kw_only=True)
    place: Text = field(default=PlaceInCode("message"), kw_only=True)
    why = "The log is the first place to look when a robot does something strange."

    expected = one_of(
        always="{executable} writes {wanted!r}", when="{when}, {executable} writes {wanted!r}"
    )
    measured = one_of(
        nothing="it wrote nothing",
        alike="the nearest line is {found!r}",
        other="it wrote {found!r}",
    )
    hint = one_of(
        alike="Compare the two lines above, letter by letter: words, numbers, signs, spaces.",
        other="Which line of your code writes to the log {place}?",
    )
    mend = one_of(other="Write it with self.get_logger().info(...) {place}.")

    @property
    def which_expected(self) -> str:
        """Whether it is asked for in one case alone."""
        return "when" if self.when else "always"

    @property
    def which_measured(self) -> str:
        """The most similar line, or another one."""
        return self.which_hint if self.found else "nothing"

    @property
    def which_hint(self) -> str:
        """What to compare, or how to write a line."""
        return "alike" if self.found and _are_alike(self.wanted, self.found) else "other"

    @property
    def which_mend(self) -> str:
        """How a line is written, where the two are not to be compared."""
        return "" if self.which_hint == "alike" else "other"


@dataclass(eq=False)
class LoggedAgain(Fault):
    """The node writes the same line more often than it had something to write."""

    executable: str
    line: str
    times: int
    why = "Who reads the log counts the lines: two lines mean that two things happened."
    hint = "Is the line logged in two places? One message is one call of get_logger().info(...)."
    was_seen = True
    expected = "{executable} writes each line once for each message"
    measured = plural(
        "times", one="it wrote {line!r} {times} time", other="it wrote {line!r} {times} times"
    )


def _are_alike(wanted: str, found: str) -> bool:
    """`found` is the wanted line with a slip in it, and no other line."""
    return difflib.SequenceMatcher(None, wanted, found).ratio() >= ALIKE


@dataclass(eq=False)
class DoesNotRepeat(Fault):
    """The listener got a message and wrote nothing about it."""

    template: str
    said: str
    wrote: str | None
    why = "A subscription only helps when its callback does something with the message."
    hint = "Which function does create_subscription get, and what does it write?"
    mend = "Give create_subscription your callback, and let the callback log msg.data."

    expected = "it writes {line!r}"
    measured = one_of(another="it wrote {wrote!r}", nothing="it wrote nothing")

    @property
    def which_measured(self) -> str:
        """Whether it wrote anything."""
        return "another" if self.wrote else "nothing"

    @property
    def line(self) -> str:
        """The echo."""
        return self.template.format(text=self.said)


@dataclass(eq=False)
class FixedText(DoesNotRepeat):
    """The listener writes a text of its own, whatever it receives."""

    why = "The listener must write what it hears. This text is always the same."
    hint = "Where does the text of your line come from?"
    mend = "Put the message's own text into the line: its field is msg.data."


@dataclass(eq=False)
class AlmostRepeats(DoesNotRepeat):
    """The listener repeats the message inside a different sentence."""

    why = "The message arrives. Only the words around it are not the ones asked for."
    hint = "Compare the line letter by letter with the one expected."
