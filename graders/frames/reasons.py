"""Why nothing can be said of frames, walls or a map."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from roslings.judge.faults.base import Inconclusive, NothingToJudge
from roslings.judge.faults.sentences import one_of


@dataclass(eq=False)
class NotSeenToHear(Inconclusive):
    """In one drive the node has not subscribed, and where nobody drove it has."""

    executable: str
    text = (
        "this computer did not see in time that {executable} hears, so it could not be told of a"
        " drive; close other programs and check again"
    )


@dataclass(eq=False)
class NoDriveTold(NothingToJudge):
    """The node could not be told of a drive."""

    what: Literal["not_told", "no_walls", "no_map"]
    text = one_of(
        not_told="the node could not be told of a drive",
        no_walls="it said no points of this part of the drive",
        no_map="there was no map to look at",
    )

    @property
    def which_text(self) -> str:
        """What it is."""
        return self.what
