"""Checks that students do not have, and builds that equal packages share."""

from __future__ import annotations

import os
import shutil
import threading
from contextlib import ExitStack
from pathlib import Path

import pytest

from roslings.arena import Place, choose_isolation
from roslings.cli import SHAPES, main
from roslings.course import lab
from roslings.course.files import BadCourseFile
from roslings.evidence import BuildSeen, Evidence, MachineSeen
from roslings.judge import judge
from roslings.report.evidence_file import evidence_bytes
from roslings.workspace import shared_build as building
from roslings.workspace.inspect import inspect_package
from roslings.workspace.shared_build import shared_build

TOPICS = lab("topics")
LONGEST_BUILD_S = 180.0
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


def test_regrade_writes_the_other_shapes_too(tmp_path: Path) -> None:
    """With hidden checks where the shape can hide them, from evidence in a file."""
    (tmp_path / "hidden_topics.py").write_text(HIDDEN)
    (tmp_path / "evidence.json").write_bytes(evidence_bytes(evidence()))
    places = {name: tmp_path / f"it.{name}" for name in SHAPES}
    words = ["regrade", "topics", str(tmp_path), "--hidden", str(tmp_path / "hidden_topics.py")]
    options = [word for name, path in places.items() for word in (f"--{name}", str(path))]
    assert main([*words, *options]) == 1
    told = {name: b"has_picture" in path.read_bytes() for name, path in places.items()}
    assert told == {name: name == "gradescope" for name in SHAPES}


def test_one_build_a_processor(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The next one waits for its turn, but not for ever: those before it may be endless."""
    entered = threading.Event()

    def enter() -> None:
        with building._turn(tmp_path):
            entered.set()

    with ExitStack() as others:
        for _ in os.sched_getaffinity(0):
            others.enter_context(building._turn(tmp_path))
        monkeypatch.setattr(building, "WAITS_FOR_ITS_TURN_S", 0.0)
        enter()
        assert entered.is_set()
        entered.clear()
        monkeypatch.setattr(building, "WAITS_FOR_ITS_TURN_S", 1e6)
        waiting = threading.Thread(target=enter)
        waiting.start()
        assert not entered.wait(1.0)
    waiting.join()
    assert entered.is_set()


def test_equal_packages_share_a_build(tmp_path: Path) -> None:
    """The second is there at once, with a home of its own; another content is built anew."""
    builds = tmp_path / "builds"
    found = []
    for name in ("anna", "ben", "cleo"):
        source, home, room = (tmp_path / name / part for part in ("chatter", "home", "room"))
        shutil.copytree(TOPICS.solution, source)
        if name == "cleo":
            (source / "setup.py").write_text("raise SystemExit('no')")
        for folder in (home, room):
            folder.mkdir()
        place = Place("domain", home, tmp_path, choose_isolation().sandbox)
        found.append(shared_build(builds, source, room, place, LONGEST_BUILD_S))
    (anna, first), (ben, second), (cleo, third) = found
    assert anna.succeeded and ben.succeeded and not cleo.succeeded
    assert first and second and third is None
    assert first.programs == second.programs
    assert (ben.seconds, ben.executables) == (0.0, anna.executables)
    assert second.environment["HOME"] == str(tmp_path / "ben" / "home")
    assert first.environment["HOME"] == str(tmp_path / "anna" / "home")
