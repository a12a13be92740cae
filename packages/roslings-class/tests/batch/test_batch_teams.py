"""One hand-in of several students: all of them get its grade, on every platform, nobody else."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from packed import make_zip, zip_bytes
from rounds import FILES, Round, canvas_zip, clone, moodle_zip, played, rule
from test_batch_export import graded

from roslings import course
from roslings_class.command import GradeOptions
from roslings_class.regrade import override
from roslings_class.result import GradingResult
from roslings_class.roster import NobodyInTheList, Student, match, read_roster

WORKSHEET = """\
Identifier,"Full name","Email address",Status,Group,Grade,"Maximum Grade",\
"Last modified (submission)","Last modified (grade)","Feedback comments"
"Participant 101","Anna Berg",a@example.org,Submitted,"Team Rot","",10.00,\
"Tuesday, 1 December 2026, 8:00 AM",-,""
"Participant 102","Ben Kaya",b@example.org,Submitted,"Team Rot","",10.00,\
"Tuesday, 1 December 2026, 8:00 AM",-,""
"Participant 103","Zoë Müller",z@example.org,Submitted,"Grün_1.1: \\"die\\" Übung","",10.00,\
"Monday, 30 November 2026, 8:00 AM",-,""
"Participant 104","Kim Lee",k@example.org,Submitted,"Default group","",10.00,\
"Monday, 30 November 2026, 8:00 AM",-,""
"Participant 7","Late Lu",l@example.org,"No submission","Team Blau","",10.00,-,-,""
""".replace('\\"', '""')
MOODLE_NAMES = {"Team Rot": 7, "Grün 1.1 die Übung": 102}
GROUP_SET = """\
name,canvas_user_id,user_id,login_id,sections,group_name,canvas_group_id,group_id
Anna Berg,77,s1001,aberg,A,Team Rot,5,
Ben Kaya,78,s1002,bkaya,A,Team Rot,5,
Zoë Müller,79,s1003,zm,A,Grüne 7,6,
Late Lu,80,s1004,ll,A,,,
"""
CLASSROOM = """\
assignment_name,assignment_url,starter_code_url,github_username,roster_identifier,\
student_repository_name,student_repository_url,submission_timestamp,points_awarded,\
points_available,group_name
Topics,u,s,annaberg,a@example.org,lab-topics-team-rot,r,2026-12-01T08:00:00Z,0,100,Team Rot
Topics,u,s,bkaya,b@example.org,lab-topics-team-rot,r,2026-12-01T08:00:00Z,0,100,Team Rot
Topics,u,s,zoe,z@example.org,lab-topics-gruen,r,2026-11-30T08:00:00Z,0,100,gruen
"""


def verdicts(name: str) -> GradingResult:
    """Red has 84, everybody else 98."""
    return (
        graded(name, "rate", "figure", hz=1.0) if "rot" in name.lower() else graded(name, "figure")
    )


def of_moodle(folder: Path) -> GradeOptions:
    """Team folders, whose numbers are also those of two participants; one group has no number."""
    zip_ = moodle_zip(folder, MOODLE_NAMES)
    entries = [
        (f"{name}_{number}{FILES}/t.zip", zip_bytes()) for name, number in MOODLE_NAMES.items()
    ]
    make_zip(zip_, [*entries, (f"Default group{FILES}/t.zip", zip_bytes())])
    (folder / "worksheet.csv").write_text(WORKSHEET, "utf-8")
    return GradeOptions(
        "topics", zip_, folder / "out", roster=folder / "worksheet.csv", rule=rule()
    )


def of_canvas(folder: Path) -> GradeOptions:
    """A group's file has the number of one member."""
    zip_ = canvas_zip(folder, ["teamrot_LATE_78_8812_topics.zip", "grüne7_79_8813_topics.zip"])
    (folder / "groups.csv").write_text(GROUP_SET, "utf-8")
    (folder / "times.json").write_text(
        '[{"user_id": 77, "submitted_at": "2026-12-01T07:00:00Z", "late": true},'
        ' {"user_id": 78, "submitted_at": "2026-12-01T07:00:00Z", "late": true},'
        ' {"user_id": 79, "submitted_at": "2026-11-30T07:00:00Z", "late": false}]'
    )
    return GradeOptions(
        "topics",
        zip_,
        folder / "out",
        roster=folder / "groups.csv",
        rule=rule(),
        times=(folder / "times.json",),
    )


def of_classroom(folder: Path) -> GradeOptions:
    """Two clones; the class list is GitHub's own list of grades."""
    for name in ("lab-topics-team-rot", "lab-topics-gruen"):
        clone(folder / "clones" / name)
    (folder / "grades.csv").write_text(CLASSROOM, "utf-8")
    return GradeOptions(
        "topics", folder / "clones", folder / "out", roster=folder / "grades.csv", rule=rule()
    )


def finals(done: Round) -> list[tuple[str, str, str]]:
    """Days late, final score, and the team, of each student in the list."""
    rows = done.rows().values()
    return [(row["days late"], row["final"], row["team"]) for row in rows]


def test_moodles_groups(tmp_path: Path) -> None:
    """Each member's line of the worksheet has the grade; a group's number is no participant's."""
    done = played(of_moodle(tmp_path), verdicts)
    red = "Anna Berg; Ben Kaya"
    assert finals(done) == [
        ("1", "74", red),
        ("1", "74", red),
        ("0", "98", ""),
        ("0", "98", ""),
        ("", "", ""),
    ]
    back = done.rows("moodle.csv", "Full name")
    assert [row["Grade"] for row in back.values()] == ["7.40", "7.40", "9.80", "9.80", ""]
    assert back["Ben Kaya"]["Feedback comments"].startswith("Handed in 1 day late")
    assert "Handed in nothing (1): Late Lu" in done.told
    assert "One hand-in for all of a team (1): " in done.told
    for loose in ("Unclear whose", "Of nobody"):
        assert loose not in done.told


def test_canvass_groups(tmp_path: Path) -> None:
    """The CSV file of the group set is the class list; canvas.csv has what Canvas asks for."""
    done = played(of_canvas(tmp_path), verdicts)
    red = "Anna Berg; Ben Kaya"
    assert finals(done) == [("1", "74", red), ("1", "74", red), ("0", "98", ""), ("", "", "")]
    rows = done.rows("canvas.csv", "ID")
    assert rows["78"] == {
        "Student": "Ben Kaya",
        "ID": "78",
        "SIS User ID": "s1002",
        "SIS Login ID": "bkaya",
        "Section": "A",
        "A talker and a listener (topics)": "74",
    }
    assert [rows[number]["A talker and a listener (topics)"] for number in ("77", "79")] == [
        "74",
        "98",
    ]
    assert "80" not in rows, "who has no score keeps what Canvas has"


def test_classrooms_groups(tmp_path: Path) -> None:
    """Several lines with one repository, and its time."""
    done = played(of_classroom(tmp_path), verdicts)
    red = "a@example.org; b@example.org"
    assert finals(done) == [("1", "74", red), ("1", "74", red), ("0", "98", "")]


@pytest.mark.parametrize(
    ("list_", "name"),
    [
        (
            "name,github_username\nAnna Berg,red-team\nBen Kaya,red-team\nZoe,zoe\n",
            "lab-topics-red-team",
        ),
        ("name,submission\nAnna Berg,red.final\nBen Kaya,red.final\nZoe,\n", "red.final"),
        ("name,team\nAnna Berg,Team Rot\nBen Kaya,Team Rot\nZoe,Team Blau\n", "team_rot"),
        ("name,team\nAnna Berg,Team Rot\nBen Kaya,Team Rot\nZoe,Team Blau\n", "Team-Rot"),
        ("name,group_name\nAnna Berg,Team Rot\nBen Kaya,Team Rot\nZoe,\n", "lab-topics-team-rot"),
    ],
)
def test_the_class_list_may_say_it(tmp_path: Path, list_: str, name: str) -> None:
    """One GitHub name, one submission, one team: in several lines."""
    (tmp_path / "class.csv").write_text(list_)
    students = read_roster(tmp_path / "class.csv")
    found = match(students, [name, "lab-topics-x", "lab-topics-zoe"])
    assert [found.of_student[each] for each in students[:2]] == [[name], [name]]
    assert found.teams == {name: students[:2]}
    assert name not in [*found.unknown, *found.unclear]


def test_the_pages_class_list_is_read_as_it_says(tmp_path: Path) -> None:
    """Its three ways, and the names of its table."""
    text = (course.root() / "site/pages/teachers/teams.md").read_text("utf-8")
    (list_,) = re.findall(r"```text\n(.*?)```", text, re.DOTALL)
    (tmp_path / "class.csv").write_text(list_)
    students = read_roster(tmp_path / "class.csv")
    names = ["lab-topics-team-rot", "lab-topics-red-robots", "final.zip", "lab-topics-x"]
    found = match(students, names)
    assert list(found.teams) == names[:3]
    assert [each.name for members in found.teams.values() for each in members] == [
        each.name for each in students
    ]
    canvas, moodle = "teamrot_LATE_78_8812_topics", f"Team Rot_7{FILES}"
    lists = {moodle: WORKSHEET, canvas: GROUP_SET, "lab-topics-team-rot": CLASSROOM}
    for name, told in lists.items():
        assert f"`{name}" in text
        (tmp_path / "list.csv").write_text(told, "utf-8")
        (two,) = match(read_roster(tmp_path / "list.csv"), [name]).teams.values()
        assert len(two) == 2


# --- who does not get it -----------------------------------------------------------------------


def students_of(*lines: tuple[str, str, str]) -> list[Student]:
    """Name, participant, team."""
    return [
        Student(name, cells={"identifier": f"Participant {number}", "group": team})
        for name, number, team in lines
    ]


MONDAY = students_of(
    ("Anna Berg", "101", "Monday"), ("Ben Kaya", "102", "Monday"), ("Mallory Doe", "103", "Tuesday")
)


def test_a_tutorial_group_shares_no_hand_in() -> None:
    """Who is in one group with somebody who has handed in has not handed in."""
    found = match(MONDAY, [f"Anna Berg_101{FILES}"])
    assert [found.of_student[each] for each in MONDAY] == [[f"Anna Berg_101{FILES}"], [], []]
    assert found.teams == {}


def test_a_profile_that_is_called_like_a_team_gives_nobody_anything() -> None:
    """Where people hand in alone: it is unclear, and a person decides."""
    found = match(MONDAY, [f"Anna Berg_101{FILES}", f"Monday_103{FILES}"])
    assert found.of_student[MONDAY[0]] == [f"Anna Berg_101{FILES}"]
    assert found.of_student[MONDAY[1]] == []
    assert list(found.unclear) == [f"Monday_103{FILES}"]
    canvas = [
        Student("Anna", "77", cells={"id": "77", "sis user id": "", "team": "Rot"}),
        Student("Mal", "79", cells={"id": "79", "sis user id": "", "team": ""}),
    ]
    assert list(match(canvas, ["rot_79_8812_x", "blau_80_8813_x"]).unclear) == ["rot_79_8812_x"]


def test_two_teams_whose_names_differ_in_a_mark_are_told_apart() -> None:
    """Where the file's name keeps it; else it is unclear."""
    teams = [
        Student(name, cells={"team": team})
        for name, team in (("Anna", "Team 1.1"), ("Ben", "Team 11"), ("Cleo", "!!"))
    ]
    names = [f"Team 1.1_3{FILES}", f"Team 11_4{FILES}", f"!!_5{FILES}"]
    found = match(teams, names)
    assert [found.of_student[each] for each in teams] == [[names[0]], [names[1]], []]
    assert match(teams, [f"Team_1-1_3{FILES}"]).of_student == {each: [] for each in teams}
    assert list(match(teams, ["team11_3_8812_x", "y_4_8813_z"]).unclear) == ["team11_3_8812_x"]
    cells = {"id": "3", "sis user id": "", "team": "Team 1.1"}
    numbered = [Student("Anna", "3", cells=cells), *teams[1:]]
    assert match(numbered, ["team11_3_8812_x", "y_4_8813_z"]).of_student[numbered[0]]


def test_a_class_list_without_the_teams_is_told_what_it_needs(tmp_path: Path) -> None:
    """Before anything is graded: nobody in it is called as the folders are."""
    (tmp_path / "class.csv").write_text("name,id\nAnna Berg,s1001\nBen Kaya,s1002\n")
    zip_ = moodle_zip(tmp_path, {"Rot": 7, "Blau": 8})
    with pytest.raises(NobodyInTheList, match="column `team`, or Moodle's worksheet"):
        played(GradeOptions("topics", zip_, tmp_path / "out", roster=tmp_path / "class.csv"))


def test_the_number_of_an_unknown_group_is_nobodys() -> None:
    """Team folders, and a class list without teams: a number may be a participant's by chance."""
    alone = students_of(("Anna Berg", "101", ""), ("Ben Kaya", "102", ""), ("Zoe Adler", "7", ""))
    names = [f"Rot_7{FILES}", f"Blau_8{FILES}", f"Grau_9{FILES}"]
    found = match(alone, names)
    assert all(own == [] for own in found.of_student.values())
    assert list(found.unclear) == [names[0]]


CLONES = "name,github_username,team\nAnna Berg,annaberg,rot\nBen Kaya,bkaya,rot\nMal,mal,\n"


def test_an_account_that_is_called_like_a_team_gives_nobody_anything(tmp_path: Path) -> None:
    """Where others have repositories of their own; where all are teams, they get it."""
    (tmp_path / "class.csv").write_text(CLONES)
    students = read_roster(tmp_path / "class.csv")
    found = match(students, ["lab-topics-rot", "lab-topics-annaberg"])
    assert [found.of_student[each] for each in students] == [["lab-topics-annaberg"], [], []]
    assert found.unclear == {"lab-topics-rot": students[:2]}
    assert list(match(students, ["lab-topics-rot", "lab-topics-blau"]).teams) == ["lab-topics-rot"]


def test_in_a_folder_of_ones_own_who_handed_in_alone_too_is_unclear(tmp_path: Path) -> None:
    """For this one, not for the others of the team."""
    (tmp_path / "class.csv").write_text("name,id,team\nAnna Berg,s1001,Rot\nBen Kaya,s1002,Rot\n")
    students = read_roster(tmp_path / "class.csv")
    found = match(students, ["Rot", "s1001"])
    assert [found.of_student[each] for each in students] == [[], ["Rot"]]
    assert found.doubts(students[0]) == ["Rot", "s1001"]


# --- what comes of it --------------------------------------------------------------------------


def test_a_team_has_one_page_and_is_no_copy_of_itself(tmp_path: Path) -> None:
    """With all names on it; the class page does not call it alike, nor counts it twice."""
    done = played(of_moodle(tmp_path), lambda name: graded(name, "rate", hz=1.0, source="s" + name))
    page = (done.out / "class.html").read_text("utf-8")
    assert "word for word the same" not in page
    assert re.search(r"<code>rate</code>.*?<td>3</td>", page), "three hand-ins, four students"
    pages = [path.read_text("utf-8") for path in done.out.glob("students/*/report.html")]
    assert len(pages) == 3
    assert sum("Anna Berg, Ben Kaya" in text for text in pages) == 1


def test_a_score_by_hand_is_the_whole_teams(tmp_path: Path) -> None:
    """And the command says so."""
    done = played(of_moodle(tmp_path), verdicts)
    told = override(done.out, "Ben Kaya", 90, "ran in class", "tutor")
    assert "It counts for the whole team: Anna Berg, Ben Kaya." in told[0]
    assert [row[1] for row in finals(done)] == ["90", "90", "98", "98", ""]
