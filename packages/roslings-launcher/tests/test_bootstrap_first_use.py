"""A fresh clone: the first command makes the environment, the next ones just run."""

from __future__ import annotations

import os
import shutil
import subprocess
import time
from collections.abc import Callable
from pathlib import Path

import pytest
from course_copy import CourseCopy
from pythons_here import find_python


@pytest.mark.slow
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


def test_the_next_runs_are_silent_and_pass_words_and_exit_code(standing: CourseCopy) -> None:
    """Nothing is printed but what the command prints."""
    again = standing.run("check", "3", "a word", "*", "")
    assert (again.code, again.err) == (3, "")
    assert again.seen["words"] == ["check", "3", "a word", "*", ""]


@pytest.mark.parametrize("place", ["build/site/html", "site/html"])
def test_a_site_that_is_there_needs_nothing(course: CourseCopy, place: str) -> None:
    """It opens at once, also while others install."""
    (course.root / place).mkdir(parents=True)
    (course.root / place / "index.html").touch()
    outcome = course.run("site")
    assert (outcome.code, outcome.err, outcome.seen["has"]) == (0, "", [])
    assert not course.venv.exists()


@pytest.mark.slow
@pytest.mark.parametrize("words", [[], ["--build"], ["--out=x"], ["--links"]])
def test_a_site_that_is_to_be_built_needs_its_packages(
    course: CourseCopy, words: list[str]
) -> None:
    """Where there is none, and where another one is asked for."""
    if words:
        (course.root / "site/html").mkdir(parents=True)
        (course.root / "site/html/index.html").touch()
    assert course.run("site", *words).seen["has"] == ["ros_x", "col_x", "check_x", "draw_x"]


@pytest.mark.slow
def test_a_command_knows_when_it_was_installed(course: CourseCopy) -> None:
    """In seconds since the computer was started; where nothing had to be installed, nobody says."""
    before_s = time.clock_gettime(time.CLOCK_BOOTTIME)
    first, second = course.run("check"), course.run("check")
    assert before_s < float(first.seen["ready_s"]) <= time.clock_gettime(time.CLOCK_BOOTTIME)
    assert second.seen["ready_s"] is None


def test_runs_from_anywhere(standing: CourseCopy, tmp_path: Path) -> None:
    """Through symbolic links, from another folder, and without standard input."""
    (tmp_path / "bin").mkdir()
    (tmp_path / "link").symlink_to(standing.root)
    (tmp_path / "bin/first").symlink_to("../link/roslings")
    (tmp_path / "bin/second").symlink_to(tmp_path / "bin/first")
    for script in ("first", "second"):
        outcome = standing.run_through(tmp_path / "bin" / script, "check")
        assert (outcome.err, outcome.seen["prefix"]) == ("", str(standing.venv))
    assert without_input(standing, tmp_path).returncode == 0


def without_input(course: CourseCopy, folder: Path) -> subprocess.CompletedProcess[str]:
    """Runs `check` in `folder` with standard input closed."""
    return subprocess.run(
        ["sh", "-c", f"exec {course.root}/roslings check <&-"],
        cwd=folder,
        env=course.environment,
        capture_output=True,
        text=True,
        check=False,
    )


@pytest.mark.slow
def test_first_use_needs_no_home_and_no_input(course: CourseCopy, tmp_path: Path) -> None:
    """HOME may be unset; nothing is asked."""
    del course.environment["HOME"]
    done = without_input(course, tmp_path)
    assert done.returncode == 0, done.stderr


@pytest.mark.slow
@pytest.mark.parametrize("home", ["", "/proc/nowhere"], ids=["empty", "read-only"])
def test_any_home_will_do(course: CourseCopy, home: str | None) -> None:
    """Nothing of ours is left where HOME is no folder."""
    outcome = course.run("check", HOME=home)
    assert outcome.code == 0, outcome.err
    assert not (course.root / ".venv.wheels").exists()


@pytest.mark.parametrize(
    "words", [[], ["status"], ["doctor"], ["--version"], ["--help"], ["check", "--help"]]
)
def test_plain_commands_need_no_environment(course: CourseCopy, words: list[str]) -> None:
    """What needs only the standard library runs at once, and installs nothing."""
    outcome = course.run(*words)
    assert (outcome.code, outcome.err) == (0, "")
    assert outcome.seen["words"] == words
    assert not course.venv.exists()


@pytest.mark.slow
def test_ready_runs_nothing(course: CourseCopy) -> None:
    """An image or a computer room is made ready beforehand: for a command, and for labs."""
    (course.root / "labs/arm").mkdir(parents=True)
    (course.root / "labs/arm/card.yaml").write_text("groups: [graph]\n")
    made = course.run("ready", "check", "arm")
    assert (made.code, made.out) == (0, ""), made.err
    used = course.run("check", "arm")
    assert (used.err, used.seen["has"]) == ("", ["ros_x", "col_x", "check_x", "draw_x"])
    again = course.run("ready", "check")
    assert (again.code, again.out, again.err) == (0, "", "")


@pytest.mark.parametrize("words", [["doctor"], ["no-such-word"]])
def test_ready_for_what_needs_nothing_is_refused(course: CourseCopy, words: list[str]) -> None:
    """A misspelt command would else look as if all were well."""
    refused = course.run("ready", *words)
    assert refused.code == 2
    assert "Next: ./roslings ready lab" in refused.err
    assert not course.venv.exists()


def test_plain_commands_use_an_environment_that_stands(standing: CourseCopy) -> None:
    """The doctor can then look at ROS as well."""
    assert standing.run("doctor").seen["prefix"] == str(standing.venv)


@pytest.mark.parametrize("shell", ["sh", "bash"])
def test_an_environment_that_stands_needs_no_other_python(
    standing: CourseCopy, tmp_path: Path, shell: str
) -> None:
    """The script finds its record right, and begins one Python, that of the environment."""
    for name in ("dirname", "readlink", "cmp", "sort"):
        (tmp_path / name).symlink_to(str(shutil.which(name)))
    own = {"ROSLINGS_PYTHON": None, "PATH": str(tmp_path), "LC_ALL": "C"}
    done = subprocess.run(
        [str(shutil.which(shell)), standing.root / "roslings", "check"],
        capture_output=True,
        text=True,
        check=False,
        env=standing.changed(own),
    )
    assert (done.returncode, done.stderr) == (0, "")


def test_a_students_folder_is_not_on_the_path(standing: CourseCopy, tmp_path: Path) -> None:
    """A student's `random.py` beside them must not end the grader."""
    (tmp_path / "random.py").write_text("raise SystemExit(9)")
    done = subprocess.run(
        [standing.root / "roslings", "check"],
        cwd=tmp_path,
        env=standing.environment,
        capture_output=True,
        check=False,
    )
    assert done.returncode == 0
    ours = [standing.root / f"packages/{name}/src" for name in ("ros2-on-pip", "roslings-launcher")]
    assert standing.run("check").seen["path"][:2] == list(map(str, ours))


@pytest.mark.slow
def test_a_shim_that_does_not_run_is_passed_over(course: CourseCopy, tmp_path: Path) -> None:
    """A version manager's python3.12 that only complains is no Python."""
    shims = tmp_path / "shims"
    shims.mkdir()
    (shims / "python3.12").write_text("#!/bin/sh\necho 'not found' >&2\nexit 127\n")
    (shims / "python3.12").chmod(0o755)
    (shims / "python3.13").symlink_to(course.environment["ROSLINGS_PYTHON"])
    path = f"{shims}:{course.environment['PATH']}"
    outcome = course.run("doctor", ROSLINGS_PYTHON=None, PATH=path)
    assert (outcome.code, outcome.err) == (0, "")


def test_a_wrong_roslings_python_is_named(course: CourseCopy) -> None:
    """The variable is the user's own word: nothing else is tried."""
    outcome = course.run("check", ROSLINGS_PYTHON="/nowhere/python3")
    assert outcome.code == 2
    assert "/nowhere/python3" in outcome.err
    assert "Next:" in outcome.err


@pytest.mark.slow
def test_without_any_python_the_next_step_is_said(course: CourseCopy, tmp_path: Path) -> None:
    """Only a shell is there."""
    tools = tmp_path / "tools"
    tools.mkdir()
    for name in ("dirname", "readlink", "cmp"):
        (tools / name).symlink_to(f"/usr/bin/{name}")
    outcome = course.run("check", ROSLINGS_PYTHON=None, PATH=str(tools))
    assert outcome.code == 2
    assert "apt install python3" in outcome.err


@pytest.mark.slow
def test_the_ros_libraries_go_first_and_python_starts_once(
    ready: CourseCopy,
) -> None:
    """Whatever a terminal carries from another environment comes after ours."""
    course = ready
    course.pin(ros_x="2.0")
    course.run("check")
    own = f"{course.venv}/lib:{course.site}/ros_x.libs"
    assert course.run("check").seen["libraries"] == own
    other = course.run("check", LD_LIBRARY_PATH="/other", _ROS_WHEELS_BOOTSTRAP_COMPLETE="1")
    assert other.seen["libraries"] == f"{own}:/other"
    assert other.seen["once"] == "1"
    assert course.run("check", LD_LIBRARY_PATH=own).seen["libraries"] == own


@pytest.mark.slow
def test_settings_for_pip_that_lead_astray_do_not(ready: CourseCopy, tmp_path: Path) -> None:
    """PIP_TARGET and its like in a shell profile would put the packages elsewhere."""
    astray = {"PIP_TARGET": str(tmp_path / "astray"), "PIP_USER": "1", "PYTHONPATH": os.devnull}
    assert "draw_x" in ready.run("graph", **astray).seen["has"]
    assert not (tmp_path / "astray").exists()


@pytest.mark.slow
def test_a_lab_may_need_more_groups_than_its_command(ready: CourseCopy) -> None:
    """Its card says so; the check of another lab installs no more than before."""
    for lab, line in {"arm": "groups: [graph, ros2]  # both", "leg": "title: groups"}.items():
        (ready.root / "labs" / lab).mkdir(parents=True)
        (ready.root / "labs" / lab / "card.yaml").write_text(f"id: {lab}\n{line}\n")
    assert ready.run("check", "leg", "--only", "x").seen["has"] == ["ros_x", "col_x", "check_x"]
    assert ready.run("regrade", "arm", "kept").seen["has"] == ["ros_x", "col_x", "check_x"]
    more = ready.run("check", "--solution", "arm")
    assert more.seen["has"] == ["ros_x", "col_x", "check_x", "draw_x", "bag_x"]
    assert ready.run("watch", "arm", "graph").err == ""


@pytest.mark.slow
@pytest.mark.parametrize("option", ["--kept", "--prices"])
def test_proofs_of_no_lab_in_particular_need_what_all_need(ready: CourseCopy, option: str) -> None:
    """Drills say it in their cards, too."""
    drill = "days/01-first/drills/01_wave/drill.yaml"
    for card, groups in {"labs/arm/card.yaml": "graph", drill: "ros2"}.items():
        (ready.root / card).parent.mkdir(parents=True)
        (ready.root / card).write_text(f"groups: [{groups}]\n")
    one = ready.run("prove", "arm", option)
    assert one.seen["has"] == ["ros_x", "col_x", "check_x", "draw_x"]
    assert ready.run("prove", option).seen["has"] == [*one.seen["has"], "bag_x"]


@pytest.mark.slow
def test_programs_find_what_stands_in_for_packages_of_ros(ready: CourseCopy) -> None:
    """Last on the path: a real package of the same name, of a sourced ROS, goes before it."""
    (seen,) = ready.venv.glob("lib/python3.*/site-packages/roslings.pth")
    ros2 = ready.root / "packages/ros2-on-pip/src"
    ours = [ros2, ready.root / "packages/roslings-launcher/src", ros2 / "ros2_on_pip/stand_ins"]
    assert seen.read_text().splitlines() == list(map(str, ours))
