"""`explain` as it is typed: its answer is what the grader says of the same change."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest

from explained import MOST, QUESTION, asked_about, first_that_fails, typed
from roslings.course import Lab, lab

pytestmark = pytest.mark.slow

LABS = ["topics", "services"]
OTHERS = [
    "nodes",
    "distance-sensor",
    "actions",
    "serial-bridge",
    "pi-camera",
    "bring-up",
    "black-box",
    "e-stop",
    "wander",
    "frames",
]


def package_of(asked: Lab, to: Path) -> Path:
    """A copy of the solution."""
    return Path(shutil.copytree(asked.solution, to / asked.outline.package))


@pytest.mark.parametrize(
    "name", [*LABS, *(pytest.param(name, marks=pytest.mark.twice) for name in OTHERS)]
)
def test_its_answer_is_what_a_check_says(name: str, tmp_path: Path) -> None:
    """Each change, found by what was printed and made by hand: the same check fails first."""
    package = package_of(lab(name), tmp_path)
    found = asked_about(name, package, tmp_path)
    assert len(found) == MOST
    for each in found:
        assert first_that_fails(name, package, each, tmp_path) == each.failed


def test_a_package_that_does_not_pass_is_told(tmp_path: Path) -> None:
    """With the next step; nothing is asked."""
    topics = lab("topics")
    package = Path(shutil.copytree(topics.starter, tmp_path / "chatter"))
    said = typed("explain", "topics", str(package), ws=tmp_path / "ws")
    assert said.returncode == 1
    assert "explain asks about a package that passes" in said.stderr
    assert "check topics" in said.stderr and "line" not in said.stdout


def test_a_stranger_is_held_or_refused(tmp_path: Path) -> None:
    """As `check --as-stranger` does it."""
    topics = lab("topics")
    package = package_of(topics, tmp_path)
    said = typed("explain", "topics", str(package), "--as-stranger", ws=tmp_path / "ws")
    if said.returncode == 0:
        assert len(QUESTION.findall(said.stdout)) == 3
    else:
        assert "sandbox" in said.stderr or "wall" in said.stderr
