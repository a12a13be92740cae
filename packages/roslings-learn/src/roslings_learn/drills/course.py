"""The drills of the course: where their files lie, and what is wrong with them, with file and line.

A drill is a folder `days/DAY/drills/NN_name/` with `drill.yaml`, `starter.py` and `solution.py`.
The last two end in `.sh` where its card says `program: bash`. At will, there are `check.py` and a
program that runs beside.
"""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from ros2_on_pip.language import said
from roslings.course import root
from roslings.course.files import BadCourseFile, CourseError, line_in, read_yaml
from roslings_learn.lessons.anchors import anchors_of

if TYPE_CHECKING:
    from roslings_learn.drills.card import DrillCard

CARD, SOLUTION, CHECK = "drill.yaml", "solution", "check.py"
FOLDER = re.compile(r"^([0-9]{2})_([a-z][a-z0-9_]*)$")
SUFFIXES = {"python": ".py", "bash": ".sh"}


class NoSuchDrill(CourseError):
    """The drill that was asked for does not exist."""


class NoSolutionHere(CourseError):
    """This edition has no solutions."""

    def __init__(self, name: str) -> None:
        text = (
            "This is the students' edition: the solution of the drill {name!r} is not in it.\n"
            "Mend your own: {command}"
        )
        command = f"./roslings drill {name}"
        super().__init__(said("drill.no_solution", text, name=name, command=command))


@dataclass(frozen=True)
class Drill:
    """One drill: its name, its place on the path, and its files."""

    name: str
    day: str
    number: int
    """Its place among the day's drills, from 1."""
    folder: Path

    @cached_property
    def card(self) -> DrillCard:
        """The contract; its texts are in the language that is asked for. Raises BadCourseFile."""
        from roslings_learn.drills.card_texts import translated

        return translated(self.name, self.written_card)

    @cached_property
    def written_card(self) -> DrillCard:
        """As its author wrote it. Raises BadCourseFile."""
        from roslings_learn.drills.card import DrillCard

        return read_yaml(self.folder / CARD, DrillCard)

    @property
    def suffix(self) -> str:
        """Of its programs. Raises BadCourseFile."""
        return SUFFIXES[self.card.program]

    @property
    def starter(self) -> Path:
        """What the student gets."""
        return self.folder / f"starter{self.suffix}"

    @property
    def solution(self) -> Path:
        """What passes. Raises NoSolutionHere in the students' edition."""
        path = self.folder / f"{SOLUTION}{self.suffix}"
        if not path.is_file():
            raise NoSolutionHere(self.name)
        return path

    @property
    def has_solution(self) -> bool:
        """Whether this edition has it."""
        return (self.folder / f"{SOLUTION}{self.suffix}").is_file()

    @property
    def check(self) -> Path | None:
        """Experiments and checks of its own; None where the card says all."""
        path = self.folder / CHECK
        return path if path.is_file() else None

    @property
    def file_name(self) -> str:
        """What the student's file is called."""
        return f"{self.folder.name}{self.suffix}"

    def where(self, *place: int | str) -> tuple[Path, int]:
        """File and line of a part of the card."""
        return self.folder / CARD, line_in(self.folder / CARD, place)


def all_drills(course: Path | None = None) -> list[Drill]:
    """Every drill, in the order of the path. Their cards are read when they are used.

    Raises BadCourseFile where a folder has no name of a drill, or two have the same.
    """
    folders = sorted(path for path in ((course or root()) / "days").glob("*/drills/*/"))
    found = [_in(path) for path in folders if path.is_dir() and path.name != "__pycache__"]
    seen: dict[str, Drill] = {}
    for each in found:
        if each.name in seen:
            other = seen[each.name].folder
            raise BadCourseFile(each.folder / CARD, 1, f"{other} is called {each.name}, too")
        seen[each.name] = each
    return found


def _in(folder: Path) -> Drill:
    found = FOLDER.match(folder.name)
    if found is None:
        problem = "a drill's folder is called 01_name: its place in the day, and its name"
        raise BadCourseFile(folder / CARD, 1, problem)
    return Drill(found[2], folder.parents[1].name, int(found[1]), folder)


def drill(name: str, course: Path | None = None) -> Drill:
    """The drill that is called `name`, with its number before it or without. Raises NoSuchDrill."""
    drills = all_drills(course)
    plain = Path(name).stem
    for each in drills:
        if plain in (each.name, each.folder.name):
            return each
    near = difflib.get_close_matches(plain, [each.name for each in drills], n=1)
    guess = said("verdict.did_you_mean", " Did you mean {name!r}?", name=near[0]) if near else ""
    text = "There is no drill {name!r}.{guess}\nAll of them: ./roslings drill --list"
    raise NoSuchDrill(said("drill.no_such", text, name=name, guess=guess))


def of_day(drills: Sequence[Drill], day: str) -> list[Drill]:
    """The drills of a day, by its folder or its number."""
    return [each for each in drills if day in (each.day, str(int(each.day[:2])), each.day[:2])]


# --- what is wrong with the files --------------------------------------------------------------


def problems(one: Drill) -> Iterator[BadCourseFile]:
    """What a drill's files may not say, each with file and line."""
    try:
        card = one.card
    except BadCourseFile as error:
        yield error
        return
    if not one.starter.is_file():
        yield BadCourseFile(one.starter, 1, "this file is missing")
    if card.beside and not (one.folder / card.beside.file).is_file():
        path, line = one.where("beside", "file")
        yield BadCourseFile(path, line, f"there is no {card.beside.file} beside it")
    day, _, anchor = card.lesson.partition("#")
    if day != f"days/{one.day}":
        yield BadCourseFile(*one.where("lesson"), f"its day is days/{one.day}, not {day}")
    elif anchor not in anchors_of(one.folder.parents[1] / "lesson.ipynb"):
        yield BadCourseFile(*one.where("lesson"), f"the lesson has no heading #{anchor}")
    yield from _longer_than_a_drill(one)


LINES = (3, 70)
"""The fewest and the most that a starter has; one to write from nothing may be short."""


def _longer_than_a_drill(one: Drill) -> Iterator[BadCourseFile]:
    count = len(one.starter.read_text("utf-8").splitlines()) if one.starter.is_file() else LINES[0]
    if not LINES[0] <= count <= LINES[1]:
        yield BadCourseFile(one.starter, 1, f"it has {count} lines; {LINES[0]} to {LINES[1]} fit")
