"""Unpack a stranger's zip or tar file: plain files and folders below one folder, or not at all.

An archive may lie about everything: names that lead elsewhere, links, sizes, a small file that
becomes a large one. So each entry is judged by its name and kind before anything is written, and
what is really written is counted.
"""

from __future__ import annotations

import bz2
import gzip
import lzma
import mmap
import stat
import struct
import tarfile
import unicodedata
import zipfile
import zlib
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath
from typing import IO, cast

from roslings.batch.trouble import HostileArchive, Refused
from roslings.workspace.sources import Limits, size
from roslings.workspace.trouble import writing

SUFFIXES = (".zip", ".tar", ".tar.gz", ".tgz", ".tar.xz", ".txz", ".tar.bz2", ".tbz2")
CHUNK_BYTES = 64 * 1024
LARGEST_READ_BYTES = 8 * 1024 * 1024
"""A header of a tar file that wants more than this at once is made to fill the memory."""
LONGEST_PART_BYTES, LONGEST_NAME_BYTES = 255, 1000
ENTRY_MARK = b"PK\x01\x02"
"""Stands before each entry in a zip file's list."""
ENCRYPTED, NAME_IS_UTF8 = 0x1, 0x800
BROKEN = (
    zipfile.BadZipFile, tarfile.TarError, zlib.error, lzma.LZMAError, EOFError, struct.error,
    NotImplementedError, RuntimeError, ValueError, gzip.BadGzipFile,
)  # fmt: skip


def is_archive(path: Path) -> bool:
    """Whether the file's name says that it is an archive."""
    return path.name.lower().endswith(SUFFIXES)


def unpack(archive: Path, into: Path, limits: Limits | None = None) -> None:
    """Unpack `archive` into the new folder `into`.

    Raises HostileArchive, Refused for a file that is no archive, and what `writing` raises.
    """
    room = Room(into, limits or Limits())
    if archive.stat().st_size > room.limits.bytes:
        raise HostileArchive(f"The file is larger than {size(room.limits.bytes)}.")
    with writing(into):
        into.mkdir(mode=0o700)
    try:
        _unpack_zip(archive, room) if zipfile.is_zipfile(archive) else _unpack_tar(archive, room)
    except BROKEN as error:
        words = str(error) or type(error).__name__
        raise Refused(f"It cannot be unpacked: {words}.", "Pack it again, as .zip.") from error


@dataclass
class Room:
    """The folder that an archive is unpacked to, and how much of its limits is used."""

    folder: Path
    limits: Limits
    entries: int = 0
    used_bytes: int = 0
    names: dict[str, bool] = field(default_factory=dict)
    """Name to whether it is a folder."""

    def enter(self, name: str, is_folder: bool, declared_bytes: int) -> Path:
        """The place of one more entry. Raises HostileArchive."""
        parts = _parts(name)
        if not parts and not is_folder:
            raise HostileArchive("A file in it has no name.")
        self.entries += 1
        if self.entries > self.limits.files:
            raise HostileArchive(f"It holds more than {self.limits.files:,} files.")
        if self.used_bytes + declared_bytes > self.limits.bytes:
            raise self.too_large()
        self._note(parts, is_folder)
        return self.folder.joinpath(*parts)

    def _note(self, parts: tuple[str, ...], is_folder: bool) -> None:
        for end in range(1, len(parts)):
            if not self.names.setdefault("/".join(parts[:end]), True):
                raise HostileArchive(f"{_shown(parts)} lies in a file as if that were a folder.")
        whole = "/".join(parts)
        if whole in self.names and not (is_folder and self.names[whole]):
            raise HostileArchive(f"{_shown(parts)} is in it twice.")
        self.names[whole] = is_folder

    def write(self, source: IO[bytes], to: Path, runs: bool) -> None:
        """Write one file, counting what really comes. Raises HostileArchive."""
        to.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        with writing(to), to.open("xb") as file:
            while chunk := source.read(CHUNK_BYTES):
                self.used_bytes += len(chunk)
                if self.used_bytes > self.limits.bytes:
                    raise self.too_large()
                file.write(chunk)
        to.chmod(0o700 if runs else 0o600)

    def too_large(self) -> HostileArchive:
        """It would fill the disk."""
        return HostileArchive(f"Unpacked, it is larger than {size(self.limits.bytes)}.")


def _parts(name: str) -> tuple[str, ...]:
    """The folders and the file of a name that stays below its folder. Raises HostileArchive."""
    _insist_on_plain_text(name)
    path = PurePosixPath(name.replace("\\", "/"))
    parts = tuple(part for part in path.parts if part != ".")
    if path.is_absolute() or (parts and parts[0].endswith(":")):
        raise HostileArchive(f"{_shown(parts)} is an absolute name.")
    if ".." in parts:
        raise HostileArchive(f"{_shown(parts)} leads out of the archive (..).")
    if len(name.encode()) > LONGEST_NAME_BYTES or any(
        len(part.encode()) > LONGEST_PART_BYTES for part in parts
    ):
        raise HostileArchive(f"A name in it is too long: {_shown(parts)}.")
    return parts


def _insist_on_plain_text(name: str) -> None:
    if any("\ud800" <= char <= "\udfff" for char in name):
        raise HostileArchive(f"A name in it is no UTF-8 text: {_shown((name,))}.")
    if any(unicodedata.category(char) == "Cc" for char in name):
        raise HostileArchive(f"A name in it has control characters: {_shown((name,))}.")


def _shown(parts: tuple[str, ...]) -> str:
    text = "/".join(parts).encode("utf-8", "backslashreplace").decode()
    plain = "".join(char if char.isprintable() else ascii(char)[1:-1] for char in text)
    return repr(plain if len(plain) <= 60 else f"{plain[:57]}...")


# --- zip ---------------------------------------------------------------------------------------


def _unpack_zip(archive: Path, room: Room) -> None:
    _count_entries(archive, room)
    try:
        file = zipfile.ZipFile(archive)
    except UnicodeDecodeError as error:
        raise HostileArchive("A name in it is no UTF-8 text.") from error
    with file:
        places = [(info, _place_of(info, room)) for info in file.infolist()]
        for info, place in places:
            if info.is_dir():
                place.mkdir(mode=0o700, parents=True, exist_ok=True)
            else:
                with file.open(info) as source:
                    room.write(source, place, runs=bool(_mode(info) & 0o100))


def _count_entries(archive: Path, room: Room) -> None:
    """Before Python makes an object of each entry: a list of millions would fill the memory."""
    with archive.open("rb") as file, _mapped(file) as content:
        at, found = content.find(ENTRY_MARK), 0
        while at >= 0:
            found += 1
            if found > 2 * room.limits.files:
                raise HostileArchive(f"It holds more than {room.limits.files:,} files.")
            at = content.find(ENTRY_MARK, at + 1)


@contextmanager
def _mapped(file: IO[bytes]) -> Iterator[mmap.mmap]:
    with mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as content:
        yield content


def _place_of(info: zipfile.ZipInfo, room: Room) -> Path:
    name = _zip_name(info)
    kind = stat.S_IFMT(_mode(info))
    if kind == stat.S_IFLNK:
        raise HostileArchive(f"{_shown((name,))} is a symbolic link.")
    if kind not in (0, stat.S_IFREG, stat.S_IFDIR):
        raise HostileArchive(f"{_shown((name,))} is neither a file nor a folder.")
    if info.flag_bits & ENCRYPTED:
        raise Refused("It is locked with a password.", "Pack it again without one.")
    return room.enter(name, info.is_dir(), info.file_size)


def _zip_name(info: zipfile.ZipInfo) -> str:
    """A name without the mark of UTF-8 was read as an old code page; most programs mean UTF-8."""
    if info.flag_bits & NAME_IS_UTF8:
        return info.orig_filename
    raw = info.orig_filename.encode("cp437", "surrogateescape")
    return raw.decode("utf-8", "surrogateescape")


def _mode(info: zipfile.ZipInfo) -> int:
    return info.external_attr >> 16


# --- tar ---------------------------------------------------------------------------------------


def _unpack_tar(archive: Path, room: Room) -> None:
    with _decompressed(archive) as plain:
        stream = cast(IO[bytes], Bounded(plain, room))
        with tarfile.open(
            fileobj=stream, mode="r:", encoding="utf-8", errors="surrogateescape"
        ) as file:
            for member in file:
                _unpack_member(file, member, room)


def _unpack_member(file: tarfile.TarFile, member: tarfile.TarInfo, room: Room) -> None:
    _insist_on_kind(member)
    place = room.enter(member.name, member.isdir(), member.size if member.isreg() else 0)
    if member.isdir():
        place.mkdir(mode=0o700, parents=True, exist_ok=True)
    elif source := file.extractfile(member):
        room.write(source, place, runs=bool(member.mode & 0o100))


def _insist_on_kind(member: tarfile.TarInfo) -> None:
    """Raises HostileArchive for what is neither a file nor a folder."""
    kinds = {tarfile.SYMTYPE: "a symbolic link", tarfile.LNKTYPE: "a hard link"}
    if member.isreg() or member.isdir():
        return
    kind = kinds.get(member.type, "neither a file nor a folder")
    raise HostileArchive(f"{_shown((member.name,))} is {kind}.")


@contextmanager
def _decompressed(archive: Path) -> Iterator[IO[bytes]]:
    """The bytes of a tar file, whatever it is packed with."""
    with archive.open("rb") as file:
        start = file.read(6)
    with _opened(archive, start) as opened:
        yield opened


def _opened(archive: Path, start: bytes) -> IO[bytes]:
    if start.startswith(b"\x1f\x8b"):
        return cast(IO[bytes], gzip.open(archive, "rb"))
    if start.startswith(b"\xfd7zXZ\x00"):
        return cast(IO[bytes], lzma.open(archive, "rb"))
    if start.startswith(b"BZh"):
        return cast(IO[bytes], bz2.open(archive, "rb"))
    return archive.open("rb")


class Bounded:
    """A stream that ends in a refusal where it holds more than any package."""

    def __init__(self, stream: IO[bytes], room: Room) -> None:
        self._stream, self._room = stream, room
        self._most = room.limits.bytes + room.limits.files * 2 * tarfile.BLOCKSIZE
        self.tell = stream.tell

    def read(self, count: int = -1) -> bytes:
        """At most `count` bytes. Raises HostileArchive."""
        if not 0 <= count <= LARGEST_READ_BYTES:
            raise HostileArchive("A header in it is made to fill the memory.")
        return self._stream.read(count)

    def seek(self, position: int) -> int:
        """Go on elsewhere. Raises HostileArchive."""
        if position > self._most:
            raise self._room.too_large()
        return self._stream.seek(position)
