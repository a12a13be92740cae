"""What was handed in: found, unpacked, or refused with a reason."""

from __future__ import annotations

import os
import struct
import tarfile
from collections.abc import Callable
from pathlib import Path

import pytest
from packed import (
    PACKAGE,
    huge_header,
    link,
    make_tar,
    make_zip,
    of_type,
    tar_of,
    zip_with_link,
    zip_with_raw_name,
)

from roslings.hand_in.archives import UnpackBudget, unpack
from roslings.hand_in.errors import HandInRefused, HostileArchive
from roslings.hand_in.unpack import package_in
from roslings.workspace.sources import PackageLimits
from roslings_class.errors import BadTable, NoSubmissions
from roslings_class.submissions import digest_of, find_submissions

SMALL = PackageLimits(bytes=100_000, files=50)
Make = Callable[[Path], Path]


# --- archives ----------------------------------------------------------------------------------


@pytest.mark.parametrize("form", ["w", "w:gz", "w:xz", "w:bz2", "zip"])
def test_a_package_comes_out_whole(tmp_path: Path, form: str) -> None:
    """Whatever it is packed with, and whatever the file is called."""
    file = tmp_path / "it.bin"
    make_zip(file) if form == "zip" else make_tar(file, form=form)
    unpack(file, tmp_path / "out")
    found = {name: (tmp_path / "out" / name).read_bytes() for name, _ in PACKAGE}
    assert found == dict(PACKAGE)


HOSTILE: dict[str, tuple[Make, str]] = {
    "zip-link": (zip_with_link, "symbolic link"),
    "zip-up": (lambda p: make_zip(p, [("a/../../b", b"1")]), r"\.\."),
    "zip-up-windows": (lambda p: make_zip(p, [("..\\..\\b", b"1")]), r"\.\."),
    "zip-absolute": (lambda p: make_zip(p, [("/etc/b", b"1")]), "absolute"),
    "zip-drive": (lambda p: make_zip(p, [("C:\\b", b"1")]), "absolute"),
    "zip-bomb": (lambda p: make_zip(p, [("a", b"0" * 200_000)]), "larger than 100.0 kB"),
    "zip-bomb-in-parts": (
        lambda p: make_zip(p, [(f"{n}", b"0" * 9_000) for n in range(20)]),
        "larger than",
    ),
    "zip-many": (lambda p: make_zip(p, [(f"{n}", b"") for n in range(60)]), "more than 50 files"),
    "zip-very-many": (
        lambda p: make_zip(p, [(f"{n}", b"") for n in range(200)]),
        "more than 50 files",
    ),
    "zip-no-utf8": (lambda p: zip_with_raw_name(p, b"\xff\xfe\xfd", utf8=True), "no UTF-8"),
    "zip-control": (lambda p: make_zip(p, [("a\x1b[2Jb", b"1")]), "control characters"),
    "zip-pipe": (lambda p: make_zip(p, [("a", b"")], mode=0o010644), "neither a file"),
    "zip-file-as-folder": (lambda p: make_zip(p, [("a", b"1"), ("a/b", b"1")]), "as if that"),
    "zip-long": (lambda p: make_zip(p, [("a" * 300, b"1")]), "too long"),
    "tar-link": (lambda p: tar_of(p, link(tarfile.SYMTYPE, "/etc")), "symbolic link"),
    "tar-hard-link": (lambda p: tar_of(p, link(tarfile.LNKTYPE, "/etc/passwd")), "hard link"),
    "tar-up": (lambda p: make_tar(p, [("../b", b"1")]), r"\.\."),
    "tar-absolute": (lambda p: make_tar(p, [("/b", b"1")]), "absolute"),
    "tar-device": (lambda p: tar_of(p, of_type(tarfile.CHRTYPE)), "neither a file"),
    "tar-pipe": (lambda p: tar_of(p, of_type(tarfile.FIFOTYPE)), "neither a file"),
    "tar-bomb": (lambda p: make_tar(p, [("a", b"0" * 200_000)]), "larger than"),
    "tar-many": (lambda p: make_tar(p, [(f"{n}", b"") for n in range(60)]), "more than 50 files"),
    "tar-no-utf8": (lambda p: make_tar(p, [("\udcff\udcfe", b"1")]), "no UTF-8"),
    "tar-twice": (lambda p: make_tar(p, [("a", b"1"), ("a", b"2")]), "twice"),
    "tar-header": (lambda p: huge_header(p, 900_000_000), "fill the memory"),
}


@pytest.mark.parametrize(("make", "says"), HOSTILE.values(), ids=HOSTILE.keys())
def test_a_hostile_archive_is_refused(tmp_path: Path, make: Make, says: str) -> None:
    """With its reason, and nothing written anywhere but in its own folder."""
    around = tmp_path / "around"
    around.mkdir()
    file = make(tmp_path / "it.zip")
    with pytest.raises(HostileArchive, match=says) as refusal:
        unpack(file, around / "out", UnpackBudget(SMALL))
    assert "roslings pack" in refusal.value.next_step
    assert [path.name for path in around.iterdir()] == ["out"]
    written = [path for path in (around / "out").rglob("*") if path.is_file()]
    assert not any(path.is_symlink() for path in (around / "out").rglob("*"))
    assert sum(path.stat().st_size for path in written) <= SMALL.bytes + 64 * 1024


@pytest.mark.parametrize("content", [b"", b"PK\x05\x06", b"no archive at all" * 100])
def test_a_broken_file_is_refused(tmp_path: Path, content: bytes) -> None:
    """As a file to pack again."""
    file = tmp_path / "it.zip"
    file.write_bytes(content)
    with pytest.raises(HandInRefused):
        package_in(file, "chatter", tmp_path)


@pytest.mark.parametrize("shift", [1, 1000, 2**31])
def test_an_entry_that_begins_before_the_file_is_refused(shift: int, tmp_path: Path) -> None:
    """The table of contents is said to lie further behind than it does."""
    archive = make_zip(tmp_path / "it.zip")
    content = bytearray(archive.read_bytes())
    at = content.rindex(b"PK\x05\x06") + 16
    (place,) = struct.unpack_from("<I", content, at)
    struct.pack_into("<I", content, at, place + shift)
    archive.write_bytes(content)
    with pytest.raises(HandInRefused):
        package_in(archive, "chatter", tmp_path)


def test_a_broken_checksum_is_refused(tmp_path: Path) -> None:
    """A download that broke off or was changed."""
    file = make_tar(tmp_path / "it.tar.gz", [("a", os.urandom(50_000))])
    content = bytearray(file.read_bytes())
    content[20_000:20_100] = bytes(100)
    file.write_bytes(content[:40_000])
    with pytest.raises(HandInRefused, match="cannot be unpacked"):
        unpack(file, tmp_path / "out")


# --- the package in it -------------------------------------------------------------------------


def folder_of(path: Path, entries: list[tuple[str, bytes]] | None = None) -> Path:
    """A folder with these files; a package where none are given."""
    for name, content in entries or PACKAGE:
        (path / name).parent.mkdir(parents=True, exist_ok=True)
        (path / name).write_bytes(content)
    return path


def test_a_folder_around_one_archive_is_that_archive(tmp_path: Path) -> None:
    """As Moodle makes them."""
    make_zip(folder_of(tmp_path / "Anna B_1_file_", [("note.txt", b"hi")]) / "day3.zip")
    package = package_in(tmp_path / "Anna B_1_file_", "chatter", tmp_path)
    assert package == tmp_path / "unpacked" / "chatter"


@pytest.mark.parametrize("name", ["inner.zip", "anna/inner.zip", "anna/inner.7z"])
def test_an_archive_in_an_archive_is_named(tmp_path: Path, name: str) -> None:
    """It is not "no package": the student sees which file to unpack."""
    outer = make_zip(tmp_path / "it.zip", [(name, b"PK"), ("readme.txt", b"")])
    with pytest.raises(HandInRefused, match=r"inner\.") as refusal:
        package_in(outer, "chatter", tmp_path)
    assert "./roslings pack LAB" in refusal.value.next_step
    assert str(tmp_path) not in str(refusal.value)


def test_an_empty_archive_is_named(tmp_path: Path) -> None:
    """So is one that holds nothing but folders."""
    outer = make_zip(tmp_path / "it.zip", [("anna/src/", b"")])
    with pytest.raises(HandInRefused, match="submission is empty"):
        package_in(outer, "chatter", tmp_path)


def test_a_package_in_a_workspace_is_found(tmp_path: Path) -> None:
    """Also beside another package."""
    folder_of(tmp_path / "ws/src")
    folder_of(tmp_path / "ws/src/other", [("package.xml", b"<name>other</name>")])
    assert package_in(tmp_path / "ws", "chatter", tmp_path).name == "chatter"


@pytest.mark.parametrize(
    ("entries", "says"),
    [
        ([("readme.txt", b"")], "no ROS package"),
        (
            [("a.zip", b""), ("b.zip", b"")],
            "no ROS package in submission:\n  b.zip is an empty file",
        ),
        ([*PACKAGE, ("chatter/COLCON_IGNORE", b"")], "has the file COLCON_IGNORE"),
        ([*PACKAGE, ("COLCON_IGNORE", b"")], "submission has the file COLCON_IGNORE"),
        (
            [*PACKAGE, ("chatter/colcon.pkg", b"{type: cmake, name: x}")],
            "type 'cmake' and name 'x'",
        ),
        ([*PACKAGE, ("chatter/colcon.pkg", b": [")], "colcon.pkg, and colcon cannot read it"),
        ([(f"{n}/{name}", text) for n in "ab" for name, text in PACKAGE], "several packages"),
        ([("x/package.xml", b"<name>other</name>")], "no package named 'chatter'"),
        ([("chatter/package.xml", b"<name>chatter</name>")], "no setup.py"),
    ],
)
def test_two_packages_or_none_are_refused(
    tmp_path: Path, entries: list[tuple[str, bytes]], says: str
) -> None:
    """The reason names no place of the machine that grades."""
    with pytest.raises(HandInRefused, match=says) as refusal:
        package_in(folder_of(tmp_path / "anna", entries), "chatter", tmp_path)
    assert str(tmp_path) not in str(refusal.value)


def test_a_link_to_another_submission_is_refused(tmp_path: Path) -> None:
    """Or everybody could hand in the best one."""
    folder_of(tmp_path / "anna")
    (tmp_path / "ben").mkdir()
    (tmp_path / "ben/chatter").symlink_to(tmp_path / "anna/chatter")
    with pytest.raises(HandInRefused, match="link"):
        package_in(tmp_path / "ben", "chatter", tmp_path)


def test_a_link_out_of_the_package_is_refused(tmp_path: Path) -> None:
    """Its target would be read as if it were handed in."""
    folder_of(tmp_path / "ben")
    (tmp_path / "ben/chatter/secret").symlink_to("/etc/passwd")
    with pytest.raises(HandInRefused, match="outside the package"):
        package_in(tmp_path / "ben", "chatter", tmp_path)


def test_a_link_tells_its_own_words_and_not_where_it_leads_here(tmp_path: Path) -> None:
    """Else a student learns how the machine that grades is laid out, link by link."""
    room = tmp_path / "room"
    room.mkdir()
    folder_of(tmp_path / "ben")
    (tmp_path / "ben/chatter/secret").symlink_to("../../anna")
    (tmp_path / "anna").mkdir()
    with pytest.raises(HandInRefused, match=r"a link to\n\.\./\.\./anna, which leads") as refusal:
        package_in(tmp_path / "ben", "chatter", room)
    assert str(tmp_path) not in str(refusal.value)


# --- which submissions there are ---------------------------------------------------------------


def test_everything_in_the_folder_is_a_submission(tmp_path: Path) -> None:
    """Folders, archives, and files that are neither; two of one name stay two."""
    folder_of(tmp_path / "anna")
    make_zip(tmp_path / "anna.zip")
    make_tar(tmp_path / "Ben.TAR.GZ")
    (tmp_path / "cleo.py").write_text("print()")
    (tmp_path / ".DS_Store").write_text("")
    (tmp_path / "__MACOSX").mkdir()
    names = [each.name for each in find_submissions(tmp_path)]
    assert names == ["Ben", "anna", "anna (2)", "cleo.py"]


def test_a_name_that_is_no_utf8_can_be_shown(tmp_path: Path) -> None:
    """And what steers a terminal cannot."""
    make_zip(Path(os.fsdecode(os.fsencode(tmp_path) + b"/\xff\xfe.zip")))
    make_zip(tmp_path / "a\x1b[2J.zip")
    names = [each.name for each in find_submissions(tmp_path)]
    assert names == ["\\xff\\xfe", "a\\x1b[2J"]


def test_one_package_or_archive_is_one_submission(tmp_path: Path) -> None:
    """Without a folder around it."""
    package = folder_of(tmp_path) / "chatter"
    assert [each.name for each in find_submissions(package)] == ["chatter"]
    assert [each.name for each in find_submissions(make_zip(tmp_path / "a.zip"))] == ["a"]


def test_a_list_names_submissions_and_times(tmp_path: Path) -> None:
    """Paths count from the list's own folder."""
    make_zip(tmp_path / "x.zip")
    table = tmp_path / "list.csv"
    table.write_text("student;path;submitted\nanna;x.zip;2026-11-20 23:59\n;y.zip;\n")
    anna, other = find_submissions(table)
    assert (anna.name, anna.path) == ("anna", tmp_path / "x.zip")
    assert anna.submitted is not None
    assert (anna.submitted.day, anna.submitted.minute) == (20, 59)
    assert (other.name, other.submitted) == ("y", None)


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ("", 1),
        ("student,path\nanna,", 2),
        ("student,path,submitted\n\nanna,x.zip,yesterday", 3),
    ],
)
def test_a_bad_list_is_named_by_its_line(tmp_path: Path, text: str, line: int) -> None:
    """With what to write instead."""
    table = tmp_path / "list.csv"
    table.write_text(text)
    with pytest.raises(BadTable, match=f"list.csv:{line}:"):
        find_submissions(table)


def test_nothing_there_is_said(tmp_path: Path) -> None:
    """An empty folder, and none."""
    for path in (tmp_path, tmp_path / "gone"):
        with pytest.raises(NoSubmissions):
            find_submissions(path)


def test_the_digest_follows_the_content(tmp_path: Path) -> None:
    """Not the dates; what tools make does not count."""
    one, other = folder_of(tmp_path / "one"), folder_of(tmp_path / "other")
    os.utime(other / "chatter/setup.py", (1, 1))
    folder_of(other, [("chatter/__pycache__/x.pyc", b"1")])
    assert digest_of(one) == digest_of(other)
    (other / "chatter/setup.py").write_text("print(1)\n")
    assert digest_of(one) != digest_of(other)
