"""Build a package with colcon, away from the student's files."""

from __future__ import annotations

import shlex
import shutil
import sys
from dataclasses import dataclass
from pathlib import Path

from roslings.arena import Installed, Launch, Process, base_environment
from roslings.evidence import BuildSeen

BUILD_BOUND_S = 180.0
LAST_LINES = 40


@dataclass(frozen=True)
class BuildRoom:
    """The folders of one build: a copy of the source goes in, an installation comes out."""

    folder: Path
    package: str

    @property
    def source(self) -> Path:
        """Where the copy of the package lies."""
        return self.folder / "src" / self.package

    @property
    def installed(self) -> Path:
        """colcon's install folder of this package."""
        return self.folder / "install" / self.package

    @property
    def programs(self) -> Path:
        """Where `ros2 run` looks for executables."""
        return self.installed / "lib" / self.package

    @property
    def sourced(self) -> Path:
        """The environment after `source install/setup.bash`, as `env -0` writes it."""
        return self.folder / "environment"


def build(room: BuildRoom, home: Path, namespaces: bool) -> tuple[BuildSeen, Installed | None]:
    """Build the package in `room` and source the result; None where nothing was installed."""
    environment = base_environment(home, hidden_package=room.package)
    launch = Launch(
        ["bash", "--noprofile", "--norc", "-c", _script(room)], environment, room.folder, namespaces
    )
    with Process("colcon", launch) as process:
        ended = process.wait_ended(BUILD_BOUND_S)
    seen = process.seen
    output = [line.text for line in seen.lines[-LAST_LINES:]]
    if process.refused:
        output.append(process.refused)
    if not ended:
        output.append(f"The build did not end within {BUILD_BOUND_S:g} s.")
    succeeded = ended and seen.status == 0 and room.sourced.is_file()
    took_s = ((seen.ended_ns or seen.started_ns) - seen.started_ns) / 1e9
    return (
        BuildSeen(
            succeeded=succeeded,
            recognised_as=_recognised(room),
            seconds=round(took_s, 3),
            output=output,
            executables=executables(room.programs),
        ),
        Installed(room.programs, read_environment(room.sourced)) if succeeded else None,
    )


def _script(room: BuildRoom) -> str:
    """colcon, then the setup script that every student sources."""
    words = [
        colcon(),
        "--log-base",
        "log",
        "build",
        "--base-paths",
        "src",
        "--packages-select",
        room.package,
        "--event-handlers",
        "console_direct+",
        "desktop_notification-",
    ]
    return f"{shlex.join(words)} && source install/setup.bash && env -0 > {room.sourced.name}"


def colcon() -> str:
    """The colcon of this environment, else the one on PATH."""
    beside_python = Path(sys.executable).with_name("colcon")
    return str(beside_python) if beside_python.exists() else shutil.which("colcon") or "colcon"


def _recognised(room: BuildRoom) -> str | None:
    """What colcon took the package for: only a ROS package gets the ament hook."""
    hook = room.installed / "share" / room.package / "hook" / "ament_prefix_path.sh"
    if hook.is_file():
        return "ros.ament_python"
    return "python" if room.installed.is_dir() else None


def executables(programs: Path) -> list[str]:
    """Names of the executables that `ros2 run` would find."""
    return sorted(path.name for path in programs.iterdir()) if programs.is_dir() else []


def read_environment(path: Path) -> dict[str, str]:
    """The variables in a file of `env -0`, without those that belong to the shell."""
    pairs = (pair.partition("=") for pair in path.read_bytes().decode(errors="replace").split("\0"))
    own = {"_", "SHLVL", "PWD", "OLDPWD", "COLCON_CURRENT_PREFIX"}
    return {name: value for name, _, value in pairs if name and name not in own}
