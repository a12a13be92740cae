"""Whether a lab's files fit each other: all that can be seen without running anything.

A mistake here costs an author minutes where a grading finds it, and one mistake at a time. So all
of them are told at once, before anything is graded.
"""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Collection, Iterable, Iterator
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TypeVar

from pydantic import BaseModel, ValidationError

from roslings.course import Lab, Mutant, root
from roslings.course.card import Card, Hint, Hints
from roslings.course.files import BadCourseFile, CourseError, line_in, read_tree
from roslings.course.labs import MUTANTS
from roslings.course.promises import NAME as PROMISES
from roslings.course.promises import Promises
from roslings.course.task import is_current
from roslings.judge.faults import Fault
from roslings.judge.grader_mistakes import GraderBroke, asked_for_nothing, load_or_tell
from roslings.judge.sheet import CheckLine, sheet
from roslings.judge.undefined import undefined_names
from roslings.workspace.normal import digest_of_all, digest_of_file
from roslings.workspace.sources import files
from roslings_learn.lessons.anchors import anchors_of
from roslings_prove.prove import DOES_NOT_APPLY, Proof

Read = TypeVar("Read", bound=BaseModel)


def files_fit(lab: Lab) -> Iterator[Proof]:
    """All that must hold of a lab's files. What cannot be read is told, and the rest goes on."""
    seen = LabFiles(lab)
    asked = [
        *ALL,
        *(WITH_CARD if seen.card else ()),
        *(WITH_SOLUTION if seen.solution else ()),
        *(WITH_GRADER if seen.checks else ()),
    ]
    for about, problems in asked:
        yield Proof(f"{lab.name}: {about}", "\n       ".join(problems(seen)))
    unread = "\n       ".join(seen.unread)
    yield Proof(f"{lab.name}: its files can be read", unread)


@dataclass
class LabFiles:
    """What a lab's files say; what cannot be read is noted, and left out."""

    lab: Lab
    unread: list[str] = field(default_factory=list)
    _digests: dict[tuple[str, bytes], str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Read all of it now: who asks for `unread` must find all of it."""
        _ = self.card, self.solution, self.points, self.hints, self.mutants, self.checks
        if (promises := self.lab.folder / PROMISES).is_file():
            self._read(promises, Promises)

    @cached_property
    def card(self) -> Card | None:
        """None where it says something wrong."""
        return self._read(self.lab.folder / "card.yaml", Card)

    @cached_property
    def solution(self) -> Path | None:
        """The package that mutants are made of, also where the card says something else wrong."""
        try:
            found = self.lab.solution
        except CourseError:
            return None
        if not found.is_dir():
            self.unread.append(f"{found.relative_to(self.lab.folder)}: there is no such folder")
            return None
        return found

    @cached_property
    def points(self) -> tuple[str, ...]:
        """Checks with points, also of a card that says something else wrong."""
        try:
            found = read_tree(self.lab.folder / "card.yaml")["points"]
        except (BadCourseFile, TypeError, KeyError):
            return ()
        return tuple(map(str, found)) if isinstance(found, dict) else ()

    @cached_property
    def hints(self) -> dict[str, Hint]:
        """Check's name to its hint."""
        found = self._read(self.lab.folder / "hints.yaml", Hints)
        return found.root if found else {}

    @cached_property
    def mutants(self) -> list[Mutant]:
        """Those that can be read."""
        paths = sorted((self.lab.folder / MUTANTS).glob("*.yaml"))
        read = ((path, self._read(path, Mutant)) for path in paths)
        return [one.model_copy(update={"name": path.stem}) for path, one in read if one]

    @cached_property
    def checks(self) -> list[CheckLine]:
        """Those of the grader; none where it cannot be loaded, and it reads the card first."""
        if not self.card:
            return []
        try:
            load_or_tell(self.lab.grader)
            return sheet(self.lab)
        except GraderBroke as mistake:
            self.unread.append(str(mistake).replace("\n", "\n       "))
        except Exception as error:  # a grader is a program: anything may be wrong with it
            self.unread.append(f"{self.lab.grader.name}: {type(error).__name__}: {error}")
        return []

    @cached_property
    def made(self) -> dict[str, MadeMutant]:
        """Mutant's name to what came of making it."""
        with tempfile.TemporaryDirectory(prefix="roslings-") as scratch:
            return {one.name: self._make(one, Path(scratch) / one.name) for one in self.mutants}

    def _make(self, mutant: Mutant, scratch: Path) -> MadeMutant:
        scratch.mkdir()
        try:
            package = mutant.make(self.lab.solution, scratch / "made")
        except DOES_NOT_APPLY:
            return MadeMutant("", tuple(_problems(mutant, self.lab.solution, scratch)))
        return MadeMutant(self.content_of(package), ())

    def content_of(self, package: Path) -> str:
        """Digest of its files. A mutant changes one of them; the others are digested once."""
        return digest_of_all({name: self._digest(path) for name, path in files(package).items()})

    def _digest(self, file: Path) -> str:
        key = (file.suffix, file.read_bytes())
        if key not in self._digests:
            self._digests[key] = digest_of_file(file)
        return self._digests[key]

    def _read(self, path: Path, model: type[Read]) -> Read | None:
        try:
            return model.model_validate(read_tree(path))
        except BadCourseFile as error:
            self._note(path, error.line, error.problem)
        except ValidationError as error:
            for each in error.errors():
                where = ".".join(map(str, each["loc"]))
                problem = each["msg"].removeprefix("Value error, ")
                self._note(path, line_in(path, each["loc"]), f"{where}: {problem}")
        return None

    def _note(self, path: Path, line: int, problem: str) -> None:
        name = path.relative_to(self.lab.folder).as_posix()
        self.unread.append(f"{name}:{line}: {problem}")


# --- making mutants ----------------------------------------------------------------------------


@dataclass(frozen=True)
class MadeMutant:
    """A mutant that was made once."""

    content: str
    """Digest of its package."""
    problems: tuple[str, ...]
    """Each step that does not fit the solution."""


def _problems(mutant: Mutant, solution: Path, scratch: Path) -> Iterator[str]:
    """Make it step by step: one that does not fit keeps none of the others from being tried."""
    package = solution
    for number, (about, file, step) in enumerate(_steps(mutant)):
        try:
            package = step.make(package, scratch / f"{number}")
        except OSError as error:
            yield f"{_file(mutant)}: {about}: {error.strerror}: {file}"
        except DOES_NOT_APPLY as error:
            yield f"{_file(mutant)}: {about}: {str(error).removeprefix(f'mutant {mutant.name}: ')}"


def _steps(mutant: Mutant) -> Iterator[tuple[str, str, Mutant]]:
    """For each of its steps what it is, its file, and a mutant of this step alone."""
    none = mutant.model_copy(update={"edits": (), "remove": (), "write": {}})
    count = len(mutant.edits)
    for number, edit in enumerate(mutant.edits, 1):
        about = f"edit {number} of {count}"
        yield about, edit.file, none.model_copy(update={"edits": (edit,)})
    for name in mutant.remove:
        yield "remove", name, none.model_copy(update={"remove": (name,)})
    for name, content in mutant.write.items():
        yield "write", name, none.model_copy(update={"write": {name: content}})


def _file(mutant: Mutant) -> str:
    return f"{MUTANTS}/{mutant.name}.yaml"


# --- the rules: each yields what is wrong ------------------------------------------------------


def _task(seen: LabFiles) -> Iterator[str]:
    try:
        if not is_current(seen.lab):
            yield f"bring it up to date: python -m roslings.course.task {seen.lab.name}"
    except BadCourseFile as error:
        yield f"{error.path.name}:{error.line}: {error.problem}"
    except OSError as error:
        yield f"{seen.lab.task.name}: {error.strerror}"


def _hints(seen: LabFiles) -> Iterator[str]:
    yield from _named("without one", _without(seen.points, seen.hints))
    yield from _named("hints without a check", _without(seen.hints, seen.points))


def _anchors(seen: LabFiles) -> Iterator[str]:
    """A lesson that the lab's own day does not have yet is none of a hint's mistakes."""
    file = seen.lab.folder / "hints.yaml"
    for check, hint in seen.hints.items():
        if _is_dead(hint.lesson, seen):
            yield f"{file.name}:{line_in(file, (check, 'lesson'))}: {hint.lesson} leads nowhere"


def _is_dead(lesson: str, seen: LabFiles) -> bool:
    day, _, anchor = lesson.partition("#")
    if (root() / day).is_dir():
        return anchor not in anchors_of(root() / day / "lesson.ipynb")
    own = f"days/{seen.card.day}" if seen.card else ""
    return day != own and any((root() / "days").glob("*/lesson.ipynb"))


def _caught(seen: LabFiles) -> Iterator[str]:
    caught = {check for mutant in seen.mutants for check in mutant.fails}
    yield from _named("nobody has seen these fail", _without(seen.points, caught))


def _applies(seen: LabFiles) -> Iterator[str]:
    for one in seen.made.values():
        yield from one.problems


def _names(seen: LabFiles) -> Iterator[str]:
    for mutant in seen.mutants:
        words = {"fails": mutant.fails, "skips": mutant.skips}
        for word, checks in words.items():
            about = f"{_file(mutant)}: {word}: no check of this name"
            yield from _named(about, _without(checks, seen.points))
        about = f"{_file(mutant)}: faults: it must not fail there"
        yield from _named(about, _without(mutant.faults, mutant.fails))


def _twins(seen: LabFiles) -> Iterator[str]:
    """Comments do not count: a package that does the same shows the same."""
    whose = {seen.content_of(seen.lab.solution): "the solution"}
    for name, one in seen.made.items():
        if one.content in whose:
            yield f"{MUTANTS}/{name}.yaml: the same package as {whose[one.content]}"
        elif one.content:
            whose[one.content] = f"{MUTANTS}/{name}.yaml"


def _checked(seen: LabFiles) -> Iterator[str]:
    there = [line.id for line in seen.checks]
    yield from _named("points, and no check in the grader", _without(seen.points, there))
    yield from _named("checks without points", _without(there, seen.points))


def _order(seen: LabFiles) -> Iterator[str]:
    for number, line in enumerate(seen.checks):
        earlier = {each.id for each in seen.checks[:number]}
        for word, names in {"needs": line.needs, "explained_by": line.explained_by}.items():
            yield from _named(f"{line.id}: {word}: no earlier check", _without(names, earlier))


def _asked(seen: LabFiles) -> Iterator[str]:
    yield from (each.in_short for each in asked_for_nothing(load_or_tell(seen.lab.grader)))


def _defined(seen: LabFiles) -> Iterator[str]:
    """Python looks for a name when the line runs, and an experiment runs late."""
    yield from (each.in_short for each in undefined_names(load_or_tell(seen.lab.grader)))


def _kinds(seen: LabFiles) -> Iterator[str]:
    """Faults by the names of their classes; the grader was loaded, and so were its faults."""
    known = {kind.__name__ for kind in _made_of(Fault)}
    for mutant in seen.mutants:
        about = f"{_file(mutant)}: no fault of this name"
        yield from _named(about, _without(mutant.faults.values(), known))
    for line in seen.checks:
        kinds = {kind for kinds in line.explained_by.values() for kind in kinds}
        about = f"{line.id}: explained_by: no fault of this name"
        yield from _named(about, _without(sorted(kinds), known))


def _made_of(kind: type[Fault]) -> Iterator[type[Fault]]:
    for one in kind.__subclasses__():
        yield one
        yield from _made_of(one)


def _without(names: Iterable[str], there: Collection[str]) -> list[str]:
    return [name for name in names if name not in there]


def _named(about: str, names: Collection[str]) -> Iterator[str]:
    if names:
        yield f"{about}: {', '.join(names)}"


Rules = tuple[tuple[str, Callable[[LabFiles], Iterator[str]]], ...]
ALL: Rules = (
    ("each check has a hint, and each hint a check", _hints),
    ("each hint leads to a paragraph of a lesson", _anchors),
    ("each check is shown at work by a mutant", _caught),
    ("each mutant names checks of the card", _names),
)
WITH_CARD: Rules = (("task.md says what the card says", _task),)
WITH_SOLUTION: Rules = (
    ("each mutant fits the solution", _applies),
    ("each mutant is a package of its own", _twins),
)
WITH_GRADER: Rules = (
    ("the card gives points for the grader's checks", _checked),
    ("what a check needs, and what explains it, is checked before", _order),
    ("each fault that is named is one", _kinds),
    ("what experiments and checks ask for is there", _asked),
    ("each name in the grader is defined", _defined),
)
