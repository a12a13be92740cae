"""The course as it is, as a site, with every lesson as `tests/days` has executed it."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from site_rules import HEAVIEST_BYTES, Look, breaches, weight_bytes

from lesson_runs import kept_for_the_site, lessons, walked
from roslings.course import root
from roslings_learn.lessons import read_lessons
from skips import imported

imported("axe_playwright_python")


@pytest.mark.slow
def test_the_course_is_a_site_that_keeps_all_rules(
    browser: Any, tmp_path: Path, shared_folder: Path
) -> None:
    """Strict: a warning ends the build. Each lesson and quiz is looked at.

    A lesson with a failing cell is not kept: the builder executes it itself, and ends with it.
    """
    for lesson in lessons():
        walk = walked(shared_folder, lesson)
        if not walk.down:
            kept_for_the_site(walk, tmp_path / ".jupyter_cache")
    command = [sys.executable, "-m", "roslings", "site", "--out", str(tmp_path)]
    environment = {**os.environ, "ROSLINGS_COURSE": str(root())}
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    site = tmp_path / "html"
    assert str(site / "index.html") in done.stdout
    days = [f"days/{day.id}/{page}" for day in read_lessons(root()).days for page in PAGES]
    heavy = [page for page in days if weight_bytes(site / f"{page}.html") > HEAVIEST_BYTES]
    assert heavy == []
    for look in (Look(1280, "light"), Look(390, "light"), Look(1280, "dark")):
        assert breaches(browser, site, days, look) == []


PAGES = ("index", "quiz")
