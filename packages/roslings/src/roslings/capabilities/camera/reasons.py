"""Why nothing can be said of the pictures of a camera."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from roslings.judge.faults.base import NothingToJudge
from roslings.judge.faults.sentences import one_of


@dataclass(eq=False)
class NoPictures(NothingToJudge):
    """There is no picture to look at."""

    what: Literal["few", "none", "not_looked_at", "none_after", "not_tried", "not_so_far"]
    name: str = ""
    text = one_of(
        few="too few pictures were understood",
        none="no picture came on {name}",
        not_looked_at="the pictures were not looked at when they came",
        none_after="no picture came after the parameter was set",
        not_tried="no wrong value was tried",
        not_so_far="the experiment did not come so far",
    )

    @property
    def which_text(self) -> str:
        """What it is."""
        return self.what
