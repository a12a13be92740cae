"""Each capability that is here, built in or found, holds what any capability must hold."""

from __future__ import annotations

from pathlib import Path

import pytest

from roslings.capabilities.conformance import CHECKS, Check
from roslings.capability import BUILT_IN, Capability, capabilities, capability, of_labs
from roslings.record import PartSeen
from roslings_class.outside import packages_of_capabilities

HERE = [each.name for each in capabilities()]


def test_all_are_looked_at() -> None:
    """Those of the table, those of labs, and rooms, which an entry point of the engine names."""
    assert {*HERE} >= {*BUILT_IN, "rooms", *(each.name for each in of_labs())}


@pytest.mark.parametrize("name", HERE)
@pytest.mark.parametrize("holds", CHECKS, ids=lambda check: check.__name__)
def test_a_capability_of_this_course_holds_it(holds: Check, name: str) -> None:
    """The same checks as another course's capability."""
    known = capability(name)
    assert known is not None
    holds(known)


def test_what_the_engine_offers_goes_with_the_engine(tmp_path: Path) -> None:
    """An edition of another course has no package more for it."""
    assert capability("rooms")
    assert packages_of_capabilities(tmp_path) == []


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
