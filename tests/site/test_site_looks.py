"""What people look at: drawings and code on every page, the front page, and a lab's page."""

from __future__ import annotations

import sys
from base64 import b64decode
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path
from typing import Any

import pytest
from site_rules import pages_of
from two_days_site import Visit

from roslings.course import root

sys.path.append(str(root() / "site"))
from course_site.picture_sizes import DATA, LEAST_TEXT_PX, smallest_text, width_of

pytestmark = pytest.mark.slow

WIDE_PX, PHONE_PX = 1280, 390
LEAST_GAP_PX = 8
MOST_EMPTY_PX = 24
"""Of the front page's drawing and the verdict beside it, one may end so much before the other."""
IMAGES = """() => [...document.querySelectorAll("article img")]
    .map(image => [image.currentSrc || image.src, image.getBoundingClientRect().width])"""
OPEN_ALL = "document.querySelectorAll('details').forEach(part => part.open = true)"
CUT = """() => [...document.querySelectorAll("article pre")]
    .filter(pre => pre.scrollWidth > pre.clientWidth + 1)
    .map(pre => pre.innerText.slice(0, 60))"""


@pytest.fixture
def looked_at(browser: Any, site: Path) -> Iterator[Visit]:
    """From the file, as wide as a test wants it."""
    context = browser.new_context(viewport={"width": WIDE_PX, "height": 900})
    context.set_default_timeout(30_000)
    visit = Visit(context, site.as_uri())
    yield visit
    context.close()
    assert visit.errors == []


def opened(visit: Visit, name: str) -> Any:
    """A page with all that is folded."""
    page = visit.go(f"{name}.html")
    page.evaluate(OPEN_ALL)
    return page


def small_letters(page: Any) -> Iterator[str]:
    """Each drawing with letters that are too small as it stands there."""
    for address, wide_px in page.evaluate(IMAGES):
        if ".svg" not in address and not address.startswith(DATA):
            continue
        is_data = address.startswith(DATA)
        svg = (
            b64decode(address.removeprefix(DATA)).decode()
            if is_data
            else Path(address.removeprefix("file://")).read_text("utf-8")
        )
        if (px := smallest_text(svg) * wide_px / width_of(svg)) < LEAST_TEXT_PX - 0.1:
            yield f"{address[-60:]}: {px:.1f} px"


def test_the_letters_of_each_drawing_can_be_read_on_a_phone(site: Path, looked_at: Visit) -> None:
    """On every page, those of cells' outputs, too."""
    looked_at.page.set_viewport_size({"width": PHONE_PX, "height": 900})
    found = {name: list(small_letters(opened(looked_at, name))) for name in pages_of(site)}
    assert {name: small for name, small in found.items() if small} == {}


def test_small_letters_are_found(site: Path, looked_at: Visit) -> None:
    """Else the silence of the test above would mean nothing."""
    page = opened(looked_at, "labs/topics")
    page.evaluate("document.querySelectorAll('article img').forEach(i => i.style.width = '200px')")
    assert len(list(small_letters(page))) == 2


def test_no_line_of_code_is_cut_on_a_wide_screen(site: Path, looked_at: Visit) -> None:
    """On every page."""
    found = {name: opened(looked_at, name).evaluate(CUT) for name in pages_of(site)}
    assert {name: cut for name, cut in found.items() if cut} == {}
    looked_at.page.add_style_tag(content="article pre { white-space: pre !important }")
    looked_at.page.evaluate(
        "document.querySelector('article').insertAdjacentHTML('beforeend',"
        " '<pre>' + 'x'.repeat(300) + '</pre>')"
    )
    assert len(looked_at.page.evaluate(CUT)) >= 1  # it sees one


@pytest.mark.parametrize("width", [WIDE_PX, PHONE_PX])
def test_the_icons_of_the_head_stand_apart(looked_at: Visit, width: int) -> None:
    """A thumb meets one of them."""
    looked_at.page.set_viewport_size({"width": width, "height": 900})
    page = looked_at.go("reference/faq.html")
    icons = page.locator(
        ".mobile-header svg:visible, .mobile-header button:visible svg:visible,"
        " .content-icon-container svg:visible"
    )
    boxes = sorted((icon.bounding_box() for icon in icons.all()), key=lambda box: box["x"])
    assert len(boxes) >= 1
    for left, right in pairwise(boxes):
        assert right["x"] - left["x"] - left["width"] >= LEAST_GAP_PX


# --- the front page ------------------------------------------------------------------------------


FRAMES = """count => new Promise(done => {
    const next = () => count-- > 0 ? requestAnimationFrame(next) : done();
    next();
})"""


def moves(page: Any) -> bool:
    """Whether the room looks otherwise while the browser draws it again and again."""
    room = page.locator(".hero-room img")
    first = room.screenshot()
    for _ in range(10):
        page.evaluate(FRAMES, 6)
        if room.screenshot() != first:
            return True
    return False


@pytest.mark.parametrize("motion", ["no-preference", "reduce"])
def test_the_drawing_moves_unless_less_motion_is_wanted(
    browser: Any, site: Path, motion: str
) -> None:
    """An image is not told what its reader wants: the page chooses another one."""
    size = {"width": WIDE_PX, "height": 900}
    context = browser.new_context(viewport=size, reduced_motion=motion)
    page = Visit(context, site.as_uri()).go("index.html")
    assert moves(page) == (motion == "no-preference")
    page.goto(f"{site.as_uri()}/labs/topics.html")
    address = page.locator("article img").first.evaluate("image => image.currentSrc")
    assert address.endswith("-still.svg") == (motion == "reduce")
    context.close()


def test_nothing_is_empty_beside_the_verdict(looked_at: Visit) -> None:
    """Drawing and verdict end together."""
    page = looked_at.go("index.html")
    ends = [
        page.locator(part).bounding_box() for part in (".hero-room img", ".hero-verdict figcaption")
    ]
    drawing, verdict = (box["y"] + box["height"] for box in ends)
    assert abs(drawing - verdict) <= MOST_EMPTY_PX


def test_pages_for_instructors_have_a_list_of_their_own(looked_at: Visit) -> None:
    """One entry in a student's list of pages; on theirs it is open."""
    there = ".sidebar-tree a[href*='teachers/']:visible"
    assert looked_at.go("index.html").locator(there).count() == 1
    page = looked_at.go("teachers/index.html")
    inside = page.locator(".sidebar-tree li.current a").all_inner_texts()
    assert "Grade a class" in inside and "Late days" in inside


# --- a lab ---------------------------------------------------------------------------------------


def test_a_lab_begins_with_what_moves_then_the_steps_then_the_card(looked_at: Visit) -> None:
    """The card folded by node; each part opens."""
    page = looked_at.go("labs/topics.html")
    tops = [
        page.locator(part).first.bounding_box()["y"]
        for part in (
            "article img",
            "#the-steps h2",
            "#what-success-looks-like h2",
            "#the-card h2",
            "#the-points h2",
        )
    ]
    assert tops == sorted(tops)
    assert tops[0] < 900 and "moves" in page.locator("article img").first.get_attribute("src")
    parts = page.locator("#the-card details.of-card")
    names = ["The package", "The node /talker", "The node /listener"]
    assert [told.partition(":")[0] for told in parts.locator("summary").all_inner_texts()] == names
    assert page.locator("#the-card table:visible").count() == 0
    parts.nth(1).locator("summary").click()
    assert "/chatter" in parts.nth(1).locator("table").inner_text()
    listed = page.locator(".toc-tree a").all_inner_texts()
    assert listed.index("The steps") < listed.index("The card") < listed.index("The points")
    page.locator(".note-box a", has_text="the card").click()
    assert page.url.endswith("#the-card")
