"""The course's own lists agree with each other: groups, pins, sizes, and the script's table."""

from __future__ import annotations

import ast
import json
import re
import subprocess
import sys
from collections.abc import Iterator
from importlib.metadata import PackageNotFoundError, requires, version
from pathlib import Path
from typing import Any

import pytest
from course_copy import REAL
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

from roslings_launcher import constraints, groups, sizes
from roslings_launcher.installing import TOOLS
from script_groups import groups_of_commands
from skips import skip_without

PYPROJECT = REAL / "pyproject.toml"
CONSTRAINTS = REAL / "constraints.txt"
CHECK = ("setup", "ros", "colcon", "check")


def tables() -> dict[str, list[Any]]:
    """The groups of pyproject.toml as TOML has them."""
    if sys.version_info >= (3, 11):
        import tomllib
    else:
        from pip._vendor import tomli as tomllib
    table: dict[str, list[Any]] = tomllib.loads(PYPROJECT.read_text())["dependency-groups"]
    return table


def pins() -> list[Requirement]:
    """Every line of constraints.txt."""
    lines = CONSTRAINTS.read_text().splitlines()
    return [Requirement(line.partition("#")[0]) for line in lines if not line.startswith("#")]


def first_of(group: str) -> list[Requirement]:
    """What a group names itself, other groups included."""
    found: list[Requirement] = []
    for word in tables()[group]:
        found += first_of(word["include-group"]) if isinstance(word, dict) else [Requirement(word)]
    return found


def closure(group: str) -> set[str]:
    """Every package that a group needs, followed through what is installed here."""
    found: set[str] = set()
    waiting = [need for need in first_of(group) if is_installed(need.name)]
    while waiting:
        need = waiting.pop()
        if canonicalize_name(need.name) not in found:
            found.add(canonicalize_name(need.name))
            waiting += needs_of(need)
    return found


def is_installed(name: str) -> bool:
    """Groups that were not asked for yet are not."""
    try:
        return bool(version(name))
    except PackageNotFoundError:
        return False


def needs_of(package: Requirement) -> Iterator[Requirement]:
    """What an installed package needs here."""
    for line in requires(package.name) or ():
        need = Requirement(line)
        extras = package.extras or {""}
        if need.marker is None or any(need.marker.evaluate({"extra": e}) for e in extras):
            yield need


@pytest.mark.parametrize("group", ["setup", "ros", "colcon", "check", "graph", "test"])
def test_every_package_that_a_group_needs_is_pinned_for_it(group: str) -> None:
    """Transitive ones too, to the version that is installed for this Python."""
    lines = constraints.of_groups(CONSTRAINTS, [group])
    pinned = [Requirement(line) for line in lines]
    here = {canonicalize_name(p.name): p for p in pinned if not p.marker or p.marker.evaluate()}
    needed = closure(group)
    if not all(is_installed(need.name) for need in first_of(group)):
        skip_without("ROS from pip")
    assert len(needed) >= len(first_of(group)) > 0
    assert needed - set(here) == set()
    wrong = [name for name in here if name in needed and version(name) not in here[name].specifier]
    assert wrong == []


def test_every_pin_names_its_groups() -> None:
    """A package that no group needs is not there."""
    known = set(groups.names(PYPROJECT))
    for pin in constraints.read(CONSTRAINTS):
        assert pin.groups
        assert pin.groups <= known


def test_pins_are_exact_and_name_no_address() -> None:
    """One version each; the registry is the machine's own business."""
    assert all(re.fullmatch(r"==[\w.!+]+", str(pin.specifier)) for pin in pins())
    assert not any(pin.url for pin in pins())
    assert "//" not in CONSTRAINTS.read_text()


def test_pins_never_conflict() -> None:
    """For each Python one line at most holds."""
    for minor in (10, 11, 12, 13):
        here = {"python_version": f"3.{minor}", "python_full_version": f"3.{minor}.1"}
        names = [p.name for p in pins() if not p.marker or p.marker.evaluate(here)]
        assert len(names) == len(set(names))


def test_ros_stays_jazzy() -> None:
    """Newer versions of the same packages are Kilted."""
    exact = {pin.name: str(pin.specifier) for pin in pins()}
    assert exact["ros-jazzy-rclpy"] == exact["ros-rclpy"] == "==7.1.6"
    assert exact["ros-rmw-fastrtps-cpp"] == "==8.4.3"
    assert exact["ros-std-msgs"] == "==5.3.6"


def test_the_tools_are_pinned() -> None:
    """pip reads groups from 25.1 on; colcon needs setuptools below 80."""
    found = constraints.exact(CONSTRAINTS, TOOLS)
    assert tuple(map(int, found["pip"].split(".")[:2])) >= (25, 1)
    assert int(found["setuptools"].split(".")[0]) < 80


def test_the_names_of_the_groups_are_read_without_toml() -> None:
    """As a TOML reader finds them."""
    assert groups.names(PYPROJECT) == list(tables())


def test_every_group_is_measured_for_every_python() -> None:
    """So that a size can be said before each download."""
    table = sizes.read()
    assert set(table) == {"3.10", "3.11", "3.12", "3.13", "3.14"}
    assert all(set(row) == set(groups.names(PYPROJECT)) for row in table.values())


@pytest.mark.parametrize("python", [(3, 11), (3, 12)])
def test_check_downloads_at_most_80_mb(python: tuple[int, int]) -> None:
    """On Ubuntu 24.04's and Debian 12's Python. On 3.10 and 3.13 Fast DDS is 4.6 MB larger."""
    found = sizes.megabytes(python, CHECK)
    assert found is not None
    assert found <= 80


def test_every_group_of_the_scripts_table_exists() -> None:
    """The table in the script `./roslings`."""
    named = {group for needed in groups_of_commands().values() for group in needed}
    assert named
    assert named <= set(groups.names(PYPROJECT))


@pytest.mark.parametrize("command", ["lab", "site", "desk", "rover", "graph", "ros2", "check"])
def test_what_a_lesson_types_is_installed_for_the_tests(command: str) -> None:
    """Else a lesson's output begins with a download, and is not what the lesson holds."""
    table = groups_of_commands()
    assert table[command] <= table["test"]


def test_the_script_is_plain_sh() -> None:
    """Nothing that only bash understands, and LF line ends in a clone made under Windows."""
    assert subprocess.run(["sh", "-n", REAL / "roslings"], check=False).returncode == 0
    assert b"\r" not in (REAL / "roslings").read_bytes()
    attributes = (REAL / ".gitattributes").read_text()
    assert re.search(r"^\* text=auto eol=lf$", attributes, re.MULTILINE)


def imports(file: Path) -> Iterator[str]:
    """The modules that a file imports."""
    for node in ast.walk(ast.parse(file.read_text())):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            yield node.module or ""


def test_no_file_of_the_bootstrap_imports_more_than_the_standard_library() -> None:
    """It runs where nothing is installed, and knows no other room."""
    folder = REAL / "packages/roslings-launcher/src/roslings_launcher"
    names = {name for file in folder.glob("*.py") for name in imports(file)}
    ours = {name for name in names if name.startswith("roslings")}
    assert all(name.startswith("roslings_launcher") for name in ours)
    assert {name.split(".")[0] for name in names - ours} <= set(sys.stdlib_module_names)


def test_sizes_hold_no_address() -> None:
    """Numbers only."""
    assert json.loads(sizes.FILE.read_text())
    assert "//" not in Path(sizes.FILE).read_text()
