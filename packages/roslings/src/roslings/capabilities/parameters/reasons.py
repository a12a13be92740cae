"""Why nothing can be said of a parameter."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from roslings.judge.faults.base import NothingToJudge
from roslings.judge.faults.sentences import one_of


@dataclass(eq=False)
class ParametersUnknown(NothingToJudge):
    """Nobody knows the parameters, or none was set."""

    what: Literal["no_names", "no_values", "no_topic", "not_set", "not_told", "before", "not_taken"]
    name: str = ""
    text = one_of(
        no_names="{name} did not say which parameters it has",
        no_values="{name} did not say what its parameters are",
        no_topic="it publishes on no topic of its own",
        not_set="the parameters could not be set",
        not_told="{name} could not be told anything then",
        before="nobody knows what its parameters were",
        not_taken="no new value was taken",
    )

    @property
    def which_text(self) -> str:
        """What it is."""
        return self.what
