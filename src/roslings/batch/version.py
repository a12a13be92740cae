"""By which engine and which lab something was judged, as one word that changes with both."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable, Iterator
from functools import cache
from pathlib import Path

from roslings.course import Lab

ENGINE = Path(__file__).parents[1]
MADE = "__pycache__"
BRINGS = ("interfaces", "firmware")
"""Folders of a lab that its nodes are built with or talk to."""


def version_of(lab: Lab) -> str:
    """Changes when the card, a hint, the grader, the hidden checks or the engine changes.

    And with the message types and the sketch that the lab brings: nodes are built with them.
    """
    files = (*lab.graders, *sorted(lab.folder.glob("*.yaml")))
    said = [(file.name, file) for file in files] + list(_brought_by(lab))
    return hashlib.sha256(engine_version() + _hash_of(said)).hexdigest()[:16]


def _brought_by(lab: Lab) -> Iterator[tuple[str, Path]]:
    for part in BRINGS:
        for file in sorted((lab.folder / part).rglob("*")):
            if file.is_file():
                yield file.relative_to(lab.folder).as_posix(), file


@cache
def engine_version() -> bytes:
    """Changes with any file of the engine; as it is when this is first asked."""
    return engine_in(ENGINE)


def engine_in(folder: Path, but: frozenset[str] = frozenset()) -> bytes:
    """The version of the engine that lies in `folder`; of what is in `but` nothing counts."""
    files = sorted(path for path in folder.rglob("*") if path.is_file())
    return _hash_of(
        (path.relative_to(folder).as_posix(), path) for path in files
        if MADE not in path.parts and path.relative_to(folder).parts[0] not in but
    )  # fmt: skip


def _hash_of(files: Iterable[tuple[str, Path]]) -> bytes:
    content = hashlib.sha256()
    for name, path in files:
        one = hashlib.sha256(path.read_bytes()).hexdigest()
        content.update(f"{name}\0{one}\0".encode())
    return content.digest()
