"""The command of the wheel, where there is no Linux or no ROS wheel: what it says instead."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest

from roslings_launcher import installed
from roslings_launcher.errors import Trouble
from roslings_launcher.machine import Machine

FITS = Machine("Linux", "x86_64", 64, (2, 39), (3, 12), cpython=True)
MAC = replace(FITS, system="Darwin", architecture="arm64", glibc=())
WINDOWS = replace(FITS, system="Windows", architecture="AMD64", glibc=())
PI = replace(FITS, architecture="aarch64")


@pytest.fixture(autouse=True)
def no_ros(monkeypatch: pytest.MonkeyPatch) -> None:
    """This terminal has none sourced."""
    monkeypatch.delenv("ROS_DISTRO", raising=False)
    monkeypatch.delenv("ROSLINGS_COURSE", raising=False)


@pytest.mark.parametrize(
    ("machine", "steps"),
    [
        (MAC, ["macOS", "docker"]),
        (WINDOWS, ["Windows", "wsl --install", "docker"]),
        (PI, ["aarch64", "Ubuntu 24.04", "docker"]),
    ],
)
def test_a_machine_without_wheels_hears_what_to_do(machine: Machine, steps: list[str]) -> None:
    """After the course was unpacked, which works everywhere."""
    told = "\n".join(installed.steps_before(machine))
    assert [step for step in steps if step not in told] == []
    assert list(installed.steps_before(FITS)) == []


def test_a_sourced_jazzy_needs_no_wheels(monkeypatch: pytest.MonkeyPatch) -> None:
    """On a Raspberry Pi, say."""
    monkeypatch.setenv("ROS_DISTRO", "jazzy")
    assert list(installed.steps_before(PI)) == []


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
    with pytest.raises(Trouble, match="carries no course"):
        installed.unpack(tmp_path / "new")
    assert list(tmp_path.iterdir()) == []
