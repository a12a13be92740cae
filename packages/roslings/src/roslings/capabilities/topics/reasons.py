"""Why nothing can be said of a topic."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from roslings.judge.faults.base import Inconclusive, NothingToJudge
from roslings.judge.faults.sentences import one_of, plural


@dataclass(eq=False)
class NothingCame(NothingToJudge):
    """There is nothing on the topic to look at, or nothing could be told."""

    what: Literal[
        "no_stamp",
        "another_type",
        "nothing",
        "not_told_this",
        "not_told",
        "not_published",
        "nothing_to_write",
    ]
    name: str = ""
    text = one_of(
        no_stamp="the messages have no stamp",
        another_type="{name} carries another type",
        nothing="nothing came on {name}",
        not_told_this="{name} could not be told this",
        not_told="{name} could not be told anything",
        not_published="nothing is published like {name}",
        nothing_to_write="it could not be told anything to write about",
    )

    @property
    def which_text(self) -> str:
        """What it is."""
        return self.what


@dataclass(eq=False)
class NearTheLimits(Inconclusive):
    """A rate that longer watching could turn."""

    hz: float
    uncertainty_hz: float
    low_hz: float
    high_hz: float
    text = (
        "too little evidence: {hz:.3f} Hz (±{uncertainty_hz:.3f}) was seen, too near to the"
        " limits, {low_hz:g} Hz and {high_hz:g} Hz; check again"
    )


@dataclass(eq=False)
class EndedInSilence(Inconclusive):
    """A message was late at the end of a watch: it may come, and it may never come."""

    silent_s: float
    period_s: float
    text = (
        "too little evidence: a message was due each {period_s:.2g} s, and the last one came"
        " {silent_s:.1f} s before the end; check again"
    )


@dataclass(eq=False)
class LostOnTheWay(Inconclusive):
    """This computer did not carry what was sent."""

    lost: int
    sent: int
    text = plural(
        "sent",
        one="this computer lost {lost} of {sent} message on their way, so it was too busy to send"
        " them in time; close other programs and check again",
        other="this computer lost {lost} of {sent} messages on their way, so it was too busy to"
        " send them in time; close other programs and check again",
    )
