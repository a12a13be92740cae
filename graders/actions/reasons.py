"""Why nothing can be said of a goal, or of the robot that drives to it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from roslings.judge.faults.base import Inconclusive, NothingToJudge
from roslings.judge.faults.sentences import one_of


@dataclass(eq=False)
class GoalUnseen(NothingToJudge):
    """What this check looks at did not happen."""

    what: Literal["not_given", "feedback", "error", "no_cancel", "ended"]
    text = one_of(
        not_given="no goal could be given",
        feedback="there was too little feedback to compare",
        error="the execute callback ended with an error: mend that first",
        no_cancel="there was no goal to cancel",
        ended="the goal ended before it could be cancelled",
    )

    @property
    def which_text(self) -> str:
        """What it is."""
        return self.what


@dataclass(eq=False)
class CancelHeldUp(Inconclusive):
    """A cancel came late, and this computer may have made it so."""

    late_s: float
    held_s: float
    text = (
        "a cancel was late by {late_s:.2f} s, but this computer held your node or the check up for"
        " {held_s:.2f} s; close other programs and check again"
    )


@dataclass(eq=False)
class SecondTooLate(Inconclusive):
    """The first goal was over when the second one was given."""

    text = (
        "this computer was so slow that the first goal ended before the second was given; close"
        " other programs and check again"
    )
