"""Where each lab's files are, and the labs' order."""

from __future__ import annotations

import difflib
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from roslings.course.files import NoSuchLab, read_tree, read_yaml, text_of
from roslings.course.outline import LabOutline, outline_as_written, outline_in
from roslings.folders.course_folder import engine_root, root
from roslings.folders.lab_folders import GRADER, GRADERS, folder_beside

if TYPE_CHECKING:
    from roslings.course.card import Card, Hint
    from roslings.course.mutants import Mutant

__all__ = ["EXAMPLE", "MUTANTS", "Lab", "all_labs", "engine_root", "example_root", "lab", "root"]

EXAMPLE = "example"
MUTANTS = "mutants"


def example_root() -> Path:
    """A tiny course with one lab, the one from which new labs are made.

    The engine's own; one that came by pip has none beside it, and takes the course's.
    """
    beside = engine_root() / EXAMPLE
    return beside if beside.is_dir() else root() / EXAMPLE


@dataclass(frozen=True)
class Lab:
    """One lab: its name and the files that belong to it."""

    name: str
    folder: Path
    grader: Path
    hidden: Path | None = None
    """More checks, which students do not have; an instructor names them."""

    @cached_property
    def card(self) -> Card:
        """The contract, with the points of hidden checks. Raises BadCourseFile."""
        from roslings.course.card import Card
        from roslings.course.hidden import hidden_points

        card = read_yaml(self.folder / "card.yaml", Card)
        more = hidden_points(self.hidden, card) if self.hidden else {}
        return card.model_copy(update={"points": {**card.points, **more}})

    @cached_property
    def hidden_checks(self) -> frozenset[str]:
        """Names of the checks that students do not have. Raises BadCourseFile."""
        if self.hidden is None:
            return frozenset()
        from roslings.course.card import Card
        from roslings.course.hidden import hidden_points

        return frozenset(hidden_points(self.hidden, read_yaml(self.folder / "card.yaml", Card)))

    @cached_property
    def outline(self) -> LabOutline:
        """What the card says of the lab as a whole. Raises BadCourseFile."""
        file = self.folder / "card.yaml"
        if plain := outline_as_written(text_of(file)) or outline_in(read_tree(file)):
            return plain
        card = self.card  # says what is wrong, and where
        return LabOutline(card.title, card.day, card.needs, card.package)

    @property
    def graders(self) -> tuple[Path, ...]:
        """The files with experiments and checks."""
        return (self.grader, self.hidden) if self.hidden else (self.grader,)

    @property
    def beside(self) -> Path:
        """The folder with what only this lab needs to measure and judge; most labs have none."""
        return folder_beside(self.grader)

    @cached_property
    def hints(self) -> dict[str, Hint]:
        """Check's name to its hint. Raises BadCourseFile."""
        from roslings.course.card import Hints

        return read_yaml(self.folder / "hints.yaml", Hints).root

    @property
    def task(self) -> Path:
        """What the student reads."""
        return self.folder / "task.md"

    @property
    def starter(self) -> Path:
        """The package that the student starts from."""
        return self.folder / "starter" / self.outline.package

    @property
    def solution(self) -> Path:
        """The package that gets the full score."""
        return self.folder / "solution" / self.outline.package

    def lesson_of(self, check: str) -> str | None:
        """Anchor of the paragraph that explains a check; None where the lesson is not there."""
        hint = self.hints.get(check)
        day = root() / hint.lesson.partition("#")[0] if hint else None
        return hint.lesson if hint and day and day.is_dir() else None

    def mutants(self) -> list[Mutant]:
        """The wrong packages, by name. Raises BadCourseFile."""
        from roslings.course.mutants import Mutant

        files = sorted((self.folder / MUTANTS).glob("*.yaml"))
        return [read_yaml(file, Mutant).model_copy(update={"name": file.stem}) for file in files]


def all_labs() -> list[Lab]:
    """Every lab of the course, in the order of its days; in a day, what needs less comes first."""
    folders = [path.parent for path in (root() / "labs").glob("*/card.yaml")]
    labs = [_lab_in(folder) for folder in folders]
    return sorted(labs, key=lambda lab: (lab.outline.day, len(lab.outline.needs), lab.name))


def lab(name: str, hidden: Path | None = None) -> Lab:
    """The lab called `name`. Raises NoSuchLab, with the nearest name there is."""
    folder = root() / "labs" / name
    if name and (folder / "card.yaml").is_file() and folder.parent == root() / "labs":
        return replace(_lab_in(folder), hidden=hidden)
    if name == EXAMPLE and example_root().is_dir():
        return replace(_lab_in(example_root() / "labs" / EXAMPLE), hidden=hidden)
    raise NoSuchLab(_no_such_lab(name))


def _lab_in(folder: Path) -> Lab:
    name = folder.name.replace("-", "_")
    grader = folder.parents[1] / GRADERS / f"{GRADER}{name}.py"
    return Lab(folder.name, folder, grader)


def _no_such_lab(name: str) -> str:
    names = [lab.name for lab in all_labs()]
    near = difflib.get_close_matches(name, names, n=1)
    guess = f" Did you mean {near[0]!r}?" if near else ""
    return f"There is no lab {name!r}.{guess} The labs are: {', '.join(names)}."
