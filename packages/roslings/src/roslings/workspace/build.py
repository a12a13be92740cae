"""Build a package with colcon, away from the student's files."""

from __future__ import annotations

import shlex
import shutil
import sys
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

from roslings.arena import ArenaPlace, Installed, Launch, Process, Sandbox, base_environment
from roslings.evidence import BuildSeen, NotOrdinary, ProcessSeen
from roslings.workspace.foreign import read_foreign

LAST_LINES = 40
NEIGHBOURS_MOST = 3
"""So many times as long as it may take, a build may wait for neighbours who hold the processors."""


@dataclass(frozen=True)
class BuildRoom:
    """The folders of one build: a copy of the source goes in, an installation comes out."""

    folder: Path
    """Where the build takes place, and where what it installs will be used."""
    package: str
    lies_at: Path | None = None
    """Where the folder lies while a sandbox shows it at its place; None where that is the same."""

    @property
    def lies(self) -> Path:
        """Where we read and write what the build finds in its folder."""
        return self.lies_at or self.folder

    @property
    def source(self) -> Path:
        """Where the copy of the package lies."""
        return self.lies / "src" / self.package

    @property
    def installed(self) -> Path:
        """colcon's install folder of this package."""
        return self.lies / "install" / self.package

    @property
    def programs(self) -> Path:
        """Where `ros2 run` will look for executables."""
        return self.folder / "install" / self.package / "lib" / self.package

    @property
    def complaint(self) -> Path:
        """What Python says of setup.py, where the build failed."""
        return self.lies / "complaint"

    @property
    def sourced(self) -> Path:
        """The environment after `source install/setup.bash`, as `env -0` writes it."""
        return self.lies / "environment"

    def around(self, place: ArenaPlace) -> Sandbox | None:
        """What stands around the build."""
        if place.sandbox is None:
            return None
        return replace(place.sandbox.writing(self.lies, self.folder), home=place.home)


def build(
    room: BuildRoom,
    place: ArenaPlace,
    within_s: float,
    meanwhile: Callable[[], object] = lambda: None,
) -> tuple[BuildSeen, Installed | None]:
    """Build the package in `room` and source the result; None where nothing was installed.

    `meanwhile` is called while colcon works.
    """
    environment = base_environment(place.home, hidden_package=room.package)
    shell = ["bash", "--noprofile", "--norc", "-c", _script(room)]
    namespaces, around = place.wall == "namespace", room.around(place)
    place.give(room.lies)
    launch = Launch(shell, environment, room.folder, namespaces, sandbox=around, user=place.user)
    with Process("colcon", launch) as process:
        meanwhile()
        process.wait_ended_in_own_time(within_s, NEIGHBOURS_MOST * within_s)
    sourced = read_foreign(room.sourced) if process.seen.status == 0 else None
    seen = BuildSeen(
        succeeded=sourced is not None,
        recognised_as=_recognised(room),
        seconds=_seconds(process.seen),
        output=_last_words(room, process, within_s),
        executables=executables(room),
        **process.seen.model_dump(include=set(NotOrdinary.model_fields)),
    )
    if sourced is None:
        return seen, None
    return seen, Installed(room.programs, environment_in(sourced), room.folder / "install")


def _seconds(seen: ProcessSeen) -> float:
    return round(((seen.ended_ns or seen.started_ns) - seen.started_ns) / 1e9, 3)


def _last_words(room: BuildRoom, process: Process, within_s: float) -> list[str]:
    """What tells most about a failure: Python's own words on setup.py, else colcon's."""
    lines = [line.text for line in process.seen.lines]
    if complaint := read_foreign(room.complaint):
        lines = complaint.decode("utf-8", errors="replace").splitlines() or lines
    if met := process.seen.bounds_met:
        what = "it printed without end" if "output" in met else "it took more than it may"
        lines.append(f"The build was ended: {what} ({', '.join(met)}).")
    elif not process.seen.ended_by_itself:
        lines.append(f"The build did not end within {within_s:g} s.")
    return lines[-LAST_LINES:]


def _script(room: BuildRoom) -> str:
    """colcon, then the setup script that every student sources.

    Where colcon fails it hides a mistake in setup.py behind a page of its own calls. Then setup.py
    is run once more, alone, for the line that the student can mend.
    """
    words = [colcon(), "--log-base", "log", "build", "--base-paths", "src", "--packages-select"]
    handlers = ["--event-handlers", "console_direct+", "desktop_notification-"]
    python = shlex.join([sys.executable, "setup.py", "--name"])
    complaint = shlex.quote(str(room.folder / room.complaint.name))
    source = room.folder / room.source.relative_to(room.lies)
    return f"""
        if {shlex.join([*words, room.package, *handlers])}; then
            source install/setup.bash && env -0 > {room.sourced.name}
        else
            cd {shlex.quote(str(source))}
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


def executables(room: BuildRoom) -> list[str]:
    """Names of the executables that `ros2 run` would find."""
    programs = room.lies / room.programs.relative_to(room.folder)
    leads_out = not programs.resolve().is_relative_to(room.lies.resolve())
    if leads_out or not programs.is_dir():
        return []
    return sorted(path.name for path in programs.iterdir())


def environment_in(text: bytes) -> dict[str, str]:
    """The variables in what `env -0` writes, without those that belong to the shell."""
    pairs = (pair.partition("=") for pair in text.decode(errors="replace").split("\0"))
    own = {"_", "SHLVL", "PWD", "OLDPWD", "COLCON_CURRENT_PREFIX"}
    return {name: value for name, _, value in pairs if name and name not in own}
