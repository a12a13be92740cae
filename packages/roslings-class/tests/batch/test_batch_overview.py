"""All labs of a class in one table: who has not begun, who stopped where, and since when."""

from __future__ import annotations

import re
from datetime import datetime, timezone
from pathlib import Path

import pytest
from test_batch_export import TOPICS, cells, graded, refused

from roslings_class.gradebook import gradebook
from roslings_class.handing_out import Settings, hand_out, keep
from roslings_class.overview import overview
from roslings_class.result import GradingResult
from roslings_class.roster import Student
from roslings_launcher.cli import main

LABS = ("nodes", "topics", "services")
"""In the order of the course."""
NIGHT = datetime(2026, 11, 20, 23, 30, tzinfo=timezone.utc)
CLASS = "name,id\nAnna Berg,s1001\nBen Kaya,s1002\nCleo Ott,s1003\nDora Li,s1004\nEve Wu,s1005\n"


def book(place: Path, lab: str, *results: GradingResult, settings: Settings | None = None) -> Path:
    """The gradebook of a lab, as `grade` leaves it."""
    folder = place / f"grades-{lab}"
    folder.mkdir(exist_ok=True)
    with gradebook(folder, lab) as book:
        for result in results:
            book.write(result)
        keep(book, settings or Settings(roster=place / "class.csv"))
    return folder


@pytest.fixture
def place(tmp_path: Path) -> Path:
    """Anna has all, Ben stopped after topics, Cleo left it out, Dora is refused, Eve is missing."""
    (tmp_path / "class.csv").write_text(CLASS)
    first, topics, services = LABS
    book(tmp_path, services, graded("s1001"), graded("s1003"))
    book(
        tmp_path,
        first,
        graded("s1001"),
        graded("s1002"),
        graded("s1003"),
        refused("s1004", "No package."),
    )
    times = {"s1002": NIGHT, "s1001": NIGHT}
    settings = Settings(roster=tmp_path / "class.csv", times=times)
    folder = book(tmp_path, topics, graded("s1001"), graded("s1002", "figure"), settings=settings)
    with gradebook(folder, topics) as made:
        hand_out(made, TOPICS, folder)
    return tmp_path


def folders(place: Path) -> list[str]:
    """In any order."""
    return [str(path) for path in sorted(place.glob("grades-*"))]


def test_each_stands_somewhere(place: Path, capsys: pytest.CaptureFixture[str]) -> None:
    """In the terminal, in the file, on the page; with the links to the labs' own pages."""
    assert main(["overview", *folders(place), "--out", str(place / "term")]) == 0
    told = capsys.readouterr().out
    assert told.startswith("5 students, 3 labs: nodes, topics, services.\n")
    assert "Has not begun (1): Eve Wu" in told
    assert "Stopped after nodes (1): Dora Li" in told
    assert "Stopped after topics (1): Ben Kaya" in told
    rows = {row["name"]: row for row in cells(place / "term/overview.csv")}
    assert {name: row["stands"] for name, row in rows.items()} == {
        "Anna Berg": "",
        "Ben Kaya": "stopped after topics",
        "Cleo Ott": "left out topics",
        "Dora Li": "stopped after nodes",
        "Eve Wu": "has not begun",
    }
    ben = rows["Ben Kaya"]
    assert (ben["since (UTC)"], ben["handed in"]) == ("2026-11-20 23:30", "2")
    assert (ben["topics"], ben["topics outcome"]) == ("98", "fail")
    assert (ben["services"], ben["services outcome"]) == ("", "missing")
    dora = rows["Dora Li"]
    assert (dora["nodes outcome"], dora["since is"]) == ("refused", "first graded")
    assert (rows["Eve Wu"]["since (UTC)"], rows["Eve Wu"]["since is"]) == ("", "")
    page = (place / "term/overview.html").read_text("utf-8")
    table = page.partition(">Everybody<")[2]
    assert table.index("Eve Wu") < table.index("Ben Kaya") < table.index("Anna Berg")
    assert "2026-11-20<" in table and re.search(r">\d{4}-\d\d-\d\d\*<", table)
    links = re.findall(r'href="(\.\./grades[^"]+)"', page)
    assert len(links) == 3, "the page of the class, and of two students; the others have none"
    assert all((place / "term" / link).is_file() for link in links)
    assert (place / "term").stat().st_mode & 0o077 == 0


def test_what_is_handed_in_anew_counts_from_then(place: Path) -> None:
    """Not what was graded again: the same content is as old as it was."""
    folder = place / "grades-nodes"
    with gradebook(folder, "nodes") as made:
        before = made.first_graded()["s1002"]
        made._connection.execute("UPDATE results SET written='2026-01-01T00:00:00+00:00'")
        made.write(graded("s1002").model_copy(update={"attempt": 2}))
        again = made.first_graded()["s1002"]
        made.write(graded("s1002").model_copy(update={"digest": "other"}))
        anew = made.first_graded()["s1002"]
    assert again == datetime(2026, 1, 1, tzinfo=timezone.utc)
    assert anew >= before > again


WORKSHEET = (
    'Identifier,"Full name","Email address",Grade,"Last modified (grade)"\n'
    "Participant {},Kim Lee,k1@example.org,,-\n"
    "Participant {},Kim Lee,k2@example.org,,-\n"
    "Participant {},Zoë Berg,z@example.org,,-\n"
)


def test_a_person_is_one_though_each_lab_numbers_anew(tmp_path: Path) -> None:
    """Moodle does so; two of one name are two, and an address is written in any way."""
    for lab, numbers in (("nodes", (11, 12, 13)), ("topics", (13, 11, 12))):
        sheet = tmp_path / f"{lab}.csv"
        sheet.write_text(
            WORKSHEET.format(*numbers).replace("z@", "Z@" if lab == "topics" else "z@")
        )
        second = f"Kim Lee_{numbers[1]}_assignsubmission_file"
        book(tmp_path, lab, graded(second), settings=Settings(roster=sheet))
    found = overview([tmp_path / "grades-topics", tmp_path / "grades-nodes"], None)
    assert [each.student.email for each in found.standings] == [
        "k1@example.org",
        "k2@example.org",
        "z@example.org",
    ]
    assert [[*each.grades] for each in found.standings] == [[], ["nodes", "topics"], []]


def test_two_equal_lines_are_one_person(tmp_path: Path) -> None:
    """Else one of them would never have begun."""
    (tmp_path / "class.csv").write_text("name,id\nAnna Berg,s1001\nAnna Berg,s1001\n")
    found = overview([book(tmp_path, "topics", graded("s1001"))], None)
    assert [[*each.grades] for each in found.standings] == [["topics"]]


def test_a_list_that_is_given_says_who_is_in_the_class(place: Path) -> None:
    """Who left is told, and has no line; who has another name for the same number is the same."""
    (place / "now.csv").write_text("name,id\nAnna Berg-Maier,S1001\nFay New,s1009\n")
    found = overview([Path(each) for each in folders(place)], place / "now.csv")
    assert [each.student.name for each in found.standings] == ["Anna Berg-Maier", "Fay New"]
    assert [len(each.grades) for each in found.standings] == [3, 0]
    assert found.not_in_list == ["Ben Kaya", "Cleo Ott", "Dora Li", "Eve Wu"]


def test_a_hand_in_that_may_be_of_two_is_no_absence(tmp_path: Path) -> None:
    """It is unclear, and the student has begun."""
    (tmp_path / "class.csv").write_text("name,id\nAnna Berg,s1001\nBen Kaya,s1002\n")
    folder = book(tmp_path, "topics", graded("s1001_s1002"))
    found = overview([folder], None)
    assert [each.grades["topics"].outcome for each in found.standings] == ["unclear", "unclear"]
    assert found.in_state("has not begun") == []


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (["nowhere"], "There is no gradebook in"),
        (["grades-topics", "grades-topics"], "both of the lab 'topics'"),
        (["bare"], "No class list was given"),
    ],
)
def test_what_cannot_be_joined_is_told(
    words: list[str], says: str, place: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """With the next step; nothing is written."""
    (place / "bare").mkdir()
    with gradebook(place / "bare", "services") as made:
        made.write(graded("anna"))
    paths = [str(place / word) for word in words]
    assert main(["overview", *paths, "--out", str(place / "term")]) == 2
    assert says in capsys.readouterr().err
    assert not (place / "term").exists()


def test_an_address_is_no_reason_to_join_two_who_have_other_numbers(tmp_path: Path) -> None:
    """A name alone joins only who contradicts in nothing."""
    from roslings_class.overview import _People

    people = _People()
    people.join([Student("Kim Lee", "k1"), Student("Kim Lee", "k2")])
    people.join([Student("Kim Lee", "k3"), Student("Ada", email="a@x.org")])
    people.join([Student("Ada Lovelace", email="A@x.org"), Student("Kim Lee")])
    names = [(each.student.name, each.student.id) for each in people.standings]
    assert names == [
        ("Kim Lee", "k1"),
        ("Kim Lee", "k2"),
        ("Kim Lee", "k3"),
        ("Ada", ""),
        ("Kim Lee", ""),
    ]
