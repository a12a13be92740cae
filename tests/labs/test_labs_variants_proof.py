"""Each value that a student's card may have is a right one, and is judged: graded for real."""

from __future__ import annotations

import subprocess
import sys

import pytest

from roslings.course import all_labs
from roslings.course.variants import variants_of

LABS = [lab.name for lab in all_labs() if variants_of(lab)]


@pytest.mark.slow
@pytest.mark.parametrize("name", LABS)
def test_prove_variants(name: str) -> None:
    """By the command that the page for instructors tells."""
    done = subprocess.run(
        [sys.executable, "-m", "roslings", "prove", name, "--variants", "--all"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert done.stdout.count("in these words gets 100 of 100") == 3
    assert done.stdout.count("in everybody's words does not pass") == 3
    assert f"The lab {name!r} is proven: its variants only." in done.stdout


def test_a_lab_without_a_choice_says_so() -> None:
    """And grades nothing."""
    done = subprocess.run(
        [sys.executable, "-m", "roslings", "prove", "nodes", "--variants"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 2
    assert "The lab 'nodes' has one card for everybody" in done.stderr
