"""Where the real `ros2` is installed, it is run, unchanged."""

from __future__ import annotations

import importlib.util
import os
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

MARKS = (b"roslings", b"ros2_on_pip")
"""What starts us names one of these near its top: the course's launcher, what pip made of our entry
point, a script that runs `start.py`. The real commands do not."""

HEAD_BYTES = 1000


def hand_over(name: str, module: str, arguments: Sequence[str]) -> None:
    """Become the real command `name`; returns only where there is none."""
    if program := real_program(name):
        os.execv(program, [str(program), *arguments])
    if importlib.util.find_spec(module.partition(".")[0]):
        code = f"import sys; from {module} import main; sys.exit(main())"
        os.execv(sys.executable, [sys.executable, "-c", code, *arguments])


def real_program(name: str) -> Path | None:
    """The first program `name` on the path that is not ours."""
    return next((place for place in _on_path(name) if not _ours(place)), None)


def _on_path(name: str) -> Iterator[Path]:
    for folder in os.environ.get("PATH", "").split(os.pathsep):
        place = Path(folder or ".") / name
        if place.is_file() and os.access(place, os.X_OK):
            yield place


def _ours(place: Path) -> bool:
    try:
        with place.open("rb") as file:
            head = file.read(HEAD_BYTES)
    except OSError:
        return True  # what cannot be read cannot be run either
    return any(mark in head for mark in MARKS)
