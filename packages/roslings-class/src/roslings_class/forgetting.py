"""`./roslings forget`: nothing of one submission is left in a gradebook and in what came of it."""

from __future__ import annotations

import shutil
from difflib import get_close_matches
from pathlib import Path

from ros2_on_pip.typed_paths import from_here
from roslings import course
from roslings_class.alone import alone_in
from roslings_class.command import AlreadyGrading
from roslings_class.errors import BadGradebook, BatchError
from roslings_class.folders import folder_of
from roslings_class.gradebook import Gradebook, gradebook, lab_of
from roslings_class.handing_out import hand_out, keep, settings_of


def forget(folder: Path, submission: str) -> list[str]:
    """Delete all that is kept of a submission, and write the tables and the class page anew.

    Raises BatchError: there is no such submission, or no gradebook, or somebody grades into it.
    """
    name = lab_of(folder)
    if name is None:
        step = "Give the folder that ./roslings grade made (--out)."
        raise BadGradebook(f"There is no gradebook in {from_here(folder)}.", step)
    with alone_in(folder, AlreadyGrading), gradebook(folder, name) as book:
        _insist_on(book, submission)
        settings = settings_of(book)
        book.forget(submission)
        keep(book, settings.without(submission))
        book.shrink()
        shutil.rmtree(folder_of(folder, submission), ignore_errors=True)
        told = hand_out(book, course.lab(name, settings.hidden), folder)
    return [
        f"Nothing of {submission} is left in {from_here(folder)}.",
        "Not reached: your class list, the hand-ins, copies, and what a platform got.",
        *told,
    ]


def _insist_on(book: Gradebook, submission: str) -> None:
    known = list(book.latest())
    if submission in known:
        return
    near = get_close_matches(submission, known, n=1)
    step = f"Did you mean {near[0]}?" if near else "Give the name that grades.csv has for it."
    raise BatchError(f"There is no submission {submission!r} in the gradebook.", step)
