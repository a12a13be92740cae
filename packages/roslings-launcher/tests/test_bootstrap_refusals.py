"""Where no environment can be made: one clear message with the next step, and nothing left."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest
from course_copy import CourseCopy
from pythons_here import BASE

from roslings_launcher.errors import LauncherTrouble
from roslings_launcher.machine import WheelPlatform, require_wheels, this_machine
from roslings_launcher.place import require_usable
from skips import skip_without

FITS = WheelPlatform("Linux", "x86_64", 64, (2, 39), (3, 12), cpython=True)

UNFIT = [
    (replace(FITS, architecture="aarch64"), "aarch64", "Ubuntu 24.04"),
    (replace(FITS, architecture="armv7l"), "armv7l", "Ubuntu 24.04"),
    (replace(FITS, system="Darwin"), "macOS", "docker run"),
    (replace(FITS, system="Windows", architecture="AMD64"), "Windows", "docker run"),
    (replace(FITS, glibc=()), "C library", "docker run"),
    (replace(FITS, glibc=(2, 27)), "2.27", "docker run"),
    (replace(FITS, bits=32), "32 bits", "docker run"),
    (replace(FITS, python=(3, 15)), "3.15", "Python 3.12"),
    (replace(FITS, cpython=False), "another build", "Python 3.12"),
]


@pytest.mark.parametrize(("machine", "reason", "step"), UNFIT, ids=lambda case: str(case)[:30])
def test_a_machine_without_wheels_is_told_the_other_way(
    machine: WheelPlatform, reason: str, step: str
) -> None:
    """What does not fit, and which way to take instead."""
    with pytest.raises(LauncherTrouble) as trouble:
        require_wheels(machine)
    assert reason in trouble.value.what
    assert any(step in text for text in trouble.value.steps)
    assert all(len(line) < 80 for line in str(trouble.value).splitlines())


@pytest.mark.parametrize("minor", [10, 11, 12, 13])
def test_the_machines_that_fit_pass(minor: int) -> None:
    """The oldest glibc and every Python; and the machine that runs this, by its own facts."""
    require_wheels(replace(FITS, glibc=(2, 28), python=(3, minor)))
    assert this_machine().python == sys.version_info[:2]
    assert this_machine().system == "Linux"


@pytest.mark.slow
@pytest.mark.parametrize("name", ["a space", "a\ttab", 'a"quote', "a`tick", "no-break\u00a0space"])
def test_a_path_that_breaks_scripts_is_refused(
    make_course: Callable[..., CourseCopy], name: str
) -> None:
    """Before anything is made."""
    outcome = make_course(name).run("check")
    assert outcome.code == 2
    assert "path of this folder" in outcome.err
    assert "Next: Move this folder" in outcome.err


@pytest.mark.slow
def test_letters_of_any_language_are_fine(ready: CourseCopy, tmp_path: Path) -> None:
    """Refused is only what breaks."""
    ready.root = ready.root.rename(tmp_path / "Müller_日本_(1)")
    assert ready.run("check").code == 0
    program = subprocess.run([ready.venv / "bin/check-x"], capture_output=True, check=True)
    assert program.stdout == b"checked\n"


@pytest.mark.slow
def test_a_path_that_linux_would_cut_is_refused(make_course: Callable[..., CourseCopy]) -> None:
    """The kernel reads no more of a script's first line."""
    outcome = make_course("/".join(["a" * 60] * 4)).run("check")
    assert outcome.code == 2
    assert "too long" in outcome.err


def in_namespace(script: str, course: CourseCopy) -> subprocess.CompletedProcess[str]:
    """Runs a shell script where it may mount; skips the test where nobody may."""
    wall = ["unshare", "--user", "--map-root-user", "--mount"]
    skip_without("small disk")
    return subprocess.run(
        [*wall, "sh", "-ec", script],
        env=course.environment,
        capture_output=True,
        text=True,
        check=False,
    )


@pytest.mark.slow
@pytest.mark.parametrize("room_kb", [4, 200, 6000])
def test_a_full_disk_is_named(course: CourseCopy, tmp_path: Path, room_kb: int) -> None:
    """Whether it fills while the environment is made, or while packages come."""
    small = tmp_path / "small"
    small.mkdir()
    done = in_namespace(
        f"mount -t tmpfs -o size=20m small {small}\n"
        f"cp -r {course.root}/. {small}\n"
        f"free=$(df -k --output=avail {small} | tail -1)\n"
        f"dd if=/dev/zero of={small}/filler bs=1k count=$((free - {room_kb})) 2>/dev/null\n"
        f"code=0; {small}/roslings check || code=$?\n"
        f"ls -A {small}; exit $code",
        course,
    )
    assert done.returncode == 2, done.stderr
    assert "disk is full" in done.stderr
    assert "Traceback" not in done.stderr
    assert ".venv\n" not in done.stdout


@pytest.mark.slow
def test_a_folder_that_cannot_be_written_is_named(course: CourseCopy) -> None:
    """A course on a read-only disk."""
    done = in_namespace(
        f"mount --bind {course.root} {course.root}\n"
        f"mount -o remount,bind,ro {course.root}\n"
        f"exec {course.root}/roslings check",
        course,
    )
    assert done.returncode == 2, done.stderr
    assert "cannot be written" in done.stderr
    assert "Next: Copy it" in done.stderr


def test_a_place_is_judged_without_making_anything(tmp_path: Path) -> None:
    """A good place passes, and nothing appears in it."""
    require_usable(tmp_path)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.slow
def test_a_python_without_venv_is_named(
    course: CourseCopy, bare_python: Callable[..., str]
) -> None:
    """Ubuntu packages it on its own."""
    outcome = course.run("check", ROSLINGS_PYTHON=bare_python("venv"))
    assert outcome.code == 2
    assert "no venv module" in outcome.err
    assert "-venv" in outcome.err
    assert "Traceback" not in outcome.err
    assert not course.venv.exists()
    assert BASE not in outcome.err
