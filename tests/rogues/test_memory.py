"""No package makes our own processes large: one real grading of the worst flood."""

from __future__ import annotations

from pathlib import Path

import pytest
from peaks import grade
from rogue import LAB, attempts

from roslings.probe.budget import GRADING_BYTES

pytestmark = pytest.mark.slow

MOST_BYTES = 400 * 10**6
"""Promised for each of our processes."""

WORST = "topics_300-node"


def test_the_worst_flood_stays_within_its_bounds(tmp_path: Path) -> None:
    """Of the command and of the measuring process; the evidence tells that much was dropped."""
    rogue = next(each for each in attempts() if each.name == WORST)
    package = rogue.make(tmp_path / LAB.card.package, {"mark": "rogue", "token": "rogue"})
    peaks = grade(LAB.name, package)
    assert peaks.measuring_bytes < MOST_BYTES
    assert peaks.command_bytes < MOST_BYTES
    assert peaks.kept_bytes < GRADING_BYTES
    assert peaks.dropped["messages"] > 0
    assert peaks.dropped["topics"] > 0
