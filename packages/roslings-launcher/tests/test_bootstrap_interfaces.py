"""A lab's own message types: what they need, when they are stale, and what is mended for them."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest
from course_copy import CourseCopy

from roslings_launcher.errors import Trouble
from roslings_launcher.interfaces import Interfaces
from roslings_launcher.place import Place
from roslings_launcher.virtual import Virtual
from skips import imported

GROUP = 'interfaces = ["type-x"]\n'
SH_TOOLS = ("dirname", "readlink", "cmp")


@pytest.fixture
def arm(course: CourseCopy) -> CourseCopy:
    """A fresh clone with a lab `arm` that asks for types of its own, and has none yet."""
    pyproject = course.root / "pyproject.toml"
    pyproject.write_text(pyproject.read_text() + GROUP)
    pins = course.root / "constraints.txt"
    pins.write_text(f"{pins.read_text()}type-x==1.0  # interfaces\n")
    (course.root / "labs/arm").mkdir(parents=True)
    (course.root / "labs/arm/card.yaml").write_text("groups: [interfaces]\n")
    return course


def add_types(root: Path) -> Path:
    """A package of types in the lab."""
    package = root / "labs/arm/interfaces/arm_interfaces"
    (package / "msg").mkdir(parents=True)
    (package / "package.xml").write_text("<package/>")
    (package / "msg/Bend.msg").write_text("float64 angle\n")
    return package


def without_compiler(folder: Path) -> str:
    """A PATH with what the script needs, and no compiler."""
    tools = folder / "tools"
    tools.mkdir()
    for name in SH_TOOLS:
        (tools / name).symlink_to(f"/usr/bin/{name}")
    return str(tools)


@pytest.mark.slow
def test_without_a_compiler_the_next_step_is_said(arm: CourseCopy, tmp_path: Path) -> None:
    """Before anything is downloaded; what does not need one works all the same."""
    path = without_compiler(tmp_path)
    add_types(arm.root)
    outcome = arm.run("check", "arm", PATH=path)
    assert outcome.code == 2
    assert "sudo apt install build-essential" in outcome.err
    assert not arm.venv.exists()
    assert arm.run("check", "leg", PATH=path).seen["has"] == ["ros_x", "col_x", "check_x"]


@pytest.mark.slow
def test_changed_types_are_built_again(arm: CourseCopy) -> None:
    """The script sees it by itself; a lab that asks for none is not held up."""
    assert arm.run("check", "arm").seen["has"] == ["ros_x", "col_x", "check_x", "type_x"]
    assert arm.run("check", "arm").err == ""
    add_types(arm.root)
    stale = arm.run("check", "arm")  # the tiny packages hold no numpy, so it ends there
    assert (stale.code, "numpy" in stale.err, "Next:" in stale.err) == (2, True, True)


@pytest.mark.slow
def test_tf_is_built_where_it_can_be(arm: CourseCopy, tmp_path: Path) -> None:
    """Without a compiler the rover runs all the same, and nobody waits for one."""
    path = without_compiler(tmp_path)
    plain = arm.run("rover", PATH=path).seen["has"]
    assert arm.run("rover", "--tf", PATH=path).seen["has"] == plain
    assert "type_x" not in plain
    assert "type_x" in arm.run("rover", "--tf").seen["has"]


def interfaces_of(root: Path) -> Interfaces:
    """Those of the course in `root`; its environment's Python is the running one."""
    environment = root / ".venv"
    (environment / "bin").mkdir(parents=True)
    python = environment / "bin" / "python"
    python.write_text(f'#!/bin/sh\nexec {sys.executable} "$@"\n')
    python.chmod(0o755)
    (root / "constraints.txt").write_text("")
    return Interfaces(Place(root), Virtual(environment), sourced=False)


def test_they_stand_as_long_as_nothing_changes(tmp_path: Path) -> None:
    """Neither their sources nor the pins."""
    interfaces, package = interfaces_of(tmp_path), add_types(tmp_path)
    assert interfaces.sources == [package]
    assert not interfaces.stand
    stamp = tmp_path / ".venv/interfaces.stamp"
    stamp.write_text(interfaces._fingerprint())
    assert interfaces.stand
    (package / "msg/Bend.msg").write_text("float32 angle\n")
    assert not interfaces.stand


def test_the_wheels_files_get_this_machines_headers(tmp_path: Path) -> None:
    """Those of the container where the wheels were made, and of a folder that was moved."""
    imported("numpy")
    interfaces = interfaces_of(tmp_path)
    file = tmp_path / ".venv/share/std_msgs/cmake/export.cmake"
    file.parent.mkdir(parents=True)
    inside = "lib/python3.12/site-packages/numpy/_core/include"
    file.write_text(
        f'A "/opt/python/cp312-cp312/include/python3.12;/opt/python/cp312-cp312/{inside}"\n'
        f'B "/home/me/old/.venv/{inside}"\nC "${{_IMPORT_PREFIX}}/include/std_msgs"\n'
    )
    interfaces.name_headers()
    first, second, third = file.read_text().splitlines()
    python, numpy = first.removeprefix('A "').removesuffix('"').split(";")
    assert (Path(numpy) / "numpy/arrayobject.h").is_file()
    assert "/opt/python" not in first + second
    assert Path(python).name.startswith("python3.")
    assert second == f'B "{numpy}"'
    assert third == 'C "${_IMPORT_PREFIX}/include/std_msgs"'
    interfaces.name_headers()
    assert file.read_text().splitlines() == [first, second, third]


def test_a_sourced_ros_without_generators_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A small apt install may lack them."""
    interfaces = Interfaces(Place(tmp_path), Virtual(tmp_path / ".venv-apt"), sourced=True)
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(tmp_path / "jazzy"))
    monkeypatch.setenv("CC", sys.executable)  # any program is enough here
    monkeypatch.setenv("CXX", sys.executable)
    with pytest.raises(Trouble, match="rosidl-default-generators"):
        interfaces.require_compiler()
    (tmp_path / "jazzy/share/rosidl_default_generators").mkdir(parents=True)
    interfaces.require_compiler()
    package = add_types(tmp_path)
    assert interfaces.sources == [package]
    (tmp_path / "jazzy/share" / package.name).mkdir()
    assert interfaces.sources == []  # what it brings is not built again
    assert interfaces.prefix == tmp_path / ".venv-apt/overlay"
