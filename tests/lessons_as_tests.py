"""Lessons as tests of nbval: `./roslings test days --nbval-lax` runs each cell of each lesson.

nbval runs the cells in a kernel, one after the other, and compares those tagged
`nbval-check-output` with the outputs that the notebook holds. What it does not know stands here:
where a lesson runs, so that nothing of it stays, and what our tags announce.

    --save-outputs   write what the compared cells print now into their lessons
    --walks DIR      write each lesson's execution into DIR, for other tests
"""

from __future__ import annotations

import json
import os
import shutil
import sys
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from functools import cached_property
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import nbformat
import pytest
from nbval.kernel import RunningKernel
from nbval.plugin import IPyNbCell, IPyNbFile, NbCellError

from costs import add_costs_option, note_costs
from needed.plugin import add_needed_option, leave_out
from ros2_on_pip.domain_lease import leased_domain
from roslings.course import root
from roslings_learn.jupyter.server import KERNEL
from roslings_learn.lessons.rules.form import COMPARED
from roslings_learn.notebook.place import ON_THE_SITE
from skips import hold_to_reasons
from sources import python_path
from subreaper import leave_nothing_behind
from walks import Walk

CELL_S = START_S = 300
"""Only a cell that hangs takes so long, and only a kernel that never starts."""

NBVALS_CELL_S, NBVALS_START_S = 2000, 60
"""What nbval takes where nobody gives a limit."""

OUTPUT_S = 60
"""So long may a busy machine take to hand over what a cell has printed already."""

SANITIZER = root() / "days" / "sanitizer.cfg"

IN_LESSONS = (87, 88)
"""Domains that a cell of day 1 names, to be apart from the others."""

FORGOTTEN = ("PYTEST_CURRENT_TEST", "ROS_AUTOMATIC_DISCOVERY_RANGE", "PYTEST_ADDOPTS")

LEAVE_THE_SITE = f"import os\nos.environ.pop({ON_THE_SITE!r}, None)"

MEND = """
Is the new output right? This writes it into the lesson:
    ./roslings test days/{} --nbval-lax --save-outputs
"""


# --- where a lesson runs -----------------------------------------------------------------------


def surroundings(folder: Path, course: Path) -> dict[str, str]:
    """The variables of a kernel: a domain, a workspace and Jupyter's folders of its own."""
    kept = {key: value for key, value in os.environ.items() if key not in FORGOTTEN}
    write_kernel_into(folder / "jupyter")
    return {
        **kept,
        "ROS_DOMAIN_ID": str(free_domain()),
        "ROSLINGS_WS": str(folder / "ws"),
        "ROSLINGS_COURSE": str(course),
        "PYTHONPATH": python_path(),
        "JUPYTER_PATH": str(folder / "jupyter"),
        "IPYTHONDIR": str(folder / "ipython"),
        "JUPYTER_CONFIG_DIR": str(folder / "config"),
        "JUPYTER_RUNTIME_DIR": str(folder / "run"),
    }


def free_domain() -> int:
    """A domain that no lesson names; the kernel holds it, or takes another, when it opens it."""
    while True:
        with leased_domain() as domain:
            if domain not in IN_LESSONS:
                return domain


def write_kernel_into(share: Path) -> None:
    """The kernel that lessons name, with this Python."""
    note = share / "kernels" / KERNEL / "kernel.json"
    note.parent.mkdir(parents=True, exist_ok=True)
    words = [sys.executable, "-m", "ipykernel_launcher", "-f", "{connection_file}"]
    note.write_text(json.dumps({"argv": words, "display_name": KERNEL, "language": "python"}))


@contextmanager
def environment(variables: dict[str, str]) -> Iterator[None]:
    """Jupyter looks for kernels by the variables of this process."""
    before = dict(os.environ)
    os.environ.clear()
    os.environ.update(variables)
    try:
        yield
    finally:
        os.environ.clear()
        os.environ.update(before)


# --- a lesson and its cells --------------------------------------------------------------------


class LessonFile(IPyNbFile):  # type: ignore[misc]
    """One lesson, in a kernel of its own, beside a copy of its pictures and pages."""

    def collect(self) -> Iterator[LessonCell]:
        """Each code cell, by its id."""
        for found in super().collect():
            yield LessonCell.from_parent(
                self,
                name=found.cell.id,
                cell_num=found.cell_num,
                cell=found.cell,
                options=found.options,
            )

    @cached_property
    def cells(self) -> list[LessonCell]:
        """All of them, also where only one was asked for."""
        return list(self.collect())

    @cached_property
    def wrong(self) -> dict[str, str]:
        """What went otherwise than announced, by the id of the cell."""
        return {}

    def setup(self) -> None:
        """Start the kernel."""
        self._stays = ExitStack()
        folder = Path(self._stays.enter_context(TemporaryDirectory()))
        copy = folder / "lesson"
        shutil.copytree(self.path.parent, copy)
        variables = {**surroundings(folder, self.path.parents[2]), ON_THE_SITE: "1"}
        name = self.config.option.nbval_kernel_name or KERNEL
        with environment(variables):
            self.kernel = RunningKernel(
                name, str(copy), self.config.option.nbval_kernel_startup_timeout
            )
        self.setup_sanitize_files()

    def get_sanitize_files(self) -> list[str]:
        """Ours, and the one of the command line."""
        return [str(SANITIZER), *super().get_sanitize_files()]

    def teardown(self) -> None:
        """Keep what was asked for, and end the kernel."""
        try:
            if self.config.option.save_outputs:
                save_outputs(self)
            if folder := self.config.option.walks:
                keep_walk(self, folder)
        finally:
            super().teardown()
            self._stays.close()

    def run(self, name: str, code: str) -> list[Any]:
        """Run some other code in the kernel; its outputs."""
        cell = nbformat.v4.new_code_cell(code)
        options = {"check_exception": True, "check": False, "skip": False}
        other = IPyNbCell.from_parent(self, name=name, cell_num=-1, cell=cell, options=options)
        other.output_timeout = OUTPUT_S
        other.runtest()
        return list(other.test_outputs)


class LessonCell(IPyNbCell):  # type: ignore[misc]
    """A code cell: it ends as its tags announce, and prints what is saved where it is compared."""

    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)
        self.output_timeout = OUTPUT_S

    @property
    def tags(self) -> list[str]:
        """As the notebook has them."""
        return list(self.cell.metadata.get("tags", []))

    def runtest(self) -> None:
        """What stands above it runs first, where nobody asked for that."""
        for cell in self.parent.cells[: self.cell_num]:
            if cell.test_outputs is None:
                with suppress(NbCellError):
                    cell.run_as_announced()
        self.parent.cells[self.cell_num].run_as_announced()

    def run_as_announced(self) -> None:
        """Run it. Raises NbCellError, and notes it for those who read the walk."""
        try:
            super().runtest()
            self._as_tagged()
        except NbCellError as error:
            self.parent.wrong[self.cell.id] = f"{error}\n{error.inner_traceback or ''}".strip()
            raise

    def _as_tagged(self) -> None:
        if told := otherwise(self.tags, self.test_outputs):
            self.raise_cell_error(told)
        if COMPARED in self.tags and not self.cell.outputs and not self.saves:
            self.raise_cell_error("Its output is to be compared, and the lesson holds none")

    @property
    def saves(self) -> bool:
        """Outputs are written, not compared."""
        return bool(self.config.getoption("save_outputs", False))

    def compare_outputs(self, test: Any, ref: Any, skip_compare: Any = None) -> bool:
        """As nbval does, unless they are to be written."""
        return self.saves or bool(super().compare_outputs(test, ref, skip_compare))

    def repr_failure(self, excinfo: Any) -> str:
        """What nbval tells, and how to take the new output."""
        told = str(super().repr_failure(excinfo))
        return told + MEND.format(self.path.parent.name) if COMPARED in self.tags else told


def otherwise(tags: list[str], outputs: list[Any]) -> str:
    """What went otherwise than the tags of a cell announce; nothing where all is well."""
    errors = [out for out in outputs if out.output_type == "error"]
    raised = errors[0].ename if errors else ""
    if "change" in tags:
        told = f"raised {raised}: {errors[0].evalue}" if errors else "raised nothing"
        return "" if raised == "AssertionError" else f"{told}, not AssertionError"
    if "raises-exception" in tags:
        return "" if raised else "raised nothing"
    return f"raised {raised}: {errors[0].evalue}" if errors else ""


# --- what is kept ------------------------------------------------------------------------------


def saved(output: Any) -> dict[str, Any]:
    """An output as a lesson holds it: what is compared, and nothing of this machine."""
    if output.output_type == "error":
        return {
            "ename": output.ename,
            "evalue": output.evalue,
            "output_type": "error",
            "traceback": [],
        }
    if output.output_type == "stream":
        text = output.text.splitlines(keepends=True)
        return {"name": output.name, "output_type": "stream", "text": text}
    raise ValueError(f"{output.output_type} cannot be compared word by word")


def save_outputs(lesson: LessonFile) -> None:
    """Write what compared cells printed where it says another thing, and clear all other cells."""
    notebook = json.loads(lesson.path.read_text("utf-8"))
    ran = {cell.cell.id: cell for cell in lesson.cells if cell.test_outputs is not None}
    for number, cell in enumerate(each for each in notebook["cells"] if "outputs" in each):
        is_compared = COMPARED in cell["metadata"].get("tags", [])
        if not is_compared:
            cell.update(execution_count=None, outputs=[])
        elif (now := ran.get(cell["id"])) and not _says(now, cell["outputs"]):
            cell.update(
                execution_count=number + 1, outputs=[saved(out) for out in now.test_outputs]
            )
    lesson.path.write_text(json.dumps(notebook, indent=1, ensure_ascii=False) + "\n", "utf-8")


def _says(cell: LessonCell, outputs: list[Any]) -> bool:
    """Whether the outputs that are saved are those of now, but for times and the like."""
    before = [nbformat.from_dict(out) for out in outputs]
    for each in before:
        if each.output_type == "stream":
            each.text = "".join(each.text)
    return bool(IPyNbCell.compare_outputs(cell, cell.test_outputs, before))


def keep_walk(lesson: LessonFile, folder: Path) -> None:
    """Write the walk of a lesson that ran from top to bottom, with its way up."""
    if any(cell.test_outputs is None for cell in lesson.cells):
        return
    executed = nbformat.writes(executed_book(lesson))
    down = [f"{name}: {told}" for name, told in lesson.wrong.items()]
    walk = Walk(executed=executed, down=down, up=list(way_up(lesson)))
    folder.mkdir(parents=True, exist_ok=True)
    (folder / f"{lesson.path.parent.name}.json").write_text(walk.model_dump_json(), "utf-8")


def executed_book(lesson: LessonFile) -> Any:
    """The notebook with all outputs of now."""
    book = nbformat.read(lesson.path, as_version=4)
    places = [cell for cell in book.cells if cell.cell_type == "code"]
    for number, (cell, ran) in enumerate(zip(places, lesson.cells, strict=True)):
        cell.outputs, cell.execution_count = ran.test_outputs, number + 1
        for output in cell.outputs:
            if output.output_type == "execute_result":
                output.execution_count = number + 1
    return book


def way_up(lesson: LessonFile) -> Iterator[str]:
    """Run the cells from bottom to top, each change made; what went otherwise, a line each."""
    lesson.run("(leaves the site)", LEAVE_THE_SITE)
    for cell in lesson.cells[::-1]:
        is_change = "change" in cell.tags
        name = f"{cell.cell.id}, edited" if is_change else cell.cell.id
        outputs = lesson.run(name, answered(cell.cell) if is_change else cell.cell.source)
        if told := otherwise([] if is_change else cell.tags, outputs):
            yield f"{name}: {told}"


def answered(cell: Any) -> str:
    """The code of a cell to be changed, after the right edit."""
    text = str(cell.source)
    for old, new in cell.metadata.get("roslings", {}).get("answer", []):
        text = text.replace(old, new)
    return text


# --- for pytest --------------------------------------------------------------------------------


def pytest_addoption(parser: pytest.Parser) -> None:
    """What can be asked for beside nbval's own options."""
    add_costs_option(parser)
    add_needed_option(parser)
    group = parser.getgroup("nbval")
    group.addoption(
        "--save-outputs",
        action="store_true",
        help="write what compared cells print now into their lessons",
    )
    group.addoption(
        "--walks",
        metavar="DIR",
        type=Path,
        help="write each lesson's execution into DIR, for other tests",
    )


def pytest_configure(config: pytest.Config) -> None:
    """A cell that hangs is told soon, and a busy machine has time to start a kernel."""
    if config.option.nbval_cell_timeout == NBVALS_CELL_S:
        config.option.nbval_cell_timeout = CELL_S
    if config.option.nbval_kernel_startup_timeout == NBVALS_START_S:
        config.option.nbval_kernel_startup_timeout = START_S
    leave_nothing_behind(config)
    note_costs(config)
    leave_out(config)
    hold_to_reasons(config)


@pytest.hookimpl(wrapper=True)
def pytest_collect_file(file_path: Path, parent: pytest.Collector) -> Iterator[Any]:
    """Where nbval takes a notebook, it is a lesson."""
    found = yield
    return [
        LessonFile.from_parent(parent, path=file_path) if isinstance(each, IPyNbFile) else each
        for each in found
    ]


@pytest.hookimpl(tryfirst=True)
def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    """All cells of a lesson go to one worker."""
    for item in items:
        if isinstance(item, LessonCell):
            item.add_marker(pytest.mark.xdist_group(item.path.parent.name))
