"""Why nothing can be said of a button or a guard."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from roslings.judge.faults.base import Inconclusive, NothingToJudge
from roslings.judge.faults.sentences import one_of


@dataclass(eq=False)
class NotWatched(NothingToJudge):
    """What this check looks at did not happen."""

    what: Literal[
        "uncalled",
        "not_driven",
        "did_not_drive",
        "no_reason",
        "not_so_far",
        "one_computer",
    ]
    name: str = ""
    text = one_of(
        uncalled="{name} could not be called",
        not_driven="the guard could not be let drive",
        did_not_drive="it did not drive before",
        no_reason="it was given no reason to stop",
        not_so_far="it could not be watched so far",
        one_computer="the nodes were not run on two computers",
    )

    @property
    def which_text(self) -> str:
        """What it is."""
        return self.what


@dataclass(eq=False)
class LateCommand(Inconclusive):
    """The operator's own command came late."""

    late_s: float
    text = (
        "this computer was so busy that a command came {late_s:.2f} s late; close other programs"
        " and check again"
    )
