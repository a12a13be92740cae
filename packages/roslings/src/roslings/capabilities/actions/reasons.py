"""Why nothing can be said of an action."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from roslings.judge.faults.base import NothingToJudge
from roslings.judge.faults.sentences import one_of


@dataclass(eq=False)
class NoGoal(NothingToJudge):
    """There is no action, or no end of a goal, to look at."""

    what: Literal["no_type", "no_end"]
    name: str = ""
    text = one_of(
        no_type="nobody performs {name}, so it has no type",
        no_end="the goal did not end",
    )

    @property
    def which_text(self) -> str:
        """What it is."""
        return self.what
