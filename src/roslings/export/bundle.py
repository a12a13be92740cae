"""`./roslings export SYSTEM LAB --to DIR`: the platform's files, filled in, and the course."""

from __future__ import annotations

import shutil
from collections.abc import Iterator
from pathlib import Path, PurePosixPath
from uuid import NAMESPACE_URL, uuid5

from roslings import course
from roslings.authoring.release import course_files, is_for_students, leaks
from roslings.course import Lab
from roslings.export.errors import CannotExport
from roslings.export.systems import SYSTEMS, System
from roslings.workspace.sources import files

PARTS = ("src", "labs", "graders", "days")
"""Folders of the course that a check reads."""
FILES = ("roslings", "pyproject.toml", "constraints.txt", "LICENSE", "LICENSE-lessons.md")
DAYS = ("path.yaml",)
"""Of the lessons only the order; their notebooks are for students."""
HIDDEN = "graders/hidden_checks.py"
RUNS = (".sh", ".py", "run_autograder", "roslings")
"""Endings of files that are run as they are."""
DOT, AS_IT_IS = "dot-", ".in"
"""A template's name begins so for a file that begins with a dot, and ends so for a program that
belongs to the platform, not to us."""


def export(system_name: str, lab: Lab, to: Path) -> list[str]:
    """Make the bundle in the new folder `to`; what is to be said about it.

    Raises CannotExport where the platform is not known, `to` holds something, hidden checks would
    be shown to students, or an answer would leak.
    """
    system = _system(system_name)
    _insist(system, lab, to)
    course_at = to / filled(system.course, lab)
    for name in names_for(lab):
        _copy(course.root() / name, course_at / name)
    if lab.hidden:
        _copy(lab.hidden, course_at / HIDDEN).chmod(0o600)
    for template, name in _templates(system, lab):
        _fill_in(template, to / name, lab)
    _insist_on_no_answers(to, lab)
    return [f"What {system.about} needs for {lab.name!r} is in {to}.",
            f"Upload: {system.upload}.", f"The wall: {system.wall}.",
            f"Read {to / 'README.md'}: it tells each step."]  # fmt: skip


def _system(name: str) -> System:
    if name in SYSTEMS:
        return SYSTEMS[name]
    known = "\n".join(f"  {system.name:13} {system.about}" for system in SYSTEMS.values())
    raise CannotExport(f"No platform is called {name!r} here. These are known:\n{known}")


def _insist(system: System, lab: Lab, to: Path) -> None:
    if to.exists() and (not to.is_dir() or any(to.iterdir())):
        raise CannotExport(f"{to} holds something already. Give a new folder: --to DIR")
    if lab.folder.parent != course.root() / "labs":
        step = "Make a lab of your own from it: ./roslings new-lab NAME"
        raise CannotExport(f"The lab {lab.name!r} is an example, with its solution.\n{step}")
    if lab.hidden and not system.keeps_hidden:
        raise CannotExport(
            f"Students could read hidden checks there: {system.about}.\n"
            "Leave --hidden out, and grade with it yourself: ./roslings grade"
        )


def names_for(lab: Lab) -> list[str]:
    """The files of the course that grade this lab; no other lab's, and no answers."""
    names = {*course_files(), *_of_lab(lab)}
    return sorted(name for name in names if is_for_students(name) and _grades(name, lab))


def _of_lab(lab: Lab) -> Iterator[str]:
    """Also of one that git does not keep yet."""
    inside = lab.folder.relative_to(course.root())
    yield from ((inside / name).as_posix() for name in files(lab.folder))
    yield lab.grader.relative_to(course.root()).as_posix()


def _grades(name: str, lab: Lab) -> bool:
    parts = PurePosixPath(name).parts
    if parts[0] == "labs":
        return parts[1] == lab.name
    if parts[0] == "graders":
        return name == lab.grader.relative_to(course.root()).as_posix()
    if parts[0] == "days":
        return parts[1:] == DAYS
    return parts[0] in PARTS or name in FILES


def _copy(source: Path, target: Path) -> Path:
    target.parent.mkdir(parents=True, exist_ok=True)
    return Path(shutil.copy(source, target))


# --- the platform's own files ------------------------------------------------------------------


def _templates(system: System, lab: Lab) -> Iterator[tuple[Path, str]]:
    for path in sorted(system.templates.rglob("*")):
        if path.is_file():
            parts = path.relative_to(system.templates).parts
            yield path, filled("/".join(map(_real_name, parts)), lab)


def _real_name(name: str) -> str:
    name = name.removesuffix(AS_IT_IS)
    return f".{name.removeprefix(DOT)}" if name.startswith(DOT) else name


def _fill_in(template: Path, target: Path, lab: Lab) -> None:
    target.parent.mkdir(parents=True, exist_ok=True)
    target.write_text(filled(template.read_text("utf-8"), lab), "utf-8")
    target.chmod(0o755 if target.name.endswith(RUNS) else 0o644)


def filled(text: str, lab: Lab) -> str:
    """A template's text with this lab's words in it."""
    hidden = f"--hidden course/{HIDDEN}" if lab.hidden else ""
    words = {
        "LAB": lab.name, "TITLE": lab.card.title, "PACKAGE": lab.card.package, "HIDDEN": hidden,
        "UUID": str(uuid5(NAMESPACE_URL, f"roslings/{lab.name}")),
    }  # fmt: skip
    for word, value in words.items():
        text = text.replace(f"@{word}@", value)
    return text


def _insist_on_no_answers(to: Path, lab: Lab) -> None:
    if leaking := list(leaks(to, [lab])):
        shutil.rmtree(to)
        told = "\n".join(leaking)
        raise CannotExport(f"An answer would leak. Nothing was exported.\n{told}")
