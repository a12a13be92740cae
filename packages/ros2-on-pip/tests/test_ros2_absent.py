"""What is not built yet, and what is not here at all: each answer names the next step."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
from terminal import Shell

from ros2_on_pip.absent import ABSENT

BEGINS = "from ros2_on_pip import absent; import sys; sys.exit(absent.{}(['x']))"
MANIFEST = "<package><name>{name}</name></package>"


def write_manifest(folder: Path, name: str = "blinker") -> None:
    """A package, as far as `ros2 run` looks."""
    folder.mkdir(parents=True)
    (folder / "package.xml").write_text(MANIFEST.format(name=name))


@pytest.fixture
def workspace(tmp_path: Path) -> Path:
    """A workspace with one package that nobody has built."""
    write_manifest(tmp_path / "roslings_ws" / "src" / "blinker")
    return tmp_path / "roslings_ws"


def test_before_the_first_build(empty: Shell, workspace: Path) -> None:
    """In the workspace: build, then the line that then exists."""
    ran = Shell(empty.environment, workspace)("run", "blinker", "blink")
    assert ran.code == 1
    assert ran.err.splitlines() == [
        "Package 'blinker' not found.",
        "It is not built yet. Build first, then source, in this terminal:",
        "  colcon build", "  source install/setup.bash",
    ]  # fmt: skip


@pytest.mark.parametrize("stands", [".", "roslings_ws/src/blinker"])
def test_from_another_folder_the_way_is_named(empty: Shell, workspace: Path, stands: str) -> None:
    """The course's own workspace is found from anywhere, and one's own from inside."""
    ran = Shell(empty.environment, workspace.parent / stands)("run", "blinker", "blink")
    assert "  cd ~/roslings_ws\n  colcon build\n  source install/setup.bash" in ran.err


@pytest.mark.parametrize("place", ["install/blinker", "install"])
def test_built_and_not_sourced(empty: Shell, workspace: Path, place: str) -> None:
    """Only the line that is missing."""
    write_manifest(workspace / place / "share" / "blinker")
    (workspace / "install" / "setup.bash").touch()
    ran = Shell(empty.environment, workspace.parent)("run", "blinker", "blink")
    told = "It is built. Source its workspace in this terminal: "
    assert ran.err.splitlines()[1:] == [f"{told}source ~/roslings_ws/install/setup.bash"]


@pytest.mark.parametrize("name", ["turtlesim", "tf2_ros", "rviz2", "rqt_image_view"])
def test_a_package_of_the_full_ros_has_a_stand_in(empty: Shell, name: str) -> None:
    """What it is, what to use here, and how the real one is installed."""
    ran = empty("run", name, "it")
    assert ran.code == 1
    assert f"'{name}' is not here" in ran.err
    assert "Use instead: " in ran.err
    assert f"sudo apt install ros-jazzy-{name.replace('_', '-')}" in ran.err


def test_ones_own_package_of_such_a_name_is_not_hidden(empty: Shell, workspace: Path) -> None:
    """Who cloned it can build it."""
    write_manifest(workspace / "src" / "turtlesim", "turtlesim")
    ran = Shell(empty.environment, workspace)("run", "turtlesim", "turtlesim_node")
    assert "Build first" in ran.err


@pytest.mark.parametrize("command", ["rqt", "rqt_console", "rqt_plot", "rviz2"])
def test_a_command_of_the_full_ros_says_so(empty: Shell, command: str) -> None:
    """Typed alone, it is found, and names what to use."""
    done = subprocess.run(
        [sys.executable, "-c", BEGINS.format(command)],
        env=empty.environment | {"PATH": "/usr/bin:/bin"},
        capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 2
    assert done.stderr.rstrip() == ABSENT[command].told(command)


def test_there_is_no_version_option(empty: Shell) -> None:
    """As in the real one; the question has an answer."""
    ran = empty("--version")
    assert ran.code == 2
    assert "ros2 has no --version. This is ROS 2 Jazzy" in ran.err


@pytest.mark.parametrize("name", ABSENT)
def test_without_the_course_nothing_of_it_is_told(
    name: str, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """Who has `ros2` alone has no ./roslings, and no day 7."""
    monkeypatch.setattr("sys.prefix", str(tmp_path / "environment"))
    told = ABSENT[name].told(name)
    assert "Use instead: " in told
    for word in ("./roslings", "roslings folder", "day 7", "rover"):
        assert word not in told
    (tmp_path / "roslings").touch()
    assert ABSENT[name].told(name).startswith(f"'{name}' is not here")
