"""What a lesson and its hints show, put together, is no solution of the lab."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
from given_away import module_of, package_of
from lesson_runs import lessons

from roslings.course import Lab, all_labs, root
from roslings.lessons.rules import Lesson

PAIRS = [
    (lesson, lab) for lesson in lessons() for lab in all_labs() if lab.card.day == lesson.day.id
]


@pytest.mark.slow
@pytest.mark.parametrize(("lesson", "lab"), PAIRS, ids=[lab.name for _, lab in PAIRS])
def test_pasting_all_of_it_does_not_pass(lesson: Lesson, lab: Lab, tmp_path: Path) -> None:
    """It builds and runs, and the lab still asks for more."""
    package, verdict = package_of(lesson, lab, tmp_path), tmp_path / "verdict.json"
    command = [sys.executable, "-m", "roslings", "check", lab.name, str(package)]
    done = subprocess.run(
        [*command, "--json", str(verdict)], capture_output=True, text=True, check=False,
        env={**os.environ, "PYTHONPATH": str(root() / "src")},
    )  # fmt: skip
    assert done.returncode == 1, done.stdout + done.stderr
    assert json.loads(verdict.read_text("utf-8"))["outcome"] == "fail"


@pytest.mark.parametrize("lab", all_labs(), ids=lambda lab: lab.name)
def test_hints_alone_make_a_module(lab: Lab, tiny_lesson: Lesson) -> None:
    """What is put together is Python, and holds what the lesson defines."""
    code = module_of(tiny_lesson, lab)
    compile(code, lab.name, "exec")
    assert "def main()" in code and "period = 0.1" in code
    assert "quiz(" not in code and "assert" not in code
