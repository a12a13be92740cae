"""The check of a lab, from a cell: the same path as `./roslings check`, in a process of its own."""

from __future__ import annotations

import os
import subprocess
import sys

from roslings_learn.notebook.programs import end, read_lines
from roslings_learn.start import START

WIDTH = "80"


def check(lab: str) -> None:
    """Grade the package in your workspace and show the verdict in colour.

    Where nothing is there yet, one line says how to begin. Raises nothing of its own.
    """
    nothing = _nothing_to_check(lab)
    if nothing:
        print(nothing)
        return
    process = subprocess.Popen(
        [sys.executable, str(START), "check", lab],
        env={**os.environ, "FORCE_COLOR": "1", "COLUMNS": WIDTH, "TERM": "xterm-256color"},
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        errors="replace",
        start_new_session=True,
    )
    try:
        for line in read_lines(process):
            print(line, flush=True)
        process.wait()
    finally:
        end(process)


def _nothing_to_check(lab: str) -> str:
    """Why there is nothing to check, with the next step; empty where there is something."""
    from roslings import course
    from roslings.course import CourseError
    from roslings.workspace.errors import NotBegun, NoWorkspace, WorkspaceError
    from roslings.workspace.student import package_of

    try:
        package_of(course.lab(lab))
    except (NoWorkspace, NotBegun):
        return (
            f"Nothing to check yet. In a terminal, in the roslings folder: ./roslings start {lab}"
        )
    except (CourseError, WorkspaceError) as error:
        return str(error)
    return ""
