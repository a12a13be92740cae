"""The course's own message types: built or to be built, when they are stale, what is mended."""

from __future__ import annotations

import io
import sys
import tarfile
from dataclasses import replace
from pathlib import Path

import pytest
from course_copy import CourseCopy

from roslings_launcher.built_interfaces import (
    BuiltPackage,
    archive_of,
    digest_of_file,
    origin_of,
)
from roslings_launcher.errors import LauncherTrouble
from roslings_launcher.interface_build import GENERATORS_CONFIG
from roslings_launcher.interfaces import Interfaces
from roslings_launcher.machine import this_machine
from roslings_launcher.place import CoursePlace
from roslings_launcher.virtual import Virtual
from skips import imported

GROUPS = 'interfaces = []\ngenerators = ["type-x"]\n'
SH_TOOLS = ("dirname", "readlink", "cmp", "sort")


@pytest.fixture
def arm(course: CourseCopy) -> CourseCopy:
    """A fresh clone with a lab `arm` that asks for types of its own, and has none yet."""
    pyproject = course.root / "pyproject.toml"
    pyproject.write_text(pyproject.read_text() + GROUPS)
    pins = course.root / "constraints.txt"
    pins.write_text(f"{pins.read_text()}type-x==1.0  # generators\n")
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


def build(root: Path, source: Path, files: dict[str, str]) -> BuiltPackage:
    """What comes built of the package in `source`, with texts in place of what was compiled."""
    folder = root / "packages/rover/src/rover/interfaces/built"
    folder.mkdir(parents=True, exist_ok=True)
    archive = archive_of(folder, source.name)
    with tarfile.open(archive, "w:gz") as packed:
        for name, text in files.items():
            entry = tarfile.TarInfo(name)
            entry.size = len(text.encode())
            packed.addfile(entry, io.BytesIO(text.encode()))
    origin = origin_of(source, root / "constraints.txt")
    made = BuiltPackage(archive, origin, digest_of_file(archive), "by hand")
    made.tell()
    return made


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
    assert arm.run("check", "arm").seen["has"] == ["ros_x", "col_x", "check_x"]
    assert arm.run("check", "arm").err == ""
    add_types(arm.root)
    stale = arm.run("check", "arm")  # the tiny packages hold no numpy, so it ends there
    assert (stale.code, "numpy" in stale.err, "Next:" in stale.err) == (2, True, True)
    assert arm.run("check", "leg").seen["has"] == ["ros_x", "col_x", "check_x", "type_x"]


@pytest.mark.slow
def test_what_comes_built_is_put_there_without_a_compiler(arm: CourseCopy, tmp_path: Path) -> None:
    """Nothing is installed for it. A newer one takes its place, and what it had not is gone."""
    path = without_compiler(tmp_path)
    source = add_types(arm.root)
    build(arm.root, source, {"python/arm_interfaces/old.py": "", "share/arm_interfaces/a": "1"})
    outcome = arm.run("check", "arm", PATH=path)
    assert outcome.code == 0, outcome.err
    assert outcome.seen["has"] == ["ros_x", "col_x", "check_x"]
    assert (arm.site / "arm_interfaces/old.py").is_file()
    assert arm.run("check", "arm", PATH=path).err == ""
    build(arm.root, source, {"python/arm_interfaces/new.py": ""})
    assert "ready" in arm.run("check", "arm", PATH=path).err
    assert [file.name for file in (arm.site / "arm_interfaces").glob("*.py")] == ["new.py"]
    assert not (arm.venv / "share/arm_interfaces/a").exists()


@pytest.mark.slow
def test_what_builds_a_students_own_types_comes_when_it_is_asked_for(
    arm: CourseCopy, tmp_path: Path
) -> None:
    """And says that it needs a compiler, before anything is downloaded."""
    path = without_compiler(tmp_path)
    refused = arm.run("ready", "generators", PATH=path)
    assert (refused.code, "build-essential" in refused.err) == (2, True)
    assert not arm.venv.exists()
    assert "type_x" not in arm.run("check").seen["has"]
    arm.run("ready", "generators")  # the tiny packages hold no numpy, so it ends there
    assert "type_x" in arm.run("check").seen["has"]


@pytest.mark.slow
def test_tf_is_built_for_who_asks_for_it(arm: CourseCopy, tmp_path: Path) -> None:
    """Without a compiler the rover runs all the same, and nobody waits for one unasked."""
    path = without_compiler(tmp_path)
    asked = arm.venv / "roslings/groups/interfaces"
    assert arm.run("rover", "--tf", PATH=path).code == 0
    assert arm.run("rover").code == 0
    assert not asked.exists()
    assert arm.run("rover", "--tf").code == 0
    assert asked.exists()


@pytest.mark.slow
@pytest.mark.parametrize("command", ["rover", "my-rover", "lab", "desk"])
def test_tf_that_comes_built_needs_no_compiler(
    arm: CourseCopy, tmp_path: Path, command: str
) -> None:
    """It is there for every rover, also for one in a notebook, but where it is told not to."""
    path = without_compiler(tmp_path)
    add_built_tf(arm.root)
    assert arm.run(command, "--no-tf", PATH=path).code == 0
    assert not (arm.site / "tf2_msgs").exists()
    assert arm.run(command, PATH=path).code == 0
    assert (arm.site / "tf2_msgs/__init__.py").is_file()


@pytest.mark.slow
def test_no_drive_waits_for_other_types(arm: CourseCopy, tmp_path: Path) -> None:
    """A lab may have types that must be built: the rover needs none of them."""
    add_built_tf(arm.root)
    add_types(arm.root)
    assert arm.run("rover", PATH=without_compiler(tmp_path)).code == 0
    assert not (arm.site / "tf2_msgs").exists()


def add_built_tf(root: Path) -> None:
    """The type of /tf, as it comes built with a course."""
    source = root / "packages/rover/src/rover/interfaces/tf2_msgs"
    source.mkdir(parents=True)
    (source / "package.xml").write_text("<package/>")
    build(root, source, {"python/tf2_msgs/__init__.py": ""})


def interfaces_of(root: Path) -> Interfaces:
    """Those of the course in `root`; its environment's Python is the running one."""
    environment = root / ".venv"
    (environment / "bin").mkdir(parents=True)
    python = environment / "bin" / "python"
    python.write_text(f'#!/bin/sh\nexec {sys.executable} "$@"\n')
    python.chmod(0o755)
    (root / "constraints.txt").write_text("")
    return Interfaces(CoursePlace(root), Virtual(environment), sourced=False)


def test_they_stand_as_long_as_nothing_changes(tmp_path: Path) -> None:
    """Neither their sources nor the pins."""
    interfaces, package = interfaces_of(tmp_path), add_types(tmp_path)
    assert interfaces.sources == interfaces.to_build == [package]
    assert not interfaces.stand
    stamp = tmp_path / ".venv/interfaces.stamp"
    stamp.write_text(interfaces._fingerprint())
    assert interfaces.stand
    (package / "msg/Bend.msg").write_text("float32 angle\n")
    assert not interfaces.stand


def to_build(interfaces: Interfaces) -> list[str]:
    """The packages that must be built, looked for anew."""
    return [each.name for each in replace(interfaces).to_build]


def test_what_comes_built_must_fit(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Its sources, the pins of ROS, its own bytes and the machine; else it is built here."""
    interfaces, source = interfaces_of(tmp_path), add_types(tmp_path)
    built = build(tmp_path, source, {"python/arm_interfaces/__init__.py": ""})
    assert to_build(interfaces) == []
    assert to_build(replace(interfaces, sourced=True)) == ["arm_interfaces"]
    pins = tmp_path / "constraints.txt"
    pins.write_text("numpy==2.0  # ros\nros-test-msgs==2.0  # test\n")  # it is linked with neither
    assert to_build(interfaces) == []
    pins.write_text("ros-jazzy-rclpy==7.2  # ros\n")
    assert to_build(interfaces) == ["arm_interfaces"]
    pins.write_text("")
    whole = built.archive.read_bytes()
    built.archive.write_bytes(whole[:-1])
    assert to_build(interfaces) == ["arm_interfaces"]
    built.archive.write_bytes(whole)
    assert to_build(interfaces) == []
    pi = replace(this_machine(), architecture="aarch64")
    with monkeypatch.context() as elsewhere:
        elsewhere.setattr("roslings_launcher.interfaces.this_machine", lambda: pi)
        assert to_build(interfaces) == ["arm_interfaces"]
    (source / "msg/Bend.msg").write_text("float32 angle\n")
    assert to_build(interfaces) == ["arm_interfaces"]


def test_a_library_in_use_is_not_written_into(tmp_path: Path) -> None:
    """A program that has opened it keeps the old one, whole."""
    interfaces, source = interfaces_of(tmp_path), add_types(tmp_path)
    (tmp_path / ".venv/lib/python3.12/site-packages").mkdir(parents=True)
    both = {"python/arm_interfaces/a.so": "old", "lib/libarm_interfaces__a.so": ""}
    build(tmp_path, source, both)
    interfaces.provide()
    with (interfaces.virtual.site / "arm_interfaces/a.so").open() as held:
        build(tmp_path, source, {"python/arm_interfaces/a.so": "newer"})
        replace(interfaces).provide()
        assert held.read() == "old"
    assert (interfaces.virtual.site / "arm_interfaces/a.so").read_text() == "newer"
    assert not (tmp_path / ".venv/lib/libarm_interfaces__a.so").exists()


def test_the_generators_make_what_rclpy_loads(tmp_path: Path) -> None:
    """C and Python alone. It is said once, however often the environment is mended."""
    imported("numpy")
    interfaces = interfaces_of(tmp_path)
    config = tmp_path / ".venv" / GENERATORS_CONFIG
    config.parent.mkdir(parents=True)
    config.write_text("theirs\n")
    for _ in range(2):
        interfaces.build.prepare()
        assert config.read_text().startswith("theirs\n")
        assert config.read_text().count('EXCLUDE REGEX "cpp"') == 1


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
    interfaces.build.prepare()
    first, second, third = file.read_text().splitlines()
    python, numpy = first.removeprefix('A "').removesuffix('"').split(";")
    assert (Path(numpy) / "numpy/arrayobject.h").is_file()
    assert "/opt/python" not in first + second
    assert Path(python).name.startswith("python3.")
    assert second == f'B "{numpy}"'
    assert third == 'C "${_IMPORT_PREFIX}/include/std_msgs"'
    interfaces.build.prepare()
    assert file.read_text().splitlines() == [first, second, third]


def test_a_sourced_ros_without_generators_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A small apt install may lack them."""
    interfaces = Interfaces(CoursePlace(tmp_path), Virtual(tmp_path / ".venv-apt"), sourced=True)
    monkeypatch.setenv("AMENT_PREFIX_PATH", str(tmp_path / "jazzy"))
    monkeypatch.setenv("CC", sys.executable)  # any program is enough here
    monkeypatch.setenv("CXX", sys.executable)
    with pytest.raises(LauncherTrouble, match="rosidl-default-generators"):
        interfaces.build.require_compiler()
    (tmp_path / "jazzy/share/rosidl_default_generators").mkdir(parents=True)
    interfaces.build.require_compiler()
    package = add_types(tmp_path)
    assert interfaces.sources == [package]
    (tmp_path / "jazzy/share" / package.name).mkdir()
    assert interfaces.sources == []  # what it brings is not built again
    assert interfaces.prefix == tmp_path / ".venv-apt/overlay"
