"""A drive that nobody can know before: what each of them has."""

from __future__ import annotations

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
