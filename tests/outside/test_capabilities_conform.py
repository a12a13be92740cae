"""Each built-in capability, and each of a lab, holds what any capability must hold."""

from __future__ import annotations

import pytest

from roslings.capabilities.conformance import CHECKS, Check
from roslings.capability import BUILT_IN, Capability, capability, of_labs
from roslings.record import PartSeen

OF_LABS = [each.name for each in of_labs()]


@pytest.mark.parametrize("name", [*BUILT_IN, *OF_LABS])
@pytest.mark.parametrize("holds", CHECKS, ids=lambda check: check.__name__)
def test_a_capability_of_this_course_holds_it(holds: Check, name: str) -> None:
    """The same checks as another course's capability."""
    known = capability(name)
    assert known is not None
    holds(known)


class Bad(PartSeen):
    """A record under another name than its capability's, with a version that nobody can reach."""

    NAME = "bad"
    v: int = 3


def test_what_does_not_hold_is_told() -> None:
    """A capability with every mistake that one line can make."""
    wrong = Capability("worse", Bad, words="nowhere:WORDS")
    told = {}
    for holds in CHECKS:
        try:
            holds(wrong)
        except (AssertionError, ModuleNotFoundError) as error:
            told[holds.__name__] = str(error)
    assert "leads to this capability" in told["is_found_by_its_name"]
    assert "NAME is not 'worse'" in told["its_record_has_its_name"]
    assert "needs an upgrade from each version" in told["it_upgrades_each_version"]
    assert "there is no nowhere:WORDS" in told["its_places_are_there"]
