"""Which ROS does this terminal have? A sourced Jazzy is used as it is; nothing else is."""

import os
import shutil
import subprocess
import sys
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from roslings_launcher.errors import LauncherTrouble

_NEW_TERMINAL = (
    "Open a new terminal that does not source it (look into ~/.bashrc), and run this there."
)


@dataclass(frozen=True)
class SourcedRos:
    """A Jazzy that the terminal has sourced: the Python that its rclpy runs on."""

    python: str


def find_sourced(environment: Mapping[str, str]) -> SourcedRos | None:
    """The sourced Jazzy, or None where no ROS is sourced.

    Raises:
        LauncherTrouble: another distribution is sourced, or Jazzy without a working rclpy.
    """
    distribution = environment.get("ROS_DISTRO", "")
    if not distribution:
        return None
    if distribution != "jazzy":
        raise LauncherTrouble(
            f"This terminal has ROS 2 {distribution.capitalize()} sourced. roslings teaches "
            "ROS 2 Jazzy, and the two do not mix.",
            _NEW_TERMINAL,
        )
    return SourcedRos(_python_with_rclpy())


def _python_with_rclpy() -> str:
    for python in _candidates():
        if found := _base_that_imports_rclpy(python):
            return found
    raise LauncherTrouble(
        "This terminal has ROS_DISTRO=jazzy, but no Python here can import rclpy.",
        "Install it: sudo apt install ros-jazzy-rclpy, then: source /opt/ros/jazzy/setup.bash",
        "Or open a terminal where ROS is not sourced, and run this there.",
    )


def _candidates() -> Iterator[str]:
    """The system's own Python first: it is the one that apt's rclpy is built for."""
    chosen = os.environ.get("ROSLINGS_PYTHON")
    if chosen:
        yield chosen
        return
    yield from filter(os.path.exists, ("/usr/bin/python3.12", "/usr/bin/python3"))
    for name in ("python3.12", "python3"):
        if found := shutil.which(name):
            yield found
    yield sys.executable


def _base_that_imports_rclpy(python: str) -> str:
    """The interpreter behind `python`, where that may be a virtual environment's; else nothing."""
    ask = "import sys, rclpy; print(sys.version_info >= (3, 10) and sys._base_executable)"
    try:
        done = subprocess.run(
            [python, "-c", ask],
            capture_output=True,
            stdin=subprocess.DEVNULL,
            text=True,
            check=False,
        )
    except OSError:
        return ""
    return done.stdout.strip().replace("False", "") if done.returncode == 0 else ""
