"""Each student is judged by the own card: the class list says whose, never the hand-in."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from roslings.course import lab
from roslings_class.own_cards import listed_as, owners
from roslings_class.roster import Student, read_roster

TOPICS = lab("topics")


def students(folder: Path, text: str) -> list[Student]:
    """Of a class list."""
    file = folder / "class.csv"
    file.write_text(text, "utf-8")
    return read_roster(file)


# --- whose card ---------------------------------------------------------------------------------

LISTS = {
    "own": ("name,id,email\nAnna Berg,s1001,a@example.org\n", "s1001"),
    "logins": ("name,login,email\nAnna Berg,aberg,a@example.org\n", "aberg"),
    "github": ("name,github_username\nAnna Berg,annaberg\n", "annaberg"),
    "addresses": ("name,email\nAnna Berg,a@example.org\n", "a@example.org"),
    "names": ("name\nAnna Berg\n", "Anna Berg"),
    "canvas": (
        "Student,ID,SIS User ID,SIS Login ID,Section\nAnna Berg,77,s1001,aberg,A\n",
        "s1001",
    ),
    "canvas without numbers": (
        "Student,ID,SIS User ID,SIS Login ID,Section\nAnna Berg,77,,aberg,A\n",
        "aberg",
    ),
    "moodle": (
        "Identifier,Full name,Email address,Status,Grade\nParticipant 101,Anna Berg,"
        "a@example.org,Submitted,\n",
        "a@example.org",
    ),
    "moodle with numbers": (
        "Identifier,Full name,ID number,Email address,Status,Grade\nParticipant 101,Anna Berg,"
        "s1001,a@example.org,Submitted,\n",
        "s1001",
    ),
}


@pytest.mark.parametrize("kind", LISTS)
def test_a_student_gives_what_the_student_knows(kind: str, tmp_path: Path) -> None:
    """Never a number that only the platform knows: `Participant 101`, or Canvas's own."""
    text, whose = LISTS[kind]
    (student,) = students(tmp_path, text)
    assert listed_as(student) == whose


def test_of_a_team_the_name_of_the_team_counts(tmp_path: Path) -> None:
    """Who is in no team has an own card, and so has who hands in alone."""
    listed = students(
        tmp_path,
        "name,id,team\nAnna Berg,s1001,Team Rot\nBen Kaya,s1002,Team Rot\nKim Lee,s1003,\n",
    )
    told = owners(listed, ["Team Rot", "s1003", "stranger"])
    assert told == {"Team Rot": "Team Rot", "s1003": "s1003", "stranger": "stranger"}


# --- the command --------------------------------------------------------------------------------


def roslings(*words: str | Path, code: int, home: Path) -> str:
    """What a command prints."""
    done = subprocess.run(
        [sys.executable, "-m", "roslings", *map(str, words)],
        env={**os.environ, "HOME": str(home), "ROSLINGS_WS": str(home / "roslings_ws")},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == code, done.stdout + done.stderr
    return done.stdout + done.stderr


@pytest.mark.parametrize(
    ("name", "more", "told"),
    [
        ("topics", (), "--roster FILE"),
        ("nodes", ("--roster", "class.csv"), "one card for everybody"),
        ("topics", ("--roster", "class.csv", "--dask", "tcp://127.0.0.1:1"), "Leave out --dask"),
    ],
)
def test_what_cannot_be_is_told_before_anything_is_run(
    name: str, more: tuple[str, ...], told: str, tmp_path: Path
) -> None:
    """With the next step; no gradebook is made."""
    students(tmp_path, LISTS["own"][0])
    shutil.copytree(TOPICS.starter, tmp_path / "hand-ins" / "s1001")
    more = tuple(str(tmp_path / word) if word == "class.csv" else word for word in more)
    said = roslings(
        "grade",
        name,
        tmp_path / "hand-ins",
        "--variants",
        "--out",
        tmp_path / "out",
        *more,
        code=2,
        home=tmp_path,
    )
    assert told in said
    assert not (tmp_path / "out").exists()
