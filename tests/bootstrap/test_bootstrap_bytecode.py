"""After a set-up nothing of the environment is compiled again: a sandbox could not keep it."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from compiled import uncompiled
from course_copy import CourseCopy
from test_bootstrap_refusals import in_namespace

from roslings import course as real_course
from roslings.arena import base_environment
from roslings.workspace.build import colcon
from roslings_launcher.virtual import Virtual
from skips import skip_without


def test_a_fresh_environment_is_compiled(standing: CourseCopy) -> None:
    """setuptools too, which every build imports."""
    assert (standing.site / "setuptools/__init__.py").is_file()
    assert uncompiled(standing.site) == []


@pytest.mark.slow
def test_a_later_group_is_compiled(ready: CourseCopy) -> None:
    """So is a package whose pin has changed."""
    ready.pin(ros_x="2.0")
    assert "draw_x" in ready.run("graph").seen["has"]
    assert uncompiled(ready.site) == []


def forget_bytecode(course: CourseCopy) -> None:
    """The environment as an older bootstrap has left it."""
    (course.venv / "roslings/bytecode").unlink()
    for folder in (course.site / "setuptools").rglob("__pycache__"):
        shutil.rmtree(folder)
    assert uncompiled(course.site)


@pytest.mark.slow
def test_an_older_environment_is_compiled(ready: CourseCopy) -> None:
    """Once, and without a package that comes again."""
    forget_bytecode(ready)
    outcome = ready.run("check")
    assert (outcome.code, "Installing check-x" in outcome.err) == (0, False), outcome.err
    assert uncompiled(ready.site) == []
    assert ready.run("check").err == ""


@pytest.mark.slow
def test_an_older_environment_that_cannot_be_written_is_used(ready: CourseCopy) -> None:
    """It is slower, and no reason to refuse."""
    forget_bytecode(ready)
    done = in_namespace(
        f"mount --bind {ready.root} {ready.root}\n"
        f"mount -o remount,bind,ro {ready.root}\n"
        f"exec {ready.root}/roslings check",
        ready,
    )
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.slow
def test_a_copy_whose_files_have_new_times_is_compiled_again(
    ready: CourseCopy, tmp_path: Path
) -> None:
    """`cp -r` gives them; then no bytecode belongs to its module any more."""
    ready.root = ready.root.rename(tmp_path / "copy")
    for module in ready.site.rglob("*.py"):
        os.utime(module, (1_700_000_000, 1_700_000_000))
    assert uncompiled(ready.site)
    assert "moved or copied" in ready.run("check").err
    assert uncompiled(ready.site) == []


def compiled_anew(command: list[str], folder: Path) -> list[str]:
    """The modules of this environment that the Pythons of a command compile before they run them.

    Python tells it in PYTHONVERBOSE: where it took a module's code from.
    """
    environment = base_environment(folder) | {
        "PYTHONVERBOSE": "1",
        "PYTHONDONTWRITEBYTECODE": "1",  # as in a sandbox: a second run finds nothing better
    }
    done = subprocess.run(
        command, cwd=folder, env=environment, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr[-2000:]
    said = [line.partition("code object from ")[2].strip("'\"") for line in told(done, folder)]
    assert any(path.endswith(".pyc") and path.startswith(sys.prefix) for path in said)
    return [path for path in said if path.startswith(sys.prefix) and path.endswith(".py")]


def told(done: subprocess.CompletedProcess[str], folder: Path) -> list[str]:
    """What it wrote, and what colcon has kept of the Pythons that it started."""
    logs = [log.read_text("utf-8", "replace") for log in folder.glob("log/latest/*/stderr.log")]
    return [line for text in (done.stderr, *logs) for line in text.splitlines()]


@pytest.fixture
def set_up() -> None:
    """An environment that the bootstrap has made; anybody's else may be as it likes."""
    skip_without("environment made by ./roslings")


@pytest.mark.slow
def test_a_real_build_compiles_nothing(set_up: None, tmp_path: Path) -> None:
    """colcon, what it asks setup.py, and setuptools at work."""
    lab = real_course.lab("topics")
    shutil.copytree(lab.solution, tmp_path / "src" / lab.card.package)
    assert compiled_anew([colcon(), "build"], tmp_path) == []
    assert list(tmp_path.glob("log/latest/*/stderr.log"))


@pytest.mark.slow
def test_a_node_and_the_grader_compile_nothing(set_up: None, tmp_path: Path) -> None:
    """What each of them imports before it does anything."""
    needed = "import rclpy, std_msgs.msg, pydantic, rich, yaml, pytest"
    assert compiled_anew([sys.executable, "-c", needed], tmp_path) == []


@pytest.mark.slow
def test_no_module_of_this_environment_waits_to_be_compiled(set_up: None) -> None:
    """The real packages, all of them, but those in which this Python finds a mistake."""
    left = uncompiled(Virtual(Path(sys.prefix)).site)
    assert [name for name in left if compiles(name)] == []


def compiles(name: str) -> bool:
    """Whether this Python can read a module of the environment."""
    try:
        compile(Virtual(Path(sys.prefix)).site.joinpath(name).read_bytes(), name, "exec")
    except (SyntaxError, ValueError):
        return False
    return True
