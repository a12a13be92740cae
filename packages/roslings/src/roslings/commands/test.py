"""`./roslings test`: run the tests of roslings."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Sequence
from typing import NoReturn

from roslings import course

UNUSED = ("rerunfailures", "repeat", "anyio", "colcon_core_warnings_stderr", "pytest_cov")
"""Plugins of pytest that come with colcon and others, and that no test of ours asks for."""
OF_LESSONS = "nbval"
"""The plugin that runs lessons. It loads for seconds, in each process of a run."""


def add_options(word: argparse.ArgumentParser) -> None:
    """What `test` takes: the rest goes to pytest."""
    word.add_argument(
        "rest",
        nargs=argparse.REMAINDER,
        metavar="...",
        help="options for pytest; a package of packages/ is tested alone",
    )


def run(options: argparse.Namespace) -> int:
    """Run the tests of roslings; what follows `test` goes to pytest."""
    run_pytest([word for word in options.rest if word != "--"])


def run_pytest(rest: Sequence[str]) -> NoReturn:
    """Become pytest in the course's folder, on both cores: who ends this process ends the tests."""
    if rest[:1] and is_package(rest[0]):
        alone = course.root() / "tests" / "alone.py"
        sys.stdout.flush()
        os.execv(sys.executable, [sys.executable, str(alone), *rest])
    unused = [f"-pno:{name}" for name in plugins_without_use(rest)]
    command = [sys.executable, "-m", "pytest", *unused, *rest]
    sys.stdout.flush()
    os.chdir(course.root())
    os.execv(sys.executable, command)


def is_package(word: str) -> bool:
    """Whether it names a package of the course: its tests run alone, in a fresh environment."""
    return (course.root() / "packages" / word / "pyproject.toml").is_file()


def plugins_without_use(rest: Sequence[str]) -> list[str]:
    """Installed plugins that these tests do not need."""
    about_lessons = any(word.startswith(("days", f"--{OF_LESSONS}")) for word in rest)
    return [*UNUSED, *([] if about_lessons else [OF_LESSONS])]
