"""What is not built yet, and what is not here at all: each answer names the next step."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest
from terminal import Shell

from ros2_on_pip.absent import ABSENT
from ros2_on_pip.command_names import COMMANDS
from ros2_on_pip.well_known import WELL_KNOWN, absent

TOLD = {**ABSENT, **WELL_KNOWN}

BEGINS = (
    "import sys; from ros2_on_pip import windows; windows._offered = dict;"
    " from {0} import {1}; sys.exit({1}(['x']))"
)
"""A name is typed where no other package offers a window for it."""
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
        "  colcon build",
        "  source install/setup.bash",
    ]


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


@pytest.mark.parametrize(
    "name", ["turtlesim", "robot_state_publisher", "rviz2", "rqt_image_overlay"]
)
def test_a_package_of_the_full_ros_has_a_stand_in(empty: Shell, name: str) -> None:
    """What it is, what to use here, and how the real one is installed."""
    ran = empty("run", name, "it")
    assert ran.code == 1
    assert f"'{name}' is not here" in ran.err
    assert "Use instead: " in ran.err
    assert f"sudo apt install ros-jazzy-{name.replace('_', '-')}" in ran.err


RQT_OF_JAZZY = (
    "rqt",
    "rqt_action",
    "rqt_bag",
    "rqt_bag_plugins",
    "rqt_common_plugins",
    "rqt_console",
    "rqt_controller_manager",
    "rqt_dotgraph",
    "rqt_gauges",
    "rqt_graph",
    "rqt_gui",
    "rqt_gui_cpp",
    "rqt_gui_py",
    "rqt_image_overlay",
    "rqt_image_overlay_layer",
    "rqt_image_view",
    "rqt_joint_trajectory_controller",
    "rqt_moveit",
    "rqt_msg",
    "rqt_plot",
    "rqt_publisher",
    "rqt_py_common",
    "rqt_py_console",
    "rqt_reconfigure",
    "rqt_robot_dashboard",
    "rqt_robot_monitor",
    "rqt_robot_steering",
    "rqt_runtime_monitor",
    "rqt_service_caller",
    "rqt_shell",
    "rqt_srv",
    "rqt_tf_tree",
    "rqt_topic",
)
"""Each package of Jazzy's list of distributed ones (rosdistro, 2025) that begins so."""
ALSO_ASKED_FOR = (
    "foxglove_bridge",
    "joint_state_publisher",
    "joint_state_publisher_gui",
    "micro_ros_agent",
    "nav2_map_server",
    "plotjuggler",
    "ros_gz_bridge",
    "rosbridge_server",
    "teleop_twist_joy",
    "turtlebot3_gazebo",
    "turtlebot4_gz_bringup",
    "xacro",
    "moveit_ros_move_group",
    "examples_rclcpp_minimal_publisher",
    "demo_nodes_cpp_native",
    "rviz_common",
)


@pytest.mark.parametrize("name", [*RQT_OF_JAZZY, *ALSO_ASKED_FOR])
def test_each_well_known_name_has_an_answer(name: str) -> None:
    """What it is, what to use here, and where the real one is: never only "not found"."""
    told = absent(name)
    assert told is not None
    first, second = told.told(name).splitlines()
    assert first.startswith(f"'{name}' is not here: it ") and ". Use instead: " in first
    assert second.startswith(("The real one needs Ubuntu 24.04: sudo apt install ", "No apt "))


@pytest.mark.parametrize("name", ["rqt_robot_monitor", "rqt_gui_cpp", "micro_ros_agent", "xacro"])
def test_who_types_it_reads_the_answer(empty: Shell, name: str) -> None:
    """Of the table and of a family, by `ros2 run` as guides write it."""
    ran = empty("run", name, name)
    assert (ran.code, ran.out) == (1, "")
    assert f"'{name}' is not here" in ran.err and "not found" not in ran.err


@pytest.mark.parametrize("name", ["rqtt", "blinker", "my_rqt_plot", "turtlebot", "navigation2"])
def test_other_names_are_of_nobody(name: str) -> None:
    """A slip of one's own gets no answer about another package."""
    assert absent(name) is None


def test_a_slip_in_the_name_of_ones_own_package_is_told_first(empty: Shell, tmp_path: Path) -> None:
    """`nav2_walker` is built and sourced, and `nav2_walkr` is typed."""
    marker = tmp_path / "share/ament_index/resource_index/packages/nav2_walker"
    marker.parent.mkdir(parents=True)
    marker.touch()
    ran = Shell(empty.environment | {"AMENT_PREFIX_PATH": str(tmp_path)}, tmp_path)(
        "run", "nav2_walkr", "walk"
    )
    assert "Did you mean nav2_walker?" in ran.err and "large robots" not in ran.err


def test_ones_own_package_of_such_a_name_is_not_hidden(empty: Shell, workspace: Path) -> None:
    """Who cloned it can build it."""
    write_manifest(workspace / "src" / "turtlesim", "turtlesim")
    ran = Shell(empty.environment, workspace)("run", "turtlesim", "turtlesim_node")
    assert "Build first" in ran.err


@pytest.mark.parametrize(
    ("command", "place"),
    [(name, place.partition(":")[0]) for who, name, _, place in COMMANDS if not who],
)
def test_a_command_of_the_full_ros_says_so(empty: Shell, command: str, place: str) -> None:
    """Typed alone, it is found, and names what to use."""
    told = absent(command)
    assert told is not None
    done = subprocess.run(
        [sys.executable, "-c", BEGINS.format(place, command)],
        env=empty.environment | {"PATH": "/usr/bin:/bin"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 2
    assert done.stderr.rstrip() == told.told(command)


def test_there_is_no_version_option(empty: Shell) -> None:
    """As in the real one; the question has an answer."""
    ran = empty("--version")
    assert ran.code == 2
    assert "ros2 has no --version. This is ROS 2 Jazzy" in ran.err


@pytest.mark.parametrize("name", TOLD)
def test_without_the_course_nothing_of_it_is_told(
    name: str, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """Who has `ros2` alone has no ./roslings, and no day 7."""
    monkeypatch.setattr("sys.prefix", str(tmp_path / "environment"))
    told = TOLD[name].told(name)
    assert "Use instead: " in told
    for word in ("./roslings", "roslings folder", "day 6", "day 7", "rover"):
        assert word not in told
    (tmp_path / "roslings").touch()
    assert TOLD[name].told(name).startswith(f"'{name}' is not here")
