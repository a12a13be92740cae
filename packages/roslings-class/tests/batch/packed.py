"""Archives as students, learning platforms and attackers make them."""

from __future__ import annotations

import gzip
import io
import stat
import tarfile
import zipfile
from collections.abc import Callable, Iterable
from pathlib import Path

Entries = Iterable[tuple[str, bytes]]
PACKAGE = (
    ("chatter/package.xml", b"<package><name>chatter</name></package>"),
    ("chatter/setup.py", b"print()\n"),
    ("chatter/chatter/talker.py", b"import rclpy\n"),
)
"""As little as a package can be; it is opened here, never built."""


def make_zip(path: Path, entries: Entries = PACKAGE, mode: int = 0) -> Path:
    """A zip file; `mode` is written beside each entry, as Unix programs do."""
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in entries:
            info = zipfile.ZipInfo(name)
            info.compress_type = zipfile.ZIP_DEFLATED
            info.external_attr = mode << 16
            archive.writestr(info, content)
    return path


def make_tar(path: Path, entries: Entries = PACKAGE, form: str = "w:gz") -> Path:
    """A tar file."""
    with tarfile.open(path, form) as archive:  # type: ignore[call-overload]
        for name, content in entries:
            info = tarfile.TarInfo(name)
            info.size = len(content)
            archive.addfile(info, io.BytesIO(content))
    return path


def tar_of(path: Path, change: Callable[[tarfile.TarInfo], None], name: str = "it") -> Path:
    """A tar file with one entry that `change` made odd."""
    with tarfile.open(path, "w:gz") as archive:
        info = tarfile.TarInfo(name)
        change(info)
        archive.addfile(info)
    return path


def link(kind: bytes, target: str) -> Callable[[tarfile.TarInfo], None]:
    """Make an entry a link."""

    def change(info: tarfile.TarInfo) -> None:
        info.type, info.linkname = kind, target

    return change


def of_type(kind: bytes) -> Callable[[tarfile.TarInfo], None]:
    """Make an entry a device or a pipe."""

    def change(info: tarfile.TarInfo) -> None:
        info.type = kind

    return change


def zip_with_link(path: Path) -> Path:
    """A zip file whose entry is a symbolic link, as `zip -y` writes it."""
    return make_zip(path, [("chatter", b"/etc")], mode=stat.S_IFLNK | 0o777)


def zip_with_raw_name(path: Path, name: bytes, utf8: bool = False) -> Path:
    """A zip file with a name that no Python would write, marked as UTF-8 or not."""
    stand_in = ("\u00ff" if utf8 else "x").encode() * (len(name) // (1 + utf8))
    stand_in = stand_in.ljust(len(name), b"x")
    make_zip(path, [(stand_in.decode(), b"1")])
    path.write_bytes(path.read_bytes().replace(stand_in, name))
    return path


def huge_header(path: Path, size: int) -> Path:
    """A small tar.gz whose first header says that it is `size` bytes long."""
    info = tarfile.TarInfo("././@PaxHeader")
    info.type, info.size = tarfile.XHDTYPE, size
    with gzip.open(path, "wb") as file:
        file.write(info.tobuf(tarfile.USTAR_FORMAT))
        file.write(b"0" * 1024)
    return path


def zip_bytes(entries: Entries = PACKAGE) -> bytes:
    """A zip file that is to be put into another one."""
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, text in entries:
            archive.writestr(name, text)
    return content.getvalue()


def windows_zip(entries: Entries = PACKAGE) -> bytes:
    """As old programs on Windows write it: backslashes, code page 437, folders of their own."""
    names = {name: name.replace("/", "\\").encode("cp437") for name, _ in entries}
    folders = {name.rpartition(b"\\")[0] + b"\\" for name in names.values() if b"\\" in name}
    flat = [(folder, b"") for folder in sorted(folders)]
    flat += [(names[name], text) for name, text in entries]
    stand_ins = [(f"{number:x}".rjust(len(name), "q"), t) for number, (name, t) in enumerate(flat)]
    content = zip_bytes(stand_ins)
    for (stand_in, _), (name, _) in zip(stand_ins, flat, strict=True):
        content = content.replace(stand_in.encode(), name)
    return content
