"""Why nothing can be said of a node on a cable."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from roslings.judge.faults.base import Inconclusive, NothingToJudge
from roslings.judge.faults.sentences import one_of


@dataclass(eq=False)
class BoardUnused(NothingToJudge):
    """The board was not there, or not used so far."""

    what: Literal["wheels", "not_driven", "stood", "motors", "unheard", "no_board", "not_so_far"]
    text = one_of(
        wheels="the wheels did not turn",
        not_driven="the rover was not driven so far",
        stood="the rover did not move",
        motors="the motors were not running",
        unheard="the node sent nothing to the board",
        no_board="there was no board",
        not_so_far="the experiment did not come so far",
    )

    @property
    def which_text(self) -> str:
        """What it is."""
        return self.what


@dataclass(eq=False)
class LinesLost(Inconclusive):
    """This computer did not carry what the board sent."""

    text = (
        "this computer was too busy to carry every line of the board to your node;"
        " close other programs and check again"
    )


@dataclass(eq=False)
class SlowBoard(Inconclusive):
    """In time by the board's clock, and that clock ran slowly."""

    passed_s: float
    text = (
        "the stop came in time for the board, but this computer ran the board so slowly that"
        " {passed_s:.2f} s had passed; close other programs and check again"
    )
