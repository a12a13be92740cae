"""Run lessons in kernels of their own: by nbval as the course's rules say, or cell by cell."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import nbformat
from nbclient import NotebookClient

from roslings.arena.lease import leased_domain
from roslings.course import root
from roslings.jupyter.server import KERNEL
from roslings.lessons.document import read
from roslings.lessons.path import Day
from roslings.lessons.path import Path as DayPath
from roslings.lessons.rules import Lesson, read_lesson

CELL_S = 60
IN_LESSONS = (87, 88)
"""Domains that a cell of day 1 names, to be apart from the others."""

FORGOTTEN = ("PYTEST_CURRENT_TEST", "ROS_AUTOMATIC_DISCOVERY_RANGE", "PYTEST_ADDOPTS")


def lessons() -> Iterator[Lesson]:
    """Every lesson that is written."""
    for day in days():
        path = root() / "days" / day.id / "lesson.ipynb"
        if path.is_file():
            yield read_lesson(path, day)


def days() -> tuple[Day, ...]:
    """The path of days."""
    return read(root() / "days" / "path.yaml", DayPath).content.days


def names(found: Sequence[Lesson]) -> list[str]:
    """For pytest's lines."""
    return [lesson.day.id for lesson in found]


def surroundings(folder: Path, course: Path) -> dict[str, str]:
    """The variables of a kernel: a domain, a workspace and Jupyter's folders of its own."""
    kept = {key: value for key, value in os.environ.items() if key not in FORGOTTEN}
    write_kernel_into(folder / "jupyter")
    return {
        **kept, "ROS_DOMAIN_ID": str(free_domain()), "ROSLINGS_WS": str(folder / "ws"),
        "ROSLINGS_COURSE": str(course), "PYTHONPATH": str(root() / "src"),
        "JUPYTER_PATH": str(folder / "jupyter"), "IPYTHONDIR": str(folder / "ipython"),
        "JUPYTER_CONFIG_DIR": str(folder / "config"), "JUPYTER_RUNTIME_DIR": str(folder / "run"),
    }  # fmt: skip


def free_domain() -> int:
    """A domain that no lesson names; the kernel holds it, or takes another, when it opens it."""
    while True:
        with leased_domain() as domain:
            if domain not in IN_LESSONS:
                return domain


def write_kernel_into(share: Path) -> None:
    """The kernel that lessons name, with this Python."""
    import json

    note = share / "kernels" / KERNEL / "kernel.json"
    note.parent.mkdir(parents=True, exist_ok=True)
    words = [sys.executable, "-m", "ipykernel_launcher", "-f", "{connection_file}"]
    note.write_text(json.dumps({"argv": words, "display_name": KERNEL, "language": "python"}))


def run_by_nbval(lesson: Path, folder: Path, course: Path) -> subprocess.CompletedProcess[str]:
    """Run a copy of a lesson as the suite does: lax, with a bound for each cell."""
    copy = folder / "lesson"
    shutil.copytree(lesson.parent, copy)
    command = [
        sys.executable, "-m", "pytest", "-p", "no:cacheprovider", "-p", "no:xdist", "-c",
        os.devnull, f"--rootdir={copy}", "--nbval-lax", f"--nbval-cell-timeout={CELL_S}",
        "--tb=short", "-q", lesson.name,
    ]  # fmt: skip
    return subprocess.run(
        command, cwd=copy, env=surroundings(folder, course), capture_output=True, text=True,
        check=False,
    )  # fmt: skip


@dataclass(frozen=True)
class Step:
    """A cell to run, and what is expected of it."""

    cell: str
    code: str
    wanted: str
    """`ends`, `raises`, or `assert`."""


def steps_of(lesson: Lesson) -> list[Step]:
    """Every code cell; a change cell as it is, and after the right edit."""
    found = []
    for cell in (cell for cell in lesson.cells if cell.is_code):
        if "change" in cell.tags:
            found.append(Step(cell.id, cell.text, "assert"))
            found.append(Step(f"{cell.id}, edited", cell.answered(), "ends"))
        else:
            raises = "raises-exception" in cell.tags
            found.append(Step(cell.id, cell.text, "raises" if raises else "ends"))
    return found


def run_steps(steps: Sequence[Step], folder: Path, course: Path, cwd: Path) -> list[str]:
    """Run the steps in one kernel; what went otherwise than expected, a line each."""
    book = nbformat.v4.new_notebook(cells=[nbformat.v4.new_code_cell(step.code) for step in steps])
    variables = surroundings(folder, course)
    before = dict(os.environ)
    os.environ.update(variables)  # Jupyter itself looks for kernels by them
    try:
        client = NotebookClient(book, timeout=CELL_S, kernel_name=KERNEL, allow_errors=True)
        client.execute(cwd=str(cwd), env=variables)
    finally:
        os.environ.clear()
        os.environ.update(before)
    pairs = zip(steps, book.cells, strict=True)
    return [f"{step.cell}: {wrong}" for step, cell in pairs if (wrong := _wrong(step, cell))]


def _wrong(step: Step, cell: Any) -> str:
    errors = [out for out in cell.outputs if out.output_type == "error"]
    raised = errors[0].ename if errors else ""
    told = f"{raised}: {errors[0].evalue}" if errors else "nothing"
    if step.wanted == "ends":
        return f"raised {told}" if raised else ""
    if step.wanted == "assert":
        return "" if raised == "AssertionError" else f"raised {told}, not AssertionError"
    return "" if raised else "raised nothing"
