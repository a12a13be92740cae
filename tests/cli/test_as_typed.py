"""Commands that repeat what was typed, and those that find the package as `check` does."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from ros2_on_pip.domain_lease import leased_domain
from roslings import course
from roslings.commands.invocation import command_line, program
from roslings.workspace.student import workspace_root
from roslings_launcher.cli import parser
from roslings_learn.drills import all_drills
from roslings_rover.remembered import remember_the_ball

TALKER = "from ros2_on_pip.demo_nodes_py.talker import main; main()"


@pytest.mark.parametrize(
    ("words", "again"),
    [
        (["topics"], "check topics"),
        (["topics", "my/path"], "check topics my/path"),
        (["topics", "my path", "--html", "page.html"], "check topics 'my path'"),
        (["topics", "--solution", "--seed", "3"], "check topics --solution"),
        (["topics", "my/path", "--as-stranger"], "check topics my/path --as-stranger"),
        (
            ["topics", "--clock", "wall", "--port", "/dev/x"],
            "check topics --port /dev/x --clock wall",
        ),
    ],
)
def test_what_decides_what_is_checked_is_repeated(words: list[str], again: str) -> None:
    """Not where the verdict is written to."""
    typed = command_line(parser().parse_args(["check", *words]))
    assert typed.check() == f"{program()} {again}"


def test_only_labs_of_the_course_are_handed_in() -> None:
    """The first page checks the example, and throws it away."""
    asked = {
        lab: command_line(parser().parse_args(["check", lab])) for lab in ("topics", "example")
    }
    assert asked["topics"].handed_in and not asked["example"].handed_in


def test_how_roslings_is_called_from_here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """`./roslings` in its folder; elsewhere the name that `source setup.bash` made known."""
    monkeypatch.chdir(course.root())
    assert program() == "./roslings"
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("PATH", f"{course.root()}{os.pathsep}/usr/bin")
    assert program() == "roslings"
    monkeypatch.setenv("PATH", "/usr/bin")
    assert program() == "./roslings"


def roslings(home: Path, *words: str, domain: int = 0) -> subprocess.CompletedProcess[str]:
    """One command of a student whose home is empty but for the workspace."""
    own = {
        "HOME": str(home),
        "ROSLINGS_WS": str(home / "roslings_ws"),
        "ROS_DOMAIN_ID": str(domain),
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
    }
    return subprocess.run(
        [sys.executable, "-m", "roslings", *words],
        cwd=course.root(),
        env={**os.environ, **own},
        capture_output=True,
        text=True,
        check=False,
    )


def test_status_has_straight_columns(tmp_path: Path) -> None:
    """The longest name of a lab moves none of them."""
    lines = roslings(tmp_path, "status").stdout.splitlines()
    labs = [line for line in lines if line.endswith("not begun")]
    assert len(labs) == len(course.all_labs())
    assert re.match(r"01-install +0/10 +- +first: first-15-minutes\.md$", lines[1])
    for day in {one.day for one in all_drills()}:
        count = sum(one.day == day for one in all_drills())
        assert any(re.match(rf"{day} +0/{count} ", line) for line in lines)
    assert max(map(len, lines)) <= 80
    assert f" 0 of {len(labs)} " in lines[-1] and lines[-1].endswith(f" 0 of {len(all_drills())}")
    assert len({line.index("not begun") for line in labs}) == 1


def test_a_fresh_clone_names_the_first_steps(tmp_path: Path) -> None:
    """The page that is there, the lesson, the first lab; then what is next in that lab."""
    told = roslings(tmp_path).stdout
    page = re.search(r"Read (\S+)", told)
    assert page and (course.root() / page[1]).is_file()
    first = next(iter(course.all_labs())).name
    assert all(f"./roslings {step}" in told for step in ("lab 1", "watch"))
    assert f"0 of {len(course.all_labs())}" in told and max(map(len, told.splitlines())) <= 80
    assert roslings(tmp_path, "start", first).returncode == 0
    begun = roslings(tmp_path).stdout
    assert f"./roslings check {first}" in begun and "15 minutes" not in begun


def test_who_has_touched_the_ball_goes_on_to_day_one(tmp_path: Path) -> None:
    """The rover wrote it down where the workspace is, and the first page is not offered again."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ROSLINGS_WS", str(tmp_path / "roslings_ws"))
        remember_the_ball()
        assert any(workspace_root().rglob("*ball*"))
    told = roslings(tmp_path).stdout
    assert "15 minutes: the rover has touched the ball" in told and "Read" not in told
    assert re.search(r"^Next +\./roslings lab 1 ", told, re.M) and "./roslings watch" in told
    _, first, *_ = roslings(tmp_path, "status").stdout.splitlines()
    assert first.endswith("the first page is done") and len(first) <= 80


@contextmanager
def a_talker(home: Path) -> Iterator[int]:
    """A node that runs, and its domain."""
    with leased_domain() as domain:
        own = {
            "HOME": str(home),
            "ROS_DOMAIN_ID": str(domain),
            "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
        }
        with subprocess.Popen(
            [sys.executable, "-c", TALKER],
            env={**os.environ, **own},
            stderr=subprocess.PIPE,
            text=True,
        ) as node:
            assert node.stderr
            node.stderr.readline()
            yield domain
            node.kill()


@pytest.mark.slow
@pytest.mark.parametrize("place", ["roslings_ws/src", "elsewhere"])
def test_one_command_saves_the_picture_that_a_lab_wants(tmp_path: Path, place: str) -> None:
    """Into the package, wherever it lies; the folder is made, and an older one is kept."""
    lab = course.lab("topics")
    package = tmp_path / place / "chatter"
    shutil.copytree(lab.solution, package)
    picture = package / lab.card.pictures[0].path
    shutil.rmtree(picture.parent)
    named = [] if place.startswith("roslings_ws") else [str(package)]
    with a_talker(tmp_path) as domain:
        done = roslings(tmp_path, "graph", "--for", "topics", *named, domain=domain)
        assert done.returncode == 0, done.stderr
        assert re.search(rf"^Saved ~/{place}/chatter/figures/", done.stdout, re.M)
        assert picture.read_bytes().startswith(b"\x89PNG")
        again = roslings(tmp_path, "graph", "--for", "topics", *named, domain=domain)
        assert again.returncode == 2
        assert "is there already" in again.stderr


def test_a_picture_of_nothing_is_not_saved(tmp_path: Path) -> None:
    """A student who forgot to start the nodes is told."""
    lab = course.lab("topics")
    package = tmp_path / "roslings_ws" / "src" / "chatter"
    shutil.copytree(lab.solution, package)
    shutil.rmtree((package / lab.card.pictures[0].path).parent)
    with leased_domain() as domain:
        done = roslings(tmp_path, "graph", "--for", "topics", domain=domain)
    assert done.returncode == 1
    assert "Nothing was saved: no node runs." in done.stdout
    assert not (package / "figures").exists()
