"""A drive that nobody can know before: what each of them has."""

from __future__ import annotations

import math

from hypothesis import given, settings
from hypothesis import strategies as st

from roslings_rover.models.drives.held import X, Y
from roslings_rover.models.drives.recording import of_topic
from roslings_rover.models.drives.unknown import unknown_drive


@settings(deadline=None, max_examples=20)
@given(seed=st.integers(0, 2**32))
def test_its_way_crosses_both_axes(seed: int) -> None:
    """Who takes a place without its sign is found out, whichever axis it is."""
    said = of_topic(unknown_drive(seed, "/odom", 4.0).said, "/odom")
    for axis in (X, Y):
        places = [each.values[axis] for each in said]
        assert min(places) < -0.05
        assert max(places) > 0.05


@settings(deadline=None, max_examples=20)
@given(seed=st.integers(0, 2**32))
def test_its_first_way_and_its_last_one_are_long(seed: int) -> None:
    """Who leaves out a place, or takes the one before, is off by more than the last digit."""
    said = of_topic(unknown_drive(seed, "/odom", 4.0).said, "/odom")
    places = [(each.values[X], each.values[Y]) for each in said]
    for one, next_one in ((places[0], places[1]), (places[-2], places[-1])):
        assert math.dist(one, next_one) > 0.04
