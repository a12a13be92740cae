"""The injuries: each changes a copy of the healthy workspace, never the student's own."""

from __future__ import annotations

import shutil
from pathlib import Path

from ros_doctor.machine import ExaminedMachine
from ros_doctor.ros import find_ros

HEALTHY = Path(__file__).parent / "healthy"
PACKAGE = "src/greeter"
BUILDING_S = 120.0


class NoColcon(Exception):
    """The injury needs a build, and there is no colcon."""


class CopyBuildFailed(Exception):
    """colcon could not build the copy; the text is what it said last."""


def misspell_function(workspace: Path) -> None:
    """Let the entry point name a function that does not exist."""
    _replace(workspace / PACKAGE / "setup.py", "greeter.hello:main", "greeter.hello:mian")


def remove_setup_cfg(workspace: Path) -> None:
    """Take away the file that says where programs go."""
    (workspace / PACKAGE / "setup.cfg").unlink()


def forget_depend(workspace: Path) -> None:
    """Take one dependency out of package.xml."""
    _replace(workspace / PACKAGE / "package.xml", "  <depend>std_msgs</depend>\n", "")


def forget_launch_file(workspace: Path) -> None:
    """Do not install the launch file."""
    line = '        ("share/" + package_name + "/launch", ["launch/greet.launch.xml"]),\n'
    _replace(workspace / PACKAGE / "setup.py", line, "")


def leave_a_backup(workspace: Path) -> None:
    """Put a second package of the same name beside the first."""
    shutil.copytree(workspace / PACKAGE, workspace / "src" / "greeter_backup")


def build_inside_src(workspace: Path) -> None:
    """Leave the folders that colcon makes, in the wrong place."""
    for name in ("build", "install", "log"):
        folder = workspace / "src" / name
        folder.mkdir()
        (folder / "COLCON_IGNORE").touch()


def change_after_build(workspace: Path, machine: ExaminedMachine) -> None:
    """Build for real, then change the source.

    Raises:
        NoColcon, CopyBuildFailed: the copy cannot be built on this machine.
    """
    build(workspace, machine)
    _replace(workspace / PACKAGE / "greeter" / "hello.py", 'data="Hello"', 'data="Good morning"')


def build(workspace: Path, machine: ExaminedMachine) -> None:
    """Build a workspace with colcon, as the student would.

    Raises:
        NoColcon, CopyBuildFailed: it cannot be built on this machine.
    """
    ros = find_ros(machine)
    program = machine.which("colcon") or (ros.prefix / "bin/colcon" if ros else None)
    if program is None or not program.exists():
        raise NoColcon
    places = [f"--{name}-base={workspace / name}" for name in ("build", "install")]
    log = f"--log-base={workspace / 'log'}"
    ran = machine.run(
        str(program), log, "build", f"--base-paths={workspace}", *places, timeout_s=BUILDING_S
    )
    if ran is None or ran.code != 0:
        raise CopyBuildFailed(ran.output[-300:] if ran else "it took too long")


def _replace(path: Path, old: str, new: str) -> None:
    text = path.read_text(encoding="utf-8")
    if old not in text:
        raise ValueError(f"{path} does not hold {old!r}")
    path.write_text(text.replace(old, new), encoding="utf-8")
