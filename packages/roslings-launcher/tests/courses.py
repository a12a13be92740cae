"""Tiny courses with real pip and real virtual environments."""

from __future__ import annotations

import re
import shutil
import subprocess
import sysconfig
from collections.abc import Callable, Iterator
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

import pytest
from course_copy import CourseCopy, plain_environment
from package_index import PackageIndex
from pythons_here import BASE
from tiny_wheels import make_wheel, wheel_of_installed

from skips import skip_without

TOOLS = ("pip", "setuptools")


@pytest.fixture(scope="session")
def wheels_for_all(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder with pip, setuptools and the tiny packages."""
    folder = tmp_path_factory.mktemp("wheels")
    for tool in TOOLS:
        try:
            wheel_of_installed(folder, tool)
        except PackageNotFoundError:
            skip_without("pip beside pytest")
            raise
    for name in ("ros-x", "col-x", "draw-x", "bag-x", "type-x"):
        make_wheel(folder, name, "1.0")
    program = {"check_x.py": "def main():\n    print('checked')\n"}
    make_wheel(folder, "check-x", "1.0", program, scripts={"check-x": "check_x:main"})
    make_wheel(folder, "ros-x", "2.0", {"ros_x.py": "", "ros_x.libs/libx.so": "no library"})
    return folder


@pytest.fixture
def wheels(wheels_for_all: Path, tmp_path: Path) -> Path:
    """The same folder, for one test to change."""
    return Path(shutil.copytree(wheels_for_all, tmp_path / "wheels"))


def lay_out(folder: Path, name: str, wheels: Path, python: str) -> CourseCopy:
    """A fresh clone called `name` in `folder`; all that it installs is a tiny wheel in `wheels`."""
    environment = plain_environment(folder / "home", python)
    course = CourseCopy(folder / name, wheels, environment | {"ROSLINGS_WHEELS": str(wheels)})
    course.pins |= {tool: version(tool) for tool in TOOLS}
    course.lay_out()
    return course


@pytest.fixture
def make_course(wheels: Path, tmp_path: Path) -> Callable[..., CourseCopy]:
    """Lays a course out in a folder of the given name, for the given Python."""

    def make(name: str, python: str = BASE) -> CourseCopy:
        return lay_out(tmp_path, name, wheels, python)

    return make


@pytest.fixture
def course(make_course: Callable[..., CourseCopy]) -> CourseCopy:
    """A fresh clone."""
    return make_course("course")


@pytest.fixture(scope="session")
def standing(wheels_for_all: Path, tmp_path_factory: pytest.TempPathFactory) -> CourseCopy:
    """A course whose environment stands; no test changes it."""
    course = lay_out(tmp_path_factory.mktemp("standing"), "course", wheels_for_all, BASE)
    outcome = course.run("check")
    assert "ready" in outcome.err, outcome.err
    return course


@pytest.fixture
def ready(standing: CourseCopy, wheels: Path, tmp_path: Path) -> CourseCopy:
    """A copy of it, for one test to change. That a copy mends itself is what makes this quick."""
    shutil.copytree(standing.root, tmp_path / "ready", symlinks=True)
    environment = standing.environment | {"ROSLINGS_WHEELS": str(wheels)}
    copy = CourseCopy(tmp_path / "ready", wheels, environment, dict(standing.pins))
    outcome = copy.run("check")
    assert "moved or copied" in outcome.err, outcome.err
    return copy


@pytest.fixture
def index(wheels: Path) -> Iterator[PackageIndex]:
    """A package index on this machine that serves the tiny wheels."""
    with PackageIndex(wheels) as running:
        yield running


@pytest.fixture
def online(course: CourseCopy, index: PackageIndex) -> CourseCopy:
    """A fresh clone whose packages come from `index`."""
    course.environment.pop("ROSLINGS_WHEELS")
    course.environment |= {
        "PIP_INDEX_URL": index.address,
        "PIP_TRUSTED_HOST": "127.0.0.1",  # pip keeps no download from an untrusted http server
        "PIP_RETRIES": "0",
        "no_proxy": "*",
    }
    return course


def without_wheels(build_variables: str) -> str:
    """Debian's Python names a folder with pip's wheel, which ensurepip's package brings."""
    return re.sub(r"^.*'WHEEL_PKG_DIR'.*\n", "", build_variables, flags=re.MULTILINE)


@pytest.fixture
def bare_python(tmp_path: Path) -> Callable[..., str]:
    """Makes a Python like a Linux distribution's: the running one, without the named modules."""

    def make(*without: str) -> str:
        prefix = tmp_path / "bare"
        library = Path(sysconfig.get_path("stdlib"))
        copy = prefix / "lib" / library.name
        (prefix / "bin").mkdir(parents=True)
        copy.mkdir(parents=True)
        for part in library.iterdir():
            if part.name.startswith("_sysconfigdata") and "ensurepip" in without:
                (copy / part.name).write_text(without_wheels(part.read_text("utf-8")), "utf-8")
            elif part.name not in (*without, "site-packages", "dist-packages"):
                (copy / part.name).symlink_to(part)
        (copy / "site-packages").mkdir()
        python = prefix / "bin" / library.name
        shutil.copy(BASE, python)
        ask = [str(python), "-c", f"import {without[-1]}"]
        done = subprocess.run(ask, capture_output=True, text=True, check=False)
        if "No module named" not in done.stderr:
            skip_without("Python that can be copied")
            raise AssertionError(done.stderr or f"{python} sees {without[-1]}")
        return str(python)

    return make
