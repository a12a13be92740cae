"""The course as it is, as a site, with every lesson as `tests/days` has executed it."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import pytest
from site_rules import HEAVIEST_BYTES, Look, breaches, weight_bytes

from asked_for import MADE_FOR_ALL
from lesson_runs import kept_for_the_site, lessons, walked
from roslings.course import root
from roslings_learn.lessons import read_lessons
from skips import imported
from walks import Walk

sys.path.append(str(root() / "site"))
from course_site.gather import gather

imported("axe_playwright_python")

AT_ONCE = 3
"""Executions of lessons, which mostly wait."""


@pytest.mark.slow
@MADE_FOR_ALL
def test_the_course_is_a_site_that_keeps_all_rules(
    browser: Any, tmp_path: Path, shared_folder: Path
) -> None:
    """Strict: a warning ends the build. Each lesson and quiz is looked at.

    A lesson with a failing cell is not kept: the builder executes it itself, and ends with it.
    """
    written, cache = list(lessons()), tmp_path / ".jupyter_cache"
    with ThreadPoolExecutor(AT_ONCE) as executions:
        walks = list(executions.map(lambda lesson: walked(shared_folder, lesson), written))
    gathered = gather(root(), root() / "site/pages", tmp_path / "gathered").folder
    for lesson, walk in zip(written, walks, strict=True):
        if not walk.down:
            page = gathered / f"days/{lesson.day.id}/index.ipynb"
            kept_for_the_site(as_gathered(walk, page), cache)
    command = [sys.executable, "-m", "roslings", "site", "--out", str(tmp_path)]
    environment = {**os.environ, "ROSLINGS_COURSE": str(root())}
    done = subprocess.run(command, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    assert len([*cache.glob("executed/*")]) == len(written), "lessons were executed a second time"
    site = tmp_path / "html"
    assert str(site / "index.html") in done.stdout
    days = [f"days/{day.id}/{page}" for day in read_lessons(root()).days for page in PAGES]
    heavy = [page for page in days if weight_bytes(site / f"{page}.html") > HEAVIEST_BYTES]
    assert heavy == []
    for look in (Look(1280, "light"), Look(390, "light"), Look(1280, "dark")):
        assert breaches(browser, site, days, look) == []


def as_gathered(walk: Walk, page: Path) -> Walk:
    """The builder knows an execution by its cells, and by what is noted of them on the page."""
    noted = {cell["id"]: cell["metadata"] for cell in json.loads(page.read_text("utf-8"))["cells"]}
    book = json.loads(walk.executed)
    for cell in book["cells"]:
        cell["metadata"] = noted[cell["id"]]
    return walk.model_copy(update={"executed": json.dumps(book)})


PAGES = ("index", "quiz")
