"""`explain` as it is typed: its answer is what the grader says of the same change."""

from __future__ import annotations

import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from roslings.course import Lab, lab
from until_told import run_until_told

pytestmark = pytest.mark.slow

QUESTION = re.compile(r"^\d of 3   (\S+), line (\d+)\n\n((?:    [-+] .*\n)+)\n.*? is (\w+):", re.M)
LABS = ["topics", "services"]
OTHERS = ["nodes", "distance-sensor", "actions", "serial-bridge", "pi-camera", "bring-up",
          "black-box", "e-stop"]  # fmt: skip


def typed(*words: str, ws: Path) -> subprocess.CompletedProcess[str]:
    """A command of the course, in a workspace of its own."""
    return run_until_told(
        [sys.executable, "-m", "roslings", *words], env={**os.environ, "ROSLINGS_WS": str(ws)},
        stdin=subprocess.DEVNULL,
    )  # fmt: skip


def package_of(asked: Lab, to: Path) -> Path:
    """A copy of the solution."""
    return Path(shutil.copytree(asked.solution, to / asked.outline.package))


@pytest.mark.parametrize(
    "name", [*LABS, *(pytest.param(name, marks=pytest.mark.twice) for name in OTHERS)]
)
def test_its_answer_is_what_a_check_says(name: str, tmp_path: Path) -> None:
    """Each change, found by what was printed and made by hand: the same check fails first."""
    asked = lab(name)
    package = package_of(asked, tmp_path)
    said = typed("explain", name, str(package), "--answers", ws=tmp_path / "ws")
    assert said.returncode == 0, said.stderr
    found = QUESTION.findall(said.stdout)
    assert len(found) == 3 and len({failed for *_, failed in found}) == 3, said.stdout
    for file, line, changed, failed in found:
        copy = Path(shutil.copytree(package, tmp_path / f"line-{line}" / package.name))
        make_by_hand(copy / file, int(line), changed)
        told = typed("check", name, str(copy), "--json", "-", ws=tmp_path / "ws")
        assert told.returncode == 1
        checks = json.loads(told.stdout)["checks"]
        assert next(each["id"] for each in checks if each["outcome"] == "fail") == failed


def make_by_hand(file: Path, line: int, changed: str) -> None:
    """As a person does who sees file, line, and lines with - and +."""
    shown = [(each[4], each[6:]) for each in changed.splitlines()]
    old, new = ([text for sign, text in shown if sign == kind] for kind in "-+")
    lines = file.read_text("utf-8").splitlines()
    there = lines[line - 1 : line - 1 + len(old)]
    assert [each.strip() for each in there] == [each.strip() for each in old]
    indent = " " * (len(there[0]) - len(there[0].lstrip()) - (len(old[0]) - len(old[0].lstrip())))
    lines[line - 1 : line - 1 + len(old)] = [indent + each for each in new]
    file.write_text("\n".join([*lines, ""]), "utf-8")


def test_a_package_that_does_not_pass_is_told(tmp_path: Path) -> None:
    """With the next step; nothing is asked."""
    topics = lab("topics")
    package = Path(shutil.copytree(topics.starter, tmp_path / "chatter"))
    said = typed("explain", "topics", str(package), ws=tmp_path / "ws")
    assert said.returncode == 1
    assert "explain asks about a package that passes" in said.stderr
    assert "check topics" in said.stderr and "line" not in said.stdout


def test_a_stranger_is_held_or_refused(tmp_path: Path) -> None:
    """As `check --as-stranger` does it."""
    topics = lab("topics")
    package = package_of(topics, tmp_path)
    said = typed("explain", "topics", str(package), "--as-stranger", ws=tmp_path / "ws")
    if said.returncode == 0:
        assert len(QUESTION.findall(said.stdout)) == 3
    else:
        assert "sandbox" in said.stderr or "wall" in said.stderr
