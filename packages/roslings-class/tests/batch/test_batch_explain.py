"""`grade --explain`: questions about the hand-ins that pass, and about no others."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from roslings.course import lab

pytestmark = pytest.mark.slow

QUESTION = re.compile(r"^\d of 3   \S+, line \d+$", re.M)


def grade(submissions: Path, out: Path) -> str:
    """What the command prints."""
    done = subprocess.run(
        [
            sys.executable,
            "-m",
            "roslings",
            "grade",
            "nodes",
            str(submissions),
            "--out",
            str(out),
            "--explain",
            "--soak",
            "0",
        ],
        env={**os.environ},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


def test_who_passes_gets_three_questions_with_answers(tmp_path: Path) -> None:
    """A second run makes none anew, but for what was handed in anew."""
    nodes = lab("nodes")
    submissions, out = tmp_path / "submissions", tmp_path / "grades"
    for name, source in {"anna": nodes.solution, "ben": nodes.starter}.items():
        shutil.copytree(source, submissions / name / nodes.outline.package)
    said = grade(submissions, out)
    assert "Questions, with answers, about 1 of 2 hand-ins:" in said
    (file,) = (out / "explain").iterdir()
    text = file.read_text("utf-8")
    assert file.name == "anna.txt" and len(QUESTION.findall(text)) == 3
    assert text.count("The first check that fails is") == 3
    file.write_text(f"{text}My note.\n", "utf-8")
    grade(submissions, out)
    assert file.read_text("utf-8").endswith("My note.\n")
    module = next((submissions / "anna").rglob("minimal_publisher.py"))
    module.write_text(module.read_text("utf-8") + "\n# another word\n", "utf-8")
    grade(submissions, out)
    assert "My note." not in file.read_text("utf-8")
    assert len(QUESTION.findall(file.read_text("utf-8"))) == 3
