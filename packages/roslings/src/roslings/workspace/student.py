"""The student's workspace: where it is, and what goes into it and out of it.

Nothing here changes a file that the student wrote.
"""

from __future__ import annotations

import os
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path

from ros2_on_pip.typed_paths import quoted, shown
from roslings.course import Lab
from roslings.workspace.copying import copy_package
from roslings.workspace.difference import changes_since
from roslings.workspace.errors import (
    EmptyFolder,
    NamedOtherwise,
    NoPackage,
    NoWorkspace,
    TargetAlreadyThere,
    WorkspaceError,
    reading,
)
from roslings.workspace.hand_in import Packed, default_zip, write_zip
from roslings.workspace.packages import find_package, package_name, packages_in
from roslings.workspace.sources import PackageLimits, files

__all__ = [
    "Packed",
    "Started",
    "diff",
    "pack",
    "package_of",
    "stage",
    "start",
    "started_package",
    "workspace_root",
]

VARIABLE = "ROSLINGS_WS"


@dataclass(frozen=True)
class Started:
    """A starter that was put into the workspace."""

    package: Path
    files: int


def workspace_root() -> Path:
    """The student's colcon workspace: `ROSLINGS_WS`, else `~/roslings_ws`. It may not exist.

    Raises WorkspaceError for a user without a home and without `ROSLINGS_WS`.
    """
    try:
        return Path(os.environ.get(VARIABLE) or "~/roslings_ws").expanduser().absolute()
    except RuntimeError:
        raise WorkspaceError(
            "There is no home folder for your workspace.",
            f"Name a folder for it: export {VARIABLE}=/path/to/a/folder",
        ) from None


def package_of(lab: Lab, path: Path | None = None) -> Path:
    """The student's package for a lab: the one that `path` means, else the workspace's.

    Raises NoWorkspace, NotBegun, OfOtherLab, and what `find_package` raises.
    """
    root = workspace_root()
    if path is None and not root.exists():
        raise NoWorkspace(root, lab.name)
    try:
        return find_package(path or root, lab.outline.package)
    except (NoPackage, EmptyFolder, NamedOtherwise) as nothing:
        raise _why_none(lab, path, nothing) from nothing


def _why_none(lab: Lab, path: Path | None, nothing: WorkspaceError) -> WorkspaceError:
    """The next step of who has not begun is another one than that of who misspelt a name."""
    from roslings.workspace import likeness  # who has the package needs none of it

    there = nothing.found if isinstance(nothing, NamedOtherwise) else []
    root = workspace_root()
    if path is None or path.expanduser().resolve() in (root.resolve(), (root / "src").resolve()):
        return likeness.why_none_in_workspace(lab, path or root, there)
    if there:
        return likeness.why_none_at(lab, path, there)
    if isinstance(nothing, EmptyFolder):
        return nothing
    return NoPackage(path, lab.outline.package, lab.name)


def start(lab: Lab, workspace: Path | None = None) -> Started:
    """Put the lab's starter into `src/` of the workspace; never over what is there.

    Raises TargetAlreadyThere, DiskFull, CannotWriteFolder.
    """
    root = workspace or workspace_root()
    package = root / "src" / lab.outline.package
    with reading(root):
        standing = package if os.path.lexists(package) else started_package(lab, root)
    if standing:
        raise _already_started(lab, standing, root)
    copy_package(lab.starter, package)
    return Started(package, len(files(package)))


def started_package(lab: Lab, workspace: Path | None = None) -> Path | None:
    """Where the workspace has the lab's package, made by hand or by `start`; None where not."""
    source = (workspace or workspace_root()) / "src"
    if not source.is_dir():
        return None
    found = packages_in(source)
    return next((each for each in found if package_name(each) == lab.outline.package), None)


def diff(lab: Lab, path: Path | None = None) -> list[str]:
    """What changed since the starter, as lines of a unified diff; empty where nothing did.

    Raises what `package_of` raises.
    """
    return changes_since(lab.starter, package_of(lab, path))


def pack(lab: Lab, out: Path | None = None, path: Path | None = None) -> Packed:
    """Make the zip file to hand in: the package's sources and nothing else.

    `out` is a file, or a folder for `LAB.zip`; without it, `LAB.zip` lies in the current folder.
    An older zip of the same package is replaced, and the answer says so. Raises TargetAlreadyThere
    where something else has that name, and what `package_of` raises.
    """
    package = package_of(lab, path)
    return write_zip(package, default_zip(lab.name, out))


def stage(package: Path, into: Path, limits: PackageLimits | None = None) -> Path:
    """Copy a package's sources to the new folder `into`, to be built there; returns `into`.

    Links that stay inside the package stay links. Raises LinkLeadsOutside, TooLarge, CannotRead,
    TargetAlreadyThere, DiskFull and CannotWriteFolder.
    """
    return copy_package(package, into, limits)


def _already_started(lab: Lab, standing: Path, root: Path) -> TargetAlreadyThere:
    return TargetAlreadyThere(
        f"There is {_what_stands(lab, standing)}:\n  {shown(standing)}\nIt stays as it is.",
        f"Go on with it. What you changed so far: ./roslings diff {lab.name}\n"
        f"For a fresh starter, move it out of the workspace first:\n"
        f"  mv {quoted(standing)} {quoted(_free_name(standing.name, root.parent))}",
    )


def _what_stands(lab: Lab, standing: Path) -> str:
    if not standing.is_dir():
        return "a file already"
    if not (standing / "package.xml").is_file():
        return "already a folder without package.xml"
    if not changes_since(lab.starter, standing):
        return "the starter already, without any change"
    return f"your package already (last changed {_last_change(standing):%Y-%m-%d %H:%M})"


def _last_change(package: Path) -> datetime:
    stamps = (path.stat().st_mtime for path in files(package).values())
    return datetime.fromtimestamp(max(stamps, default=package.stat().st_mtime))


def _free_name(name: str, folder: Path) -> Path:
    """A name outside the workspace: inside, colcon would find two packages."""
    names = (f"{name}_old{number}" for number in ("", *range(2, 1000)))
    return next(folder / name for name in names if not os.path.lexists(folder / name))
