"""`./roslings release --to DIR`: the students' edition, without what would give the answers away.

Left out are solutions, mutants, promises (they name the mutants), what is explained of generated
mutants, and hidden checks. All tests but those of `TESTS` are left out too, because most tests hold
packages that would pass.
"""

from __future__ import annotations

import re
import shutil
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path, PurePosixPath

from ros2_on_pip.typed_paths import from_here
from roslings.commands.built_site import BROUGHT, forget, is_up_to_date, note_texts, site_here
from roslings.course import CourseError, Lab, all_labs, root
from roslings.course.labs import EXAMPLE, example_root
from roslings.course.variants import NOT_FOR_STUDENTS
from roslings.workspace.sources import files
from roslings_class.course_files import course_files

TESTS = (
    "conftest.py",
    "browser.py",
    "changed.py",
    "costs.py",
    "lessons_as_tests.py",
    "machine.py",
    "needed",
    "once.py",
    "seen_with.py",
    "skips.py",
    "slow.py",
    "subreaper.py",
    "walks.py",
    "sources.py",
    "suite.py",
)
"""Parts of tests/ that students get: they show that the installation works."""
ENGINE = "roslings"
TESTS_OF_THE_ENGINE = (("arena",), ("report",))
"""The same of its own tests, by the first part of their path."""
INSTRUCTORS_ONLY = ("roslings-class", "roslings-prove")
"""Packages that grade others, and that prove."""
MAINTAINERS_ONLY = (".ci", ".github", "example-course")
_BETWEEN = r"(?:\s|<[^<>]*>)+"
SOLUTION_COMMAND = re.compile(
    rf"(\./roslings{_BETWEEN}check{_BETWEEN})[\w-]+({_BETWEEN}--solution)"
)
"""The first command of the README: in this edition it grades the example's solution. On a page of
the website, tags stand between its words."""
REWRITTEN = (
    "README.md",
    "CONTRIBUTING.md",
    "packages/ros-doctor",
    "days",
    "site/pages",
    BROUGHT.as_posix(),
)
"""Files, and folders of them, that tell students what to type."""
TEXTS = (".md", ".ipynb", ".py", ".html")
GUIDE = "site/pages/teachers/new-lab.md"
"""It shows a mutant, to be copied."""

NO_SITE = (
    "There is no website in it, which students could read with nothing installed.\n"
    "To bring one: ./roslings site --build, then do this again."
)
OLD_SITE = (
    "There is no website in it: the one that was built here shows the course as it was before.\n"
    "To bring one: ./roslings site --build, then do this again."
)
LEAST_LINE = 20
LIKE_THE_ANSWER = 0.5


class CannotRelease(CourseError):
    """The edition cannot be made like this."""


@dataclass(frozen=True)
class Edition:
    """A students' edition that was made."""

    names: list[str]
    """Of its files."""
    remarks: list[str]
    """What is in it that git does not keep, and what is not."""


def release(to: Path) -> Edition:
    """Make the students' edition in the new folder `to`.

    Raises CannotRelease where `to` holds something, or where an answer would leak, and what
    `course_files` raises.
    """
    if to.exists() and (not to.is_dir() or any(to.iterdir())):
        raise CannotRelease(f"{from_here(to)} holds something already. Give a new folder: --to DIR")
    found = course_files()
    names = [name for name in found.paths if is_for_students(name)]
    for name in names:
        _copy(found.paths[name], to / name)
    about_the_site = _bring_the_site(to)
    rewrite_texts(to)
    if about_the_site is None:
        note_texts(to / BROUGHT, to)
    if leaking := list(leaks(to, all_labs())):
        shutil.rmtree(to)
        told = "\n".join(leaking)
        raise CannotRelease(f"An answer would leak. Nothing was released.\n{told}")
    return Edition(names, [*found.remarks(names), *filter(None, [about_the_site])])


def _bring_the_site(to: Path) -> str | None:
    """Put the website that was built into the edition; what is to be said where there is none."""
    html = site_here()
    if html is None:
        return NO_SITE
    if not is_up_to_date(html, root()):
        return OLD_SITE
    shutil.copytree(html, to / BROUGHT)
    forget(to / BROUGHT)
    return None


def is_for_students(name: str) -> bool:
    """Whether a file of the course goes to students."""
    path = PurePosixPath(name)
    if path.parts[0] == "packages" and len(path.parts) > 2:
        return _is_of_a_students_package(path.parts[1], path.parts[2:])
    if path.parts[0] == "tests":
        return len(path.parts) > 1 and path.parts[1] in TESTS
    if path.parts[0] == "labs" and len(path.parts) > 2:
        return path.parts[2] not in NOT_FOR_STUDENTS
    if path.parts[0] == "days" and "drills" in path.parts:
        return path.stem != "solution"
    hidden = path.parts[0] == "graders" and path.name.startswith("hidden_")
    return not hidden and path.parts[0] not in MAINTAINERS_ONLY


def _is_of_a_students_package(package: str, inside: tuple[str, ...]) -> bool:
    """What teaches, runs and judges; of tests those of `TESTS`, for most hold what would pass."""
    if package in INSTRUCTORS_ONLY:
        return False
    return inside[0] != "tests" or (package == ENGINE and inside[1:2] in TESTS_OF_THE_ENGINE)


def rewrite_texts(edition: Path) -> None:
    """Say in all texts what works in an edition without solutions."""
    for path in _texts_in(edition):
        _rewrite(path)


def _copy(source: Path, target: Path) -> None:
    target.parent.mkdir(parents=True, exist_ok=True)
    shutil.copy(source, target)


def _texts_in(edition: Path) -> Iterator[Path]:
    for path in (edition / name for name in REWRITTEN):
        inside = path.rglob("*") if path.is_dir() else [path]
        yield from (each for each in inside if each.suffix in TEXTS and each.is_file())


def _rewrite(path: Path) -> None:
    """Commands that need a solution name the example, which is in every edition."""
    text = path.read_text("utf-8")
    path.write_text(SOLUTION_COMMAND.sub(rf"\g<1>{EXAMPLE}\g<2>", text), "utf-8")


# --- what would give an answer away ------------------------------------------------------------


def leaks(edition: Path, labs: list[Lab]) -> Iterator[str]:
    """Files of the edition that hold half of a solution's own lines, or what a mutant is.

    The example is no secret, and what a new lab still has of it, or of the guide to labs, neither.
    """
    answers = [(f"{lab.name}: {name}", lines) for lab in labs for name, lines in _answers(lab)]
    known = _known_to_all()
    mutants = ((lab.name, mutant.what) for lab in labs for mutant in lab.mutants())
    secrets = [(lab, what) for lab, what in mutants if what not in known]
    for name, file in sorted(_files_of(edition)):
        text = file.read_text("utf-8", "replace")
        lines = {line.strip() for line in text.splitlines()}
        yield from (
            f"{name} holds the solution of {whose}"
            for whose, answer in answers
            if len(lines & answer) > LIKE_THE_ANSWER * len(answer)
        )
        yield from (f"{name} tells a mutant of {lab}" for lab, what in secrets if what in text)


def _files_of(edition: Path) -> Iterator[tuple[str, Path]]:
    """All but the example's."""
    for file in (path for path in edition.rglob("*") if path.is_file()):
        name = file.relative_to(edition)
        if name.parts[0] != EXAMPLE:
            yield name.as_posix(), file


def _known_to_all() -> str:
    """What the example's mutants say, and those of the guide."""
    texts = (*(example_root() / "labs" / EXAMPLE / "mutants").glob("*.yaml"), _guide())
    return "\n".join(path.read_text("utf-8") for path in texts if path.is_file())


def _guide() -> Path:
    return example_root().parent / GUIDE


def _answers(lab: Lab) -> Iterator[tuple[str, set[str]]]:
    """Each Python file of the solution, as the lines that the starter has not."""
    if not lab.solution.is_dir():
        return
    given = {line for path in files(lab.starter).values() for line in _lines(path)}
    for name, path in files(lab.solution).items():
        own = _lines(path) - given if path.suffix == ".py" else set()
        if len(own) >= 3:
            yield name, own


def _lines(path: Path) -> set[str]:
    lines = (line.strip() for line in path.read_text("utf-8", "replace").splitlines())
    return {line for line in lines if len(line) >= LEAST_LINE}
