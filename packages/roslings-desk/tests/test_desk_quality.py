"""By which quality all publishers of a topic are heard."""

from __future__ import annotations

from dataclasses import dataclass
from importlib import import_module
from typing import Any

import pytest

from roslings_desk.looking import heard_from_all
from skips import skip_without

skip_without("module rclpy")
rclpy_qos = import_module("rclpy.qos")


@dataclass
class Offer:
    """What is known of a publisher."""

    qos_profile: Any


def offers(*words: str) -> list[Offer]:
    """Publishers: `reliable kept` says both policies of one."""
    return [Offer(_profile(*each.split())) for each in words]


def _profile(reliability: str, durability: str) -> Any:
    return rclpy_qos.QoSProfile(
        depth=1,
        reliability=rclpy_qos.ReliabilityPolicy[reliability.upper()],
        durability=rclpy_qos.DurabilityPolicy[durability.upper()],
    )


@pytest.mark.parametrize(
    ("words", "found"),
    [
        ((), ("BEST_EFFORT", "VOLATILE")),
        (("reliable transient_local",), ("RELIABLE", "TRANSIENT_LOCAL")),
        (("reliable volatile", "reliable transient_local"), ("RELIABLE", "VOLATILE")),
        (("best_effort volatile", "reliable volatile"), ("BEST_EFFORT", "VOLATILE")),
    ],
)
def test_each_of_them_is_heard(words: tuple[str, ...], found: tuple[str, str]) -> None:
    """The better quality only where all offer it; rclpy itself says that they fit."""
    publishers = offers(*words)
    asked = heard_from_all(publishers)
    assert (asked.reliability.name, asked.durability.name) == found
    for each in publishers:
        fits, why = rclpy_qos.qos_check_compatible(each.qos_profile, asked)
        assert fits != rclpy_qos.QoSCompatibility.ERROR, why
