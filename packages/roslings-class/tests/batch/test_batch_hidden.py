"""Checks that students do not have."""

from __future__ import annotations

import argparse
from pathlib import Path

import pytest

from roslings.course import lab
from roslings.course.files import BadCourseFile
from roslings.evidence import BuildSeen, Evidence, MachineSeen
from roslings.grading.platforms import write_shapes
from roslings.grading.shapes import SHAPES
from roslings.judge import judge
from roslings.workspace.inspect import inspect_package

TOPICS = lab("topics")
HIDDEN = '''
from roslings.judge import PackageView, check

POINTS = {"has_picture": 20, "is_short": 5}


@check()
def test_has_picture(package: PackageView) -> None:
    """There is a picture."""
    assert package.files.pictures


@check(needs=["builds"])
def test_is_short(package: PackageView) -> None:
    """It is short."""
'''


def evidence() -> Evidence:
    """The solution's files, and a build that failed."""
    machine = MachineSeen(
        roslings="0", ros_distro="jazzy", rmw="r", python="3", platform="p", isolation="domain"
    )
    files = inspect_package(TOPICS.solution, TOPICS.card)
    built = BuildSeen(succeeded=False, recognised_as=None, seconds=1.0)
    return Evidence(lab="topics", seed=1, machine=machine, package=files, build=built)


@pytest.mark.slow
def test_hidden_checks_come_on_top(tmp_path: Path) -> None:
    """Their points too; they may need the lab's own checks, and the score stays up to 100."""
    file = tmp_path / "hidden_topics.py"
    file.write_text(HIDDEN)
    open_, hidden = judge(TOPICS, evidence()), judge(lab("topics", file), evidence())
    more = {check.id: check for check in hidden.checks[len(open_.checks) :]}
    assert [check.id for check in hidden.checks[: len(open_.checks)]] == [
        check.id for check in open_.checks
    ]
    assert (more["has_picture"].outcome, more["has_picture"].points) == ("pass", 20)
    assert more["is_short"].outcome == "skip"
    points = sum(check.points for check in open_.checks)
    assert hidden.score == round(100 * (points + 20) / 125, 1)


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ("", "write the points"),
        ("POINTS = {'rate': 5}", "the card has a check of this name: rate"),
        ("POINTS = dict(a=1)", "plain table"),
        ("POINTS = {'a': 'many'}", "plain table"),
        ("def", "no Python"),
        (None, "cannot be read"),
    ],
)
def test_a_hidden_file_that_cannot_be_used_is_told(
    tmp_path: Path, text: str | None, says: str
) -> None:
    """With file and line, before anything is run."""
    file = tmp_path / "hidden.py"
    if text is not None:
        file.write_text(text)
    with pytest.raises(BadCourseFile, match=says):
        _ = lab("topics", file).card


def test_the_other_shapes_hide_them_where_they_can(tmp_path: Path) -> None:
    """What a platform cannot hide from students is left out."""
    (tmp_path / "hidden_topics.py").write_text(HIDDEN)
    places = {name: tmp_path / f"it.{name}" for name in SHAPES}
    verdict = judge(lab("topics", tmp_path / "hidden_topics.py"), evidence())
    write_shapes(verdict, argparse.Namespace(**places))
    told = {name: b"has_picture" in path.read_bytes() for name, path in places.items()}
    assert told == {name: name == "gradescope" for name in SHAPES}
