"""`./roslings new-lab NAME`: a small lab that works, to be changed into another."""

from __future__ import annotations

import difflib
import re
from dataclasses import dataclass
from pathlib import Path

from roslings import course
from roslings.course import CourseError, Lab
from roslings.course.labs import EXAMPLE, example_root
from roslings.folders.lab_folders import GRADER, GRADERS, folder_beside
from roslings.workspace.sources import files

LAB_NAME, PACKAGE_NAME = re.compile(r"[a-z][a-z0-9-]*"), re.compile(r"[a-z][a-z0-9_]*")
PACKAGE, CLASS = "beacon", "Beacon"
"""What the example calls its package, and the class in it."""

_ARTICLE = re.compile(rf"\b([Aa]) (?={PACKAGE}\b)")


class CannotMake(CourseError):
    """The lab cannot be made like this."""


@dataclass(frozen=True)
class NewLabNames:
    """What the new lab calls things."""

    lab: str
    package: str
    day: str

    def put_into(self, text: str) -> str:
        """The example's text with these names; its hints lead to the same lessons."""
        text = re.sub(rf"\b{EXAMPLE}\b(?!\.com)", self.lab, text)
        text = text.replace("../../../pyproject", "../../pyproject")
        text = re.sub(r"(?<=day: )03-topics", self.day, text)
        if self.package.startswith(tuple("aeio")):
            text = _ARTICLE.sub(r"\1n ", text)
        for word, name in self._words.items():
            text = text.replace(word, name)
        return text

    @property
    def _words(self) -> dict[str, str]:
        """Package, class and constant of the example to the new ones."""
        return {PACKAGE: self.package, CLASS: self._class, PACKAGE.upper(): self.package.upper()}

    @property
    def _class(self) -> str:
        return "".join(word.capitalize() for word in self.package.split("_"))


def new_lab(name: str, package: str | None = None, day: str | None = None) -> Lab:
    """Make the lab: card, task, hints, starter, solution, mutants, grader. Raises CannotMake."""
    _insist_on_example()
    names = NewLabNames(name, package or name.replace("-", "_"), day or _last_day())
    _insist_on(names)
    folder = course.root() / "labs" / name
    grader = course.root() / GRADERS / f"{GRADER}{name.replace('-', '_')}.py"
    for path in (folder, grader, folder_beside(grader)):
        if path.exists():
            raise CannotMake(f"{path} is there already. Give another name, or remove it first.")
    _copy(example_root() / "labs" / EXAMPLE, folder, names)
    text = (example_root() / GRADERS / f"{GRADER}{EXAMPLE}.py").read_text("utf-8")
    grader.parent.mkdir(exist_ok=True)
    grader.write_text(names.put_into(text), "utf-8")
    return course.lab(name)


def _insist_on_example() -> None:
    if not (example_root() / "labs" / EXAMPLE).is_dir():
        raise CannotMake(
            "The example from which new labs are made is neither in this course nor beside the\n"
            "engine, which came by pip. Make a folder of the engine: roslings new"
        )


def _insist_on(names: NewLabNames) -> None:
    if not LAB_NAME.fullmatch(names.lab) or names.lab == EXAMPLE:
        raise CannotMake(
            f"{names.lab!r} is no name for a lab.\nUse small letters, digits and -: line-follower"
        )
    if not PACKAGE_NAME.fullmatch(names.package):
        raise CannotMake(
            f"{names.package!r} is no name for a package.\n"
            "Use small letters, digits and _, and begin with a letter: --package line_follower"
        )
    if not re.fullmatch(r"[0-9]{2}-[a-z0-9-]+", names.day):
        raise CannotMake(f"{names.day!r} is no day. A day is a folder of days/: --day 03-topics")
    if (days := _days()) and names.day not in days:
        near = difflib.get_close_matches(names.day, days, n=1)
        guess = f" Did you mean {near[0]}?" if near else ""
        raise CannotMake(
            f"There is no day {names.day!r} in days/.{guess}\nThe days are: {', '.join(days)}."
        )


def _days() -> list[str]:
    """The folders of lessons; a course may have none, and says then only which day it means."""
    return sorted(path.name for path in (course.root() / "days").glob("[0-9][0-9]-*"))


def _last_day() -> str:
    return (_days() or ["03-topics"])[-1]


def _copy(example: Path, folder: Path, names: NewLabNames) -> None:
    """Copy the folder with other names in texts and paths."""
    for inside, source in files(example).items():
        target = folder / inside.replace(PACKAGE, names.package)
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(names.put_into(source.read_text("utf-8")), "utf-8")
