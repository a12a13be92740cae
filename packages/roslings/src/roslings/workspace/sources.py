"""Which files of a package are its sources: what is copied, packed and compared.

Everything that building, Python, git or an editor makes is left out, and so is whatever is
neither a file nor a folder.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from roslings.workspace.errors import LinkLeadsOutside, TooLarge, reading

BUILT = frozenset({"build", "install", "log"})
"""colcon's folders; a package built in its own folder has them at its top."""
MADE = frozenset({"__pycache__", "node_modules"})


@dataclass(frozen=True)
class PackageLimits:
    """The most that a package of a lab may hold."""

    bytes: int = 200_000_000
    files: int = 20_000


@dataclass(frozen=True)
class PackageSource:
    """One source of a package: a folder, a file, or a link that stays inside."""

    path: Path
    name: Path
    """Relative to the package."""
    size: int = 0
    link_to: str | None = None
    """Relative to the folder of the link; None where this is no link."""

    @property
    def is_folder(self) -> bool:
        """A folder that is no link."""
        return self.link_to is None and self.path.is_dir()


def sources(package: Path, limits: PackageLimits | None = None) -> Iterator[PackageSource]:
    """The sources of a package, each folder before what it holds, by name.

    Raises LinkLeadsOutside, TooLarge and CannotRead.
    """
    count = Count(package, limits or PackageLimits())
    root = package.resolve()
    for source in _in_folder(root, root):
        count.add(source)
        yield source


def files(package: Path) -> dict[str, Path]:
    """The files of a package: name relative to it, with slashes, to path."""
    found = sources(package)
    return {source.name.as_posix(): source.path for source in found if source.path.is_file()}


def is_made(folder: Path, top: bool) -> bool:
    """Whether tools make this folder; `top` where it lies directly in the package."""
    name = folder.name
    return (
        name.startswith(".")
        or name in MADE
        or name.endswith(".egg-info")
        or (top and name in BUILT)
        or (folder / "pyvenv.cfg").is_file()
    )


def _in_folder(folder: Path, root: Path) -> Iterator[PackageSource]:
    with reading(folder), os.scandir(folder) as found:
        entries = sorted(found, key=lambda entry: entry.name)
    for entry in entries:
        yield from _from_entry(entry, root)


def _from_entry(entry: os.DirEntry[str], root: Path) -> Iterator[PackageSource]:
    path = Path(entry.path)
    if entry.is_symlink():
        yield from _from_link(path, root)
    elif entry.is_dir():
        with reading(path):
            made = is_made(path, top=path.parent == root)
        if not made:
            yield PackageSource(path, path.relative_to(root))
            yield from _in_folder(path, root)
    elif entry.is_file() and not _is_made_file(entry.name):
        yield PackageSource(path, path.relative_to(root), entry.stat().st_size)


def _is_made_file(name: str) -> bool:
    return name.endswith((".pyc", ".pyo", "~")) or name.startswith(".#")


def _from_link(link: Path, root: Path) -> Iterator[PackageSource]:
    """A link that stays inside. One that leads nowhere is skipped: Emacs locks files with such.

    A link to a folder above itself is skipped too: whoever follows it never comes to an end.
    """
    if not link.exists():
        return
    target = link.resolve()
    if not target.is_relative_to(root):
        raise LinkLeadsOutside(link, os.readlink(link))  # noqa: PTH115
    if not link.parent.is_relative_to(target):
        yield PackageSource(
            link, link.relative_to(root), link_to=os.path.relpath(target, link.parent)
        )


class Count:
    """How much of a package was seen so far, held against the limits."""

    def __init__(self, package: Path, limits: PackageLimits) -> None:
        self._package, self._limits = package, limits
        self._files = 0
        self._bytes = 0
        self._by_part: dict[str, int] = {}

    def add(self, source: PackageSource) -> None:
        """Count one more. Raises TooLarge."""
        part = source.name.parts[0]
        self._by_part[part] = self._by_part.get(part, 0) + source.size + 1
        self._files += 1
        self._bytes += source.size
        if self._files > self._limits.files:
            self._refuse(f"more than {self._limits.files:,} files", f"{self._limits.files:,} files")
        if self._bytes > self._limits.bytes:
            self._refuse(f"more than {size(self._limits.bytes)}", size(self._limits.bytes))

    def _refuse(self, found: str, limit: str) -> None:
        largest = max(self._by_part, key=lambda part: self._by_part[part])
        raise TooLarge(self._package, self._package / largest, found, limit)


def size(count: int) -> str:
    """A number of bytes, for people."""
    if count < 1000:
        return f"{count} bytes"
    return f"{count / 1000:.1f} kB" if count < 1_000_000 else f"{count / 1_000_000:.1f} MB"
