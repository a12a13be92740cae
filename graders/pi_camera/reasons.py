"""Why nothing can be said of what a node finds in pictures."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from roslings.judge.faults.base import Inconclusive, NothingToJudge
from roslings.judge.faults.sentences import one_of, plural


@dataclass(eq=False)
class NoPictureShown(NothingToJudge):
    """There is no picture, or no answer to one, to look at."""

    what: Literal["not_shown", "no_answer", "not_back"]
    text = one_of(
        not_shown="no picture could be shown to the node",
        no_answer="nothing was published after a picture",
        not_back="no picture came back",
    )

    @property
    def which_text(self) -> str:
        """What it is."""
        return self.what


@dataclass(eq=False)
class PictureLost(Inconclusive):
    """A large picture did not come through, however often it was sent."""

    tries: int
    text = plural(
        "tries",
        one="a large picture was lost on the way {tries} time: this computer was too busy; close"
        " other programs and check again",
        other="a large picture was lost on the way {tries} times: this computer was too busy;"
        " close other programs and check again",
    )
