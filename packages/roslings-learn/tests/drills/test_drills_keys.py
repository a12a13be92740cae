"""What the keys of `watch` do with a drill's files, and what they show."""

from __future__ import annotations

from pathlib import Path

import pytest
from rich.console import Console

from roslings.course import root
from roslings.verdict import CheckResult
from roslings_learn.commands.watch.reading import section
from roslings_learn.drills import Drill, all_drills, drill, telling
from roslings_learn.drills.beside import beside, package_lines
from roslings_learn.drills.faults import NoAnswerYet
from roslings_learn.drills.judging import DrillVerdict, failed
from roslings_learn.drills.student import begin_again, file_of, is_changed, start, statuses

LAMP, CHILD = drill("no_spin"), drill("child")


@pytest.fixture(autouse=True)
def workspace(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Empty."""
    monkeypatch.setenv("ROSLINGS_WS", str(tmp_path))
    return tmp_path


# --- begun again -------------------------------------------------------------------------------


def test_a_starter_that_comes_back_costs_no_work(workspace: Path) -> None:
    """Each time that it is begun again, what was there gets a name of its own."""
    file, _ = start(LAMP)
    assert not is_changed(LAMP)
    kept = []
    for text in ("# one\n", "# two\n"):
        file.write_text(text)
        assert is_changed(LAMP)
        kept.append(begin_again(LAMP))
        assert not is_changed(LAMP)
    assert [each.read_text() for each in kept] == ["# one\n", "# two\n"]
    assert all(each.suffix != ".py" for each in kept)


def test_what_is_no_file_makes_room(workspace: Path) -> None:
    """A folder in the program's place, and nothing at all."""
    assert is_changed(LAMP)
    begin_again(LAMP)
    file_of(LAMP).unlink()
    file_of(LAMP).mkdir()
    assert is_changed(LAMP)
    assert begin_again(LAMP).is_dir() and file_of(LAMP).is_file()


# --- two programs, one beside the other --------------------------------------------------------

YOURS, OURS = "a = 1\nb = 2\nprint(a)\n", "a = 1\nb = 3\nc = 4\nprint(a)\n"


def test_there_is_room_for_two_columns() -> None:
    """A line that differs is marked; what only one of both has stands alone."""
    assert list(beside(YOURS, OURS, 40)) == [
        "yours    | ours",
        "a = 1    | a = 1",
        "b = 2    > b = 3",
        "         > c = 4",
        "print(a) | print(a)",
    ]


def test_there_is_room_for_one_column() -> None:
    """As `diff` shows it."""
    assert list(beside(YOURS, OURS, 15)) == [
        "- yours   + ours",
        "  a = 1",
        "- b = 2",
        "+ b = 3",
        "+ c = 4",
        "  print(a)",
    ]


def test_what_could_steer_the_terminal_is_shown() -> None:
    """It is a student's text."""
    assert "\x1b" not in "".join(beside("print('\x1b[2J')\n", OURS, 80))


def test_a_package_is_compared_file_by_file(tmp_path: Path) -> None:
    """What is equal is not shown; what is missing is named."""
    yours, ours = tmp_path / "yours", tmp_path / "ours"
    for folder, text in ((yours, YOURS), (ours, OURS)):
        folder.mkdir()
        (folder / "talker.py").write_text(text)
        (folder / "setup.py").write_text("x = 1\n")
    assert not any("setup.py" in line for line in package_lines(yours, ours))
    (yours / "talker.py").unlink()
    assert "\ntalker.py  (you have no file of this name)" in list(package_lines(yours, ours))
    (yours / "talker.py").write_text(OURS)
    assert list(package_lines(yours, ours)) == [
        "\nYour package and ours are the same, letter by letter."
    ]


# --- what is shown -----------------------------------------------------------------------------


def shown(put: object, *words: object, **named: object) -> str:
    """A page of 80 columns with it."""
    assert callable(put)
    console = Console(width=80, record=True, file=open("/dev/null", "w"))  # noqa: SIM115, PTH123
    page = telling.page(console)
    put(page, *words, **named)
    page.print()
    return console.export_text()


def test_a_question_greets_with_no_red_cross(workspace: Path) -> None:
    """Nothing is wrong before the first answer."""
    file, _ = start(CHILD)
    assert CHILD.card.answer
    title = "The file holds your answer."
    waits = failed(CHILD.name, "answer", title, NoAnswerYet(CHILD.card.answer.question))
    way = telling.WayToGoOn("./roslings")
    told = shown(telling.put_verdict, CHILD, waits, file, way)
    assert told.startswith("? child") and "✗" not in told and "expected" not in told
    assert "ANSWER is still None" in told and CHILD.card.answer.question[:20] in told
    watched = telling.WayToGoOn("./roslings", watched=True)
    told = shown(telling.put_verdict, CHILD, waits, file, watched)
    assert CHILD.card.answer.question[:20] not in told  # the task above has it


def test_the_days_drills_are_listed(workspace: Path) -> None:
    """This one is marked, the other days are counted; it fits a screen of 24 lines."""
    told = shown(telling.put_day, statuses(), LAMP, "./roslings").splitlines()
    assert any(line.startswith(">") and LAMP.name in line for line in told)
    days = sorted({one.day for one in all_drills()})
    assert all(any(f"Day {int(day[:2])} " in line for line in told) for day in days)
    assert len(told) < 24 and max(map(len, told)) <= 80


def test_a_hint_in_watch_names_the_key(workspace: Path) -> None:
    """And no command that would have to be typed elsewhere."""
    assert "Press h" in shown(telling.put_hint, LAMP, 1, "./roslings", watched=True)
    assert "--hint 2" in shown(telling.put_hint, LAMP, 1, "./roslings")


@pytest.mark.parametrize("one", all_drills(), ids=lambda one: one.name)
def test_the_paragraph_of_each_drill_can_be_read(one: Drill) -> None:
    """In the terminal, in lines of 80 columns, without marks of links; code as it is."""
    day, _, anchor = one.card.lesson.partition("#")
    lines = list(section(root() / day / "lesson.ipynb", anchor))
    assert len(lines) > 3
    prose = [line for line in lines if not line.startswith("    ") and "|" not in line]
    assert max(map(len, prose)) <= 80
    assert "](" not in "".join(prose) and "**" not in "".join(prose)


def test_a_paragraph_that_is_not_there_is_empty(tmp_path: Path) -> None:
    """So is a lesson that is not there."""
    assert list(section(root() / LAMP.day.join(("days/", "/lesson.ipynb")), "no-such")) == []
    assert list(section(tmp_path / "lesson.ipynb", "names")) == []


def test_no_path_of_a_room_is_told() -> None:
    """The student's file has another folder."""
    room = "/tmp/roslings-x/room/install/"
    first = CheckResult(
        id="runs",
        title="It runs.",
        outcome="fail",
        points=0,
        max_points=0,
        measured=f"it ended: {room}01_no_spin.py",
        log=(f'  File "{room}01_no_spin.py", line 3',),
    )
    told = DrillVerdict("no_spin", "fail", (), first).without(room)
    assert told.first and told.first.log == ('  File "01_no_spin.py", line 3',)
    assert told.headline == "it ended: 01_no_spin.py"
    assert DrillVerdict("no_spin", "pass").without(room) == DrillVerdict("no_spin", "pass")
