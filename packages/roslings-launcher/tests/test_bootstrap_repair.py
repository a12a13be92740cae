"""An environment that is stale, moved, broken or half made is right again after the next run."""

from __future__ import annotations

import os
import signal
import subprocess
import time
from pathlib import Path

import pytest
from course_copy import CourseCopy
from tiny_wheels import make_wheel

from roslings_launcher.packages import forget_damaged, installed

pytestmark = pytest.mark.slow

MANY = 3000


def test_a_group_is_installed_when_first_asked_for(ready: CourseCopy) -> None:
    """`graph` needs one more package, and the rest stays as it is."""
    assert "draw_x" not in ready.run("check").seen["has"]
    before = (ready.site / "check_x.py").stat()
    outcome = ready.run("graph")
    assert "draw_x" in outcome.seen["has"]
    assert "Installing draw-x==1.0." in outcome.err
    assert (ready.site / "check_x.py").stat() == before
    assert ready.run("check").err == ""


def test_a_changed_pin_is_installed(ready: CourseCopy) -> None:
    """The old version goes."""
    ready.pin(ros_x="2.0")
    assert ready.run("check").code == 0
    assert installed(ready.site)["ros-x"] == "2.0"
    assert ready.run("check").err == ""


def test_a_failed_change_leaves_what_stood(ready: CourseCopy, wheels: Path) -> None:
    """The wheel of a new group does not come: the old groups still work."""
    next(wheels.glob("draw_x*")).unlink()
    outcome = ready.run("graph")
    assert outcome.code == 2
    assert "no wheel of draw-x" in outcome.err
    assert "./roslings wheels" in outcome.err
    assert "Traceback" not in outcome.err
    assert (ready.run("check").code, ready.run("check").err) == (0, "")


def test_a_failed_first_use_leaves_no_environment(course: CourseCopy, wheels: Path) -> None:
    """Nothing half made, and pip's report stays where the message says."""
    next(wheels.glob("check_x*")).unlink()
    outcome = course.run("check")
    assert outcome.code == 2
    assert "no wheel of check-x" in outcome.err
    assert not course.venv.exists()
    assert (course.root / ".venv.log").is_file()


def test_a_moved_folder_says_so_and_mends(ready: CourseCopy, tmp_path: Path) -> None:
    """Nothing is downloaded for it, and the programs in it run."""
    old = ready.root
    ready.root = ready.root.rename(tmp_path / "mové d'ici".replace(" ", "_"))
    outcome = ready.run("check", ROSLINGS_WHEELS=None, PIP_INDEX_URL="http://127.0.0.1:1")
    assert f"moved or copied from {old}" in " ".join(outcome.err.split())
    assert outcome.seen["prefix"] == str(ready.venv)
    program = subprocess.run([ready.venv / "bin/check-x"], capture_output=True, check=True)
    assert program.stdout == b"checked\n"
    assert ready.run("check").err == ""


def test_a_copy_that_lost_files_is_filled_again(ready: CourseCopy, tmp_path: Path) -> None:
    """A copy was interrupted, or a stick had no more room."""
    ready.root = ready.root.rename(tmp_path / "copy")
    (ready.site / "check_x.py").unlink()
    outcome = ready.run("check")
    assert (outcome.code, "check_x" in outcome.seen["has"]) == (0, True), outcome.err


def test_a_python_that_has_gone_makes_it_anew(ready: CourseCopy) -> None:
    """An upgrade of the system took the interpreter away."""
    (ready.venv / "bin/python").unlink()
    (ready.venv / "bin/python").symlink_to("/nowhere/python3")
    outcome = ready.run("check")
    assert (outcome.code, outcome.seen["prefix"]) == (0, str(ready.venv)), outcome.err


@pytest.mark.parametrize("ending", [signal.SIGKILL, signal.SIGINT], ids=["killed", "ctrl-c"])
def test_an_interrupted_change_is_mended(
    ready: CourseCopy, wheels: Path, ending: signal.Signals
) -> None:
    """Stopped while files are being written, it is whole after the next run."""
    files: dict[str, str | bytes] = {f"many_x/m{n}.py": "x = 1\n" * 50 for n in range(MANY)}
    make_wheel(wheels, "check-x", "2.0", files | {"check_x.py": ""})
    ready.pin(check_x="2.0")
    started = ready.start("check")
    wait_until(lambda: any((ready.site / "many_x").glob("m*.py")), started)
    os.killpg(started.pid, ending)
    _, err = started.communicate()
    assert "Traceback" not in err
    if ending is signal.SIGINT:
        assert started.returncode in (130, -signal.SIGINT)
    again = ready.run("check")
    assert again.code == 0, again.err
    assert len(list((ready.site / "many_x").glob("m*.py"))) == MANY
    assert ready.run("check").err == ""


def slow_to_add(wheels: Path) -> None:
    """The package of `graph` gets so many files that one can look in while they are written."""
    files: dict[str, str | bytes] = {f"many_x/m{n}.py": "x = 1\n" * 50 for n in range(MANY)}
    make_wheel(wheels, "draw-x", "1.0", files | {"draw_x.py": ""})


def is_adding(course: CourseCopy) -> bool:
    """Files of the package that is added are there."""
    return any((course.site / "many_x").glob("m*.py"))


def test_who_needs_only_what_stands_goes_on_while_something_is_added(
    ready: CourseCopy, wheels: Path
) -> None:
    """Nobody waits for the packages of `site` to check a lab."""
    slow_to_add(wheels)
    first = ready.start("graph")
    wait_until(lambda: is_adding(ready), first)
    os.killpg(first.pid, signal.SIGSTOP)  # in the middle
    try:
        meanwhile = ready.run("check")
    finally:
        os.killpg(first.pid, signal.SIGCONT)
    assert (meanwhile.code, meanwhile.err) == (0, "")
    assert first.communicate()[1].count("Installing draw-x==1.0.") == 1
    assert first.returncode == 0
    assert (ready.run("graph").err, "draw_x" in ready.run("graph").seen["has"]) == ("", True)


def test_what_was_being_added_when_it_was_killed_is_added_again(
    ready: CourseCopy, wheels: Path
) -> None:
    """What stood before is as it was; the next one who wants the new packages gets all of them."""
    slow_to_add(wheels)
    started = ready.start("graph")
    wait_until(lambda: is_adding(ready), started)
    os.killpg(started.pid, signal.SIGKILL)
    started.communicate()
    assert (ready.run("check").code, ready.run("check").err) == (0, "")
    again = ready.run("graph")
    assert again.code == 0 and "interrupted" in again.err, again.err
    assert len(list((ready.site / "many_x").glob("m*.py"))) == MANY
    assert ready.run("graph").err == ""


def wait_until(condition: object, process: subprocess.Popen[str]) -> None:
    """Waits for a condition while `process` runs; its end comes first only by mistake."""
    assert callable(condition)
    while not condition():
        assert process.poll() is None, process.communicate()
        time.sleep(0.002)


def test_two_at_once_wait_for_one_another(ready: CourseCopy, wheels: Path) -> None:
    """The second says that it waits, and then has nothing left to do."""
    files: dict[str, str | bytes] = {f"many_x/m{n}.py": "x = 1\n" * 50 for n in range(MANY)}
    make_wheel(wheels, "check-x", "2.0", files | {"check_x.py": ""})
    ready.pin(check_x="2.0")
    first = ready.start("check")
    wait_until(lambda: changing(ready), first)
    second = ready.run("check")
    _, first_err = first.communicate()
    assert (first.returncode, second.code) == (0, 0), (first_err, second.err)
    assert "waiting" in second.err
    assert "Installing" in first_err
    assert "Installing check-x" not in second.err


def changing(course: CourseCopy) -> bool:
    """Whether the record is put aside."""
    return (course.venv / "roslings.aside").exists()


def test_damage_is_found(ready: CourseCopy) -> None:
    """Each way in which a package may be half there."""
    site = ready.site
    assert forget_damaged(site) == []
    (site / "check_x.py").write_text("cut")
    (site / "col_x-1.0.dist-info/INSTALLER").unlink()
    (site / "ros_x-1.0.dist-info/RECORD").unlink()
    assert sorted(forget_damaged(site)) == ["check_x-1.0", "col_x-1.0", "ros_x-1.0"]
    assert set(installed(site)) == {"pip", "roslings-workspace", "setuptools"}


def test_judging_again_needs_no_ros(course: CourseCopy) -> None:
    """Who only judges saved evidence downloads little."""
    assert course.run("regrade").seen["has"] == ["check_x"]


@pytest.mark.parametrize("words", [("--evidence", "here"), ("--evidence=here",)])
def test_evidence_needs_what_writes_bags(ready: CourseCopy, words: tuple[str, ...]) -> None:
    """`check` alone stays small; `check --evidence` loads one more group, once."""
    assert "bag_x" not in ready.run("check").seen["has"]
    outcome = ready.run("check", "lab", *words)
    assert "Installing" in outcome.err
    assert "bag_x" in outcome.seen["has"]
    assert ready.run("check", "lab", *words).err == ""
