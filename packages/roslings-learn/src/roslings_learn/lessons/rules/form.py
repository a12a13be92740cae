"""Rules on the file: what is in it, and what never is."""

from __future__ import annotations

import json
import re
from collections import Counter
from collections.abc import Iterator

from roslings_learn.lessons.rules.lesson_file import BrokenRule, Lesson, LessonCell

KERNEL = "roslings"
COMPARED = "nbval-check-output"
"""The tag of a cell whose output the lesson promises: nbval compares it with the one saved here."""
TAGS = frozenset({"predict", "run", "explain", "change", "raises-exception", COMPARED})
TEXT_ALONE = frozenset({"stream", "error"})
LEAST_COMPARED = 3
ID = re.compile(r"^[a-z][a-z0-9]*(-[a-z0-9]+)*$")
MACHINE = re.compile(
    r"/(?:home/(?!you\b|pi\b|ubuntu\b)\w+|(?:root)/|Users/\w+|tmp/ipykernel)|site-packages"
)


def broken(lesson: Lesson) -> Iterator[BrokenRule]:
    """Every rule on the file that `lesson` breaks."""
    yield from _of_notebook(lesson)
    yield from _ids(lesson)
    yield from _promises(lesson)
    for cell in lesson.cells:
        yield from _of_cell(lesson, cell)


def _of_notebook(lesson: Lesson) -> Iterator[BrokenRule]:
    version = lesson.raw.get("nbformat"), lesson.raw.get("nbformat_minor")
    if version != (4, 5):
        yield lesson.broken(f"The format is {version}, not 4.5.", "Convert it by jupytext again.")
    metadata = lesson.raw.get("metadata", {})
    strange = sorted(set(metadata) - {"kernelspec", "language_info"})
    if strange:
        yield lesson.broken(f"The metadata hold {', '.join(strange)}.", "Delete these entries.")
    if metadata.get("kernelspec", {}).get("name") != KERNEL:
        yield lesson.broken("The kernel is another one.", f"Name the kernelspec '{KERNEL}'.")
    if set(metadata.get("language_info", {"name": ""})) != {"name"}:
        yield lesson.broken("language_info says too much.", "Keep its 'name' alone: python.")


def _ids(lesson: Lesson) -> Iterator[BrokenRule]:
    times = Counter(cell.id for cell in lesson.cells)
    for cell in lesson.cells:
        if not ID.match(cell.id) or re.fullmatch(r"[0-9a-f]{8}", cell.id):
            mend = "Give it a readable one, such as talk-run."
            yield lesson.broken_at(cell, 1, f"'{cell.id}' is no readable id.", mend)
        if times[cell.id] > 1:
            yield lesson.broken_at(cell, 1, "Another cell has this id.", "Choose another one.")


def _promises(lesson: Lesson) -> Iterator[BrokenRule]:
    count = sum(COMPARED in cell.tags for cell in lesson.cells)
    if count < LEAST_COMPARED:
        what = f"The outputs of {count} cells are compared, fewer than {LEAST_COMPARED}."
        yield lesson.broken(what, f"Tag cells that always print the same: {COMPARED}.")


def _outputs(lesson: Lesson, cell: LessonCell) -> Iterator[BrokenRule]:
    """Saved ones belong to compared cells alone: the others differ from run to run."""
    outputs = cell.raw.get("outputs") or []
    has_run = cell.raw.get("execution_count") is not None
    save = f"Let them be written: ./roslings test days/{lesson.day.id} --nbval-lax --save-outputs"
    if COMPARED not in cell.tags:
        if outputs or has_run:
            what = "The cell holds outputs or an execution count, and is not compared."
            yield lesson.broken_at(cell, 1, what, f"Clear them, or tag the cell {COMPARED}.")
    elif not (outputs and has_run):  # nbval compares nothing without a count
        what = "The cell is compared, and holds no outputs, or no execution count."
        yield lesson.broken_at(cell, 1, what, save)
    elif strange := sorted({str(each.get("output_type")) for each in outputs} - TEXT_ALONE):
        what = f"A compared output is no text, but {', '.join(strange)}."
        yield lesson.broken_at(cell, 1, what, "Compare what another cell prints.")


def _of_cell(lesson: Lesson, cell: LessonCell) -> Iterator[BrokenRule]:
    yield from _outputs(lesson, cell)
    strange = sorted(set(cell.raw.get("metadata", {})) - {"tags", "roslings"})
    if strange:
        what = f"The cell's metadata hold {', '.join(strange)}."
        yield lesson.broken_at(cell, 1, what, "Keep tags and roslings alone.")
    for tag in sorted(set(cell.tags) - TAGS):
        mend = f"Use these alone: {', '.join(sorted(TAGS))}."
        yield lesson.broken_at(cell, 1, f"'{tag}' is no tag of a lesson.", mend)
    rest = json.dumps([cell.raw.get("metadata", {}), cell.raw.get("outputs", [])])
    found = MACHINE.search(cell.text) or MACHINE.search(rest)
    if found:
        line = cell.text[: found.start()].count("\n") + 1
        what = f"'{found.group()}' is a path of one machine."
        yield lesson.broken_at(cell, line, what, "Write ~ or a path in the course.")
