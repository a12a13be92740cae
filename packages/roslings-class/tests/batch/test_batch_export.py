"""What an instructor takes away: grades by the class list, pages, scores given by hand."""

from __future__ import annotations

import csv
import re
import unicodedata
import zlib
from datetime import datetime, timedelta, timezone
from pathlib import Path
from urllib.parse import unquote

import pytest

from ros2_on_pip import rates
from roslings.course import lab
from roslings.verdict import CheckResult, Environment, Timings, Verdict, outcome_of, score_of
from roslings_class.errors import BadTable, BatchError
from roslings_class.fingerprints import fingerprint, winnowed
from roslings_class.folders import folder_name
from roslings_class.gradebook import gradebook
from roslings_class.grades import LateRule, class_of
from roslings_class.handing_out import Settings, hand_out, keep
from roslings_class.messages import summary_lines
from roslings_class.regrade import override
from roslings_class.result import GradingResult
from roslings_class.roster import Student, match, read_roster
from roslings_class.similar import alike, equal_groups
from roslings_launcher.cli import main

TOPICS = lab("topics")
DEADLINE = datetime(2026, 11, 20, 12, tzinfo=timezone.utc)


def verdict(*failed: str) -> Verdict:
    """A verdict of the lab in which these checks fail."""
    checks = tuple(
        CheckResult(
            id=name,
            title=f"About {name}.",
            max_points=points,
            outcome="fail" if name in failed else "pass",
            points=0 if name in failed else points,
        )
        for name, points in TOPICS.card.points.items()
    )
    return Verdict(
        lab="topics",
        package="chatter",
        checks=checks,
        outcome=outcome_of(checks),
        score=score_of(checks),
        seconds=Timings(total=3.0),
        environment=Environment(
            roslings="0",
            ros_distro="jazzy",
            rmw="r",
            python="3",
            platform="p",
            isolation="namespace",
            clock="sim",
            seed=1,
        ),
    )


def graded(name: str, *failed: str, hz: float = 2.0, **more: object) -> GradingResult:
    """A result with a verdict."""
    words = {
        "submission": name,
        "digest": "d",
        "attempt": 1,
        "state": "graded",
        "verdict": verdict(*failed),
        "rates": {"/chatter": hz},
        **more,
    }
    return GradingResult.model_validate(words)


def refused(name: str, reason: str) -> GradingResult:
    """A result without one."""
    return GradingResult(submission=name, digest="d", attempt=1, state="refused", reason=reason)


def cells(path: Path) -> list[dict[str, str]]:
    """A CSV file."""
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


# --- the class list ----------------------------------------------------------------------------

ANNA = Student("Anna Berg", "s1001", "a.berg@example.org")
LI = Student("Li, Wei", "s1002", "wli@example.org", cells={"identifier": "Participant 4711"})
ZOE = Student("Zoë Müller", "s1003")


@pytest.mark.parametrize(
    ("submission", "whose"),
    [
        ("s1001", ANNA),
        ("a.berg", ANNA),
        ("Anna Berg", ANNA),
        ("berg_anna", ANNA),
        ("Berg, Anna", ANNA),
        ("anna-berg", ANNA),
        ("bergannalate_7_8_day3", None),
        ("annaberg_77_8812_chatter", ANNA),
        ("Anna Berg_17_assignsubmission_file_", ANNA),
        ("topics_s1002_v2", LI),
        ("Wei Li", LI),
        ("x_4711_assignsubmission_file_", LI),
        ("zoë müller", ZOE),
        ("chatter", None),
        ("s100", None),
    ],
)
def test_a_submission_finds_its_student(submission: str, whose: Student | None) -> None:
    """By number, name, address or what a platform makes of them; never by a guess."""
    found = match([ANNA, LI, ZOE], [submission])
    owners = [student for student, names in found.of_student.items() if names]
    assert owners == ([whose] if whose else [])
    assert found.unknown == ([] if whose else [submission])


def test_one_that_may_be_of_two_is_nobodys() -> None:
    """A person decides."""
    found = match([ANNA, LI], ["s1001_and_s1002"])
    assert found.unclear == {"s1001_and_s1002": [ANNA, LI]}
    assert found.doubts(ANNA) == found.doubts(LI) == ["s1001_and_s1002"]


@pytest.mark.parametrize(
    "text",
    [
        "name,id,email\nAnna Berg,s1001,a.berg@example.org\n",
        "Student,ID,SIS User ID,SIS Login ID,Section\n    Points Possible,,,,\n"
        '"Berg, Anna",12,s1001,aberg,S1\n',
        "\ufeffIdentifier;Full name;Email address\nParticipant 3;Anna Berg;a.berg@example.org\n",
        "First name\tLast name\tID number\nAnna\tBerg\ts1001\n",
    ],
)
def test_class_lists_of_several_platforms_are_read(tmp_path: Path, text: str) -> None:
    """Plain, Canvas, Moodle, and with tabs."""
    (tmp_path / "class.csv").write_text(text, "utf-8")
    (student,) = read_roster(tmp_path / "class.csv")
    assert match([student], ["Anna Berg"]).of_student[student] == ["Anna Berg"]


def test_a_bad_class_list_is_told_by_its_line(tmp_path: Path) -> None:
    """Before anything is run."""
    (tmp_path / "class.csv").write_text("name,id\n")
    with pytest.raises(BadTable):
        read_roster(tmp_path / "class.csv")
    (tmp_path / "class.csv").write_bytes(b"name\nZo\xeb\n")
    with pytest.raises(BadTable, match="UTF-8"):
        read_roster(tmp_path / "class.csv")


# --- the grades --------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("late", "days", "final"),
    [(-1.0, 0, 98), (0.0, 0, 98), (0.01, 1, 98), (1.0, 1, 98), (1.5, 2, 88), (30.0, 30, 0)],
)
def test_late_days(tmp_path: Path, late: float, days: int, final: float) -> None:
    """A begun day counts; the free ones cost nothing; nobody falls below zero."""
    rule = LateRule(deadline=DEADLINE, points_a_day=10, free_days=1)
    with gradebook(tmp_path, "topics") as book:
        book.write(graded("anna", "figure"))
        (grade,) = class_of(book, {"anna": DEADLINE + timedelta(days=late)}, rule=rule).grades
    assert (grade.late_days, grade.final) == (days, final)


def test_without_a_time_nobody_is_late(tmp_path: Path) -> None:
    """A file's own date is that of the download."""
    with gradebook(tmp_path, "topics") as book:
        book.write(graded("anna"))
        (grade,) = class_of(book, {}, rule=LateRule(deadline=DEADLINE, points_a_day=10)).grades
    assert (grade.late_days, grade.final) == (None, 100)


def test_the_files_and_pages_tell_the_same(tmp_path: Path) -> None:
    """Missing, unknown, refused, by hand: in each file; a formula is no formula any more."""
    (tmp_path / "class.csv").write_text("name,id\nAnna Berg,s1001\nBen Kaya,s1002\nZoe,s1003\n")
    with gradebook(tmp_path, "topics") as book:
        keep(book, Settings(roster=tmp_path / "class.csv"))
        book.write(graded("s1001", "rate", "figure", hz=1.0))
        book.write(refused("s1002", "There is no ROS package in it."))
        book.write(graded("=cmd|'x'!A1"))
        remarks = "\n".join(hand_out(book, TOPICS, tmp_path))
        override(tmp_path, "s1002", 55, "showed it <b>in class</b>", "tutor")
    assert "Handed in nothing (1): Zoe" in remarks
    rows = {row["name"]: row for row in cells(tmp_path / "grades.csv")}
    assert (rows["Anna Berg"]["final"], rows["Anna Berg"]["rate"]) == ("84", "0")
    assert (rows["Ben Kaya"]["final"], rows["Ben Kaya"]["measured"]) == ("55", "")
    assert (rows["Zoe"]["outcome"], rows["Zoe"]["final"]) == ("missing", "")
    assert "'=cmd|'x'!A1" in rows
    canvas = cells(tmp_path / "canvas.csv")
    assert [row["A talker and a listener (topics)"] for row in canvas] == ["100", "84", "55"]
    moodle = cells(tmp_path / "moodle.csv")
    assert [row["Grade"] for row in moodle] == ["84", "55", ""]
    assert "About rate." in moodle[0]["Feedback comments"]
    page = (tmp_path / "class.html").read_text("utf-8")
    assert "showed it &lt;b&gt;in class" in page
    assert page.count("<script") == 1
    links = [unquote(link) for link in re.findall(r'href="(students[^"]+)"', page)]
    assert len(links) == 3
    assert all((tmp_path / link).is_file() for link in links)
    names = ["Zoe", "Ben Kaya", "Anna Berg", "=cmd"]
    table = page.partition(">Everybody<")[2]
    places = [table.index(f">{name}") for name in names]
    assert places == sorted(places), "the lowest score comes first"
    heads = ["What most have to mend", "Scores", "Everybody", "Handed in nothing"]
    assert [*map(page.index, (f"<h2>{head}" for head in heads))] == sorted(
        map(page.index, (f"<h2>{head}" for head in heads))
    )
    assert "Scores: mean" in page
    for link in links:
        own = (tmp_path / link).read_text("utf-8")
        assert "href=" not in own and "class.html" not in own, "it stands alone"
    anna = next(link for link in links if "1001" in link)
    assert re.search(r"<title>Anna Berg: ", (tmp_path / anna).read_text("utf-8"))


def test_of_an_even_class_the_median_lies_between(tmp_path: Path) -> None:
    """In the terminal as on the page."""
    with gradebook(tmp_path, "topics") as book:
        book.write(graded("anna"))
        book.write(graded("ben", "rate", "figure", hz=1.0))
        hand_out(book, TOPICS, tmp_path)
        shown = summary_lines(book, ["anna", "ben"])
    assert "Scores: lowest 84, median 92, highest 100." in shown
    assert "median 92," in (tmp_path / "class.html").read_text("utf-8")


def test_a_refused_hand_in_never_beats_a_graded_one(tmp_path: Path) -> None:
    """Whatever comes last, in time or by name; what a person decided stands before both."""
    late = {"s1001_z": DEADLINE, "s1001_a": DEADLINE - timedelta(days=1)}
    with gradebook(tmp_path, "topics") as book:
        book.write(graded("s1001_a", "figure"))
        book.write(refused("s1001_z", "There is no ROS package in it."))
        (grade,) = class_of(book, late, [ANNA]).grades
        assert (grade.submission, grade.final) == ("s1001_a", 98)
        book.override("s1001_z", 70, "it ran in class", "tutor")
        (grade,) = class_of(book, late, [ANNA]).grades
    assert (grade.submission, grade.final) == ("s1001_z", 70)


def test_the_newest_is_that_with_the_higher_number(tmp_path: Path) -> None:
    """`topics-10` comes after `topics-2`; a known time stands before a number."""
    names = ["s1001_topics-2", "s1001_topics-10", "s1001_topics"]
    with gradebook(tmp_path, "topics") as book:
        for name in names:
            book.write(graded(name))
        found = class_of(book, {}, [ANNA])
        timed = class_of(book, {"s1001_topics-2": DEADLINE}, [ANNA])
    assert [found.grades[0].submission, timed.grades[0].submission] == [names[1], names[0]]
    assert sorted(found.twice["Anna Berg"]) == sorted(names)


def test_a_score_by_hand_for_a_student_by_name(tmp_path: Path) -> None:
    """Or by number or address: it goes to the submission that counts."""
    (tmp_path / "class.csv").write_text(
        "name,id,email\nAnna Berg,s1001,a.berg@example.org\nZoe,s1003,\nKim Lee,k1,\nKim Lee,k2,\n"
    )
    with gradebook(tmp_path, "topics") as book:
        keep(book, Settings(roster=tmp_path / "class.csv"))
        book.write(graded("Anna Berg_17_assignsubmission_file_", "rate"))
        book.write(refused("Anna Berg_17_assignsubmission_onlinetext_", "It is a text."))
    for score, who in ((60, "Anna Berg"), (70, "berg, anna"), (80, "a.berg@example.org")):
        told = override(tmp_path, who, score, "showed it", "tutor")
        assert "Anna Berg_17_assignsubmission_file_" in told[0]
        rows = {row["name"]: row["final"] for row in cells(tmp_path / "grades.csv")}
        assert rows["Anna Berg"] == f"{score}"
    with pytest.raises(BatchError, match="Zoe handed in nothing"):
        override(tmp_path, "Zoe", 5, "x", "tutor")
    with pytest.raises(BatchError, match="one of several"):
        override(tmp_path, "Kim Lee", 5, "x", "tutor")
    with pytest.raises(BatchError, match="no student 'Max'"):
        override(tmp_path, "Max", 5, "x", "tutor")


def test_canvas_is_told_which_assignment(tmp_path: Path) -> None:
    """Its import makes a new column where the name is not that of one."""
    (tmp_path / "class.csv").write_text("name,id\nAnna Berg,s1001\n")
    with gradebook(tmp_path, "topics") as book:
        keep(book, Settings(roster=tmp_path / "class.csv", assignment="Lab 3 (48151)"))
        book.write(graded("s1001"))
        hand_out(book, TOPICS, tmp_path)
    assert cells(tmp_path / "canvas.csv")[1]["Lab 3 (48151)"] == "100"


def test_a_score_by_hand_names_who_gives_it(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Nobody's user name goes to a student unasked."""
    with gradebook(tmp_path, "topics") as book:
        book.write(graded("anna"))
    words = ["override", str(tmp_path), "anna", "70", "--reason", "it ran in class"]
    with pytest.raises(SystemExit):
        main(words)
    assert "--by" in capsys.readouterr().err
    assert main([*words, "--by", "Dr. Tutor"]) == 0
    (row,) = cells(tmp_path / "grades.csv")
    assert (row["final"], row["reason"]) == ("70", "Dr. Tutor: it ran in class")


CANVAS_EXPORT = (
    "Student,ID,SIS User ID,SIS Login ID,Section,Lab 2 (7),Lab 3 (48151),Final Score\n"
    "    Points Possible,,,,,10.00,{points},(read only)\n"
    '"Berg, Anna",12,s1001,aberg,S1,,,\n'
    '"Kaya, Ben",13,s1002,bkaya,S1,,,\n'
)


@pytest.mark.parametrize(
    ("points", "asked", "whole", "score"),
    [
        ("20.00", None, "20", "16.8"),
        ("20,00", None, "20", "16.8"),
        ("20.00", 7.5, "7.5", "6.3"),
        ("", None, "100", "84"),
        ("0.00", None, "100", "84"),
        ("12", None, "12", "10.08"),
    ],
)
def test_scores_are_in_the_points_of_the_platform(
    points: str, asked: float | None, whole: str, score: str, tmp_path: Path
) -> None:
    """As the class list says, or as the instructor does; 0 to 100 stands beside it."""
    roster = tmp_path / "class.csv"
    roster.write_text(CANVAS_EXPORT.format(points=points if "," not in points else f'"{points}"'))
    settings = Settings(roster=roster, assignment="Lab 3 (48151)", points=asked)
    with gradebook(tmp_path, "topics") as book:
        keep(book, settings)
        book.write(graded("bergannalate_12_8_x", "rate", "figure", hz=1.0))
        told = "\n".join(hand_out(book, TOPICS, tmp_path))
    assert ("has no points in the class list" in told) == (points in ("", "0.00"))
    assert "new column" not in told
    canvas = [row["Lab 3 (48151)"] for row in cells(tmp_path / "canvas.csv")]
    assert canvas == [whole, score]
    assert [row["Grade"] for row in cells(tmp_path / "moodle.csv")] == [score, ""]
    anna = cells(tmp_path / "grades.csv")[0]
    assert (anna["final"], anna["points"], anna["of"]) == ("84", score, whole)


def test_an_assignment_that_canvas_does_not_have_is_told(tmp_path: Path) -> None:
    """With those that it has; Canvas would make another one without a word."""
    (tmp_path / "class.csv").write_text(CANVAS_EXPORT.format(points="20.00"))
    with gradebook(tmp_path, "topics") as book:
        book.write(graded("bergannalate_12_8_x"))
        for name, says in (("Lab 3", "No assignment is called 'Lab 3'"), ("", "was given")):
            keep(book, Settings(roster=tmp_path / "class.csv", assignment=name))
            told = "\n".join(hand_out(book, TOPICS, tmp_path))
            assert says in told and "Lab 2 (7), Lab 3 (48151)" in told


@pytest.mark.parametrize("points", ["0", "-1", "nan", "inf", "ten"])
def test_points_that_are_none_are_refused(
    points: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """Before anything is run."""
    with pytest.raises(SystemExit):
        main(["grade", "topics", str(tmp_path), "--out", str(tmp_path / "o"), "--points", points])
    assert "--points" in capsys.readouterr().err


def test_a_refused_hand_in_is_told_whole_in_each_file(tmp_path: Path) -> None:
    """The reason and what to do, in all its lines; a verdict of before does not stay."""
    reason = "There is no ROS package in it.\nThese lie there:\n  a.pdf\n  b.pdf"
    step = "Hand in the zip file\nthat pack makes."
    roster = "name,id\nAnna Berg,s1001\n"
    (tmp_path / "class.csv").write_text(roster)
    with gradebook(tmp_path, "topics") as book:
        keep(book, Settings(roster=tmp_path / "class.csv"))
        book.write(graded("s1001"))
        hand_out(book, TOPICS, tmp_path)
        assert (tmp_path / "students/s1001/verdict.json").is_file()
        again = refused("s1001", reason)
        book.write(again.model_copy(update={"digest": "e", "next_step": step}))
        hand_out(book, TOPICS, tmp_path)
    whole = (
        "There is no ROS package in it. These lie there: a.pdf, b.pdf"
        " Hand in the zip file that pack makes."
    )
    (row,) = cells(tmp_path / "grades.csv")
    assert (row["outcome"], row["final"], row["points"], row["reason"]) == (
        "refused",
        "",
        "",
        whole,
    )
    assert cells(tmp_path / "moodle.csv")[0]["Feedback comments"] == whole
    theirs = tmp_path / "students/s1001"
    assert not (theirs / "verdict.json").exists()
    for name in ("results.json", "junit.xml", "check50.json", "report.html"):
        text = " ".join((theirs / name).read_text("utf-8").replace("\\n", " ").split())
        assert "b.pdf" in text and "that pack makes." in text, name


def test_many_who_handed_in_nothing_are_a_table(tmp_path: Path) -> None:
    """With number and address, to write to them; no long list."""
    lines = [f"Student {n},m{n:04},s{n}@example.org" for n in range(192)]
    (tmp_path / "class.csv").write_text("\n".join(["name,id,email", *lines]))
    with gradebook(tmp_path, "topics") as book:
        keep(book, Settings(roster=tmp_path / "class.csv"))
        book.write(graded("somebody"))
        told = "\n".join(hand_out(book, TOPICS, tmp_path))
    page = (tmp_path / "class.html").read_text("utf-8")
    assert "Handed in nothing (192)" in page
    assert page.count("<tr><td>Student 5</td><td>m0005</td><td>s5@example.org</td></tr>") == 1
    assert page.count("<li>") < 10
    assert "Student 190" not in told


def test_an_override_needs_reason_score_and_submission(tmp_path: Path) -> None:
    """Or nothing is changed."""
    with gradebook(tmp_path, "topics") as book:
        book.write(graded("anna"))
    with pytest.raises(BatchError, match="reason"):
        override(tmp_path, "anna", 5, " ", "tutor")
    with pytest.raises(BatchError, match="somebody who gives it"):
        override(tmp_path, "anna", 5, "x", " ")
    with pytest.raises(BatchError, match="no score"):
        override(tmp_path, "anna", 101, "x", "tutor")
    with pytest.raises(BatchError, match="anna"):
        override(tmp_path, "ann", 5, "x", "tutor")
    with pytest.raises(BatchError, match="no gradebook"):
        override(tmp_path / "elsewhere", "anna", 5, "x", "tutor")
    with gradebook(tmp_path, "topics") as book:
        assert book.overrides() == {}


def test_a_folder_name_leads_nowhere_else() -> None:
    """And two submissions never share one."""
    names = [
        "anna",
        "../../etc",
        "a/b",
        "a b",
        "a_b",
        "\\xff",
        "." * 5,
        "ä" * 300,
        "ä" * 301,
        "-rf",
        "~",
        ".git",
        "a:b",
        "a*",
        "a ",
        "\U0001f916" * 90,
        "<b>",
    ]
    folders = [folder_name(name) for name in names]
    assert folders[0] == "anna"
    assert len(set(folders)) == len(names)
    assert all(re.fullmatch(r"\w[\w .,'()@+-]*\w", folder) for folder in folders)
    assert max(len(folder.encode()) for folder in folders) < 255


@pytest.mark.parametrize(
    "name",
    [
        "Zoë Müller_17_assignsubmission_file",
        "Finn O'Neill_3_assignsubmission_file_",
        "Groß, Lea",
        "李伟_9_assignsubmission_file",
        "lab-topics-annaberg",
        "v1.2 (3)",
        "a.berg@example.org",
    ],
)
def test_a_folder_is_spelt_as_its_student(name: str) -> None:
    """Letters of any language, and what names have between them."""
    assert folder_name(name) == name
    assert folder_name(unicodedata.normalize("NFD", "Zoë")).startswith("Zoë-")


def test_a_folder_of_before_is_brought_over(tmp_path: Path) -> None:
    """It is not left beside the new one."""
    name = "Zoë Müller"
    before = tmp_path / f"students/Zo_M_ller-{zlib.crc32(name.encode()):08x}"
    before.mkdir(parents=True)
    with gradebook(tmp_path, "topics") as book:
        book.write(graded(name))
        hand_out(book, TOPICS, tmp_path)
    assert [each.name for each in (tmp_path / "students").iterdir()] == [name]


# --- who is alike ------------------------------------------------------------------------------


def code(folder: Path, text: str) -> GradingResult:
    """A submission with this code."""
    (folder / "chatter").mkdir(parents=True)
    (folder / "chatter" / "talker.py").write_text(text, "utf-8")
    found = fingerprint(folder)
    return graded(folder.name, source=found.whole, marks=tuple(found.marks))


def written(first: int, count: int = 12) -> str:
    """Code whose structure differs from that of another `first`."""
    lines = []
    for number in range(first, first + count):
        bits = [f"f{bit}(x, {bit})" if number >> bit & 1 else f"x[{bit}] * 2" for bit in range(6)]
        lines.append(f"def g{number}(x):\n    return {' + '.join(bits)}\n")
    return "\n".join(lines)


def test_a_copy_with_other_names_is_found(tmp_path: Path) -> None:
    """Renamed, with other comments, numbers and texts; and a stranger is not."""
    text = written(0)
    renamed = "# mine\n\n" + re.sub(r"\bx\b", "value", text).replace("def g", "def mine")
    found = [
        code(tmp_path / "anna", text),
        code(tmp_path / "ben", renamed),
        code(tmp_path / "cleo", Path(rates.__file__).read_text("utf-8")),
        code(tmp_path / "dora", text + "\n\n# the end"),
    ]
    assert equal_groups(found) == [["anna", "dora"]]
    pairs = {(pair.one, pair.other) for pair in alike(found)}
    assert pairs == {("anna", "ben"), ("ben", "dora")}


def test_what_the_task_gives_to_all_makes_nobody_alike(tmp_path: Path) -> None:
    """The starter's marks, and those that most have, do not count."""
    shared = written(0)
    found = [code(tmp_path / f"s{n}", shared + written(20 + 3 * n, 3)) for n in range(8)]
    assert alike(found) == []
    starter = code(tmp_path / "starter", shared)
    assert alike(found[:2]) != []
    assert alike(found[:2], starter.marks) == []


def test_winnowing_keeps_a_mark_of_every_long_shared_run() -> None:
    """The guarantee of the paper: W + K - 1 tokens in common leave a common mark."""
    run = [f"t{number}" for number in range(19)]
    one = set(winnowed([*"abcdefgh", *run, *"ijklmnop"]))
    other = set(winnowed([*"qrstuvwxyz", *run]))
    assert one & other
    assert not set(winnowed(run[:11]))


def test_a_student_reads_no_path_of_the_machine_that_grades(tmp_path: Path) -> None:
    """What broke off is told the instructor; in no file for students stands where it was."""
    place = "/home/teacher/rooms/1f"
    reason = f"The disk is full. This could not be written:\n{place}\nNothing was changed."
    (tmp_path / "class.csv").write_text("name\nanna")
    with gradebook(tmp_path, "topics") as book:
        keep(book, Settings(roster=tmp_path / "class.csv"))
        step = f"Look at this one yourself: ./roslings check {place}"
        book.write(
            GradingResult(
                submission="anna",
                digest="d",
                attempt=1,
                state="broken",
                reason=reason,
                next_step=step,
            )
        )
        hand_out(book, TOPICS, tmp_path)
    assert place in (tmp_path / "grades.csv").read_text("utf-8")
    theirs = [path for path in (tmp_path / "students").rglob("*") if path.is_file()]
    for path in (*theirs, tmp_path / "moodle.csv", tmp_path / "canvas.csv"):
        assert place not in path.read_text("utf-8"), path.name
    page = (tmp_path / "students/anna/report.html").read_text("utf-8")
    assert "It is not your fault" in page and "Your instructor sees why" in page
