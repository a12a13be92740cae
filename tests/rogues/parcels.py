"""Archives that attack who unpacks and reads them, each around a whole package; and two others."""

from __future__ import annotations

import io
import stat
import struct
import tarfile
import zipfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from rogue import LAB, Truth

from written_png import head_of, png_of

Make = Callable[[Path], None]
ALL = "chatter"


@dataclass(frozen=True)
class Parcel:
    """One hostile archive, and what is to be said of it."""

    name: str
    ending: str
    make: Make
    refused: str

    @property
    def truth(self) -> Truth:
        """Refused, with its reason."""
        return Truth(refused=self.refused)


def package_in_zip(path: Path, folder: str = ALL) -> zipfile.ZipFile:
    """A zip file with the solution in it, still open."""
    archive = zipfile.ZipFile(path, "a", zipfile.ZIP_DEFLATED)
    for file in sorted(LAB.solution.rglob("*")):
        if file.is_file():
            archive.write(file, f"{folder}/{file.relative_to(LAB.solution)}")
    return archive


def zip_with(name: str, content: bytes, mode: int = 0) -> Make:
    """The solution and one more entry."""

    def make(path: Path) -> None:
        with package_in_zip(path) as archive:
            info = zipfile.ZipInfo(name)
            info.external_attr = mode << 16
            archive.writestr(info, content)

    return make


def tar_with(info: tarfile.TarInfo, content: bytes = b"") -> Make:
    """The solution and one more entry."""

    def make(path: Path) -> None:
        with tarfile.open(path, "w:gz") as archive:
            archive.add(LAB.solution, ALL)
            info.size = len(content)
            archive.addfile(info, io.BytesIO(content))

    return make


def entry(name: str, kind: bytes = tarfile.REGTYPE, target: str = "") -> tarfile.TarInfo:
    """A header."""
    info = tarfile.TarInfo(name)
    info.type, info.linkname = kind, target
    return info


def bomb(path: Path) -> None:
    """300 MB of zeros, in 300 kB."""
    with package_in_zip(path) as archive:
        archive.writestr("chatter/zeros", bytes(300 << 20))


def lying_bomb(path: Path) -> None:
    """The same, and its list says that it has 1,000 bytes."""
    bomb(path)
    raw = bytearray(path.read_bytes())
    struct.pack_into("<I", raw, raw.rindex(b"PK\x01\x02") + 24, 1000)
    path.write_bytes(raw)


def many(path: Path) -> None:
    """100,000 empty files."""
    with package_in_zip(path) as archive:
        for number in range(100_000):
            archive.writestr(f"chatter/many/{number}", b"")


def raw_name(path: Path) -> None:
    """A name that has the mark of UTF-8, and is none."""
    stand_in, name = "chatter/\u00e9x", b"chatter/\xff\xfe\xfd"
    with package_in_zip(path) as archive:
        archive.writestr(stand_in, b"1")
    path.write_bytes(path.read_bytes().replace(stand_in.encode(), name))


def file_of(name: str, content: bytes) -> Make:
    """The solution with another file in the place of one of its own, or besides."""

    def make(path: Path) -> None:
        with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
            for file in sorted(LAB.solution.rglob("*")):
                own = file.relative_to(LAB.solution).as_posix()
                if file.is_file() and own != name:
                    archive.write(file, f"{ALL}/{own}")
            archive.writestr(f"{ALL}/{name}", content)

    return make


def picture_of(width: int, height: int) -> bytes:
    """A PNG that says so; its pixels are missing."""
    return png_of(head_of(width, height), (b"IDAT", b""), (b"IEND", b""))


def growing_yaml() -> bytes:
    """Each line means nine times what the line above it means: 600 bytes, and 5 GB in words."""
    lines = ["a0: &a0 [x]"]
    lines += [f"a{n}: &a{n} [{', '.join([f'*a{n - 1}'] * 9)}]" for n in range(1, 10)]
    return "\n".join([*lines, "type: *a9", "name: *a9"]).encode()


def two_packages(path: Path) -> None:
    """Which one is meant nobody knows."""
    package_in_zip(path, "a/chatter").close()
    package_in_zip(path, "b/chatter").close()


def no_package(path: Path) -> None:
    """Only a text."""
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("readme.txt", "It is on my other computer.")


def link_in_folder(path: Path) -> None:
    """A folder with a link to the machine's own files, and one to the neighbour's package."""
    path.mkdir()
    (path / "etc").symlink_to("/etc")
    with package_in_zip(path / "it.zip"):
        pass
    with zipfile.ZipFile(path / "it.zip") as archive:
        archive.extractall(path)
    (path / "it.zip").unlink()
    (path / "chatter/passwd").symlink_to("/etc/passwd")


NOT_PLAIN = "neither a file"
SYMLINK = tar_with(entry("chatter/it", tarfile.SYMTYPE, "/etc/passwd"))
HARD_LINK = tar_with(entry("chatter/it", tarfile.LNKTYPE, "/etc/passwd"))
PARCELS = (
    Parcel(
        "zip_link",
        ".zip",
        zip_with("chatter/it", b"/etc/passwd", stat.S_IFLNK | 0o777),
        "symbolic link",
    ),
    Parcel("zip_up", ".zip", zip_with("../../../../../../tmp/up", b"1"), "leads out"),
    Parcel("zip_absolute", ".zip", zip_with("/tmp/absolute", b"1"), "absolute"),
    Parcel("zip_bomb", ".zip", bomb, "larger than"),
    Parcel("zip_lying_bomb", ".zip", lying_bomb, "cannot be unpacked|larger than"),
    Parcel("zip_100000_files", ".zip", many, "more than 20,000 files"),
    Parcel("zip_no_utf8", ".zip", raw_name, "no UTF-8"),
    Parcel("zip_device", ".zip", zip_with("chatter/it", b"", stat.S_IFCHR | 0o666), NOT_PLAIN),
    Parcel("tar_link", ".tar.gz", SYMLINK, "symbolic link"),
    Parcel("tar_hard_link", ".tar.gz", HARD_LINK, "hard link"),
    Parcel("tar_up", ".tar.gz", tar_with(entry("chatter/../../up"), b"1"), "leads out"),
    Parcel("tar_device", ".tar.gz", tar_with(entry("chatter/it", tarfile.BLKTYPE)), NOT_PLAIN),
    Parcel("tar_no_utf8", ".tar.gz", tar_with(entry("chatter/\udcff"), b"1"), "no UTF-8"),
    Parcel("two_packages", ".zip", two_packages, "several packages"),
    Parcel("no_package", ".zip", no_package, "no ROS package"),
    Parcel(
        "file_of_comments",
        ".zip",
        file_of("package.xml", b"<!--" * 100_000),
        r"package\.xml is too large to be read:\s+it has 400,000 bytes\. The limit is 64,000",
    ),
    Parcel(
        "file_of_lines",
        ".zip",
        file_of("setup.cfg", b"[a]\n" + b"y\n" * 30_000),
        r"setup\.cfg is too large to be read:\s+it has 30,001 lines\. The limit is 2,000",
    ),
    Parcel(
        "file_that_grows",
        ".zip",
        file_of("colcon.pkg", growing_yaml()),
        r"colcon\.pkg, and it says type '\(list\)' and name '\(list\)'",
    ),
    Parcel(
        "file_of_numbers",
        ".zip",
        file_of("chatter/a.py", b"x = [" + b"1," * 490_000 + b"]"),
        r"a\.py \(980\.0 kB\) cannot be read:\s+it takes more than 256 MB of memory",
    ),
    Parcel(
        "file_of_pixels",
        ".zip",
        file_of("figures/day3_rqt_graph.png", picture_of(7000, 7000)),
        r"it has 7000 x 7000 pixels, 49\.0 million\. The limit is 20 million",
    ),
    Parcel("links_in_a_folder", "", link_in_folder, "outside the package|A link in it"),
)
