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
class Kind:
    """One kind of file."""

    name: str
    """With its article."""
    way: Way

    @property
    def is_packed(self) -> bool:
        """It holds other files, or was to."""
        return self.way != "other"


EMPTY = Kind("an empty file", "nothing")
EMPTY_ARCHIVE = Kind("a zip file with nothing in it", "nothing")
CUT_OFF = Kind("a zip file that is cut off", "nothing")
ZIP_FILE = Kind("a zip file", "opens")
TAR_FILE = Kind("a tar file", "opens")
OFFICE = Kind("a document of a text program, such as Word", "other")
WEB_PAGE = Kind("a web page", "other")
TEXT = Kind("a text file", "other")
UNKNOWN = Kind("a file of an unknown kind", "other")
OFFICE_PARTS = (b"[Content_Types].xml", b"_rels/", b"docProps/", b"word/", b"mimetype")
MAGIC = {
    b"\x1f\x8b": Kind("a gz file", "opens"),
    b"\xfd7zXZ\x00": Kind("an xz file", "opens"),
    b"BZh": Kind("a bz2 file", "opens"),
    b"Rar!\x1a\x07": Kind("a RAR file", "unpack"),
    b"7z\xbc\xaf\x27\x1c": Kind("a 7z file", "unpack"),
    b"\x28\xb5\x2f\xfd": Kind("a zst file", "unpack"),
    b"MSCF": Kind("a cab file", "unpack"),
    b"!<arch>\n": Kind("a Debian package", "unpack"),
    b"PK\x07\x08": Kind("a part of a zip file", "unpack"),
    b"%PDF": Kind("a PDF document", "other"),
    b"\xd0\xcf\x11\xe0": OFFICE,
    b"{\\rtf": OFFICE,
    b"\x89PNG": Kind("a picture", "other"),
    b"\xff\xd8\xff": Kind("a picture", "other"),
    b"GIF8": Kind("a picture", "other"),
    b"\x7fELF": Kind("a program", "other"),
    b"MZ": Kind("a program for Windows", "other"),
    b"SQLite format 3\x00": Kind("a database", "other"),
}
"""First bytes of a file to its kind."""


def kind_of(path: Path) -> Kind:
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


def _kind_of_zip(path: Path, head: bytes) -> Kind:
    if head.startswith(EMPTY_ZIP) and zipfile.is_zipfile(path):
        return EMPTY_ARCHIVE
    if head[ZIP_NAME_AT:].startswith(OFFICE_PARTS):
        return OFFICE
    if zipfile.is_zipfile(path):
        return ZIP_FILE
    return next((kind for magic, kind in MAGIC.items() if head.startswith(magic)), CUT_OFF)


def _plain(head: bytes) -> Kind:
    start = head.lstrip().lower()
    if start.startswith((b"<!doctype html", b"<html")):
        return WEB_PAGE
    is_text = b"\x00" not in head and head.decode("utf-8", "replace").count("\ufffd") <= 1
    return TEXT if is_text else UNKNOWN
