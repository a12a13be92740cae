"""What this machine has and lacks for the course, in a few lines: `roslings new` says it at once.

The doctor looks at far more. This asks nothing that takes time, and imports the standard library.
"""

import os
import shutil
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from roslings_launcher import sizes
from roslings_launcher.errors import LauncherTrouble, wrapped
from roslings_launcher.machine import WheelPlatform, require_unix, require_wheels

FIRST_GROUPS = ("setup", "ros", "colcon", "check")
"""What the first `check` installs where no ROS is sourced."""
FIRST_BYTES = 500_000_000
"""The room on the disk that these need, downloads included."""
APT = "/opt/ros/jazzy/setup.bash"
COMPILERS = ("c++", "g++", "clang++")


@dataclass(frozen=True)
class ReadinessItem:
    """One thing that the machine has or lacks, and what follows."""

    has: bool
    what: str
    steps: tuple[str, ...] = ()

    def __str__(self) -> str:
        first = wrapped(self.what, "  has    " if self.has else "  lacks  ", " " * 9)
        return "\n".join([first, *(wrapped(step, " " * 9, " " * 11) for step in self.steps)])


def readiness(
    machine: WheelPlatform, environment: Mapping[str, str], folder: Path, root: Path = Path("/")
) -> list[ReadinessItem]:
    """What a course in `folder` finds on `machine`; `root` is where the system's files begin."""
    if machine.system == "Windows":
        return [_no_shell(machine)]
    path = environment.get("PATH", os.defpath)
    seen = [_system(machine), *_ros(machine, environment, root)]
    if environment.get("ROS_DISTRO"):  # else the course's own message types come built with it
        seen.append(_compiler(path))
    return [*seen, _disk(folder)]


def _no_shell(machine: WheelPlatform) -> ReadinessItem:
    try:
        require_unix(machine)
    except LauncherTrouble as trouble:
        return ReadinessItem(False, f"a Linux. {trouble.what}", trouble.steps)
    raise AssertionError(f"asked of {machine.system}")


def _system(machine: WheelPlatform) -> ReadinessItem:
    glibc = f", glibc {_dotted(machine.glibc)}" if machine.glibc else ""
    python = _dotted(machine.python)
    return ReadinessItem(
        True, f"{machine.system} on {machine.architecture}{glibc}, Python {python}"
    )


def _ros(
    machine: WheelPlatform, environment: Mapping[str, str], root: Path
) -> Iterator[ReadinessItem]:
    """A sourced Jazzy is used; else the wheels come by themselves; else there is another way."""
    sourced = environment.get("ROS_DISTRO", "")
    if sourced == "jazzy":
        yield ReadinessItem(True, "ROS 2 Jazzy, sourced in this terminal. It is used as it is.")
        return
    if sourced:
        yield ReadinessItem(
            False,
            f"a terminal for Jazzy: this one has ROS 2 {sourced.capitalize()} sourced.",
            ("Open a new terminal that does not source it (look into ~/.bashrc).",),
        )
    if (root / APT.lstrip("/")).is_file():
        yield ReadinessItem(True, f"ROS 2 Jazzy from apt. To use it: source {APT}")
        return
    yield _wheels(machine)


def _wheels(machine: WheelPlatform) -> ReadinessItem:
    try:
        require_wheels(machine)
    except LauncherTrouble as trouble:
        return ReadinessItem(False, f"ROS 2 Jazzy. {trouble.what}", trouble.steps)
    mb = sizes.megabytes(machine.python, FIRST_GROUPS)
    size = f", about {mb:.0f} MB" if mb else ""
    return ReadinessItem(
        True, f"what ROS's Python packages need. They come at the first use{size}."
    )


def _compiler(path: str) -> ReadinessItem:
    if any(shutil.which(name, path=path) for name in COMPILERS):
        return ReadinessItem(True, "a C++ compiler")
    return ReadinessItem(
        False,
        "a C++ compiler. Beside an installed ROS, day 5 needs one: it builds message types.",
        ("On Ubuntu and Debian: sudo apt install build-essential",),
    )


def _disk(folder: Path) -> ReadinessItem:
    free = shutil.disk_usage(_there(folder)).free
    told = f"{free / 1e9:.1f} GB free on the disk"
    if free >= FIRST_BYTES:
        return ReadinessItem(True, told)
    return ReadinessItem(
        False,
        f"room on the disk: {told}, and the first use needs {FIRST_BYTES / 1e9:.1f} GB.",
        ("Free some (look with: df -h .), or give a folder on another disk.",),
    )


def _there(folder: Path) -> Path:
    """The folder, or the one above it that is there already."""
    return next(each for each in (folder, *folder.parents) if each.is_dir())


def _dotted(version: tuple[int, ...]) -> str:
    return ".".join(map(str, version))
