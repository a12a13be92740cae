"""Hand-ins as Moodle, Canvas and GitHub Classroom give them to an instructor."""

from __future__ import annotations

import os
import unicodedata
import zipfile
from pathlib import Path

import pytest
from packed import PACKAGE, make_zip, windows_zip, zip_bytes, zip_with_link

from roslings.hand_in.archives import unpack
from roslings.hand_in.errors import HandInRefused, HostileArchive
from roslings.hand_in.newest import natural, newest_first
from roslings.hand_in.unpack import package_in
from roslings_class.downloads import is_download, submissions_at
from roslings_class.errors import BadTable, BatchError
from roslings_class.platform_names import platform_name
from roslings_class.roster import Student, insist_on_owners, match
from roslings_class.submissions import name_of
from roslings_launcher.cli import main

ANNA = Student("Anna Berg", "s1001", "a.berg@example.org", cells={"github_username": "annaberg"})
BEN = Student("Ben Kaya", "s1002", cells={"github_username": "b-kaya"})
FILES, TEXT = "_assignsubmission_file", "_assignsubmission_onlinetext"


def names_at(path: Path) -> list[str]:
    """What `grade` finds there."""
    with submissions_at(path) as found:
        return [each.name for each in found]


# --- a whole class in one zip ------------------------------------------------------------------


@pytest.mark.parametrize(
    ("entries", "names"),
    [
        (
            [f"Anna Berg_17{FILES}_/a.zip", f"Ben Kaya_18{FILES}_/b.zip"],
            [f"Anna Berg_17{FILES}_", f"Ben Kaya_18{FILES}_"],
        ),
        ([f"Anna Berg_17{FILES}/a.zip"], [f"Anna Berg_17{FILES}"]),
        (
            [f"Anna Berg_17{FILES}_a.zip", f"Ben Kaya_18{FILES}_b.zip"],
            [f"Anna Berg_17{FILES}_a", f"Ben Kaya_18{FILES}_b"],
        ),
        (
            [f"Anna Berg_17{FILES}/a.zip", f"Anna Berg_17{TEXT}/onlinetext.html"],
            [f"Anna Berg_17{FILES}"],
        ),
        ([f"Anna Berg_17{TEXT}/onlinetext.html"], [f"Anna Berg_17{TEXT}"]),
        (
            ["berganna_77_8812_topics.zip", "kayaben_LATE_78_8813_topics-1.zip"],
            ["berganna_77_8812_topics", "kayaben_LATE_78_8813_topics-1"],
        ),
        (
            ["class/anna.zip", "class/ben.zip", "class/Thumbs.db", "__MACOSX/class/._anna.zip"],
            ["anna", "ben"],
        ),
        (["anna/chatter/package.xml", "ben/chatter/package.xml"], ["anna", "ben"]),
        (["ws/src/chatter/package.xml", "ws/src/chatter/setup.py"], ["moodle"]),
        (["ws/src/chatter/package.xml", "ws/src/other/package.xml"], ["moodle"]),
        (["topics.zip"], ["moodle"]),
        (["talker.py"], ["moodle"]),
        (["run_1_2_fast.py", "package.xml"], ["moodle"]),
    ],
)
def test_the_zip_of_a_class_is_a_class(
    tmp_path: Path, entries: list[str], names: list[str]
) -> None:
    """Given itself, or alone in a folder; one student's zip stays one submission."""
    sheets = [
        (n, f"<name>{n.split('/')[-2]}</name>".encode()) if "/" in n else (n, b"x") for n in entries
    ]
    make_zip(tmp_path / "moodle.zip", sheets)
    assert names_at(tmp_path / "moodle.zip") == names
    assert names_at(tmp_path) == names


def test_what_was_unpacked_is_gone_afterwards(tmp_path: Path) -> None:
    """It is only for the time of the command."""
    make_zip(tmp_path / "moodle.zip", [(f"Anna_17{FILES}/a.zip", zip_bytes())])
    with submissions_at(tmp_path / "moodle.zip") as (only,):
        assert (only.path / "a.zip").is_file()
    assert not only.path.exists()


def test_a_folder_in_a_folder_is_looked_into(tmp_path: Path) -> None:
    """As a file manager unpacks a download."""
    for student in ("Anna Berg_17", "Ben Kaya_18"):
        (tmp_path / "handed-in/CS1-topics-99" / f"{student}{FILES}").mkdir(parents=True)
    assert names_at(tmp_path / "handed-in") == [f"Anna Berg_17{FILES}", f"Ben Kaya_18{FILES}"]


def test_a_hostile_download_is_the_instructors_to_unpack(tmp_path: Path) -> None:
    """One line says which entry, and what to do."""
    entries = [(f"Anna_17{FILES}/../../../x", b"1")]
    with pytest.raises(BatchError, match=r"leads out of the archive.*\n.*Unpack it yourself"):
        names_at(make_zip(tmp_path / "moodle.zip", entries))


def test_a_broken_zip_is_one_submission(tmp_path: Path) -> None:
    """It is refused with its reason when its turn comes."""
    (tmp_path / "x.zip").write_bytes(b"PK\x05\x06")
    assert not is_download(tmp_path / "x.zip")
    assert names_at(tmp_path / "x.zip") == ["x"]


# --- zip in zip, several zips ------------------------------------------------------------------


def in_zips(depth: int, content: bytes) -> bytes:
    """A zip in so many zips."""
    for _ in range(depth):
        content = zip_bytes([("topics.zip", content)])
    return content


@pytest.mark.parametrize(("depth", "opens"), [(1, True), (3, True), (4, False)])
def test_a_zip_in_a_zip_is_opened(tmp_path: Path, depth: int, opens: bool) -> None:
    """Three deep, and no deeper: a zip may hold itself."""
    file = tmp_path / "it.zip"
    file.write_bytes(in_zips(depth, zip_bytes()))
    if opens:
        assert package_in(file, "chatter", tmp_path).name == "chatter"
        return
    with pytest.raises(
        HandInRefused, match=r"topics\.zip lies in a zip in a zip in a zip"
    ) as refusal:
        package_in(file, "chatter", tmp_path)
    assert str(tmp_path) not in str(refusal.value)


@pytest.mark.parametrize(
    ("inner", "says"),
    [
        ([("../b", b"1")], r"\.\."),
        ([("/etc/b", b"1")], "absolute"),
        ([("a", bytes(201_000_000))], "larger than 200.0 MB"),
        ([(f"{number}", b"") for number in range(20_001)], "more than 20,000 files"),
    ],
)
def test_the_bounds_hold_inside_too(
    tmp_path: Path, inner: list[tuple[str, bytes]], says: str
) -> None:
    """Names, links and sizes of a zip in a zip are a stranger's as well."""
    file = make_zip(tmp_path / "it.zip", [("inner.zip", zip_bytes(inner))])
    with pytest.raises(HostileArchive, match=says):
        package_in(file, "chatter", tmp_path)


def test_a_link_inside_is_refused_too(tmp_path: Path) -> None:
    """As in a zip by itself."""
    inner = zip_with_link(tmp_path / "inner.zip").read_bytes()
    file = make_zip(tmp_path / "it.zip", [("inner.zip", inner)])
    with pytest.raises(HostileArchive, match="symbolic link"):
        package_in(file, "chatter", tmp_path)


def test_many_small_bombs_are_one(tmp_path: Path) -> None:
    """The bound is on all zips of a submission together."""
    bomb = zip_bytes([("a", bytes(70_000_000))])
    file = make_zip(tmp_path / "it.zip", [(f"{n}.zip", bomb) for n in range(10)])
    with pytest.raises(HandInRefused):
        package_in(file, "chatter", tmp_path)
    written = sum(each.stat().st_size for each in tmp_path.rglob("*") if each.is_file())
    assert written < 201_000_000


def test_a_link_to_anothers_zip_is_not_followed(tmp_path: Path) -> None:
    """A clone may hold one."""
    make_zip(tmp_path / "anna.zip")
    (tmp_path / "ben").mkdir()
    (tmp_path / "ben/topics.zip").symlink_to(tmp_path / "anna.zip")
    with pytest.raises(HandInRefused):
        package_in(tmp_path / "ben", "chatter", tmp_path)


OTHER = (("other/package.xml", b"<name>other</name>"), ("other/setup.py", b""))
SECOND = (*PACKAGE, ("chatter/second", b""))


@pytest.mark.parametrize(
    ("zips", "second"),
    [
        ({"topics-2.zip": PACKAGE, "topics-10.zip": SECOND}, True),
        ({"topics.zip": PACKAGE, "topics (1).zip": SECOND}, True),
        ({"topics.zip": PACKAGE, "day-7.zip": OTHER}, False),
        ({"topics-1.zip": PACKAGE, "topics-2.zip": None}, False),
    ],
)
def test_of_two_zips_the_newest_with_the_package_counts(
    tmp_path: Path, zips: dict[str, tuple[tuple[str, bytes], ...] | None], second: bool
) -> None:
    """Never one that is broken, or of another lab."""
    (tmp_path / "anna").mkdir()
    for name, entries in zips.items():
        (tmp_path / "anna" / name).write_bytes(zip_bytes(entries) if entries else b"PK")
    package = package_in(tmp_path / "anna", "chatter", tmp_path)
    assert (package.name, (package / "second").exists()) == ("chatter", second)


def test_the_newest_by_number_and_by_time(tmp_path: Path) -> None:
    """The alphabet says nothing of it."""
    dates = {"topics-2": 1, "topics-10": 2, "topics-9": 3, "final": 9, "zz": 5}
    for name, date in dates.items():
        (tmp_path / f"{name}.zip").touch()
        os.utime(tmp_path / f"{name}.zip", (date, date))
    found = [file.stem for file in newest_first(tmp_path.iterdir())]
    assert found == ["final", "zz", "topics-10", "topics-9", "topics-2"]
    assert sorted(["b-10", "b-2", "b"], key=natural) == ["b", "b-2", "b-10"]


def test_the_date_in_a_zip_is_kept(tmp_path: Path) -> None:
    """It tells which of two files is newer."""
    with zipfile.ZipFile(tmp_path / "it.zip", "w") as archive:
        archive.writestr(zipfile.ZipInfo("a", (2026, 11, 20, 23, 58, 0)), b"")
        archive.writestr(zipfile.ZipInfo("b", (1980, 0, 0, 0, 0, 0)), b"")
    unpack(tmp_path / "it.zip", tmp_path / "out")
    a, b = ((tmp_path / "out" / name).stat().st_mtime for name in "ab")
    assert a > b or b > 1_790_000_000  # a date that does not exist is none


# --- Windows and macOS -------------------------------------------------------------------------


def test_a_zip_of_windows_is_opened(tmp_path: Path) -> None:
    """Backslashes between folders, an old code page, and Explorer's own files."""
    more = [("chatter/größe.txt", b"1"), ("chatter/Thumbs.db", b"1"), ("chatter/desktop.ini", b"")]
    (tmp_path / "it.zip").write_bytes(windows_zip([*PACKAGE, *more]))
    package = package_in(tmp_path / "it.zip", "chatter", tmp_path)
    names = {file.name for file in package.rglob("*") if file.is_file()}
    assert names == {"package.xml", "setup.py", "talker.py", "größe.txt"}


def test_a_name_in_utf8_without_its_mark_is_read(tmp_path: Path) -> None:
    """As Python, macOS and Linux write it."""
    raw = "größe".encode()
    content = zip_bytes([("q" * len(raw), b"1")]).replace(b"q" * len(raw), raw)
    (tmp_path / "it.zip").write_bytes(content)
    unpack(tmp_path / "it.zip", tmp_path / "out")
    assert [file.name for file in (tmp_path / "out").iterdir()] == ["größe"]


def test_what_macos_adds_is_left_out(tmp_path: Path) -> None:
    """`__MACOSX` shadows each file, archives too."""
    entries = [("topics.zip", zip_bytes()), ("__MACOSX/._topics.zip", b"x"), ("._x", b"x")]
    package = package_in(make_zip(tmp_path / "it.zip", entries), "chatter", tmp_path)
    assert package.name == "chatter"
    assert {each.name for each in (tmp_path / "unpacked").iterdir()} == {"topics.zip"}


# --- whose is it? ------------------------------------------------------------------------------

TWO = [
    Student("Anna Berg", f"Participant {n}", cells={"identifier": f"Participant {n}"})
    for n in (7, 17)
]
CANVAS = [
    Student("Berg, Anna", "77", cells={"id": "77", "sis user id": "s1"}),
    Student("Kaya, Ben", "8812", cells={"id": "8812", "sis user id": "s2"}),
]


@pytest.mark.parametrize(
    ("students", "names", "owners"),
    [
        ([ANNA, BEN], ["lab-topics-annaberg", "lab-topics-b-kaya"], [0, 1]),
        ([ANNA, BEN], ["lab-topics-b-kaya"], [1]),
        (
            [ANNA, BEN],
            ["lab-topics-not-annaberg", "lab-topics-b-kaya", "lab-topics-x"],
            [None, 1, None],
        ),
        (TWO, [f"Anna Berg_17{FILES}_", f"Anna Berg_7{FILES}_"], [1, 0]),
        (CANVAS, ["berganna_77_8812_topics", "kayaben_LATE_8812_9_x"], [0, 1]),
        ([ANNA, BEN], [f"Group A-Anna Berg_3{FILES}", f"Group B-Ben Kaya_4{FILES}"], [0, 1]),
        ([Student("Zoë Müller")], [f"Zoe Mueller_3{FILES}"], [0]),
        ([Student("Zoë Müller"), Student("Zoe Muller")], [f"Zoe Muller_3{FILES}"], [1]),
        ([Student("Zoë Müller")], [unicodedata.normalize("NFD", "Zoë Müller_3") + FILES], [0]),
        ([Student("Jo", "1")], [f"Jo_1{FILES}"], [None]),
    ],
)
def test_a_platforms_name_finds_its_student(
    students: list[Student], names: list[str], owners: list[int | None]
) -> None:
    """Two of one name by the platform's number; a GitHub name only where it is whole."""
    found = match(students, names)
    whose = {name: index for index, each in enumerate(students) for name in found.of_student[each]}
    assert [whose.get(name) for name in names] == owners
    assert not found.unclear


def test_two_of_one_name_without_numbers_are_unclear() -> None:
    """A person decides."""
    twins = [Student("Anna Berg", "a1"), Student("Anna Berg", "a2")]
    assert match(twins, [f"Anna Berg_5{FILES}"]).unclear == {f"Anna Berg_5{FILES}": twins}


def test_other_names_are_no_platforms() -> None:
    """`lab_3_2_solution` is Canvas's form; what is not, is not read as one."""
    assert platform_name("annaberg") is None
    assert platform_name("s1001_topics") is None
    told = platform_name(name_of(Path("kaya_LATE_7_8_my_topics.zip")))
    assert told is not None
    assert (told.person, told.number, told.own) == ("kaya", "7", "my_topics")


def test_a_class_list_of_other_people_is_an_error(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Exit code 2, before anything is run, and how names are matched."""
    make_zip(tmp_path / "moodle.zip", [(f"Zoe Li_17{FILES}/a.zip", b"x")])
    (tmp_path / "class.csv").write_text("name,id\nAnna Berg,s1001\n")
    words = ["grade", "topics", str(tmp_path / "moodle.zip"), "--out", str(tmp_path / "out")]
    assert main([*words, "--roster", str(tmp_path / "class.csv")]) == 2
    told = capsys.readouterr().err
    for word in ("'Zoe Li_17_assignsubmission_file'", "'Anna Berg'", "github_username", "the id"):
        assert word in told
    assert not (tmp_path / "out").exists()


def test_github_classrooms_own_class_list_is_read(tmp_path: Path) -> None:
    """Four columns, of which `name` may be empty."""
    list_ = tmp_path / "classroom_roster.csv"
    list_.write_text(
        '"identifier","github_username","github_id","name"\n"s1001","annaberg","1",""\n'
    )
    insist_on_owners(list_, ["lab-topics-annaberg"])
    with pytest.raises(BatchError, match="no submission is of anybody"):
        insist_on_owners(list_, ["lab-topics-benkaya"])
    (tmp_path / "empty.csv").write_text("identifier\n")
    with pytest.raises(BadTable):
        insist_on_owners(tmp_path / "empty.csv", ["x"])
