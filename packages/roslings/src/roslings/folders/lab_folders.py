"""What only one lab needs: a folder beside its grader, `graders/e_stop/` of `grade_e_stop.py`.

The folder is a package, and is imported by its place in the course:

    from graders.e_stop.demands import stop_for

So it is in each course, wherever that lies: nothing is installed. Two courses may have a lab of the
same name; a grader then gets what lies beside it. A folder that is the same one by a link is loaded
once. Where its `__init__.py` has a `CAPABILITY`, cards, evidence and pages know it
(`capability.py`).
"""

from __future__ import annotations

import sys
import traceback
from collections.abc import Iterator, Sequence
from importlib import import_module
from importlib.abc import MetaPathFinder
from importlib.machinery import ModuleSpec
from importlib.util import spec_from_file_location
from pathlib import Path
from types import ModuleType

from ros2_on_pip.errors import INCONCLUSIVE, RoslingsError
from roslings.folders.course_folder import root

GRADERS = "graders"
GRADER = "grade_"
"""A grader's file begins with it, and what follows is the name of the folder beside it."""
IS_PACKAGE = "__init__.py"


def folder_beside(grader: Path) -> Path:
    """Where what only this grader needs lies; it need not be there."""
    return grader.parent / grader.stem.removeprefix(GRADER)


def lab_folders() -> tuple[Path, ...]:
    """All of the course, by name."""
    return tuple(sorted(file.parent for file in (root() / GRADERS).glob(f"*/{IS_PACKAGE}")))


def module_of(folder: Path) -> str:
    """What the folder is imported as; from now on it is this one."""
    _bind(folder)
    return f"{GRADERS}.{folder.name}"


def take_beside(grader: Path) -> None:
    """Let a grader import the folder that lies beside it, if there is one."""
    if grader.stem.startswith(GRADER) and _is_package(folder := folder_beside(grader)):
        _bind(folder)


def imported(module: str) -> ModuleType:
    """A module. Raises BadLabFolder where Python cannot read what lies in a lab's folder."""
    try:
        return import_module(module)
    except Exception as error:
        if place := _place_of(error):
            raise BadLabFolder(place, error) from error
        raise


class BadLabFolder(RoslingsError):
    """What lies beside a grader is no Python that can be imported; nothing is said of a package."""

    exit_status = INCONCLUSIVE

    def __init__(self, place: str, error: Exception) -> None:
        *_, words = traceback.format_exception_only(error)
        super().__init__(
            f"A folder beside a grader has a mistake: {place}\n{words.strip()}\n"
            "Nothing is said of the package. Who writes the lab mends this line, and types the\n"
            "same command again. Who does the lab tells the instructor."
        )


def _place_of(error: Exception) -> str | None:
    """The innermost line of a lab's folder that it came through, as an editor opens it."""
    frames = traceback.extract_tb(error.__traceback__)
    places = [(frame.filename, frame.lineno) for frame in reversed(frames)]
    if isinstance(error, SyntaxError) and error.filename:
        places.insert(0, (error.filename, error.lineno))
    return next((f"{shown}:{line or 1}" for name, line in places if (shown := _shown(name))), None)


def _shown(file: str) -> str | None:
    """A file of a lab's folder, from the course on; None for any other."""
    folder = next((each for each in _bound.values() if Path(file).is_relative_to(each)), None)
    if folder is None:
        return None
    return f"{GRADERS}/{folder.name}/{Path(file).relative_to(folder).as_posix()}"


# --- which folder a name means -----------------------------------------------------------------

_bound: dict[str, Path] = {}
"""Name of a folder to the one that it means."""
_put_aside: dict[Path, dict[str, ModuleType]] = {}
"""Modules of folders, without links, that another one of the same name took the place of."""


def _bind(folder: Path) -> None:
    name, before = folder.name, _bound.get(folder.name)
    if before and before.resolve() == folder.resolve():
        return
    if before:
        _put_aside[before.resolve()] = {each: sys.modules.pop(each) for each in [*_loaded(name)]}
    _bound[name] = folder
    sys.modules.update(_put_aside.pop(folder.resolve(), {}))


def _loaded(name: str) -> Iterator[str]:
    """The modules of a folder that are loaded."""
    package = f"{GRADERS}.{name}"
    return (each for each in sys.modules if each == package or each.startswith(f"{package}."))


def _is_package(folder: Path) -> bool:
    return (folder / IS_PACKAGE).is_file()


class _Finder(MetaPathFinder):
    """Finds `graders`, which is no more than a name, and the folders in it."""

    def find_spec(
        self, name: str, path: Sequence[str] | None = None, target: ModuleType | None = None
    ) -> ModuleSpec | None:
        if name == GRADERS:
            return _package_of_nothing()
        package, _, inner = name.partition(".")
        return _spec_of(name, inner) if package == GRADERS and inner.isidentifier() else None


def _package_of_nothing() -> ModuleSpec:
    spec = ModuleSpec(GRADERS, None, is_package=True)
    spec.submodule_search_locations = []
    return spec


def _spec_of(module: str, name: str) -> ModuleSpec | None:
    if name not in _bound and _is_package(folder := root() / GRADERS / name):
        _bind(folder)
    if not (bound := _bound.get(name)):
        return None
    places = [str(bound)]
    return spec_from_file_location(module, bound / IS_PACKAGE, submodule_search_locations=places)


sys.meta_path.insert(0, _Finder())
