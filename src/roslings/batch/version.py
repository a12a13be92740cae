"""By which engine and which lab something was judged, as one word that changes with both."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable
from functools import cache
from pathlib import Path

from roslings.course import Lab

ENGINE = Path(__file__).parents[1]
MADE = "__pycache__"


def version_of(lab: Lab) -> str:
    """Changes when the card, a hint, the grader, the hidden checks or the engine changes."""
    said = ((file.name, file) for file in (*lab.graders, *sorted(lab.folder.glob("*.yaml"))))
    return hashlib.sha256(engine_version() + _hash_of(said)).hexdigest()[:16]


@cache
def engine_version() -> bytes:
    """Changes with any file of the engine; as it is when this is first asked."""
    return engine_in(ENGINE)


def engine_in(folder: Path) -> bytes:
    """The version of the engine that lies in `folder`."""
    files = sorted(path for path in folder.rglob("*") if path.is_file())
    return _hash_of(
        (path.relative_to(folder).as_posix(), path) for path in files if MADE not in path.parts
    )


def _hash_of(files: Iterable[tuple[str, Path]]) -> bytes:
    content = hashlib.sha256()
    for name, path in files:
        one = hashlib.sha256(path.read_bytes()).hexdigest()
        content.update(f"{name}\0{one}\0".encode())
    return content.digest()
