"""Run lessons in kernels of their own, cell by cell; each lesson once for all tests of a run."""

from __future__ import annotations

import os
import shutil
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import nbformat
from jupyter_cache import get_cache
from jupyter_cache.base import CacheBundleIn
from nbclient import NotebookClient
from once import once
from pydantic import BaseModel

from roslings.arena.lease import leased_domain
from roslings.course import root
from roslings.jupyter.server import KERNEL
from roslings.lessons.document import read
from roslings.lessons.path import Day
from roslings.lessons.path import Path as DayPath
from roslings.lessons.rules import Lesson, read_lesson
from roslings.notebook.place import ON_THE_SITE

CELL_S = 300
"""Only a cell that hangs takes so long."""

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


@dataclass(frozen=True)
class Step:
    """A cell to run, and what is expected of it."""

    cell: str
    code: str
    wanted: str
    """`ends`, `raises`, or `assert`."""
    is_edited: bool = False
    """A change cell after the right edit."""


def steps_of(lesson: Lesson) -> list[Step]:
    """Every code cell; a change cell as it is, and after the right edit."""
    found = []
    for cell in (cell for cell in lesson.cells if cell.is_code):
        if "change" in cell.tags:
            found.append(Step(cell.id, cell.text, "assert"))
            found.append(Step(f"{cell.id}, edited", cell.answered(), "ends", is_edited=True))
        else:
            raises = "raises-exception" in cell.tags
            found.append(Step(cell.id, cell.text, "raises" if raises else "ends"))
    return found


@contextmanager
def running(book: Any, folder: Path, course: Path, cwd: Path) -> Iterator[NotebookClient]:
    """A kernel of its own for the cells of a notebook, which are told that they are on the site."""
    variables = {**surroundings(folder, course), ON_THE_SITE: "1"}
    before = dict(os.environ)
    os.environ.update(variables)  # Jupyter itself looks for kernels by them
    try:
        client = NotebookClient(book, timeout=CELL_S, kernel_name=KERNEL, allow_errors=True)
        with client.setup_kernel(env=variables, cwd=str(cwd)):
            yield client
    finally:
        os.environ.clear()
        os.environ.update(before)


def run_steps(client: NotebookClient, steps: Sequence[Step]) -> list[str]:
    """Run the steps, one after the other; what went otherwise than expected, a line each."""
    wrong = []
    for step in steps:
        cell = nbformat.v4.new_code_cell(step.code)
        client.nb.cells.append(cell)
        client.execute_cell(cell, len(client.nb.cells) - 1)
        if told := _wrong(step, cell):
            wrong.append(f"{step.cell}: {told}")
    return wrong


class Walk(BaseModel):
    """One execution of a lesson: down as it is, for the site too; then up, with its changes made.

    The cells of the way down know that they are on the site; those of the way up are a student's.
    """

    executed: str
    """The notebook after the way down, as JSON."""
    down: list[str]
    """What went otherwise than the lesson announces, a line each."""
    up: list[str]


LEAVE_THE_SITE = Step("(leaves the site)", f"import os\nos.environ.pop({ON_THE_SITE!r})", "ends")


def walk(lesson: Lesson, folder: Path, course: Path) -> Walk:
    """Execute a lesson in one kernel, beside a copy of its pictures and pages."""
    copy = folder / "lesson"
    shutil.copytree(lesson.path.parent, copy)
    book = nbformat.read(lesson.path, as_version=4)
    as_is = [step for step in steps_of(lesson) if not step.is_edited]
    again = [step for step in steps_of(lesson)[::-1] if step.wanted != "assert"]
    with running(book, folder, course, copy) as client:
        down = list(_execute(client, as_is))
        executed = nbformat.writes(book)
        up = run_steps(client, [LEAVE_THE_SITE, *again])
    return Walk(executed=executed, down=down, up=up)


def _execute(client: NotebookClient, steps: Sequence[Step]) -> Iterator[str]:
    """Run the notebook's own code cells; `steps` say what is expected of each."""
    places = [place for place, cell in enumerate(client.nb.cells) if cell.cell_type == "code"]
    for place, step in zip(places, steps, strict=True):
        cell = client.nb.cells[place]
        client.execute_cell(cell, place)
        if told := _wrong(step, cell):
            yield f"{step.cell}: {told}"


def walked(shared: Path, lesson: Lesson) -> Walk:
    """The one execution of a lesson that all tests of a run share."""

    def make() -> str:
        with TemporaryDirectory() as folder:
            return walk(lesson, Path(folder), root()).model_dump_json()

    return Walk.model_validate_json(once(shared / f"{lesson.day.id}.json", make))


def kept_for_the_site(walk: Walk, cache: Path) -> None:
    """Let the site find the executed notebook, as if its builder had executed it.

    The builder asks for it under the name of the kernel that it would take itself.
    """
    book = nbformat.reads(walk.executed, as_version=4)
    book.metadata.kernelspec.name = "python3"
    bundle = CacheBundleIn(book, uri="lesson.ipynb", data={"execution_seconds": 0.0})
    get_cache(cache).cache_notebook_bundle(bundle)


def _wrong(step: Step, cell: Any) -> str:
    errors = [out for out in cell.outputs if out.output_type == "error"]
    raised = errors[0].ename if errors else ""
    told = f"{raised}: {errors[0].evalue}" if errors else "nothing"
    if step.wanted == "ends":
        return f"raised {told}" if raised else ""
    if step.wanted == "assert":
        return "" if raised == "AssertionError" else f"raised {told}, not AssertionError"
    return "" if raised else "raised nothing"
