"""What a guard must do in each order of events, as a small model: the card, and nothing else.

A reason to stop begins and ends by an event of its own. The rover drives while there is none.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from enum import Enum


class Happens(Enum):
    """What can happen around a guard. Each button says "pressed" when it begins."""

    PRESS = "press"
    RELEASE = "release"
    SILENCE = "silence"
    COMMAND = "command"
    FREEZE = "freeze"
    THAW = "thaw"
    LEAVE = "leave"
    JOIN = "join"
    SECOND_JOINS = "second_joins"
    SECOND_LEAVES = "second_leaves"


@dataclass(frozen=True)
class GuardModel:
    """The reasons to stop, and the buttons, at one moment."""

    pressed: bool = True
    silent: bool = True
    there: bool = False
    """The button's program runs, or hangs."""
    hangs: bool = False
    second: bool = False
    """The program of a second button runs."""

    @property
    def lost(self) -> bool:
        """No button is alive."""
        return not (self.second or (self.there and not self.hangs))

    @property
    def drives(self) -> bool:
        """There is no reason to stop."""
        return not (self.pressed or self.silent or self.lost)

    def possible(self) -> Sequence[Happens]:
        """What can happen now. No program is killed while it hangs."""
        runs = self.there and not self.hangs
        return [
            *((Happens.PRESS, Happens.RELEASE) if not self.lost else ()),
            *((Happens.SILENCE,) if not self.silent else ()),
            Happens.COMMAND,
            *((Happens.FREEZE, Happens.LEAVE) if runs else ()),
            *((Happens.THAW,) if self.hangs else ()),
            *((Happens.JOIN,) if not self.there else ()),
            *((Happens.SECOND_JOINS,) if self.there and not self.second else ()),
            *((Happens.SECOND_LEAVES,) if self.second else ()),
        ]

    def after(self, event: Happens) -> GuardModel:
        """The card's word for each event."""
        return replace(self, **_CHANGES[event])


_CHANGES: dict[Happens, dict[str, bool]] = {
    Happens.PRESS: {"pressed": True},
    Happens.RELEASE: {"pressed": False},
    Happens.SILENCE: {"silent": True},
    Happens.COMMAND: {"silent": False},
    Happens.FREEZE: {"hangs": True},
    Happens.THAW: {"hangs": False},
    Happens.LEAVE: {"there": False},
    Happens.JOIN: {"there": True, "pressed": True},
    Happens.SECOND_JOINS: {"second": True, "pressed": True},
    Happens.SECOND_LEAVES: {"second": False},
}

DRIVING = GuardModel(pressed=False, silent=False, there=True)
"""Where each walk begins: a button is there and released, and commands come."""

ALWAYS = (
    (
        Happens.PRESS,
        Happens.SILENCE,
        Happens.RELEASE,
        Happens.COMMAND,
    ),
    (
        Happens.SILENCE,
        Happens.PRESS,
        Happens.COMMAND,
        Happens.FREEZE,
        Happens.THAW,
        Happens.RELEASE,
    ),
    (
        Happens.SECOND_JOINS,
        Happens.RELEASE,
        Happens.SECOND_LEAVES,
        Happens.FREEZE,
        Happens.SILENCE,
        Happens.THAW,
    ),
)
"""Walks that each check makes: two reasons at once, each of which goes first; two buttons."""

STEPS = 6
"""Of a walk that is drawn."""
