"""Every page at two widths, light and dark: accessible, inside the screen; search and print."""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import Any

import pytest
from site_rules import Look, breaches, pages_of
from two_days_site import Visit

from roslings.course import root
from roslings_learn.lessons.document import read
from roslings_learn.lessons.path import Path as DayPath
from skips import imported

pytestmark = pytest.mark.slow

Axe = imported("axe_playwright_python.sync_playwright").Axe

COVERS_THE_FIRST_LINE = """button => {
    const pre = button.previousElementSibling, style = getComputedStyle(pre);
    const { left, width } = button.getBoundingClientRect();
    const above = parseFloat(style.borderTopWidth) + parseFloat(style.paddingTop);
    pre.scrollIntoView({ block: "center" });
    const y = pre.getBoundingClientRect().top + above + parseFloat(style.lineHeight) / 2;
    return document.elementFromPoint(left + width / 2, y) === button;
}"""
MUST_BE_THERE = {
    "index",
    "glossary",
    "review",
    "search",
    "labs/index",
    "labs/topics",
    "reference/commands",
    "reference/doctor",
    "reference/messages",
    "reference/lifecycle",
    "reference/tf-and-scan",
    "reference/colcon-test",
    "reference/whole-robot",
    "reference/micro-ros",
    "reference/distributions",
    "reference/ros1",
    "reference/faq",
    "teachers/index",
    "teachers/hand-ins",
    "teachers/exports",
    "teachers/api",
    "days/01-install/index",
    "days/01-install/quiz",
    "days/01-install/answers",
    "days/03-topics/index",
    "days/03-topics/quiz",
}


def test_no_page_is_missing(site: Path) -> None:
    """The issue's list of pages, and those of the two days."""
    assert set(pages_of(site)) >= MUST_BE_THERE


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("width", [1280, 390])
def test_no_page_breaks_a_rule_of_accessibility(
    browser: Any, site: Path, width: int, scheme: str
) -> None:
    """axe-core's rules, best practices included; nothing wider than the screen; no other host."""
    assert breaches(browser, site, pages_of(site), Look(width, scheme)) == []


def test_an_open_popover_and_a_checked_quiz_are_accessible(browser: Any, site: Path) -> None:
    """What appears later keeps the rules too."""
    context = browser.new_context(viewport={"width": 390, "height": 900}, color_scheme="dark")
    visit = Visit(context, site.as_uri())
    page = visit.go("days/01-install/index.html")
    page.locator("button.word").first.focus()
    assert Axe().run(page).generate_snapshot() == ""
    page = visit.go("days/01-install/quiz.html")
    for form in page.locator("form.question").all():
        if form.locator("input").count():
            form.locator("input").nth(1).check()
        form.get_by_role("button", name="Check", exact=True).click()
    assert page.locator(".why:visible").count() >= 3
    assert Axe().run(page).generate_snapshot() == ""
    context.close()


def test_axe_sees_what_is_wrong(browser: Any, site: Path) -> None:
    """Else its silence would mean nothing."""
    page = browser.new_page()
    page.goto((site / "index.html").as_uri())
    page.evaluate("document.querySelector('article').innerHTML += '<img src=\"x.png\">'")
    assert "image-alt" in Axe().run(page).generate_snapshot()
    page.close()


def test_search_finds_words_and_pages(visit: Visit) -> None:
    """From a file too, where a page may not fetch."""
    page = visit.go("index.html")
    page.get_by_placeholder("Search").first.fill("deadlock")
    page.keyboard.press("Enter")
    result = page.locator("#search-results li a", has_text="deadlock").first
    result.wait_for()
    result.click()
    page.locator("#word-deadlock").wait_for(state="visible")


def test_search_puts_titles_first_and_raises_no_error(visit: Visit) -> None:
    """Also where words of an earlier search are remembered; errors are looked at by `visit`."""
    page = visit.go("index.html")
    page.evaluate("localStorage.setItem('sphinx_highlight_terms', 'topic')")
    page = visit.go("search.html?q=topic")
    first = page.locator("#search-results li a").first
    first.wait_for()
    assert "topic" in first.inner_text().lower().split(" > ")[-1]
    assert not first.inner_text().startswith("The engine")


def test_the_front_page_begins_and_tells_where_the_reader_is(visit: Visit) -> None:
    """Two buttons, a rover that is there, a verdict of the engine, and the first open day."""
    page = visit.go("index.html")
    rover = page.locator(".hero img")
    assert rover.evaluate("image => image.complete && image.naturalWidth > 0")
    verdict = page.locator(".hero pre.verdict")
    assert "fail" in verdict.inner_text()
    assert "Next " in verdict.inner_text()
    for width in (1280, 390):
        page.set_viewport_size({"width": width, "height": 900})
        assert verdict.evaluate("pre => pre.scrollWidth <= pre.clientWidth")
    here = page.locator(".path-day.here")
    assert here.get_attribute("data-day") == "01-install"
    page.evaluate("roslings.finishDay('01-install')")
    assert here.get_attribute("data-day") == "02-nodes"
    page.get_by_role("link", name="A day in one window").click()
    told = page.locator("#the-day-in-one-window")
    assert "./roslings lab 5" in told.inner_text()
    page.go_back()
    page.get_by_role("link", name="Drive a robot in 15 minutes").click()
    page.locator("h1").first.wait_for()


def test_the_path_tells_how_long_it_takes(visit: Visit) -> None:
    """How many days, on the front page, and how many hours and weeks that is."""
    days = read(root() / "days" / "path.yaml", DayPath).content.days
    lead = visit.go("index.html").locator(".hero .lead").inner_text()
    assert lead.startswith(f"{len(days)} days")
    said = visit.go("reference/faq.html").locator("#how-long-does-it-take").inner_text()
    hours = sum(day.hours for day in days)
    assert f"{hours:g} hours in all" in said
    assert f"{math.ceil(hours / 6)} weeks" in said


def test_a_lesson_tells_how_to_open_it(visit: Visit) -> None:
    """Nothing runs on the page, so it asks for no keys."""
    page = visit.go("days/03-topics/index.html")
    assert page.locator(".run-box pre").inner_text().strip() == "./roslings lab 3"
    assert "press Shift" not in page.locator("article").inner_text()


def test_the_first_screen_of_a_lesson_has_its_card_and_its_drawing(visit: Visit) -> None:
    """Goal, level, time and need; then the picture, before any code; the imports are folded."""
    page = visit.go("days/03-topics/index.html")
    labels = page.locator(".day-card li strong").all_inner_texts()
    assert [label.rstrip(":.") for label in labels] == ["Goal", "Level", "Time", "You need"]
    pictures = page.locator("article img")
    assert pictures.count() == 2  # the lesson has it last: it has moved, and stands there once
    assert "rover" in pictures.first.get_attribute("src")
    assert "rover" not in pictures.last.get_attribute("src")
    box = pictures.first.bounding_box()
    assert box
    assert box["y"] + box["height"] < 900
    assert page.locator(".cell_input:visible").first.bounding_box()["y"] > box["y"]
    imports = page.locator("details", has_text="The imports of this page").locator("pre").first
    assert not imports.is_visible()
    page.get_by_text("The imports of this page").click()
    assert imports.is_visible()


def test_what_the_reader_does_stands_in_a_box(visit: Visit) -> None:
    """What to guess, and what to change: there, what it says before waits for a click."""
    page = visit.go("days/03-topics/index.html")
    assert page.locator("p.guess").inner_text().startswith("Before you run:")
    turn = page.locator(".your-turn")
    assert turn.inner_text().startswith("Your turn")
    assert "number = 3" in turn.locator(".cell_input").inner_text()
    output = turn.locator(".cell_output")
    assert not output.is_visible()
    turn.get_by_text("before you change it").click()
    assert "Still 3" in output.inner_text()


def test_what_a_cell_prints_waits_where_the_reader_guesses_first(visit: Visit) -> None:
    """It is there for who reads without ROS, after a click."""
    page = visit.go("days/03-topics/index.html")
    summary = page.get_by_text("What it prints: guess first")
    folded = page.locator("details.folded", has=summary).first
    output = folded.locator(".cell_output")
    assert not output.is_visible()
    folded.locator("summary").click()
    assert output.is_visible() and output.inner_text().strip()


def test_a_folded_part_is_open_on_paper(visit: Visit) -> None:
    """Nobody can click there."""
    page = visit.go("days/03-topics/index.html")
    folded = page.locator("details.folded, .page-words details")
    assert folded.count() > 2
    page.evaluate("dispatchEvent(new Event('beforeprint'))")
    assert folded.evaluate_all("parts => parts.every(part => part.open)")


def test_a_drawing_is_dark_on_a_dark_page_unless_it_is_a_terminal(browser: Any, site: Path) -> None:
    """White drawings are turned round; a terminal is dark already."""
    context = browser.new_context(color_scheme="dark")
    look = "image => getComputedStyle(image).filter"
    visit = Visit(context, site.as_uri())
    drawing = visit.go("days/03-topics/index.html").locator("article img").first
    assert "invert" in drawing.evaluate(look)
    terminal = visit.go("labs/topics.html").locator("article img.terminal")
    assert terminal.evaluate(look) == "none"
    context.close()


def test_a_comment_is_quiet_in_the_dark(browser: Any, site: Path) -> None:
    """It has the colour of what stands beside the text, and no bright one."""
    context = browser.new_context(color_scheme="dark")
    page = Visit(context, site.as_uri()).go("days/03-topics/index.html")
    colour = "part => getComputedStyle(part).color"
    comment = page.locator(".your-turn .c").first
    assert comment.inner_text().startswith("# Change")
    assert comment.evaluate(colour) == "rgb(180, 189, 198)"
    context.close()


def test_a_drawing_on_a_phone_can_be_read_and_scrolled(browser: Any, site: Path) -> None:
    """Wider than the screen, in a holder that scrolls and that the keyboard reaches."""
    context = browser.new_context(viewport={"width": 390, "height": 900})
    drawing = Visit(context, site.as_uri()).go("days/03-topics/index.html").locator("article img")
    assert drawing.first.evaluate("image => image.clientWidth") > 390
    holder = drawing.first.locator("xpath=..")
    assert holder.evaluate("part => part.clientWidth < 390 && part.scrollWidth > 390")
    assert holder.evaluate("part => part.tabIndex") == 0
    context.close()


def test_code_can_be_read_and_copied(visit: Visit) -> None:
    """14.5 pixels, a button, and the two sides of a diff in two colours."""
    page = visit.go("days/01-install/page.html")
    diff = page.locator(".highlight-diff pre")
    assert diff.evaluate("pre => parseFloat(getComputedStyle(pre).fontSize)") >= 14.4
    assert diff.evaluate("pre => getComputedStyle(pre).borderTopWidth") == "1px"
    colour = "part => getComputedStyle(part).color"
    assert diff.locator(".gd").evaluate(colour) != diff.locator(".gi").evaluate(colour)
    if visit.base.startswith("http"):  # a file has no clipboard
        button = page.locator(".highlight-diff button.copy")
        assert button.is_visible()
        assert not button.evaluate(COVERS_THE_FIRST_LINE)


def test_a_lab_is_a_card_with_its_names(visit: Visit) -> None:
    """Nodes and topics of its card, each kind in its colour, once."""
    page = visit.go("labs/index.html")
    card = page.locator(".lab-card")
    assert card.locator(".node code").all_inner_texts() == ["/talker", "/listener"]
    assert card.locator(".topic code").all_inner_texts() == ["/chatter"]
    ground = "part => getComputedStyle(part).backgroundColor"
    assert card.locator(".node").first.evaluate(ground) != card.locator(".topic").evaluate(ground)
    assert "./roslings start topics" in card.locator("pre").inner_text()
    card.get_by_role("link").click()
    assert page.url.endswith("labs/topics.html")


def test_the_side_bar_has_one_entry_a_day(visit: Visit) -> None:
    """The quiz stands below its day."""
    page = visit.go("index.html")
    days = page.locator(".sidebar-tree .toctree-l1", has_text=re.compile(r"Day \d"))
    assert days.count() == 2
    assert days.first.locator("li", has_text="Quiz").count() == 1


def test_dark_mode_is_a_choice_that_stays(visit: Visit) -> None:
    """The button goes round, and the next page remembers."""
    page = visit.go("index.html")
    colour = "getComputedStyle(document.body).backgroundColor"
    first = page.evaluate(colour)
    button = page.locator("button.theme-toggle:visible").first
    seen = []
    for _ in range(3):
        button.click()
        seen.append((page.evaluate("document.body.dataset.theme"), page.evaluate(colour)))
        if seen[-1][0] == "dark":
            break
    assert seen[-1][0] == "dark"
    assert seen[-1][1] != first
    assert visit.go("glossary.html").evaluate("document.body.dataset.theme") == "dark"


def test_print_shows_the_lesson_and_not_the_menus(visit: Visit) -> None:
    """The words of the page stay, as a list."""
    page = visit.go("days/01-install/index.html")
    page.emulate_media(media="print")
    assert page.locator("article h1").is_visible()
    assert page.locator(".page-words").is_visible()
    for hidden in (".sidebar-drawer", ".toc-drawer", ".related-pages", ".drop"):
        assert not page.locator(hidden).first.is_visible()


def test_every_link_inside_the_site_leads_somewhere(visit: Visit, site: Path) -> None:
    """Pages and places on pages."""
    broken = []
    for name in pages_of(site):
        page = visit.go(f"{name}.html")
        links = page.evaluate("[...document.querySelectorAll('article a[href]')].map(a => a.href)")
        for link in links:
            target, _, place = link.removeprefix(visit.base + "/").partition("#")
            if link.startswith(visit.base) and not _is_there(site / target, place):
                broken.append(f"{name}: {link}")
    assert broken == []


def _is_there(file: Path, place: str) -> bool:
    return file.is_file() and (not place or f'id="{place}"' in file.read_text("utf-8"))


def test_a_wide_part_can_be_scrolled_by_keyboard(browser: Any, site: Path) -> None:
    """On a phone, long code is wider than the screen."""
    context = browser.new_context(viewport={"width": 390, "height": 900})
    page = context.new_page()
    page.goto((site / "reference/messages.html").as_uri())
    wide = page.evaluate(
        "[...document.querySelectorAll('pre')].filter(p => p.scrollWidth > p.clientWidth)"
        ".map(p => p.tabIndex)"
    )
    assert wide
    assert set(wide) == {0}
    context.close()
