"""Messages with a number in every field."""

from __future__ import annotations

from random import Random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from roslings.capabilities.topics.full import floats_of, full_values

TWIST = "geometry_msgs/msg/Twist"
FIELDS = {
    TWIST: [f"{part}.{axis}" for part in ("linear", "angular") for axis in "xyz"],
    "std_msgs/msg/Float64": ["data"],
    "sensor_msgs/msg/Range": ["field_of_view", "min_range", "max_range", "range"],
    "std_msgs/msg/String": [],
}


@pytest.mark.parametrize("type_name", FIELDS)
def test_each_number_of_a_message_is_named(type_name: str) -> None:
    """Those of messages in the message, too; a stamp, a text and a whole number are none."""
    found = floats_of(type_name)
    assert [name for name in found if name in FIELDS[type_name]] == FIELDS[type_name]
    assert not [name for name in found if "stamp" in name or name in ("radiation_type", "frame_id")]


@settings(deadline=None)
@given(st.integers(min_value=0))
def test_no_field_is_empty_and_none_is_like_another(seed: int) -> None:
    """Of two messages, one has each field above zero, and the other one below."""
    random = Random(seed)

    def between(low: float, high: float) -> float:
        return round(random.uniform(low, high), 3)

    one = full_values(TWIST, between)
    other = full_values(TWIST, between, begins_below_zero=True)
    for values in (one, other):
        assert list(values) == FIELDS[TWIST]
        assert all(values.values()) and len({*map(abs, values.values())}) == len(values)
    assert one["linear.x"] > 0 > other["linear.x"]
    assert all(one[name] * other[name] < 0 for name in FIELDS[TWIST])
