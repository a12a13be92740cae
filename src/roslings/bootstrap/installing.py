"""Packages into an environment, in three steps, so that a broken download leaves it as it was.

plan     which packages are missing (asks the index, changes nothing)
fetch    their wheels into a folder (changes nothing in the environment)
install  from that folder, with no network; the environment counts as unfinished meanwhile
"""

import json
import os
import re
import shutil
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from roslings.bootstrap.packages import installed
from roslings.bootstrap.pip import Pip
from roslings.bootstrap.place import Place
from roslings.bootstrap.progress import DownloadLine
from roslings.bootstrap.seeds import find_seed
from roslings.bootstrap.trouble import Trouble
from roslings.bootstrap.virtual import Virtual

# What installs the rest: pip itself, and setuptools for the packages that come as sources.
TOOLS = ("pip", "setuptools")


@dataclass(frozen=True)
class Installer:
    """Installs groups into `virtual`, as the constraints of `place` pin them."""

    place: Place
    virtual: Virtual
    wheels: Path | None
    sees_path: bool = False

    def require_tools(self) -> None:
        """The pinned pip and setuptools are in the environment.

        Raises:
            Trouble: there is no pip on this machine, or the pinned one does not come.
        """
        pins = pinned(self.place.constraints, TOOLS)
        have = installed(self.virtual.site)
        if any(have.get(name) != version for name, version in pins.items()):
            with tempfile.TemporaryDirectory(prefix="roslings-") as scratch:
                self._install_tools(pins, Path(scratch))

    def _install_tools(self, pins: dict[str, str], scratch: Path) -> None:
        python = str(self.virtual.python)
        seed = self.virtual.site / "pip"
        if not seed.is_dir():
            seed = find_seed(python, scratch)
        first = replace(self.pip(), command=(python, str(seed)))
        # Compiling all of the two takes longer than all else here, and little of them is ever used.
        words = ["install", "--ignore-installed", "--no-deps", "--no-compile"]
        tools = [f"{name}=={version}" for name, version in pins.items()]
        drain(first, [*words, *tools], self.place.root)

    def missing(self, groups: Sequence[str], total_mb: float | None) -> list[str]:
        """The packages (`name==version`) that `groups` still need.

        An index that does not serve what packages need beside them (PEP 658) makes pip download
        them here already; they are then at hand when they are fetched.
        """
        report = self.virtual.folder / "plan.json"
        words = ["install", "--dry-run", "--progress-bar=raw", "--report", str(report)]
        lines = self.pip().run(*words, *wanted(self.place, groups), cwd=self.place.root)
        DownloadLine(total_mb).follow(lines)
        plan = json.loads(report.read_text(encoding="utf-8"))
        report.unlink()
        return [_pin(item["metadata"]) for item in plan["install"]]

    def fetch(self, packages: Sequence[str], total_mb: float | None) -> Path:
        """A folder that holds a wheel of each of `packages`."""
        if self.wheels:
            return self.wheels
        folder = self.virtual.folder / "wheels"
        words = ["wheel", "--no-deps", "--no-build-isolation", "--progress-bar=raw"]
        lines = self.pip().run(*words, "-w", str(folder), *packages, cwd=self.place.root)
        DownloadLine(total_mb).follow(lines)
        return folder

    def install(self, packages: Sequence[str], wheels: Path) -> None:
        """Puts `packages` into the environment; a folder of our own is then removed."""
        pip = replace(self.pip(), wheels=wheels)
        drain(pip, ["install", "--no-deps", *packages], self.place.root)
        if wheels != self.wheels:
            shutil.rmtree(wheels, ignore_errors=True)
            shutil.rmtree(self.place.cache, ignore_errors=True)

    def libraries(self) -> list[Path]:
        """What the ROS wheels add to LD_LIBRARY_PATH: the folders that they find themselves."""
        own = sorted(self.virtual.site.glob("ros_*.libs"))
        return [self.virtual.folder / "lib", *own] if own else []

    def pip(self) -> Pip:
        """The environment's own pip."""
        return Pip(
            command=(str(self.virtual.python), "-m", "pip"),
            log=self.place.log,
            cache=None if _home_keeps_downloads() else self.place.cache,
            wheels=self.wheels,
            sees_path=self.sees_path,
        )


def wanted(place: Place, groups: Sequence[str]) -> list[str]:
    """What pip calls `groups` of the course, as they are pinned."""
    named = [word for group in groups for word in ("--group", group)]
    return ["--no-build-isolation", "-c", str(place.constraints), *named]


def pinned(constraints: Path, names: Sequence[str]) -> dict[str, str]:
    """Name -> version of packages that are pinned without a condition.

    Raises:
        Trouble: one of them is not.
    """
    text = constraints.read_text(encoding="utf-8")
    found = {name: re.search(rf"^{name}==([^\s;]+)\s*$", text, re.MULTILINE) for name in names}
    for name, match in found.items():
        if not match:
            raise Trouble(
                f"constraints.txt does not pin {name}.", "Write it again: ./roslings pins"
            )
    return {name: match[1] for name, match in found.items() if match}


def drain(pip: Pip, words: Sequence[str], cwd: Path) -> None:
    """Runs `pip words...` to its end."""
    for _ in pip.run(*words, cwd=cwd):
        pass


def _pin(metadata: dict[str, str]) -> str:
    return f"{metadata['name']}=={metadata['version']}"


def _home_keeps_downloads() -> bool:
    """Whether pip's own folder for downloads is a real one: HOME may be unset, empty, read-only."""
    chosen = os.environ.get("PIP_CACHE_DIR") or os.environ.get("XDG_CACHE_HOME")
    folder = Path(chosen or os.environ.get("HOME") or "nowhere")
    return folder.is_absolute() and _could_be_written(folder)


def _could_be_written(folder: Path) -> bool:
    while not folder.exists():
        folder = folder.parent
    return os.access(folder, os.W_OK)
