"""Walks through a model: each event is possible where it stands, and differences are found."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from random import Random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from roslings.walks import Impossible, drawn_walk, first_difference, states_on


@dataclass(frozen=True)
class Door:
    """Open or shut; it can be locked when it is shut."""

    is_open: bool = False
    is_locked: bool = False

    def possible(self) -> Sequence[str]:
        """What can be done with it now."""
        if self.is_open:
            return ["shut"]
        return ["unlock"] if self.is_locked else ["open", "lock", "shut"]

    def after(self, event: str) -> Door:
        """As doors are."""
        locked = {"lock": True, "unlock": False}.get(event, self.is_locked)
        return type(self)({"open": True, "shut": False}.get(event, self.is_open), locked)


class NeverLocks(Door):
    """A mistake: after `lock` it can be opened."""

    def possible(self) -> Sequence[str]:
        """Whether it is locked makes no difference."""
        return ["shut"] if self.is_open else ["open", "lock", "unlock"]

    def after(self, event: str) -> Door:
        """`unlock` opens it."""
        return type(self)(event in {"open", "unlock"})


@given(seed=st.integers(0, 2**64 - 1), steps=st.integers(0, 20))
def test_each_event_is_possible_where_it_stands(seed: int, steps: int) -> None:
    """Of as many as were asked for; the same seed draws the same walk."""
    walk = drawn_walk(Door(), Random(seed), steps)
    assert len(list(states_on(Door(), walk))) == steps
    assert walk == drawn_walk(Door(), Random(seed), steps)


def test_all_that_can_happen_is_drawn_some_time() -> None:
    """What changes nothing, too, and more rarely."""
    walk = drawn_walk(Door(), Random(1), 500)
    count = {each: walk.count(each) for each in ("open", "shut", "lock", "unlock")}
    assert all(count.values())
    repeats = sum(one == other == "shut" for one, other in pairwise(walk))
    assert 0 < repeats < count["shut"] / 2


def test_what_cannot_happen_is_named() -> None:
    """By its place in the walk."""
    with pytest.raises(Impossible, match="event 2, lock"):
        list(states_on(Door(), ["open", "lock"]))


def test_the_first_difference_is_told_by_the_length_of_the_way_to_it() -> None:
    """What both show until then is the same; who never differs has none."""
    walk = ["open", "shut", "lock", "unlock", "open"]

    def shows(door: Door) -> bool:
        return door.is_open

    assert first_difference(Door(), NeverLocks(), walk, shows) == 4
    assert first_difference(Door(), Door(), walk, shows) is None
