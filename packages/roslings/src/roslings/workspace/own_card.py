"""Whose cards a workspace has: said once, and asked by each command.

What a card may say stands in `course/variants.py`, which is loaded only where somebody has given a
name: most students have the card of everybody.
"""

from __future__ import annotations

import os
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING

from ros2_on_pip.language import said
from ros2_on_pip.typed_paths import shown
from roslings import course
from roslings.workspace.errors import WorkspaceError
from roslings.workspace.student import workspace_root

if TYPE_CHECKING:
    from roslings.course import Lab
    from roslings.course.variants import LabVariant

_KEPT, _WHOSE = Path(".roslings/variants"), Path(".roslings/for")
_LONGEST_NAME = 100
NO_NAME = "A card is somebody's: that name has no letter and no digit, or is too long."
GIVE_NAME = "Give the number or the name that your teacher has in the class list: {example}"


class NotAStudentName(WorkspaceError):
    """Nobody can be called so."""

    def __init__(self) -> None:
        super().__init__(
            said("start.no_name", NO_NAME),
            said("start.give_name", GIVE_NAME, example="--for 1234"),
        )


def take_name(whose: str) -> None:
    """From now on the cards of this workspace are those of `whose`. Raises NotAStudentName."""
    from roslings.course.variants import key_of

    if not key_of(whose) or len(whose) > _LONGEST_NAME or not whose.isprintable():
        raise NotAStudentName
    file = workspace_root() / _WHOSE
    try:
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(f"{whose}\n", "utf-8")
    except OSError as error:
        text = "{file} cannot be written: {problem}."
        problem = said("start.cannot_write", text, file=shown(file), problem=error.strerror)
        mend = said("start.see_folder", "See whether the folder is yours and the disk has room.")
        raise WorkspaceError(problem, mend) from error


def whose_cards() -> str:
    """Whose the cards of this workspace are; empty where nobody has said it."""
    with suppress(OSError, UnicodeDecodeError):
        return (workspace_root() / _WHOSE).read_text("utf-8").strip()
    return ""


def own_lab(name: str, hidden: Path | None = None, whose: str | None = None) -> Lab:
    """The lab `name` by the card of `whose`, else of this workspace's student, else everybody's.

    From then on this process and those that it starts know that course. Raises CourseError; with
    `whose` NoVariants, too.
    """
    if owner := whose or whose_cards():
        _take_course(course.lab(name, hidden), owner, for_good=not whose)
    return course.lab(name, hidden)


def _take_course(lab: Lab, owner: str, *, for_good: bool) -> None:
    from roslings.course.variants import chosen, variants_of

    if for_good and not variants_of(lab):
        return
    made = _kept(chosen(lab, owner))
    os.environ["ROSLINGS_COURSE"] = str(made)
    if for_good:
        _forget_others(lab.name, made)


def told_of(name: str) -> Iterator[str]:
    """Whose card of a lab this workspace has, and what is the student's own in it.

    Asked before `own_lab`: a student's course has nothing to choose.
    """
    whose, lab = whose_cards(), course.lab(name)
    if not whose:
        return
    from roslings.course.contract import as_typed
    from roslings.course.variants import chosen, variants_of

    if variants_of(lab):
        own = chosen(lab, whose)
        text = "Your card of {name!r} is that of {whose}. Its own words:"
        yield said("start.own_card", text, name=name, whose=whose)
        yield from (f"  {word:9} {as_typed(value)}" for word, value in own.words.items())
    else:
        yield said("start.one_card", "The lab {name!r} has one card for everybody.", name=name)


def _kept(own: LabVariant) -> Path:
    """The student's course; made where it is not there, whole or not at all."""
    folder = workspace_root() / _KEPT / f"{own.lab.name}-{own.digest()}"
    if not folder.is_dir():
        folder.parent.mkdir(parents=True, exist_ok=True)
        made = Path(tempfile.mkdtemp(prefix="new-", dir=folder.parent))
        own.make(made)
        with suppress(OSError):  # another command was as fast
            made.rename(folder)
        shutil.rmtree(made, ignore_errors=True)
    return folder


def _forget_others(lab: str, folder: Path) -> None:
    """Cards of before: another name, or a course that has changed."""
    for other in folder.parent.glob(f"{lab}-????????????"):
        if other != folder:
            shutil.rmtree(other, ignore_errors=True)
