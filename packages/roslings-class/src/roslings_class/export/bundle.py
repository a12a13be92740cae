"""`./roslings export SYSTEM LAB --to DIR`: the platform's files, filled in, and the course."""

from __future__ import annotations

import shutil
from collections.abc import Iterator, Sequence
from pathlib import Path, PurePosixPath
from uuid import NAMESPACE_URL, uuid5

from ros2_on_pip import language
from ros2_on_pip.language import said
from ros2_on_pip.typed_paths import from_here
from roslings import course
from roslings.course import Lab
from roslings.course.titles import lab_title
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
README = "README.md"
HIDDEN = "graders/hidden_checks.py"
RUNS = (".sh", ".py", "run_autograder", "roslings")
"""Endings of files that are run as they are."""
DOT, AS_IT_IS = "dot-", ".in"
"""A template's name begins so for a file that begins with a dot. It ends so for a program that
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
        *_told(system, lab, to),
        *found.remarks(names),
    ]


def _told(system: System, lab: Lab, to: Path) -> Iterator[str]:
    """Where it is, what goes where, and what keeps a student's code from the grade there."""
    made, place = "What {system} needs for {lab!r} is in {folder}.", from_here(to)
    yield said("export.made", made, system=system.about, lab=lab.name, folder=place)
    yield said("export.upload", "Upload: {what}.", what=system.upload)
    yield said("export.wall", "The wall: {wall}.", wall=system.wall)
    readme = from_here(to / README)
    yield said("export.read", "Read {file}: it tells each step.", file=readme)


def _system(name: str) -> System:
    if name in SYSTEMS:
        return SYSTEMS[name]
    known = "\n".join(f"  {system.name:13} {system.about}" for system in SYSTEMS.values())
    text = "No platform is called {name!r} here. These are known:\n{known}"
    raise CannotExport(said("export.no_platform", text, name=name, known=known))


def _insist(system: System, lab: Lab, to: Path) -> None:
    if to.exists() and (not to.is_dir() or any(to.iterdir())):
        text = "{folder} holds something already. Give a new folder: {option}"
        raise CannotExport(said("export.not_empty", text, folder=from_here(to), option="--to DIR"))
    if lab.folder.parent != course.root() / "labs":
        text = (
            "The lab {lab!r} is an example, with its solution.\n"
            "Make a lab of your own from it: {command}"
        )
        command = "./roslings new-lab NAME"
        raise CannotExport(said("export.example", text, lab=lab.name, command=command))
    if lab.hidden and not system.keeps_hidden:
        text = (
            "Students could read hidden checks there: {system}.\n"
            "Leave {option} out, and grade with it yourself: ./roslings grade"
        )
        raise CannotExport(said("export.hidden", text, system=system.about, option="--hidden"))


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
    text = filled(_written(template, system), lab, system_packages(lab, system))
    target.write_text(text, "utf-8")
    target.chmod(0o755 if target.name.endswith(RUNS) else 0o644)


def _written(template: Path, system: System) -> str:
    """A template's text; what an instructor reads, in the language that is asked for."""
    english = template.read_text("utf-8")
    return language.template(readme_id(system), english) if template.name == README else english


def readme_id(system: System) -> str:
    """The id of the page that tells each step."""
    return f"export.{system.name}.readme"


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
        "TITLE": lab_title(lab),
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
        text = "An answer would leak. Nothing was exported.\n{files}"
        raise CannotExport(said("export.leaks", text, files=told))
