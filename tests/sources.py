"""Where our own packages lie, for programs that a test starts by itself."""

from __future__ import annotations

import os
from importlib.util import find_spec
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
ALONE = "ROSLINGS_TESTS_ALONE"
"""Set by `alone.py`: folders that hold all of ours that there is, none where it is installed."""


def sources(course: Path = ROOT) -> list[Path]:
    """The folder above the modules of each package: packages/NAME/src."""
    alone = os.environ.get(ALONE)
    if alone is not None and course == ROOT:
        return [Path(folder) for folder in alone.split(os.pathsep) if folder]
    return sorted(course.glob("packages/*/src"))


def python_path(course: Path = ROOT) -> str:
    """All of them, as PYTHONPATH."""
    return os.pathsep.join(map(str, sources(course)))


def code_of(package: str) -> Path:
    """The folder with the modules of a package, by the name that is imported."""
    found = find_spec(package)
    assert found and found.origin, package
    return Path(found.origin).parent


def our_modules(course: Path = ROOT) -> list[Path]:
    """Each Python file of ours that is no test."""
    return sorted(file for folder in sources(course) for file in folder.rglob("*.py"))
