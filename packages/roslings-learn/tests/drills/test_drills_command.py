"""`./roslings drill`, typed by a student in a fresh workspace."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from roslings.course import root
from roslings_learn.drills import all_drills, drill

FIRST, SECOND = all_drills()[:2]


class Student:
    """Types commands."""

    def __init__(self, workspace: Path) -> None:
        self.workspace = workspace
        workspace.mkdir()

    def types(self, *words: str) -> subprocess.CompletedProcess[str]:
        """One command, to its end."""
        return subprocess.run(
            [sys.executable, "-m", "roslings", *words],
            cwd=root(),
            capture_output=True,
            text=True,
            check=False,
            env={**os.environ, "ROSLINGS_WS": str(self.workspace), "COLUMNS": "80"},
        )

    def file(self, name: str) -> Path:
        """Theirs of a drill."""
        one = drill(name)
        return self.workspace / "drills" / one.day / one.file_name

    @property
    def kept(self) -> dict[str, dict[str, object]]:
        """What the progress says of drills."""
        text = (self.workspace / ".roslings" / "progress.json").read_text("utf-8")
        drills: dict[str, dict[str, object]] = json.loads(text)["drills"]
        return drills


@pytest.fixture
def student(tmp_path: Path) -> Student:
    """With an empty workspace."""
    return Student(tmp_path / "ws")


@pytest.mark.slow
def test_from_the_first_drill_to_the_second(student: Student) -> None:
    """It is put in place, fails, is mended, and the next one comes."""
    shown = student.types("drill")
    assert shown.returncode == 0, shown.stderr
    assert FIRST.card.title in shown.stdout
    file = student.file(FIRST.name)
    assert file.read_bytes() == FIRST.starter.read_bytes()
    failed = student.types("drill", FIRST.name)
    assert failed.returncode == 1, failed.stderr
    assert FIRST.card.starter.names in " ".join(failed.stdout.splitlines()[:2])
    assert student.kept[FIRST.name]["passed_at"] is None
    file.write_bytes(FIRST.solution.read_bytes())
    assert student.types("drill", FIRST.name).returncode == 0
    assert student.kept[FIRST.name]["tries"] == 2
    assert SECOND.card.title in student.types("drill").stdout


def test_a_file_that_is_there_stays(student: Student) -> None:
    """Whatever stands in it."""
    file = student.file(FIRST.name)
    file.parent.mkdir(parents=True)
    file.write_text("# my work\n")
    student.types("drill")
    assert file.read_text() == "# my work\n"


def test_a_drill_by_name_is_put_in_place_first(student: Student) -> None:
    """Nothing is checked that the student has not seen."""
    shown = student.types("drill", "doubler")
    assert shown.returncode == 0
    assert student.file("doubler").is_file()


def test_hints_come_one_at_a_time(student: Student) -> None:
    """Without a run."""
    one, _, three = FIRST.card.hints
    shown = student.types("drill", FIRST.name, "--hint").stdout
    assert one.split()[0] in shown and "--hint 2" in shown
    last = three.splitlines()[-1].strip()
    assert last not in shown
    assert last in student.types("drill", FIRST.name, "--hint", "3").stdout


def test_the_list_has_all_and_counts(student: Student) -> None:
    """Day by day."""
    shown = student.types("drill", "--list").stdout
    assert f"0 of {len(all_drills())} drills" in shown
    assert all(one.name in shown for one in all_drills())
    assert all(len(line) <= 80 for line in shown.splitlines())


def test_a_wrong_name_is_told(student: Student) -> None:
    """With the nearest."""
    told = student.types("drill", FIRST.name + "x")
    assert told.returncode == 2
    assert FIRST.name in told.stderr
