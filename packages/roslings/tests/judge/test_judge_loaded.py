"""A judge that has read its sheet before a stranger's code runs."""

from __future__ import annotations

import gc
import shutil
from collections.abc import Iterator
from pathlib import Path

import pytest

from roslings.course import Lab, lab
from roslings.evidence import Evidence, MachineSeen
from roslings.judge import judge
from roslings.judge.judge import BadGrader
from roslings.judge.loaded import judge_loaded
from roslings.workspace.inspect import inspect_package

TOPICS = lab("topics")


def evidence() -> Evidence:
    """Of a package of which nothing was built."""
    machine = MachineSeen(
        roslings="0",
        ros_distro="jazzy",
        rmw="r",
        python="3",
        platform="p",
        isolation="user",
        wall="user",
    )
    return Evidence(
        lab="topics", seed=1, machine=machine, package=inspect_package(TOPICS.solution, TOPICS.card)
    )


@pytest.fixture(autouse=True)
def nothing_else_is_collected() -> Iterator[None]:
    """A worker may hold a browser: a fork that collects its greenlets dies, so it leaves them."""
    gc.freeze()
    yield
    gc.unfreeze()


def copied(tmp_path: Path) -> Lab:
    """The lab, in files that may be written."""
    folder, grader = tmp_path / "topics", tmp_path / "grade_topics.py"
    shutil.copytree(TOPICS.folder, folder)
    shutil.copy(TOPICS.grader, grader)
    return Lab("topics", folder, grader)


def test_what_becomes_of_its_files_does_not_matter(tmp_path: Path) -> None:
    """Grader, card and hints are forged when it has loaded: the verdict is the honest one."""
    found = copied(tmp_path)
    with judge_loaded(found) as ask:
        (found.folder / "card.yaml").write_text("id: forged")
        (found.folder / "hints.yaml").write_text("{}")
        found.grader.write_text("def test_forged():\n    pass\n")
        verdict = ask(evidence(), None)
    assert verdict == judge(TOPICS, evidence())
    assert verdict.environment.wall == "user"


def test_a_grader_that_cannot_be_read_is_told_before(tmp_path: Path) -> None:
    """Nothing of the stranger's has run then."""
    found = copied(tmp_path)
    found.grader.write_text("from roslings.judge import nothing_of_this_name\n")
    with pytest.raises((BadGrader, ImportError)), judge_loaded(found):
        raise AssertionError("it did not tell")
