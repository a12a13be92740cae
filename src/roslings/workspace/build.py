"""Build a package with colcon, away from the student's files."""

from __future__ import annotations

import shlex
import shutil
import sys
from dataclasses import dataclass
from pathlib import Path

from roslings.arena import Installed, Launch, Process, base_environment
from roslings.evidence import BuildSeen, ProcessSeen

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
    def complaint(self) -> Path:
        """What Python says of setup.py, where the build failed."""
        return self.folder / "complaint"

    @property
    def sourced(self) -> Path:
        """The environment after `source install/setup.bash`, as `env -0` writes it."""
        return self.folder / "environment"


def build(room: BuildRoom, home: Path, namespaces: bool) -> tuple[BuildSeen, Installed | None]:
    """Build the package in `room` and source the result; None where nothing was installed."""
    environment = base_environment(home, hidden_package=room.package)
    shell = ["bash", "--noprofile", "--norc", "-c", _script(room)]
    with Process("colcon", Launch(shell, environment, room.folder, namespaces)) as process:
        process.wait_ended(BUILD_BOUND_S)
    succeeded = process.seen.status == 0 and room.sourced.is_file()
    seen = BuildSeen(
        succeeded=succeeded,
        recognised_as=_recognised(room),
        seconds=_seconds(process.seen),
        output=_last_words(room, process),
        executables=executables(room.programs),
    )
    return seen, Installed(room.programs, read_environment(room.sourced)) if succeeded else None


def _seconds(seen: ProcessSeen) -> float:
    return round(((seen.ended_ns or seen.started_ns) - seen.started_ns) / 1e9, 3)


def _last_words(room: BuildRoom, process: Process) -> list[str]:
    """What tells most about a failure: Python's own words on setup.py, else colcon's."""
    if process.refused:
        return [process.refused]
    lines = [line.text for line in process.seen.lines]
    if room.complaint.is_file():
        lines = room.complaint.read_text("utf-8", errors="replace").splitlines() or lines
    if not process.seen.ended_by_itself:
        lines.append(f"The build did not end within {BUILD_BOUND_S:g} s.")
    return lines[-LAST_LINES:]


def _script(room: BuildRoom) -> str:
    """colcon, then the setup script that every student sources.

    Where colcon fails it hides a mistake in setup.py behind a page of its own calls: then
    setup.py is run once more, alone, for the line that the student can mend.
    """
    words = [colcon(), "--log-base", "log", "build", "--base-paths", "src", "--packages-select"]
    handlers = ["--event-handlers", "console_direct+", "desktop_notification-"]
    python = shlex.join([sys.executable, "setup.py", "--name"])
    complaint = shlex.quote(str(room.complaint))
    return f"""
        if {shlex.join([*words, room.package, *handlers])}; then
            source install/setup.bash && env -0 > {room.sourced.name}
        else
            cd {shlex.quote(str(room.source))}
            {python} > {complaint} 2>&1 && rm {complaint}
            exit 1
        fi"""


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
