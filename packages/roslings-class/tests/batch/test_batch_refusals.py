"""Who cannot be graded is told why, whole: what kind of file it is, and what to do, everywhere."""

from __future__ import annotations

import csv
import gzip
import io
import re
import zipfile
from html import unescape
from pathlib import Path

import pytest
from packed import make_tar, zip_bytes
from test_batch_export import TOPICS

from roslings.hand_in.errors import HandInRefused
from roslings.hand_in.unpack import package_in
from roslings.report.flow import one_line, paragraphs
from roslings.workspace import errors, file_kinds
from roslings.workspace.errors import MachineTrouble, WorkspaceError
from roslings.workspace.file_kinds import MAGIC, FileKind, kind_of
from roslings.workspace.packages import find_package
from roslings_class.gradebook import gradebook
from roslings_class.handing_out import Settings, hand_out, keep
from roslings_class.messages import COLUMNS, summary_lines
from roslings_class.result import GradingResult


def empty_zip() -> bytes:
    """As a program writes it that was given nothing to pack."""
    made = io.BytesIO()
    zipfile.ZipFile(made, "w").close()
    return made.getvalue()


def tar(folder: Path) -> bytes:
    """A tar file that is not compressed."""
    return gzip.decompress(make_tar(folder / "it", [("readme.txt", b"hi")]).read_bytes())


WHOLE = zip_bytes([("readme.txt", b"hi" * 500)])
KINDS: dict[str, tuple[bytes, FileKind]] = {
    "empty": (b"", file_kinds.EMPTY),
    "empty zip": (empty_zip(), file_kinds.EMPTY_ARCHIVE),
    "zip": (WHOLE, file_kinds.ZIP_FILE),
    "cut off": (WHOLE[:60], file_kinds.CUT_OFF),
    "two letters": (b"PK", file_kinds.CUT_OFF),
    "document": (zip_bytes([("[Content_Types].xml", b"x")]), file_kinds.OFFICE),
    "page": (b"\n<!DOCTYPE html><html>", file_kinds.WEB_PAGE),
    "text": ("größe = 1\n".encode(), file_kinds.TEXT),
    "bytes": (bytes(range(128, 256)) * 9, file_kinds.UNKNOWN),
    **{magic.hex(): (magic + b"\x00" * 600, kind) for magic, kind in MAGIC.items()},
}
"""Content of a file, and what kind it is."""
each_kind = pytest.mark.parametrize("word", KINDS)


@each_kind
def test_a_kind_is_told_by_the_bytes(word: str, tmp_path: Path) -> None:
    """Whatever the file is called."""
    content, kind = KINDS[word]
    (tmp_path / "topics.zip").write_bytes(content)
    assert kind_of(tmp_path / "topics.zip") == kind


def test_a_tar_file_is_told_by_its_mark(tmp_path: Path) -> None:
    """It stands behind the first name."""
    (tmp_path / "topics").write_bytes(tar(tmp_path))
    assert kind_of(tmp_path / "topics") == file_kinds.TAR_FILE


PLACES = ("topics.zip", "topics.rar", "anna/topics.zip", "anna/topics.7z")


@each_kind
@pytest.mark.parametrize("place", PLACES)
def test_each_kind_is_named_with_the_next_step(word: str, place: str, tmp_path: Path) -> None:
    """Handed in as the file itself, or in a folder; never as just a packed file."""
    content, kind = KINDS[word]
    (tmp_path / "in/anna").mkdir(parents=True)
    (tmp_path / "in" / place).write_bytes(content)
    top = tmp_path / "in" / place.partition("/")[0]
    with pytest.raises(HandInRefused) as refusal:
        package_in(top, "chatter", tmp_path)
    reason = refusal.value.reason
    assert "but a packed file" not in reason
    assert refusal.value.next_step
    assert kind.name in reason or kind.way == "opens" or kind is file_kinds.UNKNOWN
    if kind.way != "opens":
        assert "roslings pack LAB" in refusal.value.next_step


@each_kind
def test_a_student_who_gives_a_file_hears_what_it_is(word: str, tmp_path: Path) -> None:
    """`check` takes a folder."""
    content, kind = KINDS[word]
    (tmp_path / "work").write_bytes(content)
    with pytest.raises(WorkspaceError) as refusal:
        find_package(tmp_path / "work", "chatter")
    assert (kind.name if kind.is_packed else "is a file") in refusal.value.problem
    assert ("Unpack it" in refusal.value.next_step) == (kind.way in ("opens", "unpack"))


# --- every reason, wherever it is read ---------------------------------------------------------

HERE = Path("submission")
RAR, CUT_OFF = MAGIC[b"Rar!\x1a\x07"], file_kinds.CUT_OFF
TOLD: dict[type[WorkspaceError], tuple[WorkspaceError, ...]] = {
    errors.NoSuchPath: (errors.NoSuchPath(HERE),),
    errors.NoWorkspace: (errors.NoWorkspace(HERE, "topics"),),
    errors.NotBegun: (errors.NotBegun("topics", "chatter", HERE),),
    errors.OfOtherLab: (errors.OfOtherLab(HERE, "nodes", "topics"),),
    errors.OnlyOtherLabs: (errors.OnlyOtherLabs("chatter", [("rover_status", "nodes")]),),
    errors.NotThere: (errors.NotThere(HERE, "./roslings start topics"),),
    errors.NotAFile: (errors.NotAFile(HERE),),
    errors.ChangedMeanwhile: (errors.ChangedMeanwhile(HERE),),
    errors.NotAFolder: (errors.NotAFolder(HERE),),
    errors.Archive: (errors.Archive(HERE, RAR), errors.Archive(HERE, CUT_OFF)),
    errors.NoPackage: (errors.NoPackage(HERE, "chatter"),),
    errors.EmptyFolder: (errors.EmptyFolder(HERE, "chatter"),),
    errors.OnlyPacked: (
        errors.OnlyPacked(HERE, [("a.rar", RAR)]),
        errors.OnlyPacked(HERE, [("a.zip", CUT_OFF), ("b.rar", RAR), ("c.rar", RAR)]),
    ),
    errors.IgnoredByColcon: (errors.IgnoredByColcon(HERE, "COLCON_IGNORE"),),
    errors.OtherwiseForColcon: (errors.OtherwiseForColcon(HERE, "colcon cannot read it"),),
    errors.NoPackageXml: (errors.NoPackageXml(HERE),),
    errors.TwoPackages: (errors.TwoPackages("chatter", [HERE / "a", HERE / "b"]),),
    errors.NamedOtherwise: (errors.NamedOtherwise("chatter", [("chater", HERE / "chater")]),),
    errors.NoSetupPy: (errors.NoSetupPy(HERE, has_cmake=True),),
    errors.TooManyFolders: (errors.TooManyFolders(HERE, 5_000),),
    errors.LinkLeadsOutside: (errors.LinkLeadsOutside(HERE / "a", "../b"),),
    errors.TooLarge: (errors.TooLarge(HERE, HERE / "big", "300.0 MB", "200.0 MB"),),
    errors.FileTooLarge: (
        errors.FileTooLarge(HERE / "package.xml", "400,000 bytes", "64,000 bytes"),
    ),
    errors.TooMuchToRead: (
        errors.TooMuchToRead(HERE / "a.py", "1.0 MB", "it takes more than 256 MB of memory"),
    ),
    errors.PictureTooLarge: (errors.PictureTooLarge(HERE / "a.png", 7000, 7000, 20_000_000),),
    errors.PictureTooSlow: (errors.PictureTooSlow(HERE / "a.png", 49_000_000, 5.0),),
    errors.TargetAlreadyThere: (errors.TargetAlreadyThere("It is there.", "Give another name."),),
}
REASONS = [(each.problem, each.next_step) for some in TOLD.values() for each in some]


def test_the_table_has_every_refusal() -> None:
    """A new one is put into it."""
    every = {
        each
        for each in vars(errors).values()
        if isinstance(each, type)
        and issubclass(each, WorkspaceError)
        and not issubclass(each, MachineTrouble)
    }
    assert set(TOLD) == every - {WorkspaceError}


def words(text: str) -> list[str]:
    """Without what stands between them."""
    return re.findall(r"[\w./'-]*\w", text)


def test_every_reason_is_whole_in_terminal_csv_and_page(tmp_path: Path) -> None:
    """No word is missing anywhere, and no line of the terminal is longer than it is wide."""
    names = [f"student-{number:02}" for number in range(len(REASONS))]
    (tmp_path / "class.csv").write_text("\n".join(["name", *names]))
    with gradebook(tmp_path, "topics") as book:
        keep(book, Settings(roster=tmp_path / "class.csv"))
        for name, (reason, step) in zip(names, REASONS, strict=True):
            book.write(
                GradingResult(
                    submission=name,
                    digest="d",
                    attempt=1,
                    state="refused",
                    reason=reason,
                    next_step=step,
                )
            )
        hand_out(book, TOPICS, tmp_path)
        shown = {name: "\n".join(summary_lines(book, [name])) for name in names}
    grades, moodle = (rows(tmp_path / name) for name in ("grades.csv", "moodle.csv"))
    class_page = plain(tmp_path / "class.html")
    for name, (reason, step) in zip(names, REASONS, strict=True):
        wanted = words(reason)
        assert max(map(len, shown[name].splitlines())) <= COLUMNS
        for place in (shown[name], grades[name]["reason"], class_page):
            assert " ".join(wanted) in " ".join(words(place)), reason
        page = plain(tmp_path / "students" / name / "report.html")
        for place in (moodle[name]["Feedback comments"], page):
            assert " ".join([*wanted, *words(step)]) in " ".join(words(place)), reason


def rows(path: Path) -> dict[str, dict[str, str]]:
    """A CSV file, by the student's name."""
    with path.open(encoding="utf-8", newline="") as file:
        lines = list(csv.DictReader(file))
    return {line.get("name") or line["Full name"]: line for line in lines}


def plain(page: Path) -> str:
    """The text of a page."""
    return unescape(re.sub(r"<[^>]*>", " ", page.read_text("utf-8")))


def test_a_sentence_over_two_lines_is_one() -> None:
    """Lines of a list stay apart in a page, and are parted by commas in a line."""
    text = "There are several\npackages:\n  one/a\n  other/a\nMend\nthem."
    assert one_line(text) == "There are several packages: one/a, other/a Mend them."
    assert paragraphs(text) == ["There are several packages:", "one/a", "other/a", "Mend them."]
