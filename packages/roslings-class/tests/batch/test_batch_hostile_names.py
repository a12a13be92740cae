"""A file's name takes nobody's grade: what students call files, profiles and accounts."""

from __future__ import annotations

import csv
import unicodedata
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import pytest
from packed import make_zip

from roslings.course import lab
from roslings_class.downloads import submissions_at
from roslings_class.errors import BatchError
from roslings_class.gradebook import gradebook
from roslings_class.handing_out import Settings, hand_out, keep
from roslings_class.platform_names import platform_name
from roslings_class.regrade import override
from roslings_class.result import GradingOrder, GradingResult
from roslings_class.roster import Student, match, read_roster

FILES = "_assignsubmission_file"
WORKSHEET = """\
Identifier,Full name,Email address,Grade,Maximum Grade,Last modified (grade)
Participant 111,Anna Berg,a.berg@example.org,,100,-
Participant 222,Mallory Doe,m.doe@example.org,,100,-
Participant 333,Ben Kaya,b.kaya@example.org,,100,-
"""
CANVAS = """\
Student,ID,SIS User ID,SIS Login ID,Section
"Berg, Anna",111,s1001,annaberg,A
"Doe, Mallory",222,s1002,mdoe,A
"Kaya, Ben",333,s1003,bkaya,A
"""
PLAIN = """\
name,id,email
Anna Berg,s1001,a.berg@example.org
Mallory Doe,s1002,m.doe@example.org
Ben Kaya,s1003,b.kaya@example.org
"""
GITHUB = """\
name,id,github_username
Anna Berg,s1001,annaberg
Mallory Doe,s1002,mdoe
Ben Kaya,s1003,bkaya
"""
WITHOUT_MALLORY = "".join(line for line in PLAIN.splitlines(True) if "Mallory" not in line)
LISTS = {
    "worksheet": WORKSHEET,
    "canvas": CANVAS,
    "plain": PLAIN,
    "without": WITHOUT_MALLORY,
    "github": GITHUB,
}

HOSTILE = (
    "Anna Berg_111_assignsubmission_file_chatter.zip",
    "Anna Berg_111_assignsubmission_file_.zip",
    "Anna Berg_111_assignsubmission_file.zip",
    "Anna Berg_111_assignsubmission_onlinetext_.zip",
    "x_111_assignsubmission_file_chatter.zip",
    "_111_assignsubmission_file_chatter.zip",
    "A_1_assignsubmission_file_Anna Berg_111_assignsubmission_file_x.zip",
    "Group A-Anna Berg_111_assignsubmission_file_x.zip",
    "\nAnna Berg_111_assignsubmission_file_x.zip",
    "Anna Berg_111_assignsubmission_file_\n.zip",
    "Anna Berg_\u0661\u0661\u0661_assignsubmission_file_x.zip",
    "Anna Berg\uff3f111\uff3fassignsubmission\uff3ffile\uff3fx.zip",
    "berganna_111_8811_topics.zip",
    "berganna_LATE_111_8811_topics-99.zip",
    "_berganna_111_8811_topics.zip",
    "x_1_2_berganna_111_8811_topics.zip",
    "Anna Berg.zip",
    "Berg, Anna (99).zip",
    unicodedata.normalize("NFD", "\u00c4nna Berg.zip"),
    "annaberg.zip",
    "s1001.zip",
    "topics_s1001_v99.zip",
    "a.berg@example.org.zip",
    "a.berg.zip",
    "111.zip",
    "Participant 111.zip",
    "lab-topics-annaberg.zip",
    "9999_s1001 annaberg (111).zip",
    "\x1b[2K\rs1001.zip",
    "s1001_assignsubmission_file_s1001.zip",
    "s1001.tar.gz",
    "zzz s1001.py",
)
"""What Mallory calls a file."""


@dataclass(frozen=True)
class Source:
    """Where a download comes from: how it calls the hand-ins of three people."""

    anna: str
    ben: str
    mallory: str
    lists: tuple[str, ...]

    def names(self, hostile: str) -> list[str]:
        """The files of the whole class."""
        topics = "topics.zip"
        return [self.anna.format(topics), self.ben.format(topics), self.mallory.format(hostile)]


SOURCES = {
    "moodle": Source(
        f"Anna Berg_111{FILES}_{{}}",
        f"Ben Kaya_333{FILES}_{{}}",
        f"Mallory Doe_222{FILES}_{{}}",
        ("worksheet", "plain", "without"),
    ),
    "moodle-folders": Source(
        f"Anna Berg_111{FILES}/{{}}",
        f"Ben Kaya_333{FILES}/{{}}",
        f"Mallory Doe_222{FILES}/{{}}",
        ("worksheet", "plain", "without"),
    ),
    "canvas": Source(
        "berganna_111_8811_{}",
        "kayaben_333_8812_{}",
        "doemallory_LATE_222_8813_{}",
        ("canvas", "plain", "without"),
    ),
    "clones": Source(
        "lab-topics-annaberg/{}",
        "lab-topics-bkaya/{}",
        "lab-topics-mdoe/{}",
        ("github",),
    ),
}


def unpacked(folder: Path, names: Sequence[str]) -> Path:
    """The download as a file manager unpacks it."""
    for name in names:
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_bytes(b"x")
    return folder


def as_zip(place: Path, names: Sequence[str]) -> Path:
    """The download as it comes."""
    return make_zip(place.with_suffix(".zip"), [(name, b"x") for name in names])


def students_of(folder: Path, text: str) -> list[Student]:
    """The class list, from a file."""
    (folder / "class.csv").write_text(text, "utf-8")
    return read_roster(folder / "class.csv")


def found_in(path: Path, students: Sequence[Student]) -> list[str]:
    """What `grade` finds there."""
    with submissions_at(path, students) as found:
        return [each.name for each in found]


@pytest.mark.parametrize("packed", [unpacked, as_zip])
@pytest.mark.parametrize("source", SOURCES)
@pytest.mark.parametrize("hostile", HOSTILE)
def test_what_a_file_is_called_books_nothing(
    tmp_path: Path, hostile: str, source: str, packed: Callable[[Path, Sequence[str]], Path]
) -> None:
    """Everybody has exactly their own, whatever class list is given; nobody is missing."""
    names = SOURCES[source].names(hostile)
    path = packed(tmp_path / "class", names)
    for each in SOURCES[source].lists:
        students = students_of(tmp_path, LISTS[each])
        try:
            found = match(students, found_in(path, students))
        except BatchError:  # what no unpacker may write is told before anything is run
            assert packed is as_zip and not hostile.isprintable()
            return
        starts = {"Anna": names[0], "Ben": names[1], "Mallory": names[2]}
        for student, own in found.of_student.items():
            word = next(word for word in starts if word in student.name)
            (only,) = own
            assert only[:15] == starts[word][:15]
        assert found.unclear == {}
        assert len(found.unknown) == 3 - len(students)


@pytest.mark.parametrize(
    ("list_", "names", "annas", "unclear"),
    [
        # a profile that is called like another student
        ("worksheet", [f"Anna Berg_111{FILES}", f"Anna Berg_222{FILES}"], [0], [1]),
        ("plain", [f"Anna Berg_111{FILES}", f"Anna Berg_222{FILES}"], [], [0, 1]),
        ("worksheet", [f"Anna Berg_111{FILES}_a", f"Anna Berg_222{FILES}_b"], [0], [1]),
        ("worksheet", [f"Anna Berg_111{FILES}", f"X-Anna Berg_222{FILES}"], [0], [1]),
        ("plain", [f"Anna Berg_111{FILES}", f"X-Anna Berg_222{FILES}"], [], [0, 1]),
        ("worksheet", [f"Anna Berg_111{FILES}", f"\u00c4nna Berg_222{FILES}"], [0], [1]),
        ("worksheet", [f"Anna Berg_111{FILES}", f"Anna Berg_999{FILES}"], [0], [1]),
        ("worksheet", [f"Ben Kaya_333{FILES}", f"Anna Berg_999{FILES}"], [], [1]),
        ("worksheet", [f"Anna Berg_222{FILES}"], [], [0]),
        ("canvas", ["berganna_111_1_a", "berganna_222_2_b"], [0], [1]),
        ("plain", ["berganna_111_1_a", "berganna_222_2_b"], [], [0, 1]),
        # an account of GitHub that is nearly another student's, or is called by her id
        ("github", ["lab-topics-annaberg", "lab-topics-anna-berg"], [0], [1]),
        ("github", ["lab-topics-annaberg", "lab-topics-s1001"], [0], [1]),
        ("github", ["lab-topics-bkaya", "lab-topics-s1001"], [], [1]),
        ("github", ["lab-topics-annaberg", "lab-topics-bkaya", "lab-topics-x-annaberg"], [0], []),
        ("plain", ["lab-topics-annaberg", "lab-topics-anna-berg"], [], [0, 1]),
        # a file that somebody put into the folder of a download
        ("worksheet", [f"Anna Berg_111{FILES}", "s1001 Anna Berg", "a.berg"], [0], [2]),
        ("plain", [f"Anna Berg_111{FILES}", "s1001"], [], [0, 1]),
        ("canvas", ["berganna_111_1_a", "kayaben_333_2_b", f"Anna Berg_111{FILES}_x"], [0], [2]),
        # one's own, handed in again
        (
            "worksheet",
            [f"Anna Berg_111{FILES}_topics-2", f"Anna Berg_111{FILES}_topics-10"],
            [0, 1],
            [],
        ),
        ("plain", [f"Anna Berg_111{FILES}", f"Anna Berg_111{FILES}_topics"], [0, 1], []),
        ("canvas", ["berganna_111_1_a", "berganna_LATE_111_2_a-1"], [0, 1], []),
        ("plain", ["s1001_topics-2", "s1001_topics-10"], [0, 1], []),
        # the class list of another assignment has other numbers: the names are all there is
        ("worksheet", [f"Anna Berg_711{FILES}", f"Ben Kaya_733{FILES}"], [0], []),
    ],
)
def test_whose_it_is_is_never_decided_by_a_name_that_two_may_have(
    tmp_path: Path, list_: str, names: list[str], annas: list[int], unclear: list[int]
) -> None:
    """What the platform numbers counts; else it is unclear, and a person decides."""
    students = students_of(tmp_path, LISTS[list_])
    found = match(students, names)
    assert found.of_student[students[0]] == [names[index] for index in annas]
    assert list(found.unclear) == [names[index] for index in unclear]
    assert all(students[0] in owners for owners in found.unclear.values())


@pytest.mark.parametrize(
    "name", ["Mallory Doe", "s1002", f"Mallory Doe_222{FILES}_x", "doemallory_222_8811_x"]
)
def test_one_students_zip_is_no_download(tmp_path: Path, name: str) -> None:
    """Alone in a folder of late hand-ins: its files are hers, whatever they are called."""
    inside = [f"Anna Berg_111{FILES}/topics.zip", f"Ben Kaya_333{FILES}/topics.zip"]
    students = students_of(tmp_path, PLAIN)
    (tmp_path / "late").mkdir()
    as_zip(tmp_path / "late" / name, inside)
    assert found_in(tmp_path / "late", students) == [name]
    assert found_in(tmp_path / "late" / f"{name}.zip", students) == [name]


def test_a_clone_is_no_download(tmp_path: Path) -> None:
    """The only one in a folder is not looked into for other students' names."""
    unpacked(tmp_path / "late/lab-topics-mdoe", [f"Anna Berg_111{FILES}_x.zip", ".git/HEAD"])
    assert found_in(tmp_path / "late", ()) == ["lab-topics-mdoe"]


# --- what the instructor sees ------------------------------------------------------------------

STOLEN = [f"Anna Berg_111{FILES}", f"Anna Berg_222{FILES}"]


def handed_out(folder: Path, list_: str) -> tuple[str, dict[str, dict[str, str]], str]:
    """What is printed, the lines of grades.csv, and the class page, of two refused hand-ins."""
    (folder / "class.csv").write_text(list_, "utf-8")
    with gradebook(folder, "topics") as book:
        keep(book, Settings(roster=folder / "class.csv"))
        for name in STOLEN:
            words = {"submission": name, "digest": "d", "attempt": 1, "state": "refused"}
            book.write(GradingResult.model_validate(words))
        told = "\n".join(hand_out(book, lab("topics"), folder))
    with (folder / "grades.csv").open(encoding="utf-8", newline="") as file:
        rows = {row["name"]: row for row in csv.DictReader(file)}
    return told, rows, (folder / "class.html").read_text("utf-8")


def test_unclear_is_shown_where_an_instructor_looks(tmp_path: Path) -> None:
    """Page, CSV and terminal name it with the next step; she is not called missing."""
    told, rows, page = handed_out(tmp_path, PLAIN)
    assert "Unclear whose (2): " in told
    assert "Handed in nothing (2): Mallory Doe, Ben Kaya" in told
    for who in ("Anna Berg", *STOLEN):
        assert (rows[who]["outcome"], rows[who]["final"]) == ("unclear", "")
        assert "column `submission`" in rows[who]["reason"]
    assert "column `submission`" in " ".join(told.split())
    assert all(name in rows["Anna Berg"]["reason"] for name in STOLEN)
    assert "Handed in nothing (2)" in page
    assert page.count("May be of Anna Berg, or of somebody called so.") >= 2
    assert "outcome unclear" in page and "column <code>submission</code>" in page
    with pytest.raises(BatchError, match=r"(?s)unclear which is of Anna Berg.*column `submission`"):
        override(tmp_path, "Anna Berg", 50, "x", "tutor")


def test_the_instructors_word_decides(tmp_path: Path) -> None:
    """A column `submission` in the class list, and the same command again."""
    listed = [
        f"{line},{name}"
        for line, name in zip(
            PLAIN.splitlines(), ["submission", STOLEN[0], STOLEN[1], ""], strict=True
        )
    ]
    told, rows, page = handed_out(tmp_path, "\n".join(listed))
    assert rows["Anna Berg"]["submission"] == STOLEN[0]
    assert rows["Mallory Doe"]["submission"] == STOLEN[1]
    assert "nclear" not in told + page.partition("</style>")[2]


def test_a_diagnosis_is_held_against_the_platforms_part(tmp_path: Path) -> None:
    """Not against what its author calls the file."""
    words = {
        "lab": "black-box",
        "digest": "d",
        "attempt": 1,
        "path": tmp_path,
        "room": tmp_path,
        "seed": 1,
    }
    asked = {
        f"Mallory Doe_222{FILES}_Ada Lovelace": "Mallory Doe",
        "doemallory_222_8813_Ada Lovelace": "doemallory",
        f"Participant_222{FILES}_Ada Lovelace": f"Participant_222{FILES}_Ada Lovelace",
        "Lovelace_Ada_17": "Lovelace_Ada_17",
    }
    for name, person in asked.items():
        order = GradingOrder.model_validate({**words, "submission": name})
        assert order.handed_in_as == person


def test_no_name_has_both_forms() -> None:
    """A platform's own part says which it is."""
    told = [
        platform_name(SOURCES[source].mallory.format(hostile))
        for source in ("moodle", "canvas")
        for hostile in HOSTILE
    ]
    assert all(told)
    assert [each.number for each in told if each] == ["222"] * len(told)
