"""Evidence of earlier schemas is judged as it was then, word for word."""

from __future__ import annotations

import pytest
from judged_words import LABS, judged, recorded

from kills_of_old import read_kills
from roslings.course import lab
from roslings.judge import judge


@pytest.mark.parametrize("name", LABS)
def test_old_evidence_is_judged_as_before(name: str) -> None:
    """The solution, and some wrong packages."""
    before, now = recorded(name), judged(name)
    assert now.keys() == before.keys()
    for package, words in before.items():
        assert now[package] == words, package


@pytest.mark.parametrize("name", LABS)
def test_what_was_caught_is_caught(name: str) -> None:
    """By today's card and grader, the same check fails."""
    for kill, evidence in read_kills(name):
        failed = {each.id for each in judge(lab(name), evidence).checks if each.outcome == "fail"}
        assert kill.check in failed, kill.package
