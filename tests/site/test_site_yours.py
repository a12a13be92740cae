"""The site that is opened here knows what its student has done; a published one does not."""

from __future__ import annotations

import shutil
from contextlib import closing
from pathlib import Path
from typing import Any

import pytest
from two_days_site import Visit

from roslings.commands.built_site import forget, tell
from roslings.verdict import Environment, Timings, Verdict
from roslings.workspace import progress
from roslings_learn.drills.course import all_drills

pytestmark = pytest.mark.slow

DAY = "03-topics"


@pytest.fixture
def workspace(tmp_path: Path) -> Path:
    """Somebody with three drills of day 3 and 74 points in its lab."""
    place = Environment(
        roslings="0.1.0",
        ros_distro="jazzy",
        rmw="rmw_fastrtps_cpp",
        python="3.12",
        platform="Linux",
        isolation="namespace",
        clock="wall",
        seed=1,
    )
    verdict = Verdict(
        lab="topics",
        package="chatter",
        outcome="fail",
        score=74.0,
        checks=(),
        seconds=Timings(),
        environment=place,
    )
    progress.record(verdict, tmp_path)
    for each in [each.name for each in all_drills() if each.day == DAY][:3]:
        progress.record_drill(each, True, tmp_path)
    return tmp_path


def day_3(browser: Any, html: Path) -> str:
    """What the path says of day 3."""
    with closing(browser.new_context()) as context:
        visit = Visit(context, html.as_uri())
        state = visit.go("index.html").locator(f"[data-day='{DAY}'] .path-state").inner_text()
        assert visit.errors == []
        return str(state)


def test_the_path_shows_scores_and_drills(
    browser: Any, site: Path, workspace: Path, tmp_path: Path
) -> None:
    """Where it is opened; and a lab that has not passed does not end its day."""
    html = tmp_path / "html"
    shutil.copytree(site, html)
    assert day_3(browser, html) == ""
    script = (html / "_static/progress.js").read_bytes()
    for _ in range(2):  # opened again, it is told once
        tell(html, workspace)
    assert day_3(browser, html) == "3 of 10 drills · Lab 74 of 100"
    assert (html / "_static/progress.js").read_text("utf-8").count("roslings.tell(") == 1
    with closing(browser.new_context()) as context:
        page = Visit(context, html.as_uri()).go("index.html")
        missing = "roslings.missing({id: 'x', questions: [], labs: ['topics']}).labs.length"
        assert page.evaluate(missing)
        page.evaluate("roslings.passLab('topics', 100)")
        told = page.locator(f"[data-day='{DAY}'] .path-state").inner_text()
        assert told == "3 of 10 drills · Lab 100 of 100"
    forget(html)  # what is published tells of nobody
    assert (html / "_static/progress.js").read_bytes() == script


def test_who_has_done_nothing_sees_nothing(browser: Any, site: Path, tmp_path: Path) -> None:
    """No zeros."""
    html = tmp_path / "html"
    shutil.copytree(site, html)
    tell(html, tmp_path / "empty")
    assert day_3(browser, html) == ""
