"""A terminal that has ROS sourced: Jazzy is used as it is, another distribution is named.

apt's Jazzy is not on every machine that tests: a prefix made of the wheels stands in for it.
"""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from importlib.metadata import Distribution, distributions
from pathlib import Path

import pytest
from compiled import uncompiled
from course_copy import REAL, CourseCopy, Outcome
from real_course import copied
from tiny_wheels import make_wheel

from ros2_on_pip.errors import INCONCLUSIVE
from roslings_launcher.interface_sources import packages_of
from roslings_launcher.packages import installed
from roslings_launcher.virtual import Virtual
from skips import skip_without
from until_told import until_told

pytestmark = pytest.mark.slow

NEEDED_BY_ROS = ("numpy", "pyyaml", "lark-parser")
APTS = "0.0.1"
"""The version of those: apt's are others than ours."""


@pytest.fixture(scope="module")
def jazzy(tmp_path_factory: pytest.TempPathFactory) -> dict[str, str]:
    """A prefix with the real rclpy, and what sourcing its setup.bash would set."""
    skip_without("module rclpy")
    prefix = tmp_path_factory.mktemp("opt") / "jazzy"
    site = prefix / f"lib/python3.{sys.version_info.minor}/site-packages"
    site.mkdir(parents=True)
    for package in distributions():
        name = str(package.metadata["Name"]).lower()
        if name.startswith("ros-") or name in NEEDED_BY_ROS:
            _link(package, site)
        if name in NEEDED_BY_ROS:
            _call(site, package, APTS)
    _link_prefix(prefix)
    libraries = [prefix / "lib", *site.glob("ros_*.libs")]
    return {
        "ROS_DISTRO": "jazzy",
        "ROS_VERSION": "2",
        "PYTHONPATH": str(site),
        "AMENT_PREFIX_PATH": str(prefix),
        "CMAKE_PREFIX_PATH": str(prefix),
        "LD_LIBRARY_PATH": os.pathsep.join(map(str, libraries)),
    }


def _link_prefix(prefix: Path) -> None:
    """What the packages hold beside Python, without what this clone has built for its labs."""
    own = [folder.name for folder in packages_of(REAL)]
    for part in ("share", "lib", "include"):
        (prefix / part).mkdir(exist_ok=True)
        for entry in (Path(sys.prefix) / part).iterdir():
            if not (prefix / part / entry.name).exists() and not any(o in entry.name for o in own):
                _same(entry, prefix / part / entry.name)


def _link(package: Distribution, site: Path) -> None:
    """Everything of the package at the top of `site`, but what runs at the start of Python."""
    for name in {path.parts[0] for path in package.files or () if path.parts[0] != ".."}:
        real = Path(str(package.locate_file(name)))
        if real.exists() and not (site / name).exists() and real.suffix != ".pth":
            _same(real, site / name)


def _call(site: Path, package: Distribution, version: str) -> None:
    """The package in `site` says that it is of this version; the linked original stays."""
    metadata = site / next(str(path) for path in package.files or () if path.name == "METADATA")
    text = metadata.read_text(encoding="utf-8")
    metadata.unlink()
    told = text.replace(f"Version: {package.version}", f"Version: {version}", 1)
    metadata.write_text(told, encoding="utf-8")


def _same(real: Path, new: Path) -> None:
    """The same files under another name: a sandbox that shows the prefix shows no link's target."""
    if real.is_dir():
        shutil.copytree(real, new, copy_function=_hard_link)
    else:
        _hard_link(str(real), str(new))


def _hard_link(real: str, new: str) -> None:
    try:
        os.link(real, new)
    except OSError:  # another disk
        shutil.copy2(real, new)


def test_a_sourced_jazzy_is_used(
    standing: CourseCopy, course: CourseCopy, jazzy: dict[str, str]
) -> None:
    """None of the wheels of ROS is installed, and rclpy is seen."""
    outcome = course.run("check", **jazzy)
    assert outcome.code == 0, outcome.err
    assert outcome.seen["prefix"] == str(course.root / ".venv-apt")
    assert set(outcome.seen["has"]) == {"col_x", "check_x", "rclpy"}
    assert outcome.seen["libraries"] == jazzy["LD_LIBRARY_PATH"]
    assert uncompiled(Virtual(course.root / ".venv-apt").site) == []
    assert course.run("check", **jazzy).err == ""


def test_two_terminals_do_not_undo_each_other(ready: CourseCopy, jazzy: dict[str, str]) -> None:
    """One has ROS sourced and one has not."""
    assert ready.run("check", **jazzy).seen["prefix"] == str(ready.root / ".venv-apt")
    without = ready.run("check")
    assert (without.err, without.seen["prefix"]) == ("", str(ready.venv))
    assert ready.run("check", **jazzy).err == ""


def test_colcon_of_the_system_is_used(
    course: CourseCopy, jazzy: dict[str, str], tmp_path: Path
) -> None:
    """Where it is on PATH, no second one is installed."""
    (tmp_path / "bin").mkdir()
    (tmp_path / "bin/colcon").write_text("#!/bin/sh\n")
    (tmp_path / "bin/colcon").chmod(0o755)
    path = f"{tmp_path}/bin:{course.environment['PATH']}"
    assert course.run("check", **jazzy, PATH=path).code == 0
    assert "col-x" not in installed(Virtual(course.root / ".venv-apt").site)


@pytest.fixture
def with_num(course: CourseCopy, tmp_path: Path) -> CourseCopy:
    """A terminal whose ROS was built with num-x 1.0; the course pins 2.0, and more of its own."""
    (tmp_path / "apt/rclpy").mkdir(parents=True)
    (tmp_path / "apt/rclpy/__init__.py").touch()
    told = tmp_path / "apt/num_x-1.0.egg-info"  # the form of Debian's packages
    told.write_text("Metadata-Version: 2.1\nName: Num_X\nVersion: 1.0\n")
    (tmp_path / "apt/num_x.py").write_text("VERSION = '1.0'\n")
    for name in ("num-x", "lark-x"):
        make_wheel(course.wheels, name, "2.0")
    with (course.root / "constraints.txt").open("a") as pins:
        pins.write("num-x==2.0  # ros check graph\nlark-x==2.0  # ros check\n")
    course.environment |= {"ROS_DISTRO": "jazzy", "PYTHONPATH": str(tmp_path / "apt")}
    return course


def test_nothing_is_laid_over_what_ros_was_built_with(with_num: CourseCopy) -> None:
    """What the ROS lacks comes as it is pinned; nothing is installed twice."""
    assert with_num.run("check").code == 0
    have = installed(Virtual(with_num.root / ".venv-apt").site)
    assert "num-x" not in have
    assert (have["lark-x"], have["check-x"]) == ("2.0", "1.0")
    assert with_num.run("graph").code == 0
    assert "num-x" not in installed(Virtual(with_num.root / ".venv-apt").site)


def test_without_a_sourced_ros_the_pins_hold(with_num: CourseCopy) -> None:
    """A folder on PYTHONPATH that is no ROS changes nothing."""
    assert with_num.run("check", ROS_DISTRO=None).code == 0
    assert installed(Virtual(with_num.venv).site)["num-x"] == "2.0"


def test_what_was_laid_over_it_is_taken_away(with_num: CourseCopy) -> None:
    """An older launcher did so. The packages that ROS does not bring stay."""
    assert with_num.run("check").code == 0
    virtual = Virtual(with_num.root / ".venv-apt")
    make = [str(virtual.python), "-m", "pip", "install", "--no-deps", "--no-index"]
    make += ["--ignore-installed", f"--find-links={with_num.wheels}", "num-x==2.0"]
    subprocess.run(make, check=True, capture_output=True, env=with_num.environment)
    assert installed(virtual.site)["num-x"] == "2.0"
    assert with_num.run("graph").code == 0
    assert "num-x" not in installed(virtual.site)
    assert "lark-x" in installed(virtual.site)


@pytest.mark.parametrize("distribution", ["humble", "kilted", "rolling", "lyrical"])
def test_another_distribution_is_named(ready: CourseCopy, distribution: str) -> None:
    """Even where an environment stands; plain commands run."""
    outcome = ready.run("check", ROS_DISTRO=distribution)
    assert outcome.code == 2
    assert distribution.capitalize() in outcome.err
    assert "new terminal" in outcome.err
    assert not (ready.root / ".venv-apt").exists()
    assert ready.run("doctor", ROS_DISTRO=distribution).code == 0


def test_a_jazzy_without_rclpy_is_named(ready: CourseCopy, tmp_path: Path) -> None:
    """The variable lingers, but the folders behind it are gone or broken."""
    (tmp_path / "rclpy").mkdir()
    (tmp_path / "rclpy/__init__.py").write_text("import no_such_library\n")
    for path in ("/nowhere", str(tmp_path)):
        outcome = ready.run("check", ROS_DISTRO="jazzy", PYTHONPATH=path)
        assert outcome.code == 2
        assert "import rclpy" in " ".join(outcome.err.split())
        assert "ros-jazzy-rclpy" in outcome.err


# --- the real course ---------------------------------------------------------------------------


@pytest.fixture(scope="module")
def beside(jazzy: dict[str, str], tmp_path_factory: pytest.TempPathFactory) -> CourseCopy:
    """This course, copied, in a terminal that has the Jazzy sourced."""
    return copied(tmp_path_factory.mktemp("beside"), **jazzy)


def graded_by(beside: CourseCopy, lab: str) -> Outcome:
    """What its check says of the lab's solution."""
    return until_told(
        lambda: beside.run("check", lab, "--solution"), lambda each: each.code == INCONCLUSIVE
    )


@pytest.mark.slow
def test_a_lab_is_graded_on_the_sourced_jazzy(beside: CourseCopy) -> None:
    """All of it, and no ROS is downloaded; the doctor does not miss what the check built with."""
    graded = graded_by(beside, "topics")
    assert "100 of 100" in graded.out, graded.out + graded.err
    environment = Virtual(beside.root / ".venv-apt")
    assert not beside.venv.exists()
    own = installed(environment.site)
    assert not [name for name in own if name.startswith("ros-") or name in NEEDED_BY_ROS]
    seen = json.loads(beside.run("doctor", "--json", "--only", "ros-found", "colcon").out)
    told = {result["id"]: result["status"] for result in seen["checks"]}
    assert told == {"ros-found": "ok", "colcon": "advice"}


@pytest.mark.slow
@pytest.mark.twice
def test_a_lab_with_types_of_its_own_is_too(beside: CourseCopy) -> None:
    """They are built beside the sourced ROS, in the overlay."""
    graded = graded_by(beside, "actions")
    assert "100 of 100" in graded.out, graded.out + graded.err
    made = beside.root / ".venv-apt/overlay/share/rover_interfaces"
    assert made.is_dir()
