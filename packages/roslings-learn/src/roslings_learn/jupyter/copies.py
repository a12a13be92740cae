"""The student's own copies of the lessons: what a student writes in is never the course's file.

~/roslings_ws/notebooks/Days.md               the list of days, written anew each time
~/roslings_ws/notebooks/03-topics/lesson.ipynb    the student's; never overwritten
~/roslings_ws/notebooks/03-topics/pictures/       the course's, brought up to date
~/roslings_ws/notebooks/01-install/PAGE.md        the course's, too
~/roslings_ws/notebooks/reference/PAGE.md         the course's, from site/pages/reference
~/roslings_ws/notebooks/labs/topics/task.md       the course's
~/roslings_ws/.roslings/lessons/03-topics.ipynb   the lesson as it was when it was copied
"""

from __future__ import annotations

import os
import re
import shutil
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from ros2_on_pip.typed_paths import shown
from roslings.workspace.errors import writing
from roslings_learn.jupyter.meanings import with_meanings
from roslings_learn.jupyter.unrun import unrun
from roslings_learn.lessons import Day, Glossary

LESSON, PICTURES, LIST = "lesson.ipynb", "pictures", "Days.md"
MOST_COPIES = 1000
STARTED = "*.launch.*"
"""Files beside a lesson that its cells start."""
REFERENCE, LABS, TASK = "site/pages/reference", "labs", "task.md"
OUTSIDE = re.compile(rb"\]\(\.\./\.\./(?:site/pages/)?(?=reference/|labs/)")
"""A link from a day to a page that has no day: in the copies it is one folder nearer."""


@dataclass(frozen=True)
class Copies:
    """The lessons of the course in `course`, as they lie in the workspace `workspace`."""

    course: Path
    workspace: Path
    glossary: Glossary

    @property
    def folder(self) -> Path:
        """Where the student's notebooks lie."""
        return self.workspace / "notebooks"

    @property
    def root(self) -> Path:
        """What JupyterLab shows lies below: what lessons name by `~`, and the workspace."""
        try:
            return Path(os.path.commonpath((Path.home(), self.workspace)))
        except RuntimeError:  # a user without a home
            return self.workspace

    def path_of(self, file: Path) -> str:
        """A file or folder as JupyterLab names it; empty where it does not lie below its root."""
        inside = file.is_relative_to(self.root)
        return file.relative_to(self.root).as_posix() if inside else ""

    def lesson_of(self, day: Day) -> Path:
        """The course's file."""
        return self.course / "days" / day.id / LESSON

    def copy_all(self, days: tuple[Day, ...]) -> list[str]:
        """Bring what is missing and list the days; returns what a student should know.

        Raises DiskFull and CannotWriteFolder of the workspace.
        """
        told: list[str] = []
        with writing(self.folder):
            self._copy_shared()
            for day in (day for day in days if self.lesson_of(day).is_file()):
                told += self._copy(day)
            self.folder.mkdir(parents=True, exist_ok=True)
            (self.folder / LIST).write_text("\n".join(self._list(days)), encoding="utf-8")
        return told

    def _copy(self, day: Day) -> Iterator[str]:
        own, before = self.folder / day.id / LESSON, self._before(day)
        theirs = unrun(with_meanings(_linked(self.lesson_of(day)), self.glossary))
        self._copy_beside(day)
        if not own.exists():
            _write(own, theirs)
        elif _holds(before, theirs):
            return  # the course's lesson is the one that was copied
        elif _holds(own, before.read_bytes() if before.is_file() else theirs):
            _write(own, theirs)  # nothing was written in it
        elif not _holds(own, theirs):
            new = _free_name(own)
            _write(new, theirs)
            yield f"{day.name} has changed. Your work stays in {shown(own)}; the new is {new.name}."
        _write(before, theirs)

    def _before(self, day: Day) -> Path:
        return self.workspace / ".roslings" / "lessons" / f"{day.id}.ipynb"

    def _copy_beside(self, day: Day) -> None:
        (self.folder / day.id).mkdir(parents=True, exist_ok=True)
        pictures = self.course / "days" / day.id / PICTURES
        if pictures.is_dir():
            shutil.copytree(pictures, self.folder / day.id / PICTURES, dirs_exist_ok=True)
        for page in self._pages_of(day):  # the lesson links to them
            _write(self.folder / day.id / page.name, _linked(page))
        for file in sorted(self.lesson_of(day).parent.glob(STARTED)):
            _write(self.folder / day.id / file.name, file.read_bytes())

    def _copy_shared(self) -> None:
        """What lessons of several days link to: reference pages, and the labs' tasks."""
        for page in sorted((self.course / REFERENCE).glob("*.md")):
            _write(self.folder / "reference" / page.name, page.read_bytes())
        for task in sorted((self.course / LABS).glob(f"*/{TASK}")):
            own = self.folder / LABS / task.parent.name
            _write(own / TASK, task.read_bytes())
            if (task.parent / PICTURES).is_dir():
                shutil.copytree(task.parent / PICTURES, own / PICTURES, dirs_exist_ok=True)

    def _pages_of(self, day: Day) -> list[Path]:
        """What lies beside a lesson, to be read."""
        return sorted(self.lesson_of(day).parent.glob("*.md"))

    def _list(self, days: tuple[Day, ...]) -> Iterator[str]:
        pages = [page for day in days[:1] for page in self._pages_of(day)]
        yield from (
            "# The days of roslings",
            "",
            *(f"Begin with [{_title_of(page)}]({page.parent.name}/{page.name})." for page in pages),
            "",
            "| Day | You can | Hours |",
            "| --- | --- | --- |",
        )
        for day in days:
            there = self.lesson_of(day).is_file()
            name = f"[{day.name}]({day.id}/{LESSON})" if there else f"{day.name} (to come)"
            yield f"| {name} | {day.can} | {day.hours:g} |"
        yield from ("", "These are your own copies: change what you like.", "")


def _linked(page: Path) -> bytes:
    return OUTSIDE.sub(b"](../", page.read_bytes())


def _title_of(page: Path) -> str:
    lines = page.read_text("utf-8").splitlines() or [page.stem]
    return lines[0].removeprefix("# ")


def _holds(path: Path, content: bytes) -> bool:
    return path.is_file() and path.read_bytes() == content


def _write(target: Path, content: bytes) -> None:
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_bytes(content)


def _free_name(path: Path) -> Path:
    names = (path.with_stem(f"{path.stem}-{number}") for number in range(2, MOST_COPIES))
    return next(name for name in names if not name.exists())
