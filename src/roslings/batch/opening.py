"""From what was handed in to the folder of its package."""

from __future__ import annotations

from pathlib import Path

from roslings.batch.archives import is_archive, unpack
from roslings.batch.trouble import Refused
from roslings.workspace.packages import find_package, nothing_in, packages_in
from roslings.workspace.sources import files
from roslings.workspace.trouble import MachineTrouble, WorkspaceError, without_places

MOST_ARCHIVES = 100


def package_in(handed_in: Path, name: str, room: Path) -> Path:
    """The folder of the package `name` in a submission; an archive is unpacked into `room`.

    A folder that holds nothing but one archive, as learning platforms make them, is that archive.
    Raises Refused, and MachineTrouble where the disk is in the way.
    """
    try:
        folder = _folder_of(handed_in, room)
        package = _chosen(folder, name)
        files(package)  # a link that leaves the package, or too much in it
        return package
    except MachineTrouble:
        raise
    except WorkspaceError as error:
        raise _in_its_own_words(error, (room, handed_in)) from error


def _folder_of(handed_in: Path, room: Path) -> Path:
    if not handed_in.exists():
        raise Refused("There is nothing at its path.", "Look at the path in the list.")
    if handed_in.is_file():
        return _unpacked(handed_in, room)
    inside = _archives_in(handed_in)
    if len(inside) == 1 and not packages_in(handed_in):
        return _unpacked(inside[0], room)
    return handed_in


def _unpacked(archive: Path, room: Path) -> Path:
    if not is_archive(archive):
        reason = f"It is neither a folder nor an archive: {archive.suffix or 'no ending'}."
        raise Refused(reason, "Hand in the zip file that ./roslings pack LAB makes.")
    folder = room / "unpacked"
    unpack(archive, folder)
    return folder


def _archives_in(folder: Path) -> list[Path]:
    entries = (entry for entry in folder.iterdir() if not entry.name.startswith("."))
    return [entry for entry in entries if is_archive(entry) and entry.is_file()][:MOST_ARCHIVES]


def _chosen(folder: Path, name: str) -> Path:
    if not packages_in(folder):
        raise nothing_in(folder, name)
    package = find_package(folder, name)
    if not package.resolve().is_relative_to(folder.resolve()):
        reason = "A link in it leads to another place."
        raise Refused(reason, "Replace the link by the files themselves.")
    return package


def _in_its_own_words(error: WorkspaceError, places: tuple[Path, ...]) -> Refused:
    """The same sentences, without the paths of the machine that grades."""
    inside = [*(place / "unpacked" for place in places), *places]
    return Refused(without_places(error.problem, inside), without_places(error.next_step, inside))
