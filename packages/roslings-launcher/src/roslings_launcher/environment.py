"""The environment made ready: the one way from whatever is there to what a command needs."""

import os
import shutil
import sys
import time
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from roslings_launcher import sizes
from roslings_launcher.bytecode import compile_packages
from roslings_launcher.errors import LauncherTrouble, say, wrapped
from roslings_launcher.installing import TOOLS, Installer
from roslings_launcher.interfaces import GENERATORS, GROUP, Interfaces
from roslings_launcher.lock import locked
from roslings_launcher.machine import require_wheels, this_machine
from roslings_launcher.packages import forget_damaged
from roslings_launcher.place import CoursePlace, require_usable
from roslings_launcher.record import EnvironmentRecord
from roslings_launcher.seeds import interpreter
from roslings_launcher.sourced import SourcedRos, find_sourced
from roslings_launcher.virtual import Virtual

SEEN_BY_ALL = {"test"}
"""Groups with plugins of pytest, which every grading would load while they are half there."""


@dataclass(frozen=True)
class EnvironmentRequest:
    """What a command asks for."""

    command: str
    groups: tuple[str, ...]


def make_ready(root: Path, request: EnvironmentRequest) -> None:
    """Afterwards the environment in `root` holds the groups of `request`.

    Raises:
        LauncherTrouble: it cannot be made here; an environment that stood before still stands.
    """
    ros = find_sourced(os.environ)
    require_usable(root)
    if not ros:
        require_wheels(this_machine())
    work = _Work(CoursePlace(root, ".venv-apt" if ros else ".venv"), request, ros, _wheels())
    with locked(work.place.lock):
        work.do()


def _wheels() -> Path | None:
    named = os.environ.get("ROSLINGS_WHEELS")
    if not named:
        return None
    folder = Path(named).absolute()
    if not any(folder.glob("*.whl")):
        raise LauncherTrouble(
            f"ROSLINGS_WHEELS names a folder without wheels: {folder}",
            "Fill it on a machine with a network: ./roslings wheels DIR",
        )
    return folder


@dataclass(frozen=True)
class _Work:
    place: CoursePlace
    request: EnvironmentRequest
    ros: SourcedRos | None
    wheels: Path | None

    @property
    def record(self) -> EnvironmentRecord:
        return EnvironmentRecord(self.place)

    @property
    def virtual(self) -> Virtual:
        return Virtual(self.place.environment)

    def do(self) -> None:
        self._mend_move()
        if self.record.holds(self.request.groups) and self.virtual.runs():
            return  # another ./roslings was quicker
        stood = self.record.complete
        try:
            self._make()
        except BaseException:
            if not stood and not self.record.groups:
                self.virtual.remove()
            raise

    def _mend_move(self) -> None:
        old = self.record.home
        if old is None or old == self.place.root:
            return
        say(wrapped(f"This folder was moved or copied from {old}. Mending its environment."))
        groups = self.record.groups
        self.record.put_aside()
        self.virtual.moved_from(old / self.place.name)
        self.virtual.see(self.place.root)
        if self.virtual.runs() and not forget_damaged(self.virtual.site):
            if GENERATORS in groups:
                self._interfaces().build.prepare()
            compile_packages(self.virtual)  # a copy may have given its files new times
            self.record.write(groups, self._installer().libraries())

    def _make(self) -> None:
        started_s = time.monotonic()
        if GENERATORS in self._with_generators(self.request.groups):
            self._interfaces().build.require_compiler()
        if not self.virtual.runs():
            self._start_anew()
        elif not self.record.complete or self.record.is_added_to:
            say("The last set-up was interrupted. Mending it.")
            forget_damaged(self.virtual.site)
        self.virtual.see(self.place.root)
        self._install([group for group in self._wanted() if group not in self._from_ros()])
        self._provide_interfaces()
        compile_packages(self.virtual)
        self.record.write({TOOLS, *self._wanted()}, self._installer().libraries())
        say(f"The environment is ready, after {time.monotonic() - started_s:.0f} s.\n")

    def _start_anew(self) -> None:
        """The groups of an environment that broke are forgotten with it."""
        python = self.ros.python if self.ros else interpreter()
        say(f"Making the environment in {self.place.name}, once.")
        self.virtual.make(python, sees_system=self.ros is not None)

    def _wanted(self) -> list[str]:
        """The groups wanted now or before."""
        before = sorted(self.record.groups - set(self.request.groups))
        return self._with_generators([*self.request.groups, *before])

    def _with_generators(self, groups: Sequence[str]) -> list[str]:
        """And what builds the message types that do not come built, where such are wanted."""
        builds = GROUP in groups and GENERATORS not in groups and self._interfaces().to_build
        return [*groups, GENERATORS] if builds else [*groups]

    def _provide_interfaces(self) -> None:
        interfaces = self._interfaces()
        if GENERATORS in self.request.groups:
            interfaces.build.require_headers()
        if GROUP in self._wanted():
            interfaces.provide()
        if GENERATORS in self._wanted():
            interfaces.build.prepare()

    def _from_ros(self) -> set[str]:
        if not self.ros:
            return set()
        brought = {"ros", GROUP, GENERATORS}
        return {*brought, "colcon"} if shutil.which("colcon") else brought

    def _install(self, groups: Sequence[str]) -> None:
        installer = self._installer()
        new = [group for group in (TOOLS, *groups) if group not in self.record.groups]
        self._announce(new)
        installer.require_tools()
        installer.uncover_ros()
        packages = installer.missing(groups)
        if packages:
            wheels = self._wheels_of(packages, new or groups)
            say(f"Installing {_counted(packages)}.")
            self._begin_to_change(installer.replaces(packages), new)
            installer.install(packages, wheels)

    def _begin_to_change(self, replaces: bool, groups: Sequence[str]) -> None:
        """Who needs only what stands goes on meanwhile, unless something of that is replaced."""
        if self.record.complete and not (replaces or SEEN_BY_ALL & set(groups)):
            self.record.begin_adding()
        else:
            self.record.put_aside()

    def _announce(self, new: Sequence[str]) -> None:
        """How much comes from the network, before it does. A changed pin comes without a size."""
        mb = sizes.megabytes(sys.version_info[:2], new)
        if self.wheels:
            say(f"Installing from {self.wheels}, with no network.")
        elif mb:
            say(f"`{self.request.command}` needs up to {mb:.0f} MB from the network, once.")

    def _wheels_of(self, packages: Sequence[str], groups: Sequence[str]) -> Path:
        if self.wheels:
            self._installer().require_wheels(packages)
            return self.wheels
        total_mb = sizes.megabytes(sys.version_info[:2], groups)
        self._installer().fetch(packages, self.place.wheels, total_mb)
        return self.place.wheels

    def _interfaces(self) -> Interfaces:
        return Interfaces(self.place, self.virtual, sourced=self.ros is not None)

    def _installer(self) -> Installer:
        return Installer(self.place, self.virtual, self.wheels, sees_path=self.ros is not None)


def _counted(packages: Sequence[str]) -> str:
    return packages[0] if len(packages) == 1 else f"{len(packages)} packages"
