"""Moodle's grading worksheet goes back to Moodle as it came, with grades and feedback in it."""

from __future__ import annotations

import csv
import io
from dataclasses import dataclass
from pathlib import Path

import pytest
from test_batch_export import TOPICS, graded, refused

from roslings_class.errors import BadTable
from roslings_class.gradebook import gradebook
from roslings_class.handing_out import Settings, hand_out, keep
from roslings_class.moodle_worksheet import read_worksheet
from roslings_class.regrade import override
from roslings_launcher.cli import main

CHANGEABLE = {"Grade", "Feedback comments"}
PLAIN = """\
Identifier,"Full name","Email address",Status,Grade,"Maximum Grade","Grade can be changed",\
"Last modified (submission)","Last modified (grade)","Feedback comments"
"Participant 101","Anna Berg",a.berg@example.org,"Submitted for grading - ","",100.00,Yes,\
"Thursday, 26 November 2026, 6:12 PM",-,""
"Participant 102","Ben Kaya",b.kaya@example.org,"Submitted for grading - ","",100.00,Yes,\
"Thursday, 26 November 2026, 6:13 PM",-,""
"Participant 103","Zoe Adler",z@example.org,"No submission - ","",100.00,Yes,-,-,""
"Participant 104","Kim Lee",k@example.org,"Submitted for grading - ",55.00,100.00,Yes,\
"Thursday, 26 November 2026, 6:14 PM","Friday, 27 November 2026, 9:00 AM","<p>a talk</p>"
"""
WITH_GROUPS = """\
Identifier,"Full name","ID number","Email address",Status,Group,Grade,"Maximum Grade",\
"Marking workflow state","Grade can be changed","Last modified (submission)","Online text",\
"Last modified (grade)","Feedback comments"
"Participant 101","Anna Berg",s1001,a.berg@example.org,"Submitted for grading","Group A, Monday",\
"","10,00","Not marked",Yes,"Donnerstag, 26. November 2026, 18:12","<p>Line one
line ""two"", with a comma</p>",-,""
"Participant 102","Ben Kaya",s1002,b.kaya@example.org,"Submitted for grading","Group A, Monday",\
"","10,00","Not marked",Yes,"Donnerstag, 26. November 2026, 18:13","",-,""
"Participant 103","Zoe Adler",s1003,z@example.org,"No submission","","","10,00","Not marked",Yes,\
-,"",-,""
"Participant 104","Kim Lee",s1004,k@example.org,"Submitted for grading","","5,50","10,00",\
"Not marked",Yes,"Donnerstag, 26. November 2026, 18:14","","Freitag, 27. November 2026, 09:00",""
"""
BLIND = "\n".join(
    ",".join(cells)
    for cells in (
        ("Identifier", "Status", "Grade", "Last modified (grade)"),
        *((f"Participant {number}", "Submitted", "", "-") for number in range(101, 105)),
    )
)
AS_WRITTEN = {
    "plain": PLAIN.encode(),
    "a mark of UTF-8": b"\xef\xbb\xbf" + PLAIN.encode(),
    "ends of Windows": b"\xef\xbb\xbf" + PLAIN.replace("\n", "\r\n").encode(),
    "semicolons": PLAIN.replace(",", ";").encode(),
    "groups, another language's dates, a text": WITH_GROUPS.encode(),
    "blind marking, no feedback": BLIND.encode(),
}


@dataclass(frozen=True)
class Imported:
    """What Moodle's importer takes from a line."""

    grade: str
    feedback: str
    rest: tuple[str, ...]


def imported(content: bytes) -> dict[str, Imported]:
    """As Moodle reads it: the mark away, and nothing at all without its three columns."""
    text = content.decode("utf-8-sig")
    separator = max(",;", key=text.partition("\n")[0].count)
    head, *lines = csv.reader(io.StringIO(text, newline=""), delimiter=separator)
    places = {name: at for at, name in enumerate(head)}
    assert {"Identifier", "Grade", "Last modified (grade)"} <= places.keys()
    assert {len(line) for line in lines} == {len(head)}
    return {
        line[places["Identifier"]]: Imported(
            line[places["Grade"]],
            line[places["Feedback comments"]] if "Feedback comments" in places else "",
            tuple(cell for name, cell in zip(head, line, strict=True) if name not in CHANGEABLE),
        )
        for line in lines
    }


def handed_out(folder: Path, content: bytes) -> bytes:
    """moodle.csv: Anna was graded, Ben refused, Zoe handed in nothing, of Kim nobody could tell."""
    (folder / "worksheet.csv").write_bytes(content)
    with gradebook(folder, "topics") as book:
        keep(book, Settings(roster=folder / "worksheet.csv"))
        book.write(graded("Anna Berg_101_assignsubmission_file_", "rate", "figure", hz=1.0))
        book.write(refused("Ben Kaya_102_assignsubmission_file_", "There is no <package> in it."))
        unclear = refused("Kim Lee_104_assignsubmission_file_", "/home/me/x broke off")
        book.write(unclear.model_copy(update={"state": "broken"}))
        told = hand_out(book, TOPICS, folder)
    assert any("moodle.csv" in line for line in told)
    return (folder / "moodle.csv").read_bytes()


@pytest.mark.parametrize("name", AS_WRITTEN)
def test_a_worksheet_is_filled_in_and_is_else_as_it_was(name: str, tmp_path: Path) -> None:
    """Every column and every line; the mark, the separator and the ends of lines, too."""
    given = AS_WRITTEN[name]
    made = handed_out(tmp_path, given)
    before, after = imported(given), imported(made)
    assert [*before] == [*after]
    assert {who: each.rest for who, each in before.items()} == {
        who: each.rest for who, each in after.items()
    }
    assert after["Participant 103"] == before["Participant 103"], "who handed in nothing"
    assert after["Participant 104"] == before["Participant 104"], "of whom nobody could tell"
    assert made.startswith(b"\xef\xbb\xbf") == given.startswith(b"\xef\xbb\xbf")
    assert made.count(b"\r\n") == given.count(b"\r\n")
    whole = "8,40" if b"10,00" in given else "84.00"
    assert (after["Participant 101"].grade, after["Participant 102"].grade) == (whole, "")
    if b"Feedback" in given:
        assert "About rate." in after["Participant 101"].feedback
        assert after["Participant 102"].feedback == "There is no &lt;package&gt; in it."


def test_what_a_person_says_goes_into_it(tmp_path: Path) -> None:
    """A score by hand writes the worksheet anew."""
    handed_out(tmp_path, PLAIN.encode())
    override(tmp_path, "Kim Lee", 70, "it ran in class", "tutor")
    line = imported((tmp_path / "moodle.csv").read_bytes())["Participant 104"]
    assert (line.grade, line.feedback) == ("70.00", "tutor: it ran in class")


CZECH = 'Identifikátor,"Celé jméno",Známka,"Naposledy změněno (známka)"\n'
SCALE = PLAIN.replace("Maximum Grade", "Scale").replace("100.00", '"Pass or fail"')


@pytest.mark.parametrize(
    ("text", "says", "step"),
    [
        (
            "Identifier,Full name,Email address\nParticipant 101,Anna Berg,\n",
            "no column 'Grade'",
            "Download grading worksheet",
        ),
        (
            PLAIN.replace('"Last modified (grade)"', "Changed"),
            r"'Last modified \(grade\)'",
            "Download grading worksheet",
        ),
        (
            CZECH + "Účastník101,Anna Berg,,-\nÚčastník102,Ben Kaya,,-\n",
            "in a language that is not known",
            "headings.yaml",
        ),
        (PLAIN.replace("100.00", "Pass or fail"), "not graded by points", "type Point"),
        (SCALE, "its scale is 'Pass or fail'", "type Point"),
    ],
)
def test_what_moodle_would_refuse_is_told_before_anything_is_run(
    text: str, says: str, step: str, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """With the file, and what to do; nothing is graded and nothing is made."""
    (tmp_path / "worksheet.csv").write_text(text, "utf-8")
    with pytest.raises(BadTable, match=says) as refusal:
        read_worksheet(tmp_path / "worksheet.csv")
    assert step in refusal.value.next_step
    (tmp_path / "in/Anna Berg_101_assignsubmission_file_").mkdir(parents=True)
    words = [str(tmp_path / "in"), "--out", str(tmp_path / "out")]
    assert main(["grade", "topics", *words, "--roster", str(tmp_path / "worksheet.csv")]) == 2
    assert "worksheet.csv:" in capsys.readouterr().err
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    "text",
    [
        "name,id\nAnna Berg,s1001\n",
        "Student,ID,SIS User ID,SIS Login ID,Section\nBerg Anna,77,s1001,aberg,A\n",
        "identifier,github_username\ns1001,annaberg\n",
        "name\nStudent 1\nStudent 2\n",
        "login,a,b,c\nstud1001,,,\nstud1002,,,\n",
        "id\nstud1001\nstud1002\n",
    ],
)
def test_another_class_list_is_no_worksheet(text: str, tmp_path: Path) -> None:
    """It needs no column of Moodle's."""
    (tmp_path / "class.csv").write_text(text, "utf-8")
    assert read_worksheet(tmp_path / "class.csv") is None
