"""Packages: made, built, found, run."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import pytest
from terminal import Shell

pytestmark = pytest.mark.slow

CREATED = """\
going to create a new package
package name: chatter
destination directory: {folder}
package format: 3
version: 0.0.0
description: TODO: Package description
maintainer: ['Ada <ada@example.com>']
licenses: ['TODO: License declaration']
build type: ament_python
dependencies: ['rclpy', 'std_msgs']
node_name: talker
creating folder ./chatter
creating ./chatter/package.xml
creating source folder
creating folder ./chatter/chatter
creating ./chatter/setup.py
creating ./chatter/setup.cfg
creating folder ./chatter/resource
creating ./chatter/resource/chatter
creating ./chatter/chatter/__init__.py
creating folder ./chatter/test
creating ./chatter/test/test_copyright.py
creating ./chatter/test/test_flake8.py
creating ./chatter/test/test_pep257.py
creating ./chatter/chatter/talker.py
"""
CREATE = (
    "pkg",
    "create",
    "--build-type",
    "ament_python",
    "--node-name",
    "talker",
    "chatter",
    "--maintainer-name",
    "Ada",
    "--maintainer-email",
    "ada@example.com",
    "--dependencies",
    "rclpy",
    "std_msgs",
)


def test_create_build_source_run(empty: Shell, tmp_path: Path) -> None:
    """The way of every student on day 3."""
    source = tmp_path / "src"
    source.mkdir()
    ran = Shell(empty.environment, source)(*CREATE)
    assert ran.code == 0
    assert ran.out.startswith(CREATED.format(folder=source))
    built = subprocess.run(
        ["colcon", "build"],
        cwd=tmp_path,
        capture_output=True,
        text=True,
        check=False,
        env=empty.environment | {"AMENT_PREFIX_PATH": sys.prefix, "PATH": path_with_ours()},
    )
    assert "1 package finished" in built.stdout, built.stderr
    script = f'source install/setup.bash; exec "{sys.executable}" "$0" run chatter talker'
    ours = str(Path(__file__).with_name("ours.py"))
    with empty.program(["bash", "-c", script, ours]) as talker:
        talker.wait_for("^Hi from chatter.$")
        assert talker.wait() == 0


def path_with_ours() -> str:
    """The programs of this environment first."""
    return os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]])


def test_created_package_is_well_formed(empty: Shell, tmp_path: Path) -> None:
    """Its manifest is XML, whatever the texts hold, and says how it is built."""
    words = (
        "--description",
        'a "b" & <c>',
        "--license",
        "Apache-2.0",
        "--maintainer-name",
        "A 'B'",
    )
    assert empty(*CREATE, *words).code == 0
    manifest = ElementTree.parse(tmp_path / "chatter/package.xml").getroot()
    assert manifest.findtext("description") == 'a "b" & <c>'
    assert manifest.findtext("export/build_type") == "ament_python"
    assert {"rclpy", "std_msgs"} <= {each.text for each in manifest.findall("depend")}
    compile((tmp_path / "chatter" / "setup.py").read_text(), "setup.py", "exec")


def test_create_overwrites_nothing(empty: Shell) -> None:
    """A second time it stops, and the first package is as it was."""
    assert empty(*CREATE).code == 0
    ran = empty(*CREATE)
    assert ran.code == 1
    assert "The directory already exists: chatter" in ran.err


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("My-Pkg", "Try my_pkg"),
        ("random", "Python itself has something of that name"),
        ("test", "the folder 'test' is for the tests"),
        ("2wheels", "a letter first"),
    ],
)
def test_create_refuses_names_that_cannot_work(empty: Shell, name: str, said: str) -> None:
    """Said before anything is written."""
    ran = empty("pkg", "create", "--build-type", "ament_python", name)
    assert (ran.code, ran.out) == (1, "")
    assert said in ran.err


def test_create_of_a_cpp_package(empty: Shell) -> None:
    """The real tool's default; it cannot be built on the wheels."""
    ran = empty("pkg", "create", "mine")
    assert ran.code == 1
    assert "add: --build-type ament_python" in ran.err


@pytest.fixture
def overlay(empty: Shell, tmp_path: Path) -> Shell:
    """A terminal with a sourced workspace: package `mine` with two executables."""
    prefix = tmp_path / "install" / "mine"
    marker = prefix / "share" / "ament_index" / "resource_index" / "packages" / "mine"
    marker.parent.mkdir(parents=True)
    marker.touch()
    programs = prefix / "lib" / "mine"
    programs.mkdir(parents=True)
    write_program(programs / "ends", "exit 7")
    write_program(programs / "tells", 'echo "got: $*"')
    (programs / "no_program.txt").touch()
    return Shell(empty.environment | {"AMENT_PREFIX_PATH": str(prefix)}, tmp_path)


def write_program(place: Path, line: str) -> None:
    """An executable shell script."""
    place.write_text(f"#!/bin/sh\n{line}\n")
    place.chmod(0o755)


def test_pkg_words(overlay: Shell, tmp_path: Path) -> None:
    """list, prefix, executables."""
    assert {"mine", "demo_nodes_py", "rclpy"} <= set(overlay("pkg", "list").lines)
    assert overlay("pkg", "prefix", "mine").out == f"{tmp_path}/install/mine\n"
    assert overlay("pkg", "executables", "mine").out == "mine ends\nmine tells\n"
    assert overlay("pkg", "executables", "demo_nodes_py").lines == [
        "demo_nodes_py listener",
        "demo_nodes_py talker",
    ]
    ran = overlay("pkg", "prefix", "mines")
    assert ran.code == 1
    assert "Package 'mines' not found. Did you mean mine?" in ran.err


def test_run_hands_words_and_exit_code_on(overlay: Shell) -> None:
    """The node's own."""
    assert overlay("run", "mine", "ends").code == 7
    ran = overlay("run", "mine", "tells", "-x", "--ros-args", "-r", "a:=b")
    assert ran.out == "got: -x --ros-args -r a:=b\n"


def test_run_of_what_is_not_there(overlay: Shell) -> None:
    """Near misses, and what there is."""
    ran = overlay("run", "mine", "tell")
    assert ran.code == 1
    assert "Did you mean tells?" in ran.err
    assert "It has: ends, tells" in ran.err
    assert "source install/setup.bash" in overlay("run", "nowhere", "tells").err


@pytest.mark.parametrize("whole_group", [False, True])
def test_demo_talker_and_listener(empty: Shell, whole_group: bool) -> None:
    """The first thing that every guide asks for; Ctrl-C, typed or sent, ends each with 0."""
    rename = ("--ros-args", "-r", "chatter:=news", "-r", "__node:=caller")
    with (
        empty.start(
            "run", "demo_nodes_py", "listener", "--ros-args", "-r", "chatter:=news"
        ) as listener,
        empty.start("run", "demo_nodes_py", "talker", *rename) as talker,
    ):
        talker.wait_for(r'^\[INFO\] \[\d+\.\d+\] \[caller\]: Publishing: "Hello World: 0"$')
        listener.wait_for(r"^\[INFO\] \[\d+\.\d+\] \[listener\]: I heard: \[Hello World: \d+\]$")
        assert talker.interrupt(whole_group) == 0
        assert listener.interrupt(whole_group) == 0
    assert "Traceback" not in talker.text + listener.text


def test_the_tests_of_a_created_package_are_skipped_without_a_warning(
    empty: Shell, tmp_path: Path
) -> None:
    """Its marks are known; the linters of a full ROS are not here."""
    assert empty(*CREATE).code == 0
    ran = subprocess.run(
        [sys.executable, "-m", "pytest", "-rs", "-p", "no:cacheprovider"],
        cwd=tmp_path / "chatter",
        capture_output=True,
        text=True,
        check=False,
        env={**empty.environment, "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1"},
    )
    assert "3 skipped" in ran.stdout, ran.stdout + ran.stderr
    assert "warning" not in ran.stdout.lower()
    assert ran.returncode == 0
