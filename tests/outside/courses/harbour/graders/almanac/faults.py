"""What can be wrong with a warning, in words."""

from __future__ import annotations

from dataclasses import dataclass

from roslings.judge.faults import Fault


@dataclass(eq=False)
class NoWarning(Fault):
    """A gale is not told."""

    line: str
    why = "Who sails out in a gale does not come back."
    hint = "What does the function of your subscription do with a strong wind?"
    expected = "in a gale, the node writes: {line}"
    measured = "it writes nothing of it"


@dataclass(eq=False)
class FalseWarning(NoWarning):
    """A breeze is told as a gale."""

    why = "Who is warned of each breeze hears no warning any more."
    expected = "in a breeze, the node does not write: {line}"
    measured = "it writes it"
