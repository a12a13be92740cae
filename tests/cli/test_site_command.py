"""`./roslings site` where a site lies already: it opens, and nothing is built or installed."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from roslings.commands import built_site
from roslings.commands.built_site import (
    BROUGHT,
    BUILT_HERE,
    forget,
    is_up_to_date,
    note_texts,
    tell,
)
from roslings.course import root
from roslings_class import release
from roslings_learn.drills import all_drills

SCRIPT = "window.roslings = {};\n"
BROWSER = '#!/bin/sh\necho "$1" >> "$0.log"\n'


@pytest.fixture
def course(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A course with one text and its site, as the students' edition has both."""
    (drill := tmp_path / "course/days/01-install/drills/01_letter").mkdir(parents=True)
    (drill / "drill.yaml").touch()
    (tmp_path / "course/days/01-install/page.md").write_text("# A page\n")
    lay_site(tmp_path / "course", BROUGHT)
    monkeypatch.setenv("ROSLINGS_COURSE", str(tmp_path / "course"))
    return tmp_path / "course"


def lay_site(course: Path, place: Path) -> Path:
    """A site of one page, made of the course's texts."""
    html = course / place
    (html / "_static").mkdir(parents=True)
    (html / "index.html").write_text("<p>A page</p>")
    (html / built_site.SCRIPT).write_text(SCRIPT)
    note_texts(html, course)
    return html


def site(course: Path, *words: str, screen: bool = True) -> tuple[str, list[str]]:
    """Type it; what was printed, and the addresses that a browser was given."""
    browser = course.parent / "browser"
    browser.write_text(BROWSER)
    browser.chmod(0o755)
    hidden = ("DISPLAY", "WAYLAND_DISPLAY", "WSL_DISTRO_NAME")
    plain = {name: value for name, value in os.environ.items() if name not in hidden}
    own = {"BROWSER": f"{browser} %s", "ROSLINGS_WS": str(course.parent / "ws")}
    done = subprocess.run(
        [sys.executable, "-m", "roslings", "site", *words],
        env={**plain, **own, **({"DISPLAY": ":0"} if screen else {})},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    log = Path(f"{browser}.log")
    return done.stdout, log.read_text().splitlines() if log.exists() else []


def test_a_site_that_is_there_opens(course: Path) -> None:
    """The one that came along; one that was built here is newer, and goes before."""
    assert site(course)[1] == [(course / BROUGHT / "index.html").as_uri()]
    own = lay_site(course, BUILT_HERE)
    told, opened = site(course)
    assert opened[-1] == (own / "index.html").as_uri()
    assert str(own / "index.html") in told and "has changed" not in told


def test_without_a_screen_it_says_where_it_is(course: Path) -> None:
    """A browser of letters is not wanted in the middle of a terminal, unless it is asked for."""
    told, opened = site(course, screen=False)
    assert opened == [] and str(course / BROUGHT / "index.html") in told
    assert (course / BROUGHT / built_site.SCRIPT).read_text() == SCRIPT
    assert len(site(course, "--open", screen=False)[1]) == 1


def test_it_says_when_the_course_has_changed(course: Path) -> None:
    """The old one opens all the same: who has no half hour to build reads on."""
    (course / "days/01-install/page.md").write_text("# Another page\n")
    told, opened = site(course)
    assert "has changed" in told and "site --build" in told and len(opened) == 1


def test_what_it_is_made_of_is_known_by_content_alone(course: Path) -> None:
    """Neither the time of a file nor what Python leaves beside it counts."""
    html, page = course / BROUGHT, course / "days/01-install/page.md"
    os.utime(page, (1, 1))
    (page.parent / "__pycache__").mkdir()
    (page.parent / "__pycache__" / "x.pyc").touch()
    assert is_up_to_date(html, course)
    page.rename(page.with_name("other.md"))
    assert not is_up_to_date(html, course)
    (html / built_site.RECORD).write_bytes(b"\xff")
    assert not is_up_to_date(html, course)
    (html / built_site.RECORD).unlink()
    assert not is_up_to_date(html, course)


def test_a_site_that_cannot_be_written_opens(course: Path) -> None:
    """It only lacks what the student has done, and says so."""
    (course / BROUGHT / built_site.SCRIPT).unlink()
    assert len(site(course)[1]) == 1


def test_what_is_told_of_a_student_is_told_once_and_taken_back(course: Path) -> None:
    """The next one who opens it is another one, perhaps."""
    html = course / BROUGHT
    tell(html, course.parent / "ws")
    tell(html, course.parent / "ws")
    script = html / built_site.SCRIPT
    assert script.read_text().count("roslings.tell(") == 1
    assert '{"01-install": [0, 1]}' in script.read_text()
    forget(html)
    assert script.read_text() == SCRIPT


def test_days_have_as_many_drills_as_their_cards_say(monkeypatch: pytest.MonkeyPatch) -> None:
    """Counted by folders here, where no card can be read."""
    monkeypatch.delenv("ROSLINGS_COURSE", raising=False)
    told = built_site.yours(root() / "no workspace")["drills"]
    days = [each.day for each in all_drills()]
    assert told == {day: [0, days.count(day)] for day in sorted(set(days))}


# --- the students' edition brings it ------------------------------------------------------------


def test_an_edition_brings_the_site_and_tells_of_nobody(course: Path, tmp_path: Path) -> None:
    """Its commands name the example, as those of all texts; it is up to date there, too."""
    shown = '<span>./roslings</span><span class="w"> </span>check topics --solution'
    html = lay_site(course, BUILT_HERE)
    (html / "index.html").write_text(f"<p>{shown}</p><p>./roslings check topics --solution</p>")
    tell(html, tmp_path / "ws")
    edition = tmp_path / "edition"
    (edition / "days").mkdir(parents=True)
    assert release._bring_the_site(edition) is None
    release.rewrite_texts(edition)
    note_texts(edition / BROUGHT, edition)
    page = (edition / BROUGHT / "index.html").read_text()
    assert page.count("example") == 2 and "topics" not in page
    assert (edition / BROUGHT / built_site.SCRIPT).read_text() == SCRIPT
    assert is_up_to_date(edition / BROUGHT, edition)


def test_an_edition_without_a_site_says_how_it_gets_one(course: Path, tmp_path: Path) -> None:
    """An old one is not brought: it would show another course."""
    (course / "days/01-install/page.md").write_text("# Another page\n")
    assert release._bring_the_site(tmp_path / "edition") == release.OLD_SITE
    (course / BROUGHT / "index.html").unlink()
    assert release._bring_the_site(tmp_path / "edition") == release.NO_SITE
    assert "./roslings site --build" in release.NO_SITE
    assert not (tmp_path / "edition").exists()
