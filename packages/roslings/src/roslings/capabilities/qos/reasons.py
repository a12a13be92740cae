"""Why nothing can be said of a late joiner."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from roslings.judge.faults.base import NothingToJudge
from roslings.judge.faults.sentences import one_of


@dataclass(eq=False)
class NobodyCameLate(NothingToJudge):
    """There is no late joiner to look at."""

    what: Literal["nobody", "nothing"]
    name: str = ""
    text = one_of(
        nobody="nobody could come late to {name}",
        nothing="no late joiner got anything on {name}",
    )

    @property
    def which_text(self) -> str:
        """What it is."""
        return self.what
