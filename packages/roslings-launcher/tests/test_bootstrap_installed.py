"""The command of the wheel, where there is no Linux or no ROS wheel: what it says instead."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import pytest

from roslings_launcher import installed
from roslings_launcher.errors import LauncherTrouble
from roslings_launcher.machine import WheelPlatform
from roslings_launcher.readiness import readiness

FITS = WheelPlatform("Linux", "x86_64", 64, (2, 39), (3, 12), cpython=True)
MAC = replace(FITS, system="Darwin", architecture="arm64", glibc=())
WINDOWS = replace(FITS, system="Windows", architecture="AMD64", glibc=())
PI = replace(FITS, architecture="aarch64")


PC_OF_CLASS = {"PATH": "/nowhere"}
"""Its variables: no compiler is found, and no ROS is sourced."""


@pytest.fixture(autouse=True)
def no_ros(monkeypatch: pytest.MonkeyPatch) -> None:
    """This terminal has none sourced."""
    monkeypatch.delenv("ROS_DISTRO", raising=False)
    monkeypatch.delenv("ROSLINGS_COURSE", raising=False)


def lines(machine: WheelPlatform, folder: Path, **variables: str) -> str:
    """What `new` says of it, where the system's files are those in `folder`."""
    seen = readiness(machine, {**PC_OF_CLASS, **variables}, folder / "new/course", root=folder)
    return "\n".join(map(str, seen))


@pytest.mark.parametrize(
    ("machine", "steps"),
    [
        (MAC, ["lacks  ROS 2 Jazzy.", "macOS", "docker"]),
        (WINDOWS, ["lacks  a Linux.", "Windows", "wsl --install", "docker"]),
        (PI, ["lacks  ROS 2 Jazzy.", "aarch64", "Ubuntu 24.04", "docker"]),
        (replace(FITS, python=(3, 15)), ["lacks  ROS 2 Jazzy.", "3.10 to 3.14", "Install Python"]),
        (replace(FITS, glibc=(2, 17)), ["glibc 2.17, Python 3.12", "glibc 2.28 or newer"]),
    ],
)
def test_a_machine_without_wheels_hears_what_to_do(
    machine: WheelPlatform, steps: list[str], tmp_path: Path
) -> None:
    """After the course was unpacked, which works everywhere."""
    told = lines(machine, tmp_path)
    assert [step for step in steps if step not in told] == [], told


def test_what_a_machine_has_is_said_too(tmp_path: Path) -> None:
    """With how much the first use brings."""
    told = lines(FITS, tmp_path)
    assert "has    Linux on x86_64, glibc 2.39, Python 3.12" in told
    assert re.search(r"They come at the first use, about \d\d MB", " ".join(told.split()))
    assert re.search(r"has    [\d.]+ GB free", told)


def test_only_an_installed_ros_needs_a_compiler(tmp_path: Path) -> None:
    """It is found by its program. With the wheels, the message types come built."""
    assert "compiler" not in lines(FITS, tmp_path)
    assert "lacks  a C++ compiler" in lines(FITS, tmp_path, ROS_DISTRO="jazzy")
    (tmp_path / "g++").touch(mode=0o755)
    found = lines(FITS, tmp_path, ROS_DISTRO="jazzy", PATH=str(tmp_path))
    assert "has    a C++ compiler" in found


def test_a_full_disk_is_lacking(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Before anything is fetched."""
    monkeypatch.setattr("shutil.disk_usage", lambda _: SimpleNamespace(free=90_000_000))
    told = lines(FITS, tmp_path)
    assert "lacks  room on the disk: 0.1 GB free" in told
    assert "df -h" in told


def test_a_sourced_jazzy_needs_no_wheels(tmp_path: Path) -> None:
    """On a Raspberry Pi, say. One that is not sourced is found; another one is in the way."""
    told = lines(PI, tmp_path, ROS_DISTRO="jazzy")
    assert "has    ROS 2 Jazzy, sourced" in told
    assert "lacks  ROS" not in told
    (tmp_path / "opt/ros/jazzy").mkdir(parents=True)
    (tmp_path / "opt/ros/jazzy/setup.bash").touch()
    unsourced = lines(PI, tmp_path)
    assert "To use it: source /opt/ros/jazzy/setup.bash" in unsourced
    assert "lacks  ROS" not in unsourced
    assert "has ROS 2 Humble" in " ".join(lines(FITS, tmp_path, ROS_DISTRO="humble").split())


def test_windows_itself_is_not_handed_a_shell_script(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """It could not be started there."""
    (tmp_path / "roslings-course" / "packages/roslings-launcher/src/roslings_launcher").mkdir(
        parents=True
    )
    (tmp_path / "roslings-course" / "roslings").touch()
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(installed, "this_machine", lambda: WINDOWS)
    monkeypatch.setattr("sys.argv", ["roslings", "check", "topics"])
    assert installed.main() == 2
    assert "wsl --install" in capsys.readouterr().err


def test_the_nearest_course_is_taken(tmp_path: Path) -> None:
    """The one we are in before one beside us, and that before one further up."""
    below = tmp_path / "a" / "b"
    below.mkdir(parents=True)
    assert installed.nearest_course(below) is None
    for folder in (tmp_path / "roslings-course", tmp_path / "a", below / "roslings-course"):
        (folder / "packages/roslings-launcher/src/roslings_launcher").mkdir(parents=True)
        (folder / "roslings").touch()
        assert installed.nearest_course(below) == folder


def test_a_clone_carries_no_course_of_its_own(tmp_path: Path) -> None:
    """Only a wheel does; it is said, and nothing is left."""
    with pytest.raises(LauncherTrouble, match="carries no course"):
        installed.unpack(tmp_path / "new")
    assert list(tmp_path.iterdir()) == []
