"""Late days from where they are known: worksheets, names, lists, commits; zones, extensions."""

from __future__ import annotations

import json
import os
import re
import shlex
import subprocess
from datetime import datetime, timedelta, timezone
from pathlib import Path

import pytest
from packed import make_zip, zip_bytes
from rounds import BERLIN, CLASS, FILES, canvas_zip, clone, moodle_zip, played, rule

from roslings import course
from roslings_class.clock_times import NoSuchZone, as_time, zone_of
from roslings_class.command import GradeOptions, NoDeadline
from roslings_class.commit_times import commit_time
from roslings_class.errors import BadTable
from roslings_class.gradebook import gradebook
from roslings_class.handed_in import LATE_BY_SOME, NOT_KNOWN
from roslings_class.handing_out import settings_of
from roslings_class.late_days import ExtensionOfNobody, LateRule, read_extensions
from roslings_class.moodle_dates import MONTHS, moodle_time
from roslings_class.regrade import override
from roslings_launcher.cli import main, parser

NUMBERS = {name: number for number, name in enumerate(CLASS, start=101)}
UTC = timezone.utc


def worksheet(folder: Path, lines: list[str], head: str = "") -> Path:
    """Moodle's grading worksheet."""
    head = head or (
        'Identifier,"Full name","Email address",Status,Grade,"Maximum Grade",'
        '"Last modified (submission)","Last modified (grade)","Feedback comments"'
    )
    (folder / "worksheet.csv").write_text("\n".join([head, *lines]), "utf-8")
    return folder / "worksheet.csv"


def line(name: str, submitted: str, status: str = "Submitted for grading - ") -> str:
    """One student's line of it."""
    who = f'"Participant {NUMBERS[name]}","{name}",x@example.org'
    return f'{who},"{status}",,100.00,"{submitted}",-,""'


@pytest.fixture
def download(tmp_path: Path) -> Path:
    """All four have handed in."""
    return moodle_zip(tmp_path, NUMBERS)


# --- Moodle ------------------------------------------------------------------------------------

TIMES = {
    "Anna Berg": "Monday, 30 November 2026, 11:58 PM",
    "Ben Kaya": "Tuesday, 1 December 2026, 12:01 AM",
    "Zoë Müller": "Thursday, 3 December 2026, 9:00 AM",
    "Finn O'Neill": "-",
}


def test_a_worksheet_tells_the_times(tmp_path: Path, download: Path) -> None:
    """From the download to Moodle's own file: points go, the student reads why; a gap is told."""
    list_ = worksheet(tmp_path, [line(name, time) for name, time in TIMES.items()])
    done = played(GradeOptions("topics", download, tmp_path / "out", roster=list_, rule=rule()))
    assert done.late() == {"Anna Berg": "0", "Ben Kaya": "1", "Zoë Müller": "3", "Finn O'Neill": ""}
    ben, finn = done.rows()["Ben Kaya"], done.rows()["Finn O'Neill"]
    assert (ben["handed in"], ben["told by"]) == ("2026-12-01 00:01+01:00", "Moodle's worksheet")
    assert (ben["late points"], ben["final"]) == ("10", "88")
    assert (finn["handed in"], finn["late points"], finn["final"]) == ("not known", "", "98")
    back = done.rows("moodle.csv", "Full name")
    assert [back[name]["Grade"] for name in CLASS] == ["98.00", "88.00", "68.00", "98.00"]
    assert back["Ben Kaya"]["Feedback comments"].startswith("Handed in 1 day late: 10 points less.")
    assert back["Zoë Müller"]["Feedback comments"].startswith("Handed in 3 days late: 30 points")
    assert "late" not in back["Anna Berg"]["Feedback comments"]
    assert "Late, in days (2): Ben Kaya (1), Zoë Müller (3)" in done.told
    assert "When it was handed in is not known (1): Finn O'Neill" in done.told
    assert "Monday 30 November 2026, 23:59 (UTC+01:00)" in done.told
    assert "read in Europe/Berlin" in done.told


def test_free_days_cost_nothing_and_say_nothing(tmp_path: Path, download: Path) -> None:
    """The student reads only what cost points."""
    list_ = worksheet(tmp_path, [line(name, time) for name, time in TIMES.items()])
    free = rule(free_days=1)
    done = played(GradeOptions("topics", download, tmp_path / "out", roster=list_, rule=free))
    back = done.rows("moodle.csv", "Full name")
    assert "late" not in back["Ben Kaya"]["Feedback comments"]
    assert "3 days late: 20 points less" in back["Zoë Müller"]["Feedback comments"]


def test_an_extension_in_the_worksheet_counts(tmp_path: Path, download: Path) -> None:
    """Moodle writes it behind the status."""
    granted = (
        "Submitted for grading - 2 days 9 hours late - Extension granted until: "
        "Thursday, 3 December 2026, 8:00 AM"
    )
    lines = [
        line(name, time, granted if name.startswith("Z") else "Submitted - 1 day late")
        for name, time in TIMES.items()
    ]
    list_ = worksheet(tmp_path, lines)
    done = played(GradeOptions("topics", download, tmp_path / "out", roster=list_, rule=rule()))
    assert done.late()["Zoë Müller"] == "1"
    assert done.late()["Ben Kaya"] == "1"


@pytest.mark.parametrize(
    ("text", "time"),
    [
        ("Thursday, 26 November 2026, 6:12 PM", (2026, 11, 26, 18, 12)),
        ("Saturday, 1 May 2027, 12:00 AM", (2027, 5, 1, 0, 0)),
        ("Saturday, 1 May 2027, 12:30 PM", (2027, 5, 1, 12, 30)),
        ("Donnerstag, 26. November 2026, 18:12", (2026, 11, 26, 18, 12)),
        ("Montag, 1. März 2027, 08:05", (2027, 3, 1, 8, 5)),
        ("martes, 2 de marzo de 2027, 23:59", (2027, 3, 2, 23, 59)),
        ("jeudi 13 août 2026, 07:00", (2026, 8, 13, 7, 0)),
        ("quinta, 26 nov 2026, 18:12", (2026, 11, 26, 18, 12)),
        ("giovedì, 26 novembre 2026, 18:12", (2026, 11, 26, 18, 12)),
        ("2026年11月26日 星期四 18:12", (2026, 11, 26, 18, 12)),
        ("2026年11月26日 下午 6:12", (2026, 11, 26, 18, 12)),
        ("-", None),
        ("", None),
        ("Submitted for grading - 2 days 3 hours late", None),
        ("31 February 2027, 10:00", None),
        ("26/11/2026 18:12", None),
        ("April or May 3 2026, 10:00", None),
        ("26 November 2026", None),
    ],
)
def test_a_date_is_read_in_any_language_of_the_table_or_not_at_all(
    text: str, time: tuple[int, ...] | None
) -> None:
    """What is not sure is no date."""
    assert moodle_time(text) == (datetime(*time) if time else None)  # type: ignore[arg-type]


def test_the_worksheets_clock_is_that_of_the_deadline(tmp_path: Path, download: Path) -> None:
    """The same worksheet, read in New York: all are hours later."""
    list_ = worksheet(tmp_path, [line(name, TIMES["Ben Kaya"]) for name in CLASS])
    for zone, days in (("Europe/Berlin", "1"), ("Asia/Tokyo", "0"), ("America/New_York", "1")):
        deadline = rule("2026-11-30T23:59+01:00").deadline
        there = LateRule(deadline=deadline, zone=zone)
        out = tmp_path / zone.replace("/", "-")
        done = played(GradeOptions("topics", download, out, roster=list_, rule=there))
        assert done.late()["Ben Kaya"] == days


# --- Canvas ------------------------------------------------------------------------------------

CANVAS_LIST = """\
Student,ID,SIS User ID,SIS Login ID,Section,Lab 3 (48151)
    Points Possible,,,,,100
"Berg, Anna",77,s1001,aberg,A,
"Kaya, Ben",78,s1002,bkaya,A,
"Müller, Zoë",79,s1003,zmueller,A,
"""
CANVAS_FILES = [
    "berganna_77_8812_topics.zip",
    "kayaben_LATE_78_8813_topics.zip",
    "müllerzoë_LATE_79_8814_topics-1.zip",
]


def submissions_of_canvas() -> list[dict[str, object]]:
    """As its API tells them."""
    return [
        {"user_id": 77, "submitted_at": "2026-11-30T22:58:59Z", "late": False, "seconds_late": 0},
        {
            "user_id": 78,
            "submitted_at": "2026-12-01T10:00:00Z",
            "late": True,
            "seconds_late": 39660,
        },
        {"user_id": 80, "submitted_at": None, "late": False},
    ]


def test_canvas_marks_who_is_late(tmp_path: Path) -> None:
    """By its own due date, and not by how much: nobody is charged for what is not known."""
    (tmp_path / "canvas-list.csv").write_text(CANVAS_LIST, "utf-8")
    zip_ = canvas_zip(tmp_path, CANVAS_FILES)
    done = played(
        GradeOptions(
            "topics", zip_, tmp_path / "out", roster=tmp_path / "canvas-list.csv", rule=rule()
        )
    )
    assert done.late() == {"Berg, Anna": "0", "Kaya, Ben": "", "Müller, Zoë": ""}
    rows = done.rows()
    assert (rows["Berg, Anna"]["handed in"], rows["Berg, Anna"]["told by"]) == (
        "in time",
        "Canvas's file name",
    )
    assert rows["Kaya, Ben"]["handed in"] == "late, by how much is not known"
    assert rows["Kaya, Ben"]["final"] == "98"
    assert "Late, by how much is not known (2): Kaya, Ben, Müller, Zoë" in done.told


def test_without_a_due_date_canvas_marks_nobody(tmp_path: Path) -> None:
    """So no mark at all says nothing."""
    (tmp_path / "canvas-list.csv").write_text(CANVAS_LIST, "utf-8")
    zip_ = canvas_zip(tmp_path, [CANVAS_FILES[0], "kayaben_78_8813_topics.zip"])
    done = played(
        GradeOptions(
            "topics", zip_, tmp_path / "out", roster=tmp_path / "canvas-list.csv", rule=rule()
        )
    )
    assert done.late() == {"Berg, Anna": "", "Kaya, Ben": "", "Müller, Zoë": ""}


@pytest.mark.parametrize("guard", ["", "while(1);"])
def test_canvass_own_list_tells_by_how_much(tmp_path: Path, guard: str) -> None:
    """Its API in JSON, as a browser saves it; a page of it is a file."""
    (tmp_path / "canvas-list.csv").write_text(CANVAS_LIST, "utf-8")
    pages = [submissions_of_canvas()[:1], submissions_of_canvas()[1:]]
    files = []
    for number, page in enumerate(pages):
        files.append(tmp_path / f"page-{number}.json")
        files[-1].write_text(guard + json.dumps(page), "utf-8")
    zip_ = canvas_zip(tmp_path, CANVAS_FILES)
    done = played(
        GradeOptions(
            "topics",
            zip_,
            tmp_path / "out",
            roster=tmp_path / "canvas-list.csv",
            rule=rule(),
            times=tuple(files),
        )
    )
    assert done.late() == {"Berg, Anna": "0", "Kaya, Ben": "1", "Müller, Zoë": ""}
    assert done.rows()["Kaya, Ben"]["told by"] == "Canvas"
    canvas = done.rows("canvas.csv", "Student")
    assert [row["A talker and a listener (topics)"] for row in canvas.values()] == [
        "100",
        "98",
        "88",
        "98",
    ]


# --- clones ------------------------------------------------------------------------------------

GITHUB_LIST = "name,id,github_username\nAnna Berg,s1001,annaberg\nBen Kaya,s1002,bkaya\n"
GRADES = """\
assignment_name,assignment_url,starter_code_url,github_username,roster_identifier,\
student_repository_name,student_repository_url,submission_timestamp,points_awarded,points_available
Topics,https://x,https://y,annaberg,a.berg@example.org,lab-topics-annaberg,https://z,\
2026-11-30 22:59,0,100
Topics,https://x,https://y,bkaya,b.kaya@example.org,my-class/lab-topics-bkaya,https://z,\
2026-12-02T00:00:00Z,0,100
"""


@pytest.fixture
def clones(tmp_path: Path) -> Path:
    """Two; the second committed a day late."""
    clone(tmp_path / "clones/lab-topics-annaberg", datetime(2026, 11, 30, 20, tzinfo=UTC))
    clone(tmp_path / "clones/lab-topics-bkaya", datetime(2026, 12, 1, 20, tzinfo=UTC))
    return tmp_path / "clones"


def test_a_clones_newest_commit_tells_the_time(tmp_path: Path, clones: Path) -> None:
    """And that the student's own computer says so."""
    (tmp_path / "class.csv").write_text(GITHUB_LIST)
    done = played(
        GradeOptions("topics", clones, tmp_path / "out", roster=tmp_path / "class.csv", rule=rule())
    )
    assert done.late() == {"Anna Berg": "0", "Ben Kaya": "1"}
    assert done.rows()["Ben Kaya"]["told by"] == "its newest commit"


@pytest.mark.parametrize("way", ["as the class list", "by --times"])
def test_classrooms_grades_stand_before_a_commit(tmp_path: Path, clones: Path, way: str) -> None:
    """GitHub's own time, in UTC where it names no zone; the file names the clone, too."""
    (tmp_path / "grades.csv").write_text(GRADES)
    (tmp_path / "class.csv").write_text(GITHUB_LIST)
    is_list = way == "as the class list"
    done = played(
        GradeOptions(
            "topics",
            clones,
            tmp_path / "out",
            rule=rule(),
            roster=tmp_path / ("grades.csv" if is_list else "class.csv"),
            times=() if is_list else (tmp_path / "grades.csv",),
        )
    )
    assert list(done.late().values()) == ["0", "2"]
    assert {row["told by"] for row in done.rows().values()} == {"GitHub Classroom"}


def test_a_packed_clone_is_read_too(tmp_path: Path) -> None:
    """What a fresh clone of a larger repository is."""
    time = datetime(2026, 11, 30, 20, 15, tzinfo=timezone(timedelta(hours=-5)))
    packed = clone(tmp_path / "packed", time, files=5)
    git = ["git", "-C", str(packed)]
    subprocess.run([*git, "gc", "-q"], check=True)
    subprocess.run([*git, "pack-refs", "--all"], check=True)
    assert not (packed / ".git/refs/heads/main").exists()
    assert commit_time(packed) == time


def test_a_clones_own_settings_run_nothing(tmp_path: Path) -> None:
    """Its author may have written them; and a link out of it, or a pipe, ends in nothing."""
    hostile = clone(tmp_path / "hostile")
    bait = tmp_path / "ran"
    run = f"touch {bait}"
    for key in (
        "gpg.program",
        "core.fsmonitor",
        "core.sshCommand",
        "core.pager",
        "alias.cat-file",
        "remote.origin.uploadpack",
    ):
        subprocess.run(["git", "-C", str(hostile), "config", key, run], check=True)
    for key, value in (("extensions.partialClone", "origin"), ("remote.origin.url", f"ext::{run}")):
        subprocess.run(["git", "-C", str(hostile), "config", key, value], check=True)
    assert commit_time(hostile) is not None
    head = hostile / ".git/HEAD"
    for text in ("ref: refs/heads/../../../secret\n", "ref: refs/heads/none\n", "f" * 40, "x", ""):
        head.write_text(text)
        assert commit_time(hostile) is None
    head.unlink()
    head.symlink_to("/etc/hostname")
    assert commit_time(hostile) is None
    head.unlink()
    os.mkfifo(head)
    assert commit_time(hostile) is None
    assert not bait.exists()


def test_what_is_no_clone_has_no_commit(tmp_path: Path) -> None:
    """A folder, a file, and a clone without a commit."""
    (tmp_path / "empty").mkdir()
    subprocess.run(["git", "init", "-q", str(tmp_path / "new")], check=True)
    for path in (tmp_path / "empty", tmp_path / "nothing", tmp_path / "new"):
        assert commit_time(path) is None


# --- lists of the instructor's own -------------------------------------------------------------


def test_a_list_tells_the_times(tmp_path: Path, download: Path) -> None:
    """By any word that names the student; the id decides between two of one name."""
    (tmp_path / "class.csv").write_text(
        "name,id\nAnna Berg,s1\nBen Kaya,s2\nZoë Müller,s3\n", "utf-8"
    )
    (tmp_path / "times.csv").write_text(
        "name,id,submitted\nAnna Berg,s1,2026-12-01 08:00\n,s2,2026-11-29T10:00Z\nZoe Mueller,,\n"
    )
    done = played(
        GradeOptions(
            "topics",
            download,
            tmp_path / "out",
            roster=tmp_path / "class.csv",
            rule=rule(),
            times=(tmp_path / "times.csv",),
        )
    )
    late = done.late()
    assert [late[name] for name in ("Anna Berg", "Ben Kaya", "Zoë Müller")] == ["1", "0", ""]


def test_two_of_one_name_keep_their_own_times(tmp_path: Path) -> None:
    """And their own extensions."""
    for who in ("kim1", "kim2"):
        (tmp_path / "in" / who).mkdir(parents=True)
    (tmp_path / "class.csv").write_text("name,id\nKim Lee,kim1\nKim Lee,kim2\n")
    (tmp_path / "times.csv").write_text(
        "name,id,submitted\nKim Lee,kim1,2026-12-02 08:00\nKim Lee,kim2,2026-12-03 08:00\n"
    )
    (tmp_path / "more.csv").write_text("name,id,until\nKim Lee,kim2,2026-12-05 08:00\n")
    done = played(
        GradeOptions(
            "topics",
            tmp_path / "in",
            tmp_path / "out",
            roster=tmp_path / "class.csv",
            rule=rule(),
            times=(tmp_path / "times.csv",),
            extensions=tmp_path / "more.csv",
        )
    )
    assert [row["days late"] for row in done.rows(key="id").values()] == ["2", "0"]


def test_a_csv_file_of_submissions_stands_before_all(tmp_path: Path, clones: Path) -> None:
    """It is the instructor's word; its times are in the zone of the deadline."""
    (tmp_path / "in.csv").write_text(
        "student,path,submitted\n"
        f"lab-topics-annaberg,{clones / 'lab-topics-annaberg'},2026-12-03 12:00\n"
        f"lab-topics-bkaya,{clones / 'lab-topics-bkaya'},\n"
    )
    done = played(GradeOptions("topics", tmp_path / "in.csv", tmp_path / "out", rule=rule()))
    assert done.late() == {"lab-topics-annaberg": "3", "lab-topics-bkaya": "1"}
    anna = done.rows()["lab-topics-annaberg"]
    assert anna["handed in"] == "2026-12-03 12:00+01:00"


def test_who_has_more_time(tmp_path: Path, download: Path) -> None:
    """A list of extensions: the instructor's word stands before Moodle's."""
    granted = "Extension granted until: Thursday, 31 December 2026, 8:00 AM"
    lines = [line(name, "Wednesday, 2 December 2026, 1:00 PM", granted) for name in CLASS[:2]]
    list_ = worksheet(tmp_path, lines)
    (tmp_path / "more.csv").write_text("email,student,until\n,Ben Kaya,2026-12-02 12:00\n")
    out = tmp_path / "out"
    done = played(
        GradeOptions(
            "topics", download, out, roster=list_, rule=rule(), extensions=tmp_path / "more.csv"
        )
    )
    assert (done.late()["Anna Berg"], done.late()["Ben Kaya"]) == ("0", "1")
    override(out, "Anna Berg", 60, "showed it", "tutor")
    assert done.late()["Ben Kaya"] == "1", "it is kept"


def test_a_score_by_hand_is_not_changed_by_late_days(tmp_path: Path, download: Path) -> None:
    """And the student reads the person's words alone."""
    list_ = worksheet(tmp_path, [line("Zoë Müller", TIMES["Zoë Müller"])])
    out = tmp_path / "out"
    done = played(GradeOptions("topics", download, out, roster=list_, rule=rule()))
    override(out, "Zoë Müller", 90, "showed it", "tutor")
    back = done.rows("moodle.csv", "Full name")["Zoë Müller"]
    assert (back["Grade"], back["Feedback comments"]) == ("90.00", "tutor: showed it")


# --- break it ----------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("text", "time", "zone"),
    [
        ("2026-11-30T23:59+01:00", "2026-11-30T22:59+00:00", "+01:00"),
        ("2026-11-30T23:59Z", "2026-11-30T23:59+00:00", "+00:00"),
        ("2026-11-30T23:59-03:30", "2026-12-01T03:29+00:00", "-03:30"),
        (BERLIN, "2026-11-30T22:59+00:00", "Europe/Berlin"),
        ("2026-07-01T12:00 Europe/Berlin", "2026-07-01T10:00+00:00", "Europe/Berlin"),
        ("2026-11-30 23:59 UTC", "2026-11-30T23:59+00:00", "UTC"),
    ],
)
def test_a_deadline_may_name_its_zone(text: str, time: str, zone: str) -> None:
    """By its hours, or by its name, which knows of summer time."""
    assert as_time(text) == datetime.fromisoformat(time)
    assert zone_of(text) == zone
    assert as_time("2026-11-30T23:59").tzinfo is not None


@pytest.mark.parametrize("name", ["Europe/Atlantis", "../../etc/passwd", "/etc/passwd", "Mars"])
def test_a_zone_that_nobody_knows_is_told(name: str) -> None:
    """With what to write instead."""
    with pytest.raises(NoSuchZone, match=r"\+01:00"):
        as_time(f"2026-11-30T23:59 {name}")


@pytest.mark.parametrize(
    ("name", "text", "says"),
    [
        ("more.csv", "name,until\nAnna Berg,soon\n", "more.csv:2: 'soon' is no date"),
        ("more.csv", "name,until\nAnna Berg,\n", "more.csv:2: there is no until here"),
        ("more.csv", "until\n2026-12-01 08:00\n", "more.csv:2: it is not said whose"),
        (
            "more.csv",
            "name,until\nAnna Borg,2026-12-01 08:00\n",
            "nobody in the class .* Anna Borg",
        ),
        ("times.csv", "name,id\nAnna Berg,s1\n", "no column says when"),
        ("times.csv", "name,submitted\nAnna Berg,late\n", "times.csv:2: 'late' is no date"),
        ("times.json", "{", "it cannot be read"),
        ("times.json", '{"errors": []}', "no list of submissions"),
        ("nothing.json", None, "it cannot be read"),
    ],
)
def test_a_bad_list_is_told_before_anything_is_run(
    tmp_path: Path, download: Path, name: str, text: str | None, says: str
) -> None:
    """With its line, and the next step."""
    (tmp_path / "class.csv").write_text("name,id\nAnna Berg,s1\n")
    if text is not None:
        (tmp_path / name).write_text(text)
    times = () if name == "more.csv" else (tmp_path / name,)
    more = tmp_path / name if name == "more.csv" else None
    choices = GradeOptions(
        "topics",
        download,
        tmp_path / "out",
        roster=tmp_path / "class.csv",
        rule=rule(),
        times=times,
        extensions=more,
    )
    with pytest.raises((BadTable, ExtensionOfNobody), match=says) as refusal:
        played(choices)
    assert refusal.value.next_step


def test_extensions_need_a_deadline(tmp_path: Path, download: Path) -> None:
    """Of what would they be one?"""
    (tmp_path / "more.csv").write_text("name,until\nAnna Berg,2026-12-01\n")
    with pytest.raises(NoDeadline, match="--deadline"):
        played(GradeOptions("topics", download, tmp_path / "out", extensions=tmp_path / "more.csv"))


def test_without_a_deadline_nothing_is_said_of_late_days(tmp_path: Path, clones: Path) -> None:
    """The times are in grades.csv all the same."""
    done = played(GradeOptions("topics", clones, tmp_path / "out"))
    assert "late" not in done.told.lower().replace("late days", "")
    assert done.rows()["lab-topics-bkaya"]["handed in"] == "2026-12-01 20:00+00:00"


def test_canvass_list_may_hold_what_nobody_expects(tmp_path: Path) -> None:
    """A broken time is none; what is missing is not guessed."""
    (tmp_path / "canvas-list.csv").write_text(CANVAS_LIST, "utf-8")
    odd = [
        {},
        {"user_id": None},
        {"user_id": 78, "submitted_at": "soon", "late": "yes"},
        {"user_id": 77, "submitted_at": 5},
    ]
    (tmp_path / "odd.json").write_text(json.dumps(odd))
    done = played(
        GradeOptions(
            "topics",
            canvas_zip(tmp_path, CANVAS_FILES),
            tmp_path / "out",
            rule=rule(),
            roster=tmp_path / "canvas-list.csv",
            times=(tmp_path / "odd.json",),
        )
    )
    assert set(done.late().values()) == {""}


def test_a_deadline_that_is_no_time_is_told(
    download: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """With all the ways to write one."""
    words = ["grade", "topics", str(download), "--out", "out", "--deadline"]
    for text in ("tomorrow", "2026-13-01", "30.11.2026"):
        assert main([*words, text]) == 2
        assert "'2026-11-30 23:59 Europe/Berlin'" in capsys.readouterr().err


def test_the_page_is_true(tmp_path: Path) -> None:
    """Its command is taken, its list of extensions is read, and its words are in grades.csv."""
    text = (course.root() / "site/pages/teachers/late-days.md").read_text("utf-8")
    bash, *_ = re.findall(r"```bash\n(.*?)```", text, re.DOTALL)
    options = parser(["grade"]).parse_args(shlex.split(bash.replace("\\\n", ""))[1:])
    assert (options.deadline, options.late_points, options.late_free) == (BERLIN, 10.0, 1)
    *_, more = re.findall(r"```text\n(.*?)```", text, re.DOTALL)
    (tmp_path / "more.csv").write_text(more)
    assert [each.who for each in read_extensions(tmp_path / "more.csv", "")] == [
        ("Anna Berg", "s1001"),
        ("Ben Kaya", "s1002"),
    ]
    for word in (NOT_KNOWN, LATE_BY_SOME, "in time", *re.findall(r"`(2026-11-30[ T].*?)`", text)):
        assert f"`{word}`" in text
        assert word[0].isalpha() or as_time(word) == as_time(word)
    for name in ("de", "en", "es", "fr", "it", "nl", "pt"):
        assert name in MONTHS


@pytest.mark.slow
def test_the_command_reads_all_of_it(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """Typed as an instructor does; the hand-in cannot be graded, so that nothing is built."""
    make_zip(tmp_path / "moodle.zip", [(f"Anna Berg_101{FILES}/a.zip", zip_bytes([("a", b"")]))])
    list_ = worksheet(tmp_path, [line("Anna Berg", "Tuesday, 1 December 2026, 10:00 PM")])
    (tmp_path / "more.csv").write_text("name,until\nAnna Berg,2026-12-01 08:00\n")
    words = ["grade", "topics", str(tmp_path / "moodle.zip"), "--out", str(tmp_path / "out")]
    words += ["--roster", str(list_), "--deadline", BERLIN, "--late-points", "5", "--trust"]
    words += ["--extensions", str(tmp_path / "more.csv")]
    assert main(words) == 0
    told = " ".join(capsys.readouterr().out.split())
    assert "Late, in days (1): Anna Berg (1)" in told
    with gradebook(tmp_path / "out", "topics") as book:
        kept = settings_of(book).rule
    assert kept is not None
    assert kept.zone == "Europe/Berlin"
    assert kept.extensions[0].until == as_time("2026-12-01 08:00 Europe/Berlin")
