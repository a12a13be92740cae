"""The course itself: its site and its tests."""

from __future__ import annotations

import argparse
import os
import subprocess
import sys
from collections.abc import Sequence
from typing import NoReturn

from roslings import course

SITE_WORDS = ("open", "fresh", "links", "check_links")


def site(options: argparse.Namespace) -> int:
    """Build the site. Sphinx and its settings live beside the pages, not in the engine."""
    words = [f"--{name.replace('_', '-')}" for name in SITE_WORDS if getattr(options, name)]
    place = ["--out", str(options.out)] if options.out else []
    builder = course.root() / "site" / "build.py"
    return subprocess.run([sys.executable, str(builder), *words, *place], check=False).returncode


def test(options: argparse.Namespace) -> int:
    """Run the tests of roslings; what follows `test` goes to pytest."""
    run_pytest([word for word in options.rest if word != "--"])


UNUSED = ("rerunfailures", "repeat", "anyio", "colcon_core_warnings_stderr", "pytest_cov")
"""Plugins of pytest that come with colcon and others, and that no test of ours asks for."""
OF_LESSONS = "nbval"
"""The plugin that runs lessons. It loads for seconds, in each process of a run."""


def run_pytest(rest: Sequence[str]) -> NoReturn:
    """Become pytest in the course's folder, on both cores: who ends this process ends the tests."""
    unused = [f"-pno:{name}" for name in plugins_without_use(rest)]
    command = [sys.executable, "-m", "pytest", *unused, *rest]
    sys.stdout.flush()
    os.chdir(course.root())
    os.execv(sys.executable, command)


def plugins_without_use(rest: Sequence[str]) -> list[str]:
    """Installed plugins that these tests do not need."""
    about_lessons = any(word.startswith(("days", f"--{OF_LESSONS}")) for word in rest)
    return [*UNUSED, *([] if about_lessons else [OF_LESSONS])]
