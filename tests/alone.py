"""The tests of one package, in a fresh environment: what it needs is there, and no other of ours.

    ./roslings test PACKAGE [WORD...]

PACKAGE is a folder of packages/, WORD what pytest takes. Packages that are useful without the
course are installed from a wheel that is built for it. The others belong to a course's folder: the
environment sees their sources, and those of the packages that they say they stand on.
"""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any

from roslings_launcher.sources import OFFERS, merged
from sources import ALONE, ROOT

if sys.version_info >= (3, 11):
    import tomllib
else:
    import tomli as tomllib

PACKAGES = ROOT / "packages"
BUILT = shutil.ignore_patterns("*.egg-info", "build", "__pycache__", "tests")
FROM_A_WHEEL = ("ros-doctor", "ros2-on-pip", "roslings-launcher")
ENGINE = "roslings"
"""It says what it needs by the groups of the course, and what of ours by `UNDER_THE_ENGINE`."""
GROUPS = ("ros", "colcon", "check", "ros2", "graph", "generators", "vision")
TESTS_OF_THE_ENGINE = (
    "pytest-xdist",  # the tests run on both cores
    "pillow",  # draws odd pictures
    "hypothesis",  # looks for values that break a rule
    "jsonschema",  # holds a real verdict against the published schema
)
UNDER_THE_ENGINE = ("roslings-launcher", "ros-doctor", "ros2-on-pip", "roslings-rover")


class NoSuchPackage(Exception):
    """There is no package of this name."""


@dataclass(frozen=True)
class Package:
    """One of ours, as its own `pyproject.toml` describes it."""

    name: str

    @property
    def folder(self) -> Path:
        """Where it lies."""
        return PACKAGES / self.name

    @property
    def _said(self) -> dict[str, Any]:
        said: dict[str, Any] = tomllib.loads((self.folder / "pyproject.toml").read_text("utf-8"))
        return said["project"]

    @property
    def _needs(self) -> list[str]:
        return list(self._said.get("dependencies", ()))

    @property
    def ours(self) -> list[Package]:
        """Itself, and all of ours that it stands on."""
        names = UNDER_THE_ENGINE if self.name == ENGINE else filter(None, map(_ours, self._needs))
        below = [each for name in names for each in Package(name).ours]
        return list(dict.fromkeys([self, *below]))

    @property
    def theirs(self) -> list[str]:
        """What it and its tests need from the index."""
        if self.name == ENGINE:
            return [*self.needed, *TESTS_OF_THE_ENGINE]
        return [*self.needed, *self._said["optional-dependencies"]["test"]]

    @property
    def needed(self) -> list[str]:
        """What it needs itself from the index, and what it can use where that is there."""
        if self.name == ENGINE:
            return pinned(GROUPS)
        extras = self._said["optional-dependencies"].items()
        more = [need for extra, needs in extras if extra != "test" for need in needs]
        return [*(need for need in self._needs if not _ours(need)), *more]


@cache
def names() -> list[str]:
    """Of all our packages."""
    return sorted(file.parent.name for file in PACKAGES.glob("*/pyproject.toml"))


def _ours(need: str) -> str | None:
    """The package of ours that a requirement names; None where it is another one."""
    name = re.split(r"[\s=<>!~;\[]", need, maxsplit=1)[0]
    return name if name in names() else None


def pinned(groups: Sequence[str]) -> list[str]:
    """The packages of the course's groups, as constraints.txt pins them."""
    lines = (ROOT / "constraints.txt").read_text("utf-8").splitlines()
    parts = (line.partition("#") for line in lines)
    return [pin.strip() for pin, _, of in parts if pin.strip() and set(of.split()) & set(groups)]


# --- its environment ---------------------------------------------------------------------------


@contextmanager
def environment(package: Package) -> Iterator[Path]:
    """The Python of a fresh environment for its tests."""
    with tempfile.TemporaryDirectory(prefix="roslings-alone-") as scratch:
        folder = Path(scratch).resolve()
        run(sys.executable, "-m", "venv", "--without-pip", str(folder / "it"))
        python = folder / "it/bin/python"
        needs = [need for each in package.ours for need in each.theirs]
        install(python, *needs)
        if package.name in FROM_A_WHEEL:
            # A copy is built: what a build leaves would be found beside the sources.
            source = shutil.copytree(package.folder, folder / package.name, ignore=BUILT)
            words = ("wheel", "--no-deps", "--no-build-isolation", "-w", str(folder))
            pip(*words, str(source))
            install(python, "--no-deps", *map(str, folder.glob("*.whl")))
        else:
            show_sources(python, package.ours)
        yield python


def install(python: Path, *words: str) -> None:
    """With the pins of the course."""
    pip("--python", str(python), "install", "-c", str(ROOT / "constraints.txt"), *words)


def pip(*words: str) -> None:
    """That of this environment; it says nothing unless something is wrong."""
    run(sys.executable, "-m", "pip", "-q", "--disable-pip-version-check", *words)


def run(*words: str) -> None:
    """To its end, which must be a good one."""
    subprocess.run(words, check=True, stdin=subprocess.DEVNULL)


def show_sources(python: Path, packages: Sequence[Package]) -> None:
    """As `./roslings` does for the whole course: their folders, and what they offer."""
    (site,) = python.parents[1].glob("lib/python3*/site-packages")
    folders = [each.folder / "src" for each in packages]
    stand_ins = [each for folder in folders for each in folder.glob("*/stand_ins")]
    (site / "ours.pth").write_text("".join(f"{each}\n" for each in (*folders, *stand_ins)), "utf-8")
    info = site / "ours-0.1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: ours\nVersion: 0.1.0\n", "utf-8")
    (info / OFFERS).write_text(merged(each.folder / OFFERS for each in packages), "utf-8")


# --- its tests ---------------------------------------------------------------------------------


def seen_by_the_tests(package: Package) -> dict[str, str]:
    """What they start by themselves sees the same packages, and no other."""
    sources = () if package.name in FROM_A_WHEEL else (each.folder / "src" for each in package.ours)
    return {**os.environ, ALONE: os.pathsep.join(map(str, sources)), "PYTHONPATH": ""}


def main(name: str, words: Sequence[str]) -> int:
    """Run them; pytest's exit code. Raises NoSuchPackage."""
    if name not in names():
        raise NoSuchPackage(f"There is no package {name!r}. There is: {', '.join(names())}")
    package = Package(name)
    with environment(package) as python:
        tests = [str(package.folder / "tests"), *words]
        return subprocess.run(
            [python, "-m", "pytest", *tests], cwd=ROOT, env=seen_by_the_tests(package), check=False
        ).returncode


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2:]))
