"""What kind of file somebody gave, told by its first bytes: a name's ending says little."""

from __future__ import annotations

import zipfile
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

Way = Literal["opens", "unpack", "nothing", "other"]
"""We open it; only its owner can; nothing comes out of it; it is nothing packed."""
HEAD_BYTES = 1024
TAR_AT, TAR = 257, b"ustar"
ZIP, EMPTY_ZIP = b"PK\x03\x04", b"PK\x05\x06"
ZIP_NAME_AT = 30
"""Where the name of the first file stands in a zip file."""


@dataclass(frozen=True)
class FileKind:
    """One kind of file."""

    name: str
    """With its article."""
    way: Way

    @property
    def is_packed(self) -> bool:
        """It holds other files, or was to."""
        return self.way != "other"


EMPTY = FileKind("an empty file", "nothing")
EMPTY_ARCHIVE = FileKind("a zip file with nothing in it", "nothing")
CUT_OFF = FileKind("a zip file that is cut off", "nothing")
ZIP_FILE = FileKind("a zip file", "opens")
TAR_FILE = FileKind("a tar file", "opens")
OFFICE = FileKind("a document of a text program, such as Word", "other")
WEB_PAGE = FileKind("a web page", "other")
TEXT = FileKind("a text file", "other")
UNKNOWN = FileKind("a file of an unknown kind", "other")
OFFICE_PARTS = (b"[Content_Types].xml", b"_rels/", b"docProps/", b"word/", b"mimetype")
MAGIC = {
    b"\x1f\x8b": FileKind("a gz file", "opens"),
    b"\xfd7zXZ\x00": FileKind("an xz file", "opens"),
    b"BZh": FileKind("a bz2 file", "opens"),
    b"Rar!\x1a\x07": FileKind("a RAR file", "unpack"),
    b"7z\xbc\xaf\x27\x1c": FileKind("a 7z file", "unpack"),
    b"\x28\xb5\x2f\xfd": FileKind("a zst file", "unpack"),
    b"MSCF": FileKind("a cab file", "unpack"),
    b"!<arch>\n": FileKind("a Debian package", "unpack"),
    b"PK\x07\x08": FileKind("a part of a zip file", "unpack"),
    b"%PDF": FileKind("a PDF document", "other"),
    b"\xd0\xcf\x11\xe0": OFFICE,
    b"{\\rtf": OFFICE,
    b"\x89PNG": FileKind("a picture", "other"),
    b"\xff\xd8\xff": FileKind("a picture", "other"),
    b"GIF8": FileKind("a picture", "other"),
    b"\x7fELF": FileKind("a program", "other"),
    b"MZ": FileKind("a program for Windows", "other"),
    b"SQLite format 3\x00": FileKind("a database", "other"),
}
"""First bytes of a file to its kind."""


def kind_of(path: Path) -> FileKind:
    """What kind of file `path` is. Raises OSError."""
    with path.open("rb") as file:
        head = file.read(HEAD_BYTES)
    if not head:
        return EMPTY
    if head.startswith(b"PK") or zipfile.is_zipfile(path):
        return _kind_of_zip(path, head)
    if head[TAR_AT:].startswith(TAR):
        return TAR_FILE
    return next((kind for magic, kind in MAGIC.items() if head.startswith(magic)), _plain(head))


def _kind_of_zip(path: Path, head: bytes) -> FileKind:
    if head.startswith(EMPTY_ZIP) and zipfile.is_zipfile(path):
        return EMPTY_ARCHIVE
    if head[ZIP_NAME_AT:].startswith(OFFICE_PARTS):
        return OFFICE
    if zipfile.is_zipfile(path):
        return ZIP_FILE
    return next((kind for magic, kind in MAGIC.items() if head.startswith(magic)), CUT_OFF)


def _plain(head: bytes) -> FileKind:
    start = head.lstrip().lower()
    if start.startswith((b"<!doctype html", b"<html")):
        return WEB_PAGE
    is_text = b"\x00" not in head and head.decode("utf-8", "replace").count("\ufffd") <= 1
    return TEXT if is_text else UNKNOWN
