"""The site in the false language: the first page and day 1, as readers see them in a browser.

The days are the real ones. Their cells are not run: code is the same in each language.
"""

from __future__ import annotations

import json
import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from site_rules import Look, breaches
from two_days_site import TWO_DAYS, Visit, build, write_course

from plain_english import plain
from ros2_on_pip.false_language import false
from ros2_on_pip.language import FALSE
from roslings.course import root

pytestmark = pytest.mark.slow

DAY = "days/01-install"
PAGES = (f"{DAY}/first-15-minutes", f"{DAY}/index", f"{DAY}/quiz", "index", "review", "labs/topics")
READ = """() => {
    const skipped = "code, pre, script, style, template, noscript, svg, kbd, .cell_output";
    const place = (element) => {
        const names = [];
        for (let at = element; at && names.length < 3; at = at.parentElement) {
            names.unshift(at.tagName.toLowerCase() + (at.className ? "." + at.className : ""));
        }
        return names.join(" > ");
    };
    const found = [];
    const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    while (walker.nextNode()) {
        const parent = walker.currentNode.parentElement;
        const text = walker.currentNode.textContent;
        if (text.trim() && !parent.closest(skipped)) found.push([text, place(parent)]);
    }
    const aloud = "[aria-label], [title], img[alt], [placeholder]";
    for (const element of document.querySelectorAll(aloud)) {
        for (const name of ["aria-label", "title", "alt", "placeholder"]) {
            const text = element.getAttribute(name);
            if (text && text.trim()) found.push([text, `${place(element)} ${name}`]);
        }
    }
    found.push([document.title, "the page's title"]);
    return found;
}"""
"""Every text of a page with its place: also what is folded, and what is only read aloud."""
NAMES = frozenset({"Furo", "pradyunsg", "source", "export"})
"""The theme, and commands that a quiz has in its steps."""


@pytest.fixture(scope="module")
def false_course(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The real day 1 with its pages, quiz and words, beside day 3 of the tests."""
    course = write_course(tmp_path_factory.mktemp("false") / "course")
    shutil.rmtree(course / DAY)
    shutil.copytree(root() / DAY, course / DAY, ignore=shutil.ignore_patterns("drills"))
    shutil.copy(TWO_DAYS / "01-install/page.md", course / DAY)  # day 3 of the tests leads to it
    (course / "days/03-topics/quiz.yaml").unlink()  # and asks again what another day 1 asked
    for lesson in course.glob("days/*/lesson.ipynb"):
        notebook = json.loads(lesson.read_text("utf-8"))
        notebook["metadata"]["mystnb"] = {"execution_mode": "off"}
        lesson.write_text(json.dumps(notebook), "utf-8")
    return course


@pytest.fixture(scope="module")
def false_site(false_course: Path) -> Path:
    """Built by the real builder, every warning an error."""
    done = build(false_course, "--language", "en-XA")
    assert done.returncode == 0, done.stdout + done.stderr
    return false_course / "out" / "html"


@pytest.fixture
def visit(browser: Any, false_site: Path) -> Iterator[Visit]:
    """From the file; no script fails."""
    context = browser.new_context(viewport={"width": 1280, "height": 900})
    context.set_default_timeout(30_000)
    visit = Visit(context, false_site.as_uri())
    yield visit
    context.close()
    assert visit.errors == []


@pytest.mark.parametrize("name", PAGES)
def test_no_plain_english_is_left(visit: Visit, name: str) -> None:
    """In the text, the menus, the boxes and buttons, and what a screen reader says."""
    page = visit.go(f"{name}.html")
    found = plain([(text, f"{name}: {where}") for text, where in page.evaluate(READ)], NAMES)
    assert not found, "\n".join(found)


def test_what_the_scripts_say_is_asked_for_by_id(visit: Visit) -> None:
    """An answer in a quiz, and a copied command."""
    page = visit.go(f"{DAY}/quiz.html")
    for button in page.locator("form.question button[type=submit]").all():
        button.click()
    outcomes = page.locator(".outcome").all_inner_texts()
    assert false("Answer first, then press Check.") in outcomes
    assert not plain((each, "outcome") for each in outcomes)
    page = visit.go(f"{DAY}/index.html")
    assert page.locator("button.copy").first.inner_text() == false("Copy")


def test_plain_english_is_found(visit: Visit) -> None:
    """Else the silence of the tests above would mean nothing."""
    page = visit.go(f"{PAGES[0]}.html")
    page.evaluate("document.querySelector('h1').append(' Look here')")
    (first, *_) = plain(map(tuple, page.evaluate(READ)), NAMES)
    assert first.startswith("'Look' in ")
    assert "h1" in first


@pytest.mark.parametrize("width", [390, 1280])
def test_nothing_is_wider_than_the_screen(browser: Any, false_site: Path, width: int) -> None:
    """Words a third longer, as German has them, with all open that is folded."""
    context = browser.new_context(viewport={"width": width, "height": 900})
    visit = Visit(context, false_site.as_uri())
    wide = [name for name in PAGES if width_of(visit, name) > width]
    context.close()
    assert wide == []


def width_of(visit: Visit, name: str) -> int:
    """Of a page's content, in CSS pixels."""
    page = visit.go(f"{name}.html")
    page.evaluate("document.querySelectorAll('details').forEach(part => part.open = true)")
    return int(page.evaluate("document.documentElement.scrollWidth"))


def test_the_rules_of_accessibility_hold(browser: Any, false_site: Path) -> None:
    """The language of the page is told, and what is read aloud has a name."""
    assert breaches(browser, false_site, PAGES[:2], Look(390, "light")) == []


def test_links_lead_to_the_same_places_in_each_language(
    false_course: Path, false_site: Path
) -> None:
    """A heading's id is that of its English, so a link from elsewhere holds."""
    page = (false_site / f"{DAY}/index.html").read_text("utf-8")
    for place in ("three-ways", "the-doctor", "prepare-the-pi"):
        assert f"#{place}" in page
    assert '<section id="three-ways">' in page
    assert f"<h2>{false('Three ways')}<" in page


def test_a_language_without_a_translation_says_how_one_begins(false_course: Path) -> None:
    """Nothing is built in English under another name."""
    done = build(false_course, "--language", "de")
    assert done.returncode == 1
    assert "There is no translation into 'de' yet" in done.stderr
    assert "./roslings site --catalogue --language de" in done.stderr


def test_what_is_translated_by_gettext_stands_on_the_page(false_course: Path) -> None:
    """A translator's file is filled in: its text is on the page, all else is English."""
    course = false_course.parent / "translated"
    shutil.copytree(false_course, course, ignore=shutil.ignore_patterns("out"))
    wrote = build(course, "--catalogue", "--language", "de")
    assert wrote.returncode == 0, wrote.stderr
    po = course / f"site/languages/de/LC_MESSAGES/{DAY}/first-15-minutes.po"
    text = po.read_text("utf-8")
    heading = 'msgid "The first 15 minutes"\nmsgstr ""'
    assert heading in text
    po.write_text(text.replace(heading, heading[:-1] + 'Die ersten 15 Minuten"'), "utf-8")
    drawings = course / DAY / "pictures"
    shutil.copy(drawings / "rover.svg", drawings / "rover.de.svg")
    built = build(course, "--language", "de")
    assert built.returncode == 0, built.stdout + built.stderr
    page = (course / "out" / "html" / f"{PAGES[0]}.html").read_text("utf-8")
    assert '<html class="no-js" lang="de"' in page
    assert "<h1>Die ersten 15 Minuten<" in page
    assert "Drive a little, and let it run." in page
    assert "rover.de.svg" in (course / "out" / "html" / f"{DAY}/index.html").read_text("utf-8")


def test_the_false_language_is_told_as_what_it_is() -> None:
    """Its name is that of pseudo-locales everywhere."""
    assert FALSE == "en_XA"
