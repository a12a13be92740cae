"""Unpack a stranger's zip or tar file: plain files and folders below one folder, or not at all.

An archive may lie about everything: names that lead elsewhere, links, sizes, a small file that
becomes a large one. So each entry is judged by its name and kind before anything is written, and
what is really written is counted.
"""

from __future__ import annotations

import bz2
import errno
import gzip
import lzma
import mmap
import os
import stat
import struct
import tarfile
import time
import unicodedata
import zipfile
import zlib
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path, PurePosixPath
from typing import IO, cast

from roslings.hand_in.errors import PACK_AGAIN, HandInRefused, HostileArchive
from roslings.workspace.errors import writing
from roslings.workspace.file_kinds import UNKNOWN, FileKind, kind_of
from roslings.workspace.sources import PackageLimits, size

SUFFIXES = (".zip", ".tar", ".tar.gz", ".tgz", ".tar.xz", ".txz", ".tar.bz2", ".tbz2")
CHUNK_BYTES = 64 * 1024
LARGEST_READ_BYTES = 8 * 1024 * 1024
"""A header of a tar file that wants more than this at once is made to fill the memory."""
LONGEST_PART_BYTES, LONGEST_NAME_BYTES = 255, 1000
ENTRY_MARK = b"PK\x01\x02"
"""Stands before each entry in a zip file's list."""
ENCRYPTED, NAME_IS_UTF8 = 0x1, 0x800
CLUTTER = frozenset({"__macosx", "thumbs.db", "desktop.ini"})
"""What Windows and macOS add by themselves, in small letters; so are files that begin with `._`."""
OF_CONTENT = (None, errno.EINVAL)
"""Numbers of errors that an archive itself makes, not the disk. What bz2 cannot read has none.
Where an entry is said to begin before the file, there is no such place."""
BROKEN = (
    zipfile.BadZipFile,
    tarfile.TarError,
    zlib.error,
    lzma.LZMAError,
    EOFError,
    struct.error,
    NotImplementedError,
    RuntimeError,
    ValueError,
    gzip.BadGzipFile,
)


def is_archive(path: Path) -> bool:
    """Whether the file's name says that it is an archive."""
    return path.name.lower().endswith(SUFFIXES)


def is_clutter(name: str) -> bool:
    """Whether a computer made this file or folder by itself, and nobody handed it in."""
    return name.casefold() in CLUTTER or name.startswith("._") or name == ".DS_Store"


@dataclass
class UnpackBudget:
    """How much may come out of all archives of one submission together, and how much has."""

    limits: PackageLimits = field(default_factory=PackageLimits)
    entries: int = 0
    used_bytes: int = 0

    def take_entry(self, declared_bytes: int) -> None:
        """One more file or folder. Raises HostileArchive."""
        self.entries += 1
        if self.entries > self.limits.files:
            raise self.too_many()
        if self.used_bytes + declared_bytes > self.limits.bytes:
            raise self.too_large()

    def take_bytes(self, count: int) -> None:
        """So much more was really unpacked. Raises HostileArchive."""
        self.used_bytes += count
        if self.used_bytes > self.limits.bytes:
            raise self.too_large()

    def too_many(self) -> HostileArchive:
        """It would make too many files."""
        return HostileArchive(f"It holds more than {self.limits.files:,} files.")

    def too_large(self) -> HostileArchive:
        """It would fill the disk."""
        return HostileArchive(f"Unpacked, it is larger than {size(self.limits.bytes)}.")


def unpack(archive: Path, into: Path, budget: UnpackBudget | None = None) -> None:
    """Unpack `archive` into the new folder `into`, as far as `budget` reaches.

    Raises HostileArchive, HandInRefused for a file that is no archive, and what `writing` raises.
    """
    room = UnpackFolder(into, budget or UnpackBudget())
    if archive.stat().st_size > room.budget.limits.bytes:
        raise HostileArchive(f"The file is larger than {size(room.budget.limits.bytes)}.")
    with writing(into):
        into.mkdir(mode=0o700)
    _insist_on_archive(archive)
    try:
        _unpack_zip(archive, room) if zipfile.is_zipfile(archive) else _unpack_tar(archive, room)
    except BROKEN as error:
        raise _broken(error) from error
    except OSError as error:
        if error.errno not in OF_CONTENT:
            raise
        raise _broken(error) from error


def _broken(error: Exception) -> HandInRefused:
    words = str(error) or type(error).__name__
    return HandInRefused(f"It cannot be unpacked: {words}.", PACK_AGAIN)


def _insist_on_archive(file: Path) -> None:
    """Bytes of a kind that we know, and that is no archive of ours. Raises HandInRefused."""
    kind = kind_of(file)
    if kind.way != "opens" and kind is not UNKNOWN:
        raise not_opened(kind)


def not_opened(kind: FileKind) -> HandInRefused:
    """What is handed in instead of an archive, and the next step."""
    reasons = {
        "unpack": f"It is {kind.name}, and such a file is not opened here.",
        "nothing": f"It is {kind.name}.",
    }
    return HandInRefused(
        reasons.get(kind.way, f"It is {kind.name}, not a packed package."), PACK_AGAIN
    )


@dataclass
class UnpackFolder:
    """The folder that one archive is unpacked to."""

    folder: Path
    budget: UnpackBudget
    names: dict[str, bool] = field(default_factory=dict)
    """Name to whether it is a folder."""

    def enter(self, name: str, is_folder: bool, declared_bytes: int) -> Path:
        """The place of one more entry. Raises HostileArchive."""
        parts = _parts(name)
        if not parts and not is_folder:
            raise HostileArchive("A file in it has no name.")
        self.budget.take_entry(declared_bytes)
        self._note(parts, is_folder)
        return self.folder.joinpath(*parts)

    def make(self, folder: Path) -> None:
        """One folder, unless it is clutter."""
        if not self._is_clutter(folder):
            folder.mkdir(mode=0o700, parents=True, exist_ok=True)

    def _is_clutter(self, place: Path) -> bool:
        return any(is_clutter(part) for part in place.relative_to(self.folder).parts)

    def _note(self, parts: tuple[str, ...], is_folder: bool) -> None:
        for end in range(1, len(parts)):
            if not self.names.setdefault("/".join(parts[:end]), True):
                raise HostileArchive(f"{_shown(parts)} lies in a file as if that were a folder.")
        whole = "/".join(parts)
        if whole in self.names and not (is_folder and self.names[whole]):
            raise HostileArchive(f"{_shown(parts)} is in it twice.")
        self.names[whole] = is_folder

    def write(self, source: IO[bytes], to: Path, runs: bool, written_s: float | None) -> None:
        """Write one file with its date, counting what really comes. Raises HostileArchive."""
        if self._is_clutter(to):
            return
        to.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
        with writing(to), to.open("xb") as file:
            while chunk := source.read(CHUNK_BYTES):
                self.budget.take_bytes(len(chunk))
                file.write(chunk)
        to.chmod(0o700 if runs else 0o600)
        if written_s is not None:
            with suppress(OSError, OverflowError, ValueError):  # a date that no disk knows
                os.utime(to, (written_s, written_s))


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


def _unpack_zip(archive: Path, room: UnpackFolder) -> None:
    _count_entries(archive, room.budget)
    try:
        file = zipfile.ZipFile(archive)
    except UnicodeDecodeError as error:
        raise HostileArchive("A name in it is no UTF-8 text.") from error
    with file:
        places = [(info, _place_of(info, room)) for info in file.infolist()]
        for info, place in places:
            if _is_folder(info):
                room.make(place)
            else:
                with file.open(info) as source:
                    room.write(source, place, bool(_mode(info) & 0o100), _written_s(info))


def zip_names(archive: Path, limits: PackageLimits) -> dict[str, zipfile.ZipInfo]:
    """The files in a zip file, by name with slashes; empty for what is none.

    Nothing is unpacked, and clutter is left out. Raises HostileArchive where it holds too many.
    """
    if not zipfile.is_zipfile(archive):
        return {}
    _count_entries(archive, UnpackBudget(limits))
    with suppress(*BROKEN, OSError), zipfile.ZipFile(archive) as file:
        named = ((_zip_name(info).replace("\\", "/"), info) for info in file.infolist())
        return {
            name: info
            for name, info in named
            if not _is_folder(info) and not any(map(is_clutter, name.split("/")))
        }
    return {}


def _count_entries(archive: Path, budget: UnpackBudget) -> None:
    """Before Python makes an object of each entry: a list of millions would fill the memory."""
    with archive.open("rb") as file, _mapped(file) as content:
        at, found = content.find(ENTRY_MARK), 0
        while at >= 0:
            found += 1
            if found > 2 * budget.limits.files:
                raise budget.too_many()
            at = content.find(ENTRY_MARK, at + 1)


@contextmanager
def _mapped(file: IO[bytes]) -> Iterator[mmap.mmap]:
    with mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as content:
        yield content


def _place_of(info: zipfile.ZipInfo, room: UnpackFolder) -> Path:
    name = _zip_name(info)
    kind = stat.S_IFMT(_mode(info))
    if kind == stat.S_IFLNK:
        raise HostileArchive(f"{_shown((name,))} is a symbolic link.")
    if kind not in (0, stat.S_IFREG, stat.S_IFDIR):
        raise HostileArchive(f"{_shown((name,))} is neither a file nor a folder.")
    if info.flag_bits & ENCRYPTED:
        raise HandInRefused("It is locked with a password.", "Pack it again without one.")
    return room.enter(name, _is_folder(info), info.file_size)


def _is_folder(info: zipfile.ZipInfo) -> bool:
    """Some programs on Windows end a folder's name with a backslash."""
    return info.orig_filename.endswith(("/", "\\"))


def _written_s(info: zipfile.ZipInfo) -> float | None:
    """When the file was last written, in local time as zip files have it."""
    with suppress(OverflowError, ValueError):
        return time.mktime((*info.date_time, 0, 0, -1))
    return None


def _zip_name(info: zipfile.ZipInfo) -> str:
    """A name without the mark of UTF-8 was read as code page 437; most programs mean UTF-8.

    What is no UTF-8 is of an old program on Windows, and was meant as it was read.
    """
    if info.flag_bits & NAME_IS_UTF8:
        return info.orig_filename
    with suppress(UnicodeError):
        return info.orig_filename.encode("cp437").decode("utf-8")
    return info.orig_filename


def _mode(info: zipfile.ZipInfo) -> int:
    return info.external_attr >> 16


# --- tar ---------------------------------------------------------------------------------------


def _unpack_tar(archive: Path, room: UnpackFolder) -> None:
    with _decompressed(archive) as plain:
        stream = cast(IO[bytes], Bounded(plain, room))
        with tarfile.open(
            fileobj=stream, mode="r:", encoding="utf-8", errors="surrogateescape"
        ) as file:
            for member in file:
                _unpack_member(file, member, room)


def _unpack_member(file: tarfile.TarFile, member: tarfile.TarInfo, room: UnpackFolder) -> None:
    _insist_on_kind(member)
    place = room.enter(member.name, member.isdir(), member.size if member.isreg() else 0)
    if member.isdir():
        room.make(place)
    elif source := file.extractfile(member):
        room.write(source, place, bool(member.mode & 0o100), member.mtime)


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

    def __init__(self, stream: IO[bytes], room: UnpackFolder) -> None:
        self._stream, self._budget = stream, room.budget
        limits = room.budget.limits
        self._most = limits.bytes + limits.files * 2 * tarfile.BLOCKSIZE
        self.tell = stream.tell

    def read(self, count: int = -1) -> bytes:
        """At most `count` bytes. Raises HostileArchive."""
        if not 0 <= count <= LARGEST_READ_BYTES:
            raise HostileArchive("A header in it is made to fill the memory.")
        return self._stream.read(count)

    def seek(self, position: int) -> int:
        """Go on elsewhere. Raises HostileArchive."""
        if position > self._most:
            raise self._budget.too_large()
        return self._stream.seek(position)
