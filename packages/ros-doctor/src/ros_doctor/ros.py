"""Where ROS 2 Jazzy is on this machine, found without importing or running it."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from ros_doctor.machine import ExaminedMachine, exists

DISTRO = "jazzy"
APT_PREFIX = f"/opt/ros/{DISTRO}"


@dataclass(frozen=True)
class Ros:
    """One installation of Jazzy.

    `prefix` holds `share` and `lib`; `python` can import rclpy once the shell is ready;
    `ready` is True where this terminal knows the installation already.
    """

    kind: str  # "apt", "wheels" or "source"
    prefix: Path
    python: Path
    rclpy: Path
    ready: bool

    @property
    def packages(self) -> Path:
        """The folder from which this Python imports rclpy."""
        return self.rclpy.parent


def rclpy_under(prefix: Path) -> Path | None:
    """Return the folder of rclpy in an installation, or None."""
    for pattern in ("lib/python3*/site-packages/rclpy", "local/lib/python3*/dist-packages/rclpy"):
        for folder in sorted(prefix.glob(pattern)):
            return folder
    return None


def find_ros(machine: ExaminedMachine) -> Ros | None:
    """Return the Jazzy that the course would use: the sourced one, the wheels, the apt one."""
    return next(_candidates(machine), None)


def _candidates(machine: ExaminedMachine) -> Iterator[Ros]:
    if machine.env.get("ROS_DISTRO") == DISTRO:
        yield from _sourced(machine)
    yield from _wheels(machine)
    yield from _apt(machine)


def _sourced(machine: ExaminedMachine) -> Iterator[Ros]:
    for prefix in machine.variable_paths("AMENT_PREFIX_PATH"):
        rclpy = rclpy_under(prefix)
        if rclpy and not exists(prefix / "pyvenv.cfg"):
            kind = "apt" if prefix == machine.path(APT_PREFIX) else "source"
            yield Ros(kind, prefix, machine.which("python3") or Path("python3"), rclpy, True)


def _wheels(machine: ExaminedMachine) -> Iterator[Ros]:
    for venv in environments(machine):
        rclpy = rclpy_under(venv)
        if rclpy:
            python = venv / "bin" / "python"
            yield Ros("wheels", venv, python, rclpy, _first_on_path(machine, venv))


def environments(machine: ExaminedMachine) -> list[Path]:
    """Return the Python environments that may hold the wheels, the course's own first."""
    active = machine.env.get("VIRTUAL_ENV", "")
    named = [machine.clone / ".venv", Path(active) if active else None, machine.interpreter.prefix]
    return list(dict.fromkeys(path for path in named if path))


def _first_on_path(machine: ExaminedMachine, venv: Path) -> bool:
    found = machine.which("python3") or machine.which("python")
    return found is not None and found.parent == venv / "bin"


def _apt(machine: ExaminedMachine) -> Iterator[Ros]:
    prefix = machine.path(APT_PREFIX)
    if exists(prefix / "setup.bash"):
        rclpy = rclpy_under(prefix) or prefix / "lib/python3.12/site-packages/rclpy"
        yield Ros("apt", prefix, Path("/usr/bin/python3"), rclpy, False)


def prefixes(machine: ExaminedMachine) -> list[Path]:
    """Return every folder in which this shell would look for packages."""
    ros = find_ros(machine)
    own = [ros.prefix] if ros else []
    return [*machine.variable_paths("AMENT_PREFIX_PATH"), *own]


def has_package(machine: ExaminedMachine, name: str) -> bool:
    """Tell whether a ROS package is installed where this shell would look."""
    return any(exists(prefix / "share" / name / "package.xml") for prefix in prefixes(machine))


def has_library(machine: ExaminedMachine, name: str) -> bool:
    """Tell whether `lib<name>.so` is installed where this shell would look."""
    return any(exists(prefix / "lib" / f"lib{name}.so") for prefix in prefixes(machine))
