"""From what was handed in to the folder of its package."""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import islice
from pathlib import Path

from roslings.hand_in.archives import UnpackBudget, is_archive, is_clutter, not_opened, unpack
from roslings.hand_in.errors import PACK_AGAIN, HandInRefused, HostileArchive
from roslings.hand_in.newest import newest_first
from roslings.workspace.errors import (
    MOST_NAMED,
    MachineTrouble,
    NamedOtherwise,
    OnlyOtherLabs,
    OnlyPacked,
    WorkspaceError,
    without_places,
)
from roslings.workspace.file_kinds import UNKNOWN, kind_of
from roslings.workspace.likeness import lab_with
from roslings.workspace.packages import find_package, nothing_in, package_name, packages_in
from roslings.workspace.sources import files

MOST_ARCHIVES = 20
"""Of one submission, all levels together."""
DEEPEST = 3
"""A zip in a zip in a zip."""
TOO_DEEP = "It lies in a zip in a zip in a zip, and so deep nothing is opened."


def package_in(handed_in: Path, name: str, room: Path) -> Path:
    """The folder of the package `name` in a submission; archives are unpacked into `room`.

    Where a folder or an archive holds no package but archives, the newest of these that has the
    package counts.
    Raises HandInRefused, and MachineTrouble where the disk is in the way.
    """
    opening = Opening(name, room)
    try:
        package = _chosen(opening.folder_of(handed_in), opening)
        files(package)  # a link that leaves the package, or too much in it
        return package
    except MachineTrouble:
        raise
    except WorkspaceError as error:
        raise in_its_own_words(error, (*opening.unpacked, handed_in, room)) from error


@dataclass
class Opening:
    """What is unpacked of one submission: its bounds hold for all of its archives together."""

    name: str
    """Of the package that is looked for."""
    room: Path
    budget: UnpackBudget = field(default_factory=UnpackBudget)
    unpacked: list[Path] = field(default_factory=list)
    told: dict[str, str] = field(default_factory=dict)
    """Archives inside, and why no package came out of each."""

    def folder_of(self, handed_in: Path) -> Path:
        """The folder with what was handed in. Raises HandInRefused."""
        if not handed_in.exists():
            raise HandInRefused("There is nothing at its path.", "Look at the path in the list.")
        if handed_in.is_dir():
            return self._searched(handed_in, 0)
        kind = kind_of(handed_in)
        if kind.way != "opens" and not (kind is UNKNOWN and is_archive(handed_in)):
            raise not_opened(kind)
        return self._out_of(handed_in, 0)

    def _out_of(self, archive: Path, depth: int) -> Path:
        number = len(self.unpacked)
        folder = self.room / (f"unpacked-{number}" if number else "unpacked")
        self.unpacked.append(folder)
        unpack(archive, folder, self.budget)
        return self._searched(folder, depth)

    def _searched(self, folder: Path, depth: int) -> Path:
        """The folder itself, or what comes out of an archive in it."""
        if packages_in(folder):
            return folder
        if depth == DEEPEST:
            too_deep = dict.fromkeys((each.name for each in _archives_in(folder)), TOO_DEEP)
            self.told.update(too_deep)
            return folder
        inside = list(islice(_archives_in(folder), MOST_ARCHIVES))
        opened = [*self._tried(inside, depth + 1)]
        with_package = [each for each in opened if packages_in(each)]
        return next(
            (each for each in with_package if self._has_it(each)), [*with_package, folder][0]
        )

    def _tried(self, archives: list[Path], depth: int) -> Iterator[Path]:
        """Each that can be unpacked, the newest first. Raises HostileArchive where it is alone."""
        for archive in newest_first(archives):
            if len(self.unpacked) >= MOST_ARCHIVES:
                return
            try:
                folder = self._out_of(archive, depth)
            except HostileArchive:
                if len(archives) == 1:
                    raise
            except HandInRefused as refusal:  # said where nothing else has the package
                self.told[archive.name] = refusal.reason
            else:
                self.told.setdefault(archive.name, self._why_not(folder))
                yield folder
                if self._has_it(folder):
                    return

    def _why_not(self, folder: Path) -> str:
        """What is in an archive, where no package is."""
        if isinstance(why := nothing_in(folder, self.name), OnlyPacked):
            return f"It holds no ROS package, but {why.what}."
        return "It holds no ROS package."

    def _has_it(self, folder: Path) -> bool:
        return any(package_name(package) == self.name for package in packages_in(folder))


def _archives_in(folder: Path) -> Iterator[Path]:
    """Archives at any depth; a link may lead to somebody else's, so none is followed."""
    for here, folders, names in os.walk(folder):
        folders[:] = sorted(each for each in folders if not _is_passed_by(each))
        for name in sorted(names):
            path = Path(here, name)
            if is_archive(path) and not _is_passed_by(name) and not path.is_symlink():
                yield path


def _is_passed_by(name: str) -> bool:
    return name.startswith(".") or is_clutter(name)


def _chosen(folder: Path, opening: Opening) -> Path:
    if not packages_in(folder):
        raise _nothing_came_out(opening.told) or nothing_in(folder, opening.name)
    package = _found(folder, opening.name)
    if not package.resolve().is_relative_to(folder.resolve()):
        reason = "A link in it leads to another place."
        raise HandInRefused(reason, "Replace the link by the files themselves.")
    return package


def _found(folder: Path, name: str) -> Path:
    """The package; packages of other labs are no misspelt ones of this."""
    try:
        return find_package(folder, name)
    except NamedOtherwise as nothing:
        labs = [(found, lab_with(found)) for found, _ in nothing.found]
        if all(lab for _, lab in labs):
            raise OnlyOtherLabs(name, [(found, lab.name) for found, lab in labs if lab]) from None
        own = [each for each, (_, lab) in zip(nothing.found, labs, strict=True) if not lab]
        raise NamedOtherwise(name, own) from None


def _nothing_came_out(told: dict[str, str]) -> HandInRefused | None:
    """Of any archive inside; None where there is none."""
    if not told:
        return None
    lines = [_of(name, reason) for name, reason in islice(told.items(), MOST_NAMED)]
    return HandInRefused(
        "\n  ".join(["There is no ROS package in submission:", *lines]), PACK_AGAIN
    )


def _of(name: str, reason: str) -> str:
    """`It is cut off.` of a file, with the file's name."""
    return f"{name} {reason[3:]}" if reason.startswith("It ") else f"{name}: {reason}"


def in_its_own_words(error: WorkspaceError, places: tuple[Path, ...]) -> HandInRefused:
    """The same sentences, without the paths of the machine that grades."""
    return HandInRefused(
        without_places(error.problem, places), without_places(error.next_step, places)
    )
