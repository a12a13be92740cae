"""A launch file in Python is launched in the arena, as those in XML and YAML are, and judged."""

from __future__ import annotations

from pathlib import Path

import pytest
from launches import seen_of

from roslings.capabilities.launch.demands import start_all
from roslings.capabilities.launch.faults import LaunchFailed, LaunchMissesNode
from roslings.judge import ExperimentView, Inconclusive
from skips import imported

imported("rclpy")
BOTH = start_all(["/left", "/right"])
PYTHON = """\
import os

from launch import LaunchDescription
from launch_ros.actions import Node

print("launched by", os.getpid(), flush=True)


def generate_launch_description():
    return LaunchDescription([
        Node(package="mine", executable="it", name=name) for name in ("left", "right")
    ])
"""


def view_of(folder: Path, text: str) -> ExperimentView:
    """What is seen of a launch file in Python."""
    file = folder / "two.launch.py"
    file.write_text(text, "utf-8")
    return ExperimentView(seen_of(file))


def test_a_python_launch_file_is_carried_out(tmp_path: Path) -> None:
    """Once, by the launch; both nodes are in the graph, and the launch ends them."""
    view = view_of(tmp_path, PYTHON)
    view.must(BOTH)
    process = view.labelled("ros2 launch")
    assert process.seen.status == 0
    lines = [line.plain for line in process.seen.lines]
    assert sum(line.startswith("launched by") for line in lines) == 1
    ended = [line for line in lines if "process has finished" in line or "has died" in line]
    assert len(ended) == 2, lines


@pytest.mark.slow
def test_a_python_launch_file_that_misses_a_node(tmp_path: Path) -> None:
    """The hint speaks Python, too."""
    with pytest.raises(LaunchMissesNode) as caught:
        view_of(tmp_path, PYTHON.replace(', "right"', ",")).must(BOTH)
    assert "Node(package=..., executable=...)" in caught.value.mend


@pytest.mark.slow
def test_a_python_launch_file_with_a_fault(tmp_path: Path) -> None:
    """It fails, and the last lines name file and line."""
    with pytest.raises(LaunchFailed) as caught:
        view_of(tmp_path, PYTHON.replace("package=", "pkg=")).must(BOTH)
    assert any("two.launch.py, line 11: Node has no 'pkg'" in line for line in caught.value.log)


@pytest.mark.slow
def test_a_launch_file_for_the_full_ros_is_no_fault(tmp_path: Path) -> None:
    """What it asks for is named."""
    asked = "from launch_ros.actions import Node"
    text = PYTHON.replace(asked, "from launch_ros.actions import ComposableNodeContainer")
    with pytest.raises(
        Inconclusive, match="line 4: 'ComposableNodeContainer' is right in Jazzy, and not"
    ):
        view_of(tmp_path, text).must(BOTH)
