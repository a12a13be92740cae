"""A fresh clone: the first command makes the environment, the next ones just run."""

from __future__ import annotations

import os
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest
from conftest import find_python
from course_copy import CourseCopy


@pytest.mark.parametrize("minor", [10, 11, 12, 13])
def test_makes_an_environment_with_each_python(
    make_course: Callable[..., CourseCopy], minor: int
) -> None:
    """One command is enough on any of the Pythons."""
    course = make_course("course", python=find_python(minor))
    outcome = course.run("check", "topics")
    assert outcome.code == 0, outcome.err
    assert outcome.seen["prefix"] == str(course.venv)
    assert outcome.seen["python"] == [3, minor]
    assert outcome.seen["has"] == ["ros_x", "col_x", "check_x"]


def test_the_second_run_is_silent_and_passes_words_and_exit_code(course: CourseCopy) -> None:
    """Nothing is printed but what the command prints."""
    assert "ready" in course.run("check").err
    again = course.run("check", "3", "a word", "*", "")
    assert (again.code, again.err) == (3, "")
    assert again.seen["words"] == ["check", "3", "a word", "*", ""]


def test_runs_from_anywhere(course: CourseCopy, tmp_path: Path) -> None:
    """Through symbolic links, from another folder, and without standard input."""
    course.run("check")
    (tmp_path / "bin").mkdir()
    (tmp_path / "bin/first").symlink_to("../course/roslings")
    (tmp_path / "bin/second").symlink_to(tmp_path / "bin/first")
    for script in (tmp_path / "bin/first", tmp_path / "bin/second"):
        assert course.run("check", script=script).seen["prefix"] == str(course.venv)
    closed = subprocess.run(
        ["sh", "-c", "exec ../course/roslings check <&-"],
        cwd=tmp_path / "bin",
        env=course.environment,
        capture_output=True,
        text=True,
        check=False,
    )
    assert (closed.returncode, closed.stderr) == (0, "")


@pytest.mark.parametrize("home", ["", None, "/proc/nowhere"], ids=["empty", "unset", "read-only"])
def test_needs_no_home(course: CourseCopy, home: str | None) -> None:
    """HOME may be anything."""
    outcome = course.run("check", HOME=home)
    assert outcome.code == 0, outcome.err
    assert not (course.root / ".venv.cache").exists()


def test_stdin_may_be_closed_at_first_use(course: CourseCopy) -> None:
    """The set-up asks nothing."""
    command = ["sh", "-c", f"exec {course.root}/roslings check <&-"]
    done = subprocess.run(
        command, env=course.environment, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("words", [["doctor"], ["--version"], ["--help"], ["check", "--help"]])
def test_plain_commands_need_no_environment(course: CourseCopy, words: list[str]) -> None:
    """What needs only the standard library runs at once, and installs nothing."""
    outcome = course.run(*words)
    assert (outcome.code, outcome.err) == (0, "")
    assert outcome.seen["words"] == words
    assert not course.venv.exists()


def test_plain_commands_use_an_environment_that_stands(course: CourseCopy) -> None:
    """The doctor can then look at ROS as well."""
    course.run("check")
    assert course.run("doctor").seen["prefix"] == str(course.venv)


def test_a_students_folder_is_not_on_the_path(course: CourseCopy, tmp_path: Path) -> None:
    """A student's `random.py` beside them must not end the grader."""
    course.run("check")
    (tmp_path / "random.py").write_text("raise SystemExit(9)")
    done = subprocess.run(
        [course.root / "roslings", "check"],
        cwd=tmp_path,
        env=course.environment,
        capture_output=True,
        check=False,
    )
    assert done.returncode == 0
    assert course.run("check").seen["path"][0] == str(course.root / "src")


def test_a_shim_that_does_not_run_is_passed_over(course: CourseCopy, tmp_path: Path) -> None:
    """A version manager's python3.12 that only complains is no Python."""
    shims = tmp_path / "shims"
    shims.mkdir()
    (shims / "python3.12").write_text("#!/bin/sh\necho 'not found' >&2\nexit 127\n")
    (shims / "python3.12").chmod(0o755)
    (shims / "python3.13").symlink_to(course.environment["ROSLINGS_PYTHON"])
    path = f"{shims}:{course.environment['PATH']}"
    outcome = course.run("check", ROSLINGS_PYTHON=None, PATH=path)
    assert (outcome.code, outcome.seen["prefix"]) == (0, str(course.venv))


def test_a_wrong_roslings_python_is_named(course: CourseCopy) -> None:
    """The variable is the user's own word: nothing else is tried."""
    outcome = course.run("check", ROSLINGS_PYTHON="/nowhere/python3")
    assert outcome.code == 2
    assert "/nowhere/python3" in outcome.err
    assert "Next:" in outcome.err


def test_without_any_python_the_next_step_is_said(course: CourseCopy, tmp_path: Path) -> None:
    """Only a shell is there."""
    tools = tmp_path / "tools"
    tools.mkdir()
    for name in ("dirname", "readlink", "cmp"):
        (tools / name).symlink_to(f"/usr/bin/{name}")
    outcome = course.run("check", ROSLINGS_PYTHON=None, PATH=str(tools))
    assert outcome.code == 2
    assert "apt install python3" in outcome.err


def test_the_ros_libraries_go_first_and_python_starts_once(
    course: CourseCopy, wheels: Path
) -> None:
    """Whatever a terminal carries from another environment comes after ours."""
    course.pin(ros_x="2.0")
    course.run("check")
    own = f"{course.venv}/lib:{course.site}/ros_x.libs"
    assert course.run("check").seen["libraries"] == own
    other = course.run("check", LD_LIBRARY_PATH="/other", _ROS_WHEELS_BOOTSTRAP_COMPLETE="1")
    assert other.seen["libraries"] == f"{own}:/other"
    assert other.seen["once"] == "1"
    assert course.run("check", LD_LIBRARY_PATH=own).seen["libraries"] == own


def test_settings_for_pip_that_lead_astray_do_not(course: CourseCopy, tmp_path: Path) -> None:
    """PIP_TARGET and its like in a shell profile would put the packages elsewhere."""
    astray = {"PIP_TARGET": str(tmp_path / "astray"), "PIP_USER": "1", "PYTHONPATH": os.devnull}
    assert course.run("check", **astray).seen["has"] == ["ros_x", "col_x", "check_x"]
    assert not (tmp_path / "astray").exists()
