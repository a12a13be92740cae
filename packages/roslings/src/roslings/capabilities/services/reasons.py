"""Why nothing can be said of a service."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from roslings.judge.faults.base import Inconclusive, NothingToJudge
from roslings.judge.faults.sentences import one_of


@dataclass(eq=False)
class NoCall(NothingToJudge):
    """Nobody could be asked, or there is no answer to look at."""

    what: Literal["no_type", "unanswered", "uncalled", "nothing_came", "waits"]
    name: str = ""
    text = one_of(
        no_type="nobody serves {name}, so it has no type",
        unanswered="no call was answered",
        uncalled="{name} could not be called",
        nothing_came="nothing came on {name}",
        waits="it waits for ever, so it has no answer to write",
    )

    @property
    def which_text(self) -> str:
        """What it is."""
        return self.what


@dataclass(eq=False)
class LateByTheMachine(Inconclusive):
    """Answers came late, and this computer stood still for longer."""

    late_s: float
    stood_s: float
    text = (
        "some answers were late by {late_s:.2f} s, but this computer stood still for"
        " {stood_s:.2f} s; close other programs and check again"
    )
