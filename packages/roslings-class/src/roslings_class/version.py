"""By which engine and which lab something was judged, as one word that changes with both."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Iterator
from functools import cache
from pathlib import Path

import ros2_on_pip
import roslings
import roslings_class
import roslings_rover
from roslings.course import Lab

ENGINE = tuple(
    Path(package.__path__[0]) for package in (ros2_on_pip, roslings_rover, roslings, roslings_class)
)
"""The packages that measure and judge; the others teach, prove, and look at a machine."""
MADE = "__pycache__"
BRINGS = ("interfaces", "firmware")
"""Folders of a lab that its nodes are built with or talk to."""


def version_of(lab: Lab) -> str:
    """Changes when the card, a hint, the grader, the hidden checks or the engine changes.

    And with the message types and the sketch that the lab brings: nodes are built with them.
    """
    files = (*_graders(lab), *sorted(lab.folder.glob("*.yaml")))
    said = [(file.name, file) for file in files] + list(_brought_by(lab))
    return hashlib.sha256(engine_version() + _hash_of(said)).hexdigest()[:16]


def _graders(lab: Lab) -> Iterator[Path]:
    """Its own, and what lies beside them for several labs; no other lab's."""
    yield from lab.graders
    for file in sorted(lab.grader.parent.glob("*.py")):
        if not file.name.startswith(("grade_", "hidden_")):
            yield file
    yield from (file for file in sorted(lab.beside.rglob("*")) if _is_written(file))


def _is_written(file: Path) -> bool:
    return file.is_file() and MADE not in file.parts


def _brought_by(lab: Lab) -> Iterator[tuple[str, Path]]:
    for part in BRINGS:
        for file in sorted((lab.folder / part).rglob("*")):
            if file.is_file():
                yield file.relative_to(lab.folder).as_posix(), file


@cache
def engine_version() -> bytes:
    """Changes with any file of the engine; as it is when this is first asked."""
    return engine_in(*ENGINE)


def engine_in(*folders: Path, but: frozenset[str] = frozenset()) -> bytes:
    """The version of the packages that lie in `folders`; of what is in `but` nothing counts."""
    return _hash_of(pair for folder in folders for pair in _files_in(folder, but))


def _files_in(folder: Path, but: frozenset[str]) -> Iterator[tuple[str, Path]]:
    for path in sorted(path for path in folder.rglob("*") if path.is_file()):
        inside = path.relative_to(folder)
        if MADE not in path.parts and inside.parts[0] not in but:
            yield f"{folder.name}/{inside.as_posix()}", path


def _hash_of(files: Iterable[tuple[str, Path]]) -> bytes:
    content = hashlib.sha256()
    for name, path in files:
        one = hashlib.sha256(path.read_bytes()).hexdigest()
        content.update(f"{name}\0{one}\0".encode())
    return content.digest()
