"""`./roslings export SYSTEM LAB --to DIR`: the platform's files, filled in, and the course."""

from __future__ import annotations

import shutil
from collections.abc import Iterator, Sequence
from pathlib import Path, PurePosixPath
from uuid import NAMESPACE_URL, uuid5

from ros2_on_pip.typed_paths import from_here
from roslings import course
from roslings.course import Lab
from roslings_class.course_files import CourseFiles, course_files
from roslings_class.export.errors import CannotExport
from roslings_class.export.systems import OF_SYSTEM, SYSTEMS, System
from roslings_class.release import is_for_students, leaks
from roslings_launcher.built_interfaces import fitting
from roslings_launcher.interface_sources import packages_in
from roslings_launcher.interfaces import GROUP as INTERFACES

PARTS = ("packages", "labs", "graders", "days")
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
    found = course_files()
    names = names_for(lab, found)
    for name in names:
        _copy(found.paths[name], course_at / name)
    if lab.hidden:
        _copy(lab.hidden, course_at / HIDDEN).chmod(0o600)
    write_own_files(system, lab, to)
    _insist_on_no_answers(to, lab)
    return [
        f"What {system.about} needs for {lab.name!r} is in {from_here(to)}.",
        f"Upload: {system.upload}.",
        f"The wall: {system.wall}.",
        f"Read {from_here(to / 'README.md')}: it tells each step.",
        *found.remarks(names),
    ]


def _system(name: str) -> System:
    if name in SYSTEMS:
        return SYSTEMS[name]
    known = "\n".join(f"  {system.name:13} {system.about}" for system in SYSTEMS.values())
    raise CannotExport(f"No platform is called {name!r} here. These are known:\n{known}")


def _insist(system: System, lab: Lab, to: Path) -> None:
    if to.exists() and (not to.is_dir() or any(to.iterdir())):
        raise CannotExport(f"{from_here(to)} holds something already. Give a new folder: --to DIR")
    if lab.folder.parent != course.root() / "labs":
        step = "Make a lab of your own from it: ./roslings new-lab NAME"
        raise CannotExport(f"The lab {lab.name!r} is an example, with its solution.\n{step}")
    if lab.hidden and not system.keeps_hidden:
        raise CannotExport(
            f"Students could read hidden checks there: {system.about}.\n"
            "Leave --hidden out, and grade with it yourself: ./roslings grade"
        )


def names_for(lab: Lab, found: CourseFiles) -> list[str]:
    """The files of the course that grade this lab; no other lab's, and no answers."""
    return sorted(name for name in found.paths if is_for_students(name) and _grades(name, lab))


def _grades(name: str, lab: Lab) -> bool:
    parts = PurePosixPath(name).parts
    if parts[0] == "labs":
        return parts[1] == lab.name
    if parts[0] == "graders":
        path = course.root() / name
        return path == lab.grader or path.is_relative_to(lab.beside)
    if parts[0] == "days":
        return parts[1:] == DAYS
    if parts[0] == "packages":
        return "tests" not in parts[:3]
    return parts[0] in PARTS or name in FILES


def _copy(source: Path, target: Path) -> Path:
    target.parent.mkdir(parents=True, exist_ok=True)
    return Path(shutil.copy(source, target))


# --- the platform's own files ------------------------------------------------------------------


def write_own_files(system: System, lab: Lab, to: Path) -> None:
    """All of the bundle but the course."""
    for template, name in _templates(system, lab):
        _fill_in(template, to / name, lab, system)


def _templates(system: System, lab: Lab) -> Iterator[tuple[Path, str]]:
    for path in sorted(system.templates.rglob("*")):
        if path.is_file():
            parts = path.relative_to(system.templates).parts
            yield path, filled("/".join(map(_real_name, parts)), lab)


def _real_name(name: str) -> str:
    name = name.removesuffix(AS_IT_IS)
    return f".{name.removeprefix(DOT)}" if name.startswith(DOT) else name


def _fill_in(template: Path, target: Path, lab: Lab, system: System) -> None:
    target.parent.mkdir(parents=True, exist_ok=True)
    text = filled(template.read_text("utf-8"), lab, system_packages(lab, system))
    target.write_text(text, "utf-8")
    target.chmod(0o755 if target.name.endswith(RUNS) else 0o644)


def system_packages(lab: Lab, system: System) -> list[str]:
    """What apt brings for the groups of the lab's card, beyond what the platform has."""
    groups = (group for group in lab.card.groups if group != INTERFACES or not _come_built(lab))
    wanted = (package for group in groups for package in OF_SYSTEM.get(group, ()))
    return [package for package in wanted if package not in system.has]


def _come_built(lab: Lab) -> bool:
    """The message types of the lab's own are compiled already."""
    sources = packages_in(lab.folder / "interfaces")
    return all(fitting(course.root(), source) for source in sources)


def filled(text: str, lab: Lab, packages: Sequence[str] = ()) -> str:
    """A template's text with this lab's words in it, and what apt is to bring for it."""
    hidden = f"--hidden course/{HIDDEN}" if lab.hidden else ""
    words = {
        "LAB": lab.name,
        "TITLE": lab.card.title,
        "PACKAGE": lab.card.package,
        "HIDDEN": hidden,
        "SYSTEM": " ".join(packages),
        "ALSO": "".join(f" {each}" for each in packages),
        "QUOTED": "".join(f', "{each}"' for each in packages),
        "UUID": str(uuid5(NAMESPACE_URL, f"roslings/{lab.name}")),
    }
    for word, value in words.items():
        text = text.replace(f"@{word}@", value)
    return text


def _insist_on_no_answers(to: Path, lab: Lab) -> None:
    if leaking := list(leaks(to, [lab])):
        shutil.rmtree(to)
        told = "\n".join(leaking)
        raise CannotExport(f"An answer would leak. Nothing was exported.\n{told}")
