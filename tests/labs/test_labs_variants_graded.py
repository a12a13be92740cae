"""A class with cards of the students' own: from `start --for` to the regrade, as the page says."""

from __future__ import annotations

import csv
import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from ros2_on_pip.errors import INCONCLUSIVE
from roslings.course import lab, root
from roslings.course.files import read_yaml
from roslings.course.variants import chosen
from roslings_prove.variants import InOwnWords, SolutionEdits
from until_told import until_told

PAGE = (root() / "site/pages/teachers/variants.md").read_text("utf-8")
TOPICS = lab("topics")
FILES = ("class.csv", "hand-ins", "grades")


def roslings(*words: str | Path, code: int, home: Path) -> str:
    """What a command prints, as soon as it can tell."""
    command = [sys.executable, "-m", "roslings", *map(str, words)]
    environment = {**os.environ, "HOME": str(home), "ROSLINGS_WS": str(home / "roslings_ws")}

    def ask() -> subprocess.CompletedProcess[str]:
        return subprocess.run(command, env=environment, capture_output=True, text=True, check=False)

    done = until_told(ask, lambda done: done.returncode == INCONCLUSIVE)
    assert done.returncode == code, done.stdout + done.stderr
    return done.stdout + done.stderr


def typed(part: str, folder: Path) -> list[str]:
    """The words of a command on the page, with its files in `folder`."""
    line = next(
        line for line in PAGE.splitlines() if line.startswith("./roslings") and part in line
    )
    return [
        str(folder / word) if word.partition("/")[0] in FILES else word for word in line.split()[1:]
    ]


def in_the_words_of(whose: str, folder: Path) -> None:
    """The hand-in of a student who did all of the lab."""
    own = chosen(TOPICS, whose)
    edits = read_yaml(TOPICS.folder / "variants_solution.yaml", SolutionEdits)
    made = InOwnWords(TOPICS, own.words, folder / "made", edits).make(folder / "scratch" / whose)
    shutil.copytree(made, folder / "hand-ins" / whose)


@pytest.mark.slow
def test_a_class_is_graded_by_the_own_cards(tmp_path: Path) -> None:
    """The same package is right for one and wrong for another; a regrade and a new list know it."""
    listed = tmp_path / "class.csv"
    listed.write_text("name,id\nAnna Berg,s1001\nBen Kaya,s1002\nKim Lee,s1003\n", "utf-8")
    words = [chosen(TOPICS, each).words for each in ("s1001", "s1002", "s1003")]
    assert words[0] != words[1]
    in_the_words_of("s1001", tmp_path)
    shutil.copytree(tmp_path / "hand-ins" / "s1001", tmp_path / "hand-ins" / "s1002")
    command = [
        word.replace("class.csv", str(tmp_path / "class.csv"))
        .replace("hand-ins", str(tmp_path / "hand-ins"))
        .replace("grades", str(tmp_path / "grades"))
        for word in next(line for line in PAGE.splitlines() if "--variants --out" in line).split()[
            1:
        ]
    ]
    roslings(*command, "--soak", "0", code=0, home=tmp_path)
    grades = tmp_path / "grades"

    def scores() -> dict[str, str]:
        with (grades / "grades.csv").open(encoding="utf-8") as file:
            return {row["id"]: row["measured"] for row in csv.DictReader(file)}

    first = scores()
    assert first["s1001"] == "100" and float(first["s1002"]) < 100 and first["s1003"] == ""
    failed = json.loads((grades / "students" / "s1002" / "verdict.json").read_text("utf-8"))
    assert {each["id"] for each in failed["checks"] if each["outcome"] == "fail"} & {
        "rate",
        "text",
        "hears",
    }
    page = (
        (grades / "students" / "s1002" / "page.html").read_text("utf-8")
        if (grades / "students" / "s1002" / "page.html").exists()
        else next((grades / "students" / "s1002").glob("*.html")).read_text("utf-8")
    )
    assert re.search(r"Judged by the card of s1002: rate [\d.]+", page)
    assert "How the rates spread" not in (grades / "class.html").read_text("utf-8")
    with (grades / "cards.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [row["for"] for row in rows] == ["s1001", "s1002", "s1003"]
    assert [float(row["rate"]) for row in rows] == [each["rate"] for each in words]
    said = roslings("regrade", "topics", grades, code=0, home=tmp_path)
    assert "2 judged again, 0 scores changed." in said
    assert scores() == first
    # Whose it is was wrong: what has another card now is graded anew, and nothing else.
    listed.write_text("name,id,submission\nAnna,s1001,s1002\nBen,s1009,s1001\n", "utf-8")
    roslings(*command, "--soak", "0", code=0, home=tmp_path)
    assert scores()["s1001"] == "100"
    # One hand-in alone, as the page says it.
    alone = [word.replace("anna", "s1001") for word in typed("check topics", tmp_path)]
    assert "100 of 100" in roslings(*alone, code=0, home=tmp_path)


@pytest.mark.slow
def test_a_student_begins_with_the_own_card(tmp_path: Path) -> None:
    """As the page says: the words that it prints are those of the page; the task has them, too."""
    printed = re.search(r"```text\n(.*?)```", PAGE, re.DOTALL)
    assert printed
    said = roslings(*typed("start topics", tmp_path), code=0, home=tmp_path)
    assert said.replace(str(tmp_path), "~").startswith(printed[1])
    task = re.search(r"^Read the task:\s+(\S+)$", said, re.M)
    assert task
    text = Path(task[1].replace("~", str(tmp_path))).read_text("utf-8")
    assert "`Step 0 is done`" in text and "Hello robotics" not in text
    package = tmp_path / "roslings_ws/src/chatter"
    shutil.rmtree(package)
    in_the_words_of("s1001", tmp_path)
    shutil.copytree(tmp_path / "hand-ins" / "s1001", package)
    assert "100 of 100" in roslings("check", "topics", code=0, home=tmp_path)
    everybodys = TOPICS.solution
    shutil.rmtree(package)
    shutil.copytree(everybodys, package)
    assert "100 of 100" not in roslings("check", "topics", code=1, home=tmp_path)
    hint = roslings("check", "topics", "--hint", code=1, home=tmp_path)
    assert "hint" in hint.lower()
    roslings("pack", "topics", "--soak", "0", "--out", tmp_path / "a.zip", code=0, home=tmp_path)
    assert (tmp_path / "a.zip").is_file()
