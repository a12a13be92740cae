"""Why nothing can be said of a program that reads bags."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from roslings.judge.faults.base import NothingToJudge
from roslings.judge.faults.sentences import one_of


@dataclass(eq=False)
class NoBagGiven(NothingToJudge):
    """The program got no bag, or an empty one."""

    what: Literal["empty", "not_given"]
    text = one_of(
        empty="there was nothing to tell of this bag",
        not_given="the program was not given this bag",
    )

    @property
    def which_text(self) -> str:
        """What it is."""
        return self.what
