"""Why a lab's package is not where it is looked for: not begun, or there under another name.

From the second lab on, the finished packages of other labs lie in every workspace: they say nothing
about this one.
"""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterable, Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

from roslings.course import Lab, all_labs
from roslings.workspace.code import NotPython, parse, read_setup
from roslings.workspace.errors import NamedOtherwise, NotBegun, OfOtherLab, WorkspaceError

ALIKE = 0.75
"""`chater` and `chatter` have 0.92, `rover_status` and `rover_bringup` 0.56."""

Found = tuple[str, Path]
"""A package's name and its folder."""


def why_none_in_workspace(lab: Lab, place: Path, there: Iterable[Found]) -> WorkspaceError:
    """Of a search through a workspace: speaks of names only where one means this lab."""
    alike = [each for each in there if looks_like(each, lab)]
    if alike:
        return NamedOtherwise(lab.outline.package, alike, lab.name)
    return NotBegun(lab.name, lab.outline.package, place)


def why_none_at(lab: Lab, place: Path, there: list[Found]) -> WorkspaceError:
    """Of a path that was given: who gives the one package there means that one."""
    if len(there) > 1:
        return why_none_in_workspace(lab, place, there)
    name, folder = there[0]
    other = lab_with(name)
    if other is None or looks_like(there[0], lab):
        return NamedOtherwise(lab.outline.package, there, lab.name)
    return OfOtherLab(folder, other.name, lab.name)


def lab_with(package: str) -> Lab | None:
    """The lab that asks for a package of this name."""
    return next((lab for lab in all_labs() if lab.outline.package == package), None)


def looks_like(found: Found, lab: Lab) -> bool:
    """Whether a package with another name may be meant for this lab."""
    name, folder = found
    if any(_is_near(each, lab) for each in {name, folder.name} if lab_with(each) is None):
        return True
    if folder.name == lab.outline.package:  # a copy of another lab's package, to begin with
        return True
    return lab_with(name) is None and _has_an_executable_of(lab, folder)


def _is_near(name: str, lab: Lab) -> bool:
    said, package = _letters(name), _letters(lab.outline.package)
    return package in said or any(
        difflib.SequenceMatcher(None, said, wanted).ratio() >= ALIKE
        for wanted in (package, _letters(lab.name))
    )


def _letters(name: str) -> str:
    return re.sub(r"[^a-z0-9]", "", name.lower())


def _has_an_executable_of(lab: Lab, folder: Path) -> bool:
    wanted = {*_executables(lab.card.model_dump())}
    with suppress(NotPython, OSError):
        return bool(wanted & read_setup(parse(folder / "setup.py")).console_scripts.keys())
    return False


def _executables(words: Any) -> Iterator[str]:
    """All that a card names, a capability's own words included."""
    if isinstance(words, dict):
        if isinstance(words.get("executable"), str):
            yield words["executable"]
        words = words.values()
    if not isinstance(words, str) and isinstance(words, Iterable):
        for each in words:
            yield from _executables(each)
