"""Every lesson that is written, and the one execution of each, which all tests of a run share."""

from __future__ import annotations

import os
import subprocess
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

from once import once
from roslings.course import root
from roslings_learn.lessons.document import read
from roslings_learn.lessons.path import Day
from roslings_learn.lessons.path import Path as DayPath
from roslings_learn.lessons.rules import Lesson, read_lesson
from sources import python_path
from walks import Walk

WALKS = os.environ.get("ROSLINGS_WALKS")
"""Where `.ci/run` keeps what `./roslings test days --nbval-lax --walks DIR` has written."""


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


def run_lesson(lesson: Path, *words: str) -> str:
    """Run a lesson of any course, or a cell of it, under nbval; what pytest said."""
    places = [python_path(), str(root() / "tests"), os.environ.get("PYTHONPATH", "")]
    done = subprocess.run(
        [
            sys.executable,
            "-m",
            "pytest",
            "--noconftest",
            "-p",
            "lessons_as_tests",
            "-p",
            "no:cacheprovider",
            "-n",
            "0",
            "-m",
            "",
            "--nbval-lax",
            *words,
            str(lesson),
        ],
        cwd=root(),
        env={**os.environ, "PYTHONPATH": os.pathsep.join(filter(None, places))},
        capture_output=True,
        text=True,
        check=False,
    )
    return done.stdout + done.stderr


def walk(lesson: Path, folder: Path, *words: str) -> tuple[Walk, str]:
    """Run a lesson from top to bottom and up again; its walk, and what pytest said."""
    said = run_lesson(lesson, "--walks", str(folder), *words)
    file = folder / f"{lesson.parent.name}.json"
    assert file.is_file(), said
    return Walk.model_validate_json(file.read_text("utf-8")), said


def walked(shared: Path, lesson: Lesson) -> Walk:
    """The one execution of a lesson that all tests of a run share.

    A run before this one may have made it. Where something went wrong there, it is made again.
    """
    if WALKS and (file := Path(WALKS, f"{lesson.day.id}.json")).is_file():
        found = Walk.model_validate_json(file.read_text("utf-8"))
        if not (found.down or found.up):
            return found

    def make() -> str:
        with TemporaryDirectory() as folder:
            return walk(lesson.path, Path(folder))[0].model_dump_json()

    return Walk.model_validate_json(once(shared / f"{lesson.day.id}.json", make))


def kept_for_the_site(walk: Walk, cache: Path) -> None:
    """Let the site find the executed notebook, as if its builder had executed it.

    The builder asks for it under the name of the kernel that it would take itself.
    """
    import nbformat  # a second of a processor, which each process of a test run would pay
    from jupyter_cache import get_cache
    from jupyter_cache.base import CacheBundleIn

    book = nbformat.reads(walk.executed, as_version=4)
    book.metadata.kernelspec.name = "python3"
    bundle = CacheBundleIn(book, uri="lesson.ipynb", data={"execution_seconds": 0.0})
    get_cache(cache).cache_notebook_bundle(bundle)
