"""What a lesson and its hints show, put together, is no solution of the lab."""

from __future__ import annotations

import os
from pathlib import Path

import pytest
from given_away import module_of, package_of

from lesson_runs import lessons
from roslings.course import Lab, all_labs
from roslings_learn.lessons.rules import Lesson
from sources import python_path
from until_told import checked

LABS = all_labs()
PAIRS = [(lesson, lab) for lesson in lessons() for lab in LABS if lab.card.day == lesson.day.id]


@pytest.mark.slow
@pytest.mark.parametrize(("lesson", "lab"), PAIRS, ids=[lab.name for _, lab in PAIRS])
def test_pasting_all_of_it_does_not_pass(lesson: Lesson, lab: Lab, tmp_path: Path) -> None:
    """It builds and runs, and the lab still asks for more."""
    package = package_of(lesson, lab, tmp_path)
    env = {**os.environ, "PYTHONPATH": python_path()}
    found = checked(lab.name, package, folder=tmp_path, env=env)
    assert (found.status, found.verdict["outcome"]) == (1, "fail"), found.ran.stdout


@pytest.mark.parametrize("lab", LABS, ids=lambda lab: lab.name)
def test_hints_alone_make_a_module(lab: Lab, tiny_lesson: Lesson) -> None:
    """What is put together is Python, and holds what the lesson defines."""
    code = module_of(tiny_lesson, lab)
    compile(code, lab.name, "exec")
    assert "def main()" in code and "period = 0.1" in code
    assert "quiz(" not in code and "assert" not in code
