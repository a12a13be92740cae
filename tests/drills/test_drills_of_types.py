"""Drills with the course's own message types, which a package of the course alone does not have."""

from __future__ import annotations

from pathlib import Path

from changed_drills import changed, check

from roslings_learn.drills import drill


def test_feedback_belongs_to_its_goal(tmp_path: Path) -> None:
    """Who tells it for the first goal alone tells too little."""
    before = "goal_handle.publish_feedback("
    after = f"self.level <= 60.0 and {before}"
    file = changed(tmp_path, "whole_server", before, after, of="solution")
    verdict = check(drill("whole_server"), file)
    assert verdict.first and verdict.first.fault == "NoFeedback"
