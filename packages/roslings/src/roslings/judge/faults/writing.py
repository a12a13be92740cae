"""Faults in what a node writes."""

from __future__ import annotations

import difflib
from dataclasses import dataclass, field

from roslings.judge.faults.base import Fault

ALIKE = 0.6
"""Lines that have so much in common are meant to be the same."""


@dataclass(eq=False)
class NotLogged(Fault):
    """The node does not write the line that it should."""

    executable: str
    wanted: str
    found: str | None
    when: str = field(default="", kw_only=True)
    place: str = field(default="in the function that has the message", kw_only=True)
    why = "The log is the first place to look when a robot does something strange."

    @property
    def expected(self) -> str:
        """The line, and when it is asked for."""
        begin = f"{self.when}, " if self.when else ""
        return f"{begin}{self.executable} writes {self.wanted!r}"

    @property
    def measured(self) -> str:
        """The most similar line, or another one."""
        if not self.found:
            return "it wrote nothing"
        alike = _are_alike(self.wanted, self.found)
        return f"{'the nearest line is' if alike else 'it wrote'} {self.found!r}"

    @property
    def hint(self) -> str:
        """What to compare, or how to write a line."""
        if self.found and _are_alike(self.wanted, self.found):
            return "Compare the two lines above, letter by letter: words, numbers, signs, spaces."
        return f"Which line of your code writes to the log {self.place}?"

    @property
    def mend(self) -> str:
        """How a line is written."""
        alike = self.found and _are_alike(self.wanted, self.found)
        return "" if alike else f"Write it with self.get_logger().info(...) {self.place}."


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
    measured = "it wrote {line!r} {times} times"


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
    hint = "Where does the text of your line come from?"
    mend = "Put the message's own text into the line: its field is msg.data."


@dataclass(eq=False)
class AlmostRepeats(DoesNotRepeat):
    """The listener repeats the message inside a different sentence."""

    why = "The message arrives. Only the words around it are not the ones asked for."
    hint = "Compare the line letter by letter with the one expected."
