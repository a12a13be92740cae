"""A course outside of this one has a lab, and beside its grader what only this lab needs.

Nothing is installed; the engine is as it is.
"""

from __future__ import annotations

import csv
import json
import os
import re
import shutil
from pathlib import Path

import pytest
from from_outside import CONFORMS, run
from played import furnish

from once import once
from roslings.course import root
from sources import our_modules
from until_told import run_until_told

COURSE = root() / "example-course"
README = COURSE / "README.md"


@pytest.fixture(scope="session")
def outside(shared_folder: Path) -> dict[str, str]:
    """The environment of a command that uses the course."""
    folder = shared_folder / "outside-course"
    once(shared_folder / "outside-course-made", lambda: str(shutil.copytree(COURSE, folder)))
    return {**os.environ, "ROSLINGS_COURSE": str(folder / "course")}


def test_its_capability_conforms(outside: dict[str, str]) -> None:
    """As those of roslings."""
    assert "13 hold" in run(outside, "-c", CONFORMS.format(package="graders.valve"))


def test_its_task_says_what_its_card_says(outside: dict[str, str]) -> None:
    """The rows of the capability's words, too."""
    told = run(outside, "-m", "roslings.course.task")
    assert "unchanged" in told
    task = (COURSE / "course/labs/valve/task.md").read_text("utf-8")
    assert "| asked to activate | its state is then `active` |" in task


@pytest.mark.slow
def test_its_lab_is_checked(outside: dict[str, str], tmp_path: Path) -> None:
    """100 for the solution, as its README says it: the course and the rest from the folder here.

    The evidence has the part, and the page its section.
    """
    (tmp_path / "example-course").symlink_to(Path(outside["ROSLINGS_COURSE"]).parent)
    page = tmp_path / "page.html"
    (said,) = re.findall(r"(ROSLINGS_COURSE)=(\S+) \S+ (.+ check .+)", README.read_text("utf-8"))
    words = [*said[2].split(), "--evidence", "kept", "--html", page.name]
    run({**outside, said[0]: said[1]}, *words, cwd=tmp_path)
    verdict = json.loads((tmp_path / "kept/verdict.json").read_bytes())
    assert verdict["score"] == 100
    evidence = json.loads((tmp_path / "kept/evidence.json").read_bytes())
    part = evidence["experiments"]["leading"]["parts"]["lifecycle"]
    assert [step["state"] for step in part["steps"]] == ["inactive", "active", "inactive"]
    assert "The states of the node" in page.read_text("utf-8")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("words", "inside"),
    [(["release"], ""), (["export", "gradescope", "valve"], "course")],
    ids=["release", "export"],
)
def test_an_edition_of_it_grades_its_own_lab(
    outside: dict[str, str], tmp_path: Path, words: list[str], inside: str
) -> None:
    """The engine and the folder are in it: 100 for the solution, where nothing is installed."""
    run(outside, "-m", "roslings", *words, "--to", "edition", cwd=tmp_path)
    edition = tmp_path / "edition" / inside
    assert not (edition / "labs/valve/solution").exists()
    furnish(edition)
    solution = str(COURSE / "course/labs/valve/solution/valve")
    done = run_until_told(
        [edition / "roslings", "check", "valve", solution, "--json", "verdict.json"],
        cwd=tmp_path,
        env={"PATH": "/usr/bin:/bin:/usr/sbin:/sbin", "HOME": str(tmp_path)},
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert json.loads((tmp_path / "verdict.json").read_bytes())["score"] == 100


@pytest.mark.slow
def test_its_mutants_are_caught(outside: dict[str, str]) -> None:
    """`prove`, as for any lab."""
    told = run(outside, "-m", "roslings", "prove", "valve", "--packages")
    (held, of) = re.findall(r"valve: (\d+) of (\d+) proofs hold", told)[0]
    assert held == of and int(of) > len(list((COURSE / "course/labs/valve/mutants").iterdir()))


@pytest.mark.slow
def test_its_submissions_are_graded(outside: dict[str, str], tmp_path: Path) -> None:
    """`grade`: the starter of one student, the solution of another."""
    for student, kind in (("ann", "solution"), ("bo", "starter")):
        shutil.copytree(COURSE / f"course/labs/valve/{kind}/valve", tmp_path / "in" / student)
    words = ["grade", "valve", str(tmp_path / "in"), "--out", str(tmp_path / "out")]
    run({**outside, "ROSLINGS_SOAK_S": "0"}, "-m", "roslings", *words)
    with (tmp_path / "out" / "grades.csv").open(encoding="utf-8", newline="") as file:
        scores = {row["submission"]: float(row["final"]) for row in csv.DictReader(file)}
    assert scores["ann"] == 100 and scores["bo"] < 100


def test_the_engine_does_not_name_it() -> None:
    """Nobody changed it for this course."""
    words = re.compile(r"lifecycle\.record|graders\.valve|LifecycleSeen")
    assert not [file for file in our_modules() if words.search(file.read_text("utf-8"))]
