"""The rule for QoS that cannot match, held against rclpy's own."""

from __future__ import annotations

import itertools

import pytest

from roslings.judge.faults import EndpointKind, MatchedPolicies, qos_conflicts
from skips import imported

RELIABILITY, DURABILITY = ("reliable", "best_effort"), ("volatile", "transient_local")
PROFILES = list(itertools.product(RELIABILITY, DURABILITY))


@pytest.mark.parametrize("ours", PROFILES)
@pytest.mark.parametrize("theirs", PROFILES)
@pytest.mark.parametrize("kind", ["publisher", "subscription"])
def test_it_is_rclpys_own_rule(
    ours: tuple[str, str], theirs: tuple[str, str], kind: EndpointKind
) -> None:
    """Every pair of profiles, on both sides."""
    qos = imported("rclpy.qos")

    def profile(words: tuple[str, str]) -> object:
        return qos.QoSProfile(
            depth=1,
            reliability=qos.ReliabilityPolicy[words[0].upper()],
            durability=qos.DurabilityPolicy[words[1].upper()],
        )

    pair = (ours, theirs) if kind == "publisher" else (theirs, ours)
    compatible, _ = qos.qos_check_compatible(profile(pair[0]), profile(pair[1]))
    conflicts = qos_conflicts(kind, MatchedPolicies(*ours), MatchedPolicies(*theirs))
    assert (not conflicts) == (compatible != qos.QoSCompatibility.ERROR)
