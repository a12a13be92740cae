"""Capabilities that come from packages of others, as files that go into an edition.

A package lies in an edition's `packages/NAME/src` as it is installed. That is its folder, and the
record of its entry points beside it, by which Python finds them.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from importlib.metadata import Distribution, EntryPoint, entry_points
from importlib.util import find_spec
from pathlib import Path

from roslings.capability import BUILT_IN, GROUP
from roslings.course import CourseError
from roslings.course.labs import engine_root
from roslings.workspace.sources import files
from roslings_launcher import constraints

RECORDS = ("METADATA", "entry_points.txt")
ENGINE = "roslings"
"""What it offers by entry points itself goes into each edition with it."""
_NAME = re.compile(r"[A-Za-z0-9._-]+")


class CannotBring(CourseError):
    """A package with a capability cannot go into an edition."""


@dataclass(frozen=True)
class EditionPackage:
    """One package, and where its files go in an edition."""

    name: str
    files: dict[str, Path]


def packages_of_capabilities(modules: Path) -> list[EditionPackage]:
    """Those that are installed here, and are not in the course's folder `modules` already.

    Raises CannotBring.
    """
    found: dict[str, EditionPackage] = {}
    for entry in entry_points(group=GROUP):
        if _is_built_in(entry):
            continue
        if not _folder_of(entry).is_relative_to(modules):
            package = _package(entry)
            found[package.name] = package
    return [found[name] for name in sorted(found)]


def _is_built_in(entry: EntryPoint) -> bool:
    return entry.name in BUILT_IN or entry.module.partition(".")[0] == ENGINE


def _package(entry: EntryPoint) -> EditionPackage:
    distribution = entry.dist
    if distribution is None:
        raise CannotBring(f"Nothing is known of the package of the capability {entry.name!r}.")
    name = f"{distribution.metadata['Name']} {distribution.version}"
    _insist_on_needs(name, distribution)
    folder = _folder_of(entry)
    src = f"packages/{_plain(distribution.metadata['Name'])}/src"
    inside = {f"{src}/{folder.name}/{inner}": path for inner, path in files(folder).items()}
    return EditionPackage(name, {**inside, **dict(_records(name, distribution, src))})


def _folder_of(entry: EntryPoint) -> Path:
    """The folder of the package that an entry point leads into."""
    top = entry.module.partition(".")[0]
    spec = find_spec(top)
    places = list(spec.submodule_search_locations or []) if spec else []
    if not places:
        raise CannotBring(
            f"The capability {entry.name!r} is in {top}, which is no folder with an __init__.py.\n"
            "Make it one: only whole folders can go into an edition."
        )
    return Path(places[0])


def _records(name: str, distribution: Distribution, src: str) -> Iterator[tuple[str, Path]]:
    own = [file for file in distribution.files or () if file.name in RECORDS]
    if {file.name for file in own} < set(RECORDS):
        raise CannotBring(
            f"{name} is not installed as pip does it now: its record has no list of files.\n"
            f"Install it anew: python -m pip install --no-deps {name.partition(' ')[0]}"
        )
    for file in own:
        yield f"{src}/{file.as_posix()}", Path(str(distribution.locate_file(file)))


def _insist_on_needs(name: str, distribution: Distribution) -> None:
    """`./roslings` installs what constraints.txt pins, and nothing else. Raises CannotBring."""
    pinned = {_plain(pin.name) for pin in constraints.read(engine_root() / "constraints.txt")}
    needs = [need for need in distribution.requires or () if "extra ==" not in need]
    wanting = [need for need in needs if _word(need) not in {*pinned, "roslings"}]
    if wanting:
        raise CannotBring(
            f"{name} needs {', '.join(wanting)}, and ./roslings installs no such package.\n"
            "Put what it needs into the package itself, or leave it out."
        )


def _word(need: str) -> str:
    found = _NAME.match(need)
    return _plain(found[0]) if found else need


def _plain(name: str) -> str:
    return re.sub(r"[-_.]+", "-", name).lower()
