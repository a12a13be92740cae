"""Packages into an environment, in steps, so that a broken download leaves it as it was.

    missing  which pinned packages it lacks (asks nobody outside)
    fetch    their wheels into a folder; what lies there already is not fetched again
    install  from that folder, with no network; the environment counts as unfinished meanwhile

Every package of a group is pinned, so nothing is left for pip to choose: it is told not to look
for dependencies.
"""

import os
import shutil
import tempfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from roslings_launcher import constraints
from roslings_launcher.packages import fetched, installed
from roslings_launcher.pip import Pip
from roslings_launcher.place import CoursePlace
from roslings_launcher.progress import DownloadLine, going_on
from roslings_launcher.seeds import find_seed
from roslings_launcher.virtual import Virtual

ROS = "ros"  # the group of ROS, and of all that it needs itself
TOOLS = "setup"  # the group of pip itself, and of setuptools for packages that come as sources
_AT_ONCE = 25  # packages that one pip fetches: what it has fetched is kept when it has ended well


@dataclass(frozen=True)
class Installer:
    """Installs groups into `virtual`, as the constraints of `place` pin them."""

    place: CoursePlace
    virtual: Virtual
    wheels: Path | None = None  # the only source of packages, where given
    sees_path: bool = False

    def require_tools(self) -> None:
        """The pinned pip and setuptools are in the environment.

        Raises:
            LauncherTrouble: there is no pip on this machine, or the pinned one does not come.
        """
        pins = constraints.exact(self.place.constraints, TOOLS)
        have = installed(self.virtual.site)
        if any(have.get(name) != version for name, version in pins.items()):
            with (
                tempfile.TemporaryDirectory(prefix="roslings-") as scratch,
                going_on(lambda: "Getting pip"),
            ):
                self._install_tools(pins, Path(scratch))

    def _install_tools(self, pins: dict[str, str], scratch: Path) -> None:
        python = str(self.virtual.python)
        seed = self.virtual.site / "pip"
        if not seed.is_dir():
            seed = find_seed(python, scratch)
        first = replace(self.pip(), command=(python, str(seed)))
        # Compiling pip takes longer than all else here; setuptools is compiled with the packages.
        words = ["install", "--ignore-installed", "--no-deps", "--no-compile"]
        tools = [f"{name}=={version}" for name, version in pins.items()]
        drain(first, [*words, *tools], self.place.root)

    def missing(self, groups: Sequence[str]) -> list[str]:
        """The packages (`name==version`) that `groups` still need.

        What a sourced ROS was built with (numpy, PyYAML) is taken as it is: another numpy laid over
        it, and its messages cannot be imported.
        """
        return constraints.missing(
            self.virtual.python,
            constraints.of_groups(self.place.constraints, groups),
            self.pip().environment(),
            self._from_ros(),
        )

    def replaces(self, packages: Sequence[str]) -> bool:
        """Whether one of `packages` (`name==version`) is in the environment, in another version."""
        have = installed(self.virtual.site)
        return any(package.partition("==")[0] in have for package in packages)

    def all_of(self, groups: Sequence[str]) -> list[str]:
        """All packages (`name==version`) of `groups` on this Python."""
        requirements = constraints.of_groups(self.place.constraints, groups)
        return constraints.applying(self.virtual.python, requirements, self.pip().environment())

    def uncover_ros(self) -> None:
        """Removes what an older launcher laid over packages that the sourced ROS was built with."""
        over = constraints.seen_twice(
            self.virtual.python, self._from_ros(), self.pip().environment()
        )
        if over:  # pip would take the one that stands first on the path, and refuse
            own = replace(self.pip(), sees_path=False, wheels=None)
            drain(own, ["uninstall", "--yes", *over], self.place.root)

    def _from_ros(self) -> set[str]:
        """The packages that a sourced ROS brings along; none where no ROS is sourced."""
        if not self.sees_path:
            return set()
        pins = self.place.constraints
        return constraints.names_of(pins, ROS) - constraints.names_of(pins, TOOLS)

    def fetch(self, packages: Sequence[str], folder: Path, total_mb: float | None) -> None:
        """Afterwards `folder` holds a wheel of each of `packages`."""
        left = [package for package in packages if package not in fetched(folder)]
        words = ["wheel", "--no-deps", "--no-build-isolation", "--progress-bar=raw"]
        words += ["--ignore-requires-python"]  # the pins know better, and may be for another one
        with DownloadLine(total_mb) as line:
            for some in at_once(left, _AT_ONCE):
                line.follow(self.pip().run(*words, "-w", str(folder), *some, cwd=self.place.root))

    def require_wheels(self, packages: Sequence[str]) -> None:
        """Nothing where the only source of packages has all of `packages`.

        Raises:
            LauncherTrouble: one is missing.
        """
        drain(self.pip(), ["install", "--dry-run", "--no-deps", *packages], self.place.root)

    def install(self, packages: Sequence[str], wheels: Path) -> None:
        """Puts `packages` into the environment; a folder of our own is then removed."""
        pip = replace(self.pip(), wheels=wheels)
        before = self._count()
        with going_on(lambda: f"{self._count() - before} of {len(packages)} packages"):
            drain(pip, ["install", "--no-deps", *packages], self.place.root)
        if wheels != self.wheels:
            shutil.rmtree(wheels, ignore_errors=True)

    def _count(self) -> int:
        """How many packages are in the environment; those that are replaced count too late."""
        return sum(1 for _ in self.virtual.site.glob("*.dist-info"))

    def libraries(self) -> list[Path]:
        """What the ROS wheels add to LD_LIBRARY_PATH: the folders that they find themselves."""
        own = sorted(self.virtual.site.glob("ros_*.libs"))
        return [self.virtual.folder / "lib", *own] if own else []

    def pip(self) -> Pip:
        """The environment's own pip."""
        return Pip(
            command=(str(self.virtual.python), "-m", "pip"),
            log=self.place.log,
            keeps_downloads=_home_keeps_downloads(),
            wheels=self.wheels,
            sees_path=self.sees_path,
        )


def at_once(packages: Sequence[str], most: int) -> Iterator[list[str]]:
    """`name==version` texts, so many at a time, and never two versions of one package together.

    pip takes that for a conflict, also where it only fetches.
    """
    waiting = list(packages)
    while waiting:
        some: dict[str, str] = {}
        for package in waiting:
            if len(some) < most:
                some.setdefault(package.partition("==")[0], package)
        yield [*some.values()]
        waiting = [package for package in waiting if package not in some.values()]


def drain(pip: Pip, words: Sequence[str], cwd: Path) -> None:
    """Runs `pip words...` to its end."""
    for _ in pip.run(*words, cwd=cwd):
        pass


def _home_keeps_downloads() -> bool:
    """Whether pip's own folder for downloads is a real one: HOME may be unset, empty, read-only."""
    chosen = os.environ.get("PIP_CACHE_DIR") or os.environ.get("XDG_CACHE_HOME")
    folder = Path(chosen or os.environ.get("HOME") or "nowhere")
    return folder.is_absolute() and _could_be_written(folder)


def _could_be_written(folder: Path) -> bool:
    while not folder.exists():
        folder = folder.parent
    return os.access(folder, os.W_OK)
