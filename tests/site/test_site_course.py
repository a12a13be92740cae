"""The course as it is, as a site: every lesson is executed, so this takes minutes."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from site_rules import Look, breaches

from roslings.course import root
from roslings.lessons import read_lessons

pytest.importorskip("axe_playwright_python")


@pytest.mark.slow
def test_the_course_is_a_site_that_keeps_all_rules(browser: Any, tmp_path: Path) -> None:
    """Strict: a warning or a failing cell ends the build. Each lesson and quiz is looked at."""
    command = [sys.executable, "-m", "roslings", "site", "--out", str(tmp_path)]
    environment = {**os.environ, "ROSLINGS_COURSE": str(root())}
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    site = tmp_path / "html"
    assert str(site / "index.html") in done.stdout
    days = [f"days/{day.id}/{page}" for day in read_lessons(root()).days for page in PAGES]
    for look in (Look(1280, "light"), Look(390, "light"), Look(1280, "dark")):
        assert breaches(browser, site, days, look) == []


PAGES = ("index", "quiz")
