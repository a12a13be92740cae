"""Find the package that a student means by a path."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

from roslings.workspace.errors import (
    Archive,
    EmptyFolder,
    FileTooLarge,
    IgnoredByColcon,
    NamedOtherwise,
    NoPackage,
    NoPackageXml,
    NoSetupPy,
    NoSuchPath,
    NotAFolder,
    OnlyPacked,
    OtherwiseForColcon,
    TooManyFolders,
    TwoPackages,
    WorkspaceError,
    reading,
)
from roslings.workspace.file_kinds import EMPTY, UNKNOWN, FileKind, kind_of
from roslings.workspace.sources import BUILT, MADE

MOST_FOLDERS = 5_000
MOST_LOOKED_AT = 2_000
"""Files of a folder without a package, to see whether one is packed."""
DEEPEST = 8
LEVELS_UP = 3
COLCON_MARKERS = ("COLCON_IGNORE", "AMENT_IGNORE", "CATKIN_IGNORE")
IGNORE_MARKERS = (*COLCON_MARKERS, "pyvenv.cfg")
PACKED = (".zip", ".tar", ".gz", ".tgz", ".xz", ".txz", ".bz2", ".tbz2", ".7z", ".rar")
LARGEST_BYTES = {name: 64_000 for name in ("package.xml", "setup.cfg", "colcon.pkg")}
"""Of what we and colcon read to know what the package is; people write a fiftieth of it."""
MOST_LINES, LONGEST_LINE = 2_000, 1_000
"""Of setup.cfg: Python's own reader takes the square of them."""
NAME = re.compile(r"<name>\s*([^<>\s]+)\s*</name>")
COMMENT = ("<!--", "-->")


def find_package(path: Path, name: str) -> Path:
    """The folder of the package `name`: `path` itself, a folder in it, or one around it.

    `path` may be the package, a folder of it, its parent or a workspace with `src/`. Built
    folders, hidden ones, virtual environments and those with COLCON_IGNORE are not searched.

    Raises a WorkspaceError for a path that means no package, or more than one.
    """
    folder = _folder(path)
    found = [(package_name(package), package) for package in packages_in(folder)]
    if not found:
        found = [(package_name(package), package) for package in _around(folder)]
    package = _choose(folder, name, found)
    if not (package / "setup.py").is_file():
        raise NoSetupPy(package, has_cmake=(package / "CMakeLists.txt").is_file())
    insist_on_small_files(package)
    _insist_that_colcon_takes(package, name)
    return package


def insist_on_small_files(package: Path) -> None:
    """So that reading them comes to an end, for us and for colcon. Raises FileTooLarge."""
    for name, most_bytes in LARGEST_BYTES.items():
        file = package / name
        if file.is_file() and (found := file.stat().st_size) > most_bytes:
            raise FileTooLarge(file, f"{found:,} bytes", f"{most_bytes:,} bytes")
    settings = package / "setup.cfg"
    if settings.is_file():
        with reading(settings):
            _insist_on_short_lines(settings, settings.read_bytes().splitlines())


def _insist_on_short_lines(file: Path, lines: list[bytes]) -> None:
    if len(lines) > MOST_LINES:
        raise FileTooLarge(file, f"{len(lines):,} lines", f"{MOST_LINES:,} lines")
    longest = max(map(len, lines), default=0)
    if longest > LONGEST_LINE:
        found = f"a line of {longest:,} bytes"
        raise FileTooLarge(file, found, f"{LONGEST_LINE:,} bytes a line")


def _insist_that_colcon_takes(package: Path, name: str) -> None:
    """No file of its own keeps colcon from it. Raises IgnoredByColcon, OtherwiseForColcon."""
    if marker := _marker_in(package):
        raise IgnoredByColcon(package, marker)
    settings = package / "colcon.pkg"
    if settings.exists() and (problem := _problem_in(settings, name)):
        raise OtherwiseForColcon(package, problem)


def _problem_in(settings: Path, name: str) -> str:
    """What colcon.pkg says against package.xml; empty where both say the same."""
    from roslings.workspace.colcon_settings import said_in  # few packages have such a file

    said = said_in(settings)
    wanted = {"type": "ros.ament_python", "name": name}
    if said is None:
        return "colcon cannot read it"
    if said in ({"type": None, "name": None}, wanted):
        return ""
    return f"it says type {said['type']!r} and name {said['name']!r}"


def packages_in(folder: Path) -> list[Path]:
    """Every package under `folder`, as colcon would find it; links are followed once.

    Raises TooManyFolders, and CannotRead where `folder` itself is closed to this user.
    """
    return sorted(here for here, is_package in _searched(folder).items() if is_package)


def _searched(folder: Path) -> dict[Path, bool]:
    """Every folder that colcon would look at, those that it ignores too: is it a package?"""
    seen: dict[Path, bool] = {}
    waiting = [(folder.resolve(), 0)]
    while waiting:
        here, depth = waiting.pop()
        if here in seen:
            continue
        seen[here] = False
        if len(seen) > MOST_FOLDERS:
            raise TooManyFolders(folder, MOST_FOLDERS)
        with reading(here) if depth == 0 else suppress(PermissionError):
            seen[here] = _is_package(here)
            if depth < DEEPEST and not seen[here]:
                waiting += [(child, depth + 1) for child in _subfolders(here)]
    return seen


def _is_package(folder: Path) -> bool:
    return (folder / "package.xml").is_file() and not _is_ignored(folder)


def _subfolders(folder: Path) -> Iterator[Path]:
    """The folders that colcon would look into."""
    if _is_ignored(folder):
        return
    for child in sorted(folder.iterdir()):
        if child.is_dir() and not _is_made(child):
            yield child.resolve()


def package_name(package: Path) -> str:
    """The name in package.xml, else that of the folder. Reads invalid XML too."""
    found = NAME.search(xml_text(package / "package.xml"))
    return found[1] if found else package.name


def xml_text(path: Path) -> str:
    """The text of a package.xml without its comments; what is no UTF-8 becomes a �."""
    with reading(path), path.open("rb") as file:
        start = file.read(LARGEST_BYTES["package.xml"])
    return "".join(_without_comments(start.decode("utf-8", errors="replace")))


def _without_comments(text: str) -> Iterator[str]:
    """The pieces between comments; one that does not end is none."""
    opening, closing = COMMENT
    begin = 0
    while (comment := text.find(opening, begin)) >= 0:
        end = text.find(closing, comment + len(opening))
        if end < 0:
            break
        yield text[begin:comment]
        begin = end + len(closing)
    yield text[begin:]


def _folder(path: Path) -> Path:
    path = Path(os.path.abspath(path.expanduser()))  # noqa: PTH100 - a link keeps its name
    if not _exists(path):
        raise NoSuchPath(path)
    if path.is_dir():
        return path
    with reading(path):
        kind = kind_of(path) if path.is_file() else UNKNOWN
    raise Archive(path, kind) if kind.is_packed else NotAFolder(path)


def _exists(path: Path) -> bool:
    """Whether there is something; a link that leads nowhere is nothing."""
    with reading(path):
        try:
            path.stat()
        except PermissionError:
            raise
        except (OSError, ValueError):  # gone, a loop of links, too long, a zero byte
            return False
    return True


def _is_ignored(folder: Path) -> bool:
    return any((folder / marker).exists() for marker in IGNORE_MARKERS)


def _marker_in(folder: Path) -> str | None:
    """The file that keeps colcon out of a folder; None where there is none."""
    return next((marker for marker in COLCON_MARKERS if (folder / marker).exists()), None)


def _is_made(folder: Path) -> bool:
    return folder.name.startswith(".") or folder.name in BUILT or folder.name in MADE


def _around(folder: Path) -> list[Path]:
    """The package that `folder` is a part of, as a list of one or none."""
    above = [folder, *folder.parents][: LEVELS_UP + 1]
    return [part for part in above if (part / "package.xml").is_file()][:1]


def _choose(folder: Path, name: str, found: list[tuple[str, Path]]) -> Path:
    same = [package for found_name, package in found if found_name == name]
    if len(same) == 1:
        return same[0]
    if same:
        raise TwoPackages(name, same)
    if passed_by := _passed_by(folder, name):
        raise passed_by
    raise NamedOtherwise(name, found) if found else nothing_in(folder, name)


def _passed_by(folder: Path, name: str) -> WorkspaceError | None:
    """Why the package is none for colcon, though it stands where it belongs."""
    for place in (folder, folder / name, folder / "src" / name):
        if (place / "setup.py").is_file() and not (place / "package.xml").is_file():
            return NoPackageXml(place)
        if (place / "package.xml").is_file() and (marker := _marker_in(place)):
            return IgnoredByColcon(place, marker)
    return None


def nothing_in(folder: Path, name: str) -> WorkspaceError:
    """Why there is no package in a folder: it is empty, ignored, packed; or there is just none."""
    places = sorted(_searched(folder))
    for place in places:
        if (marker := _marker_in(place)) and _holds_a_package(place):
            return IgnoredByColcon(place, marker)
    entries = [entry for place in places for entry in _files_in(place)]
    if not entries:
        return EmptyFolder(folder, name)
    packed = list(_packed(entries))
    return OnlyPacked(folder, packed) if packed else NoPackage(folder, name)


def _packed(entries: list[Path]) -> Iterator[tuple[str, FileKind]]:
    """Packed files, by their bytes or by their names, with what they are."""
    for entry in entries[:MOST_LOOKED_AT]:
        if entry.is_symlink() or not entry.is_file():
            continue
        with suppress(OSError):
            kind = kind_of(entry)
            if entry.name.lower().endswith(PACKED) or (kind.is_packed and kind is not EMPTY):
                yield entry.name, kind


def _holds_a_package(folder: Path) -> bool:
    return any(next(folder.glob(f"{way}package.xml"), None) for way in ("", "*/", "*/*/"))


def _files_in(folder: Path) -> list[Path]:
    with suppress(PermissionError):
        return [entry for entry in sorted(folder.iterdir()) if not entry.is_dir()]
    return []
