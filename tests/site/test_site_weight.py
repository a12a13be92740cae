"""A page loads little, and misses nothing by it."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest
from site_rules import pages_of
from two_days_site import Visit

from roslings.course import root

pytestmark = pytest.mark.slow

SHEETS = ("pygments.css", "styles/furo.css", "mystnb.*.css", "styles/furo-extensions.css")
OURS = "course.css"
SEEN = (
    "color background border margin padding display position width height font line-height content"
    " text-decoration visibility opacity overflow white-space transform list-style-type z-index"
)
LOOKS = """keys => [...document.querySelectorAll('body, body *')].flatMap(
  element => ['', '::before', '::after'].map(part => {
    const style = getComputedStyle(element, part || null);
    const looks = keys.map(key => `${key}: ${style.getPropertyValue(key)}`);
    return `${element.tagName} ${element.className} ${part} ${looks.join('; ')}`;
  }))"""
SWAP = """names => Promise.all([
  ...names.map(name => new Promise(done => {
    const link = document.createElement('link');
    link.rel = 'stylesheet'; link.href = name; link.onload = done;
    document.head.append(link);
  }))]).then(() => document.querySelector('link[href*="all.css"]').remove())
    .then(() => document.head.append(document.querySelector('head > style')))"""
"""In the place of the one sheet those that it is made of; the page's own style stays below them."""


@pytest.mark.parametrize(("width", "scheme"), [(1280, "light"), (390, "dark")])
@pytest.mark.parametrize("name", ["days/01-install/index", "days/03-topics/quiz", "index"])
def test_a_page_looks_as_with_all_rules(
    browser: Any, site: Path, name: str, width: int, scheme: str
) -> None:
    """The sheet without unused rules gives each element the same look as the whole sheets do."""
    context = browser.new_context(viewport={"width": width, "height": 900}, color_scheme=scheme)
    page = context.new_page()
    page.goto((site / f"{name}.html").as_uri())
    page.add_style_tag(content="* { transition: none !important; animation: none !important }")
    few = page.evaluate(LOOKS, SEEN.split())
    assert any("font: 700 " in look for look in few)  # else nothing would be compared
    whole = [next((site / "_static").glob(sheet)) for sheet in (*SHEETS, OURS)]
    page.evaluate(SWAP, [file.as_uri() for file in whole])
    looks = page.evaluate(LOOKS, SEEN.split())
    assert [pair for pair in zip(few, looks, strict=True) if pair[0] != pair[1]] == []
    context.close()


def test_the_sheet_is_small(site: Path) -> None:
    """What no page uses is gone."""
    text = (site / "_static" / "all.css").read_text("utf-8")
    assert ".sd-card" not in text
    assert ".button.plain" in text
    whole = [next((site / "_static").glob(sheet)) for sheet in (*SHEETS, OURS)]
    assert len(text) < sum(file.stat().st_size for file in whole) / 2


def test_the_scripts_are_small(site: Path) -> None:
    """They lose their comments, and nothing that a reader's browser runs."""
    for script in (root() / "site" / "static").glob("*.js"):
        small = (site / "_static" / script.name).read_text("utf-8")
        assert not any(line.lstrip().startswith("//") for line in small.splitlines())
        assert 0 < len(small) < len(script.read_text("utf-8"))


def test_each_page_links_one_sheet_and_few_scripts(site: Path) -> None:
    """Only the search page needs the scripts of the search."""
    for name in pages_of(site):
        text = (site / f"{name}.html").read_text("utf-8")
        assert re.findall(r'rel="stylesheet"[^>]*href="[^"]*_static/([^"]+)"', text) == ["all.css"]
        assert ("doctools.js" in text) == (name == "search")


def test_what_was_searched_for_is_marked(visit: Visit) -> None:
    """The scripts that do it come with the reader who searched."""
    page = visit.go("reference/lifecycle.html")
    assert page.locator("span.highlighted").count() == 0
    page.evaluate("localStorage.setItem('sphinx_highlight_terms', 'lifecycle')")
    page.reload()
    page.locator("span.highlighted").first.wait_for()
    assert visit.errors == []


def test_code_is_coloured_and_copied_as_it_is(visit: Visit) -> None:
    """Fewer tags, the same text; a word of Python still has its colour."""
    page = visit.go("days/01-install/index.html")
    code = page.locator(".cell_input pre").first
    assert "import" in code.inner_text() or "print" in code.inner_text()
    assert code.locator("span").count() >= 1
    colours = code.evaluate(
        "pre => [getComputedStyle(pre).color, getComputedStyle(pre.querySelector('span')).color]"
    )
    assert colours[0] != colours[1]
