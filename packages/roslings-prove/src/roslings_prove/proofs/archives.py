"""Evidence of a lab's packages, several in one archive: `LAB/0.tar.xz` to `LAB/7.tar.xz`.

Packages of one lab show nearly the same, so their evidence is small where it is packed together.
The name of a package alone says which archive it is in: who records it anew writes that file and
no other. What an archive holds is read, and never written to the disk.
"""

from __future__ import annotations

import lzma
import os
import tarfile
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, field
from io import BytesIO
from pathlib import Path

from roslings.workspace.normal import digest_of
from roslings_class.grading import THOROUGHLY

ARCHIVES = 8
"""Of a lab. With more of them each file is smaller, and all together are larger."""
ENDING = ".tar.xz"
LARGEST_BYTES = 1_000_000
MOST_UNPACKED_BYTES = 100_000_000
"""Of one archive."""

Members = Mapping[str, bytes]
"""Package to its evidence, as thin JSON."""


class UnreadableArchive(Exception):
    """A file is no archive as it is written here."""


class ArchiveTooLarge(Exception):
    """One more package would make an archive larger than any may be."""


@dataclass(frozen=True)
class Archives:
    """Those of one lab, as they are when each is first read."""

    folder: Path
    _read: dict[Path, Members] = field(default_factory=dict, init=False, compare=False)

    def file(self, package: str) -> Path:
        """The archive that a package belongs into."""
        return self.folder / f"{int(digest_of(package.encode()), 16) % ARCHIVES}{ENDING}"

    def label(self, package: str) -> str:
        """What messages call it: `topics/3.tar.xz`."""
        return f"{self.folder.name}/{self.file(package).name}"

    def files(self) -> list[Path]:
        """All that lies in the lab's folder, whatever it is."""
        return sorted(file for file in self.folder.glob("*") if file.is_file())

    def members(self, file: Path) -> Members:
        """All of one archive; none where it is not there. Raises UnreadableArchive."""
        if file not in self._read:
            self._read[file] = read(file) if file.is_file() else {}
        return self._read[file]

    def evidence(self, package: str) -> bytes | None:
        """Thin JSON; None where the package is not in its archive. Raises UnreadableArchive."""
        return self.members(self.file(package)).get(package)

    def strangers(self, packages: Collection[str]) -> Iterator[str]:
        """Files that hold none of these packages, and what else is packed beside them."""
        for file in self.files():
            if own := self._own(file, packages):
                yield from (f"{name} in {file.name}" for name in sorted({*self._told(file)} - own))
            else:
                yield file.name

    def put(self, package: str, content: bytes) -> None:
        """Keep a package's evidence. Raises ArchiveTooLarge, and then all is as it was.

        An archive that cannot be read begins anew: nobody can judge what was in it.
        """
        file = self.file(package)
        self._write(file, {**self._told(file), package: content})

    def keep_only(self, packages: Collection[str]) -> None:
        """What belongs to none of these goes."""
        for file in self.files():
            own, there = self._own(file, packages), self._told(file)
            if not own:
                file.unlink()
            elif there.keys() - own:
                self._write(file, {name: there[name] for name in there.keys() & own})

    def _own(self, file: Path, packages: Collection[str]) -> set[str]:
        return {package for package in packages if self.file(package) == file}

    def _told(self, file: Path) -> Members:
        try:
            return self.members(file)
        except UnreadableArchive:
            return {}

    def _write(self, file: Path, members: Members) -> None:
        content = packed(members)
        if len(content) > LARGEST_BYTES:
            raise ArchiveTooLarge(
                f"with it {self.folder.name}/{file.name} would have {len(content):,} bytes;"
                f" {LARGEST_BYTES:,} are the most"
            )
        replace_file(file, content)
        self._read[file] = members


def packed(members: Members) -> bytes:
    """The archive of them: the same bytes, whoever packs them and whenever."""
    found = BytesIO()
    with tarfile.open(fileobj=found, mode="w:") as archive:
        for package, content in sorted(members.items()):
            member = tarfile.TarInfo(package)  # of no time and no user
            member.size = len(content)
            archive.addfile(member, BytesIO(content))
    return lzma.compress(found.getvalue(), preset=THOROUGHLY)


def read(file: Path) -> Members:
    """All that an archive holds. Raises UnreadableArchive."""
    if file.stat().st_size > LARGEST_BYTES:
        raise UnreadableArchive(f"has more than {LARGEST_BYTES:,} bytes")
    try:
        plain = _unpacked(file.read_bytes())
        with tarfile.open(fileobj=BytesIO(plain), mode="r:") as archive:
            return dict(_members(archive))
    except (lzma.LZMAError, tarfile.TarError, ValueError, OSError) as error:
        raise UnreadableArchive(f"cannot be read: {str(error)[:200]}") from error


def _unpacked(content: bytes) -> bytes:
    unpacking = lzma.LZMADecompressor(lzma.FORMAT_XZ)
    plain = unpacking.decompress(content, MOST_UNPACKED_BYTES)
    if not unpacking.eof:
        most = f"{MOST_UNPACKED_BYTES:,}"
        raise UnreadableArchive(f"has no end, or unpacked more than {most} bytes")
    return plain


def _members(archive: tarfile.TarFile) -> Iterator[tuple[str, bytes]]:
    names = set()
    for member in archive:
        content = archive.extractfile(member) if _is_plain(member) else None
        if content is None or member.name in names:
            raise UnreadableArchive(f"holds {member.name} twice, or it is no ordinary file")
        names.add(member.name)
        yield member.name, content.read()


def _is_plain(member: tarfile.TarInfo) -> bool:
    return member.type == tarfile.REGTYPE and not member.issparse()


PART = ".part"


def replace_file(file: Path, content: bytes) -> None:
    """A file is there whole or as it was: who reads or ends the command meets no half of it."""
    file.parent.mkdir(parents=True, exist_ok=True)
    part = file.with_name(f".{file.name}-{os.getpid()}{PART}")
    try:
        part.write_bytes(content)
        part.replace(file)
    finally:
        part.unlink(missing_ok=True)
