"""Why nothing can be said of a drill."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from roslings.judge.faults.base import NothingToJudge
from roslings.judge.faults.sentences import one_of


@dataclass(eq=False)
class NothingShown(NothingToJudge):
    """The run showed nothing of the kind."""

    what: Literal["no_goal", "not_said", "no_rate"]
    name: str = ""
    text = one_of(
        no_goal="no goal could be given to {name}",
        not_said="nothing could be said on {name}",
        no_rate="too few messages came to speak of a rate",
    )

    @property
    def which_text(self) -> str:
        """What it is."""
        return self.what


@dataclass(eq=False)
class FewShown(NothingToJudge):
    """The run showed fewer things than the one that is asked for."""

    count: int
    number: int
    text = "the run showed {count} of them, and number {number} is asked"
