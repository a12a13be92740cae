"""Packages on the way, graded once each: none passes, and each gets its verdict."""

from __future__ import annotations

from pathlib import Path

import pytest
from half_done import HalfDone, states

from roslings.course import Lab, all_labs
from until_told import checked

STATES = [
    pytest.param(state, id=state.name, marks=[pytest.mark.slow, pytest.mark.twice])
    for lab in all_labs()
    for state in states(lab)
]


@pytest.mark.parametrize("lab", all_labs(), ids=lambda lab: lab.name)
def test_every_state_is_another_one(lab: Lab, tmp_path: Path) -> None:
    """Each TODO changes something, and all modules can be compiled."""
    texts = set[str]()
    for state in states(lab):
        package = state.make(tmp_path / state.name)
        files = sorted(file for file in package.rglob("*") if file.is_file())
        texts.add("\n".join(file.read_text("utf-8") for file in files))
    assert len(texts) == len(states(lab))


@pytest.mark.parametrize("state", STATES)
def test_a_half_done_package_fails(state: HalfDone, tmp_path: Path) -> None:
    """What is missing is a fault of the package, not of the computer."""
    package = state.make(tmp_path / "src" / state.lab.card.package)
    found = checked(state.lab.name, package, folder=tmp_path)
    assert (found.status, found.verdict["outcome"]) == (1, "fail")
    assert found.outcomes("inconclusive") == []
