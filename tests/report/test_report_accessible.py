"""The engine's own pages in a browser: verdicts, a class, its students; two widths, light, dark."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from written_evidence import evidence, messages, steady, talking
from written_verdicts import full_score, inconclusive, three_faults, too_slow, verdict

from roslings.course import lab
from roslings.report.command_line import CommandLine
from roslings.report.html import Own, RequiredRate, html_of
from roslings.verdict import Verdict
from roslings_class.gradebook import gradebook
from roslings_class.handing_out import hand_out
from roslings_class.result import GradingResult
from skips import imported

Axe = imported("axe_playwright_python.sync_playwright").Axe

TOPICS = lab("topics")
ASKED = [RequiredRate("/chatter", "std_msgs/msg/String", 2.0, 1.9, 2.1)]
LOOKS = [(width, scheme) for width in (1280, 390) for scheme in ("light", "dark")]


def graded(name: str, found: Verdict, hz: float) -> GradingResult:
    """A submission that was judged."""
    return GradingResult(
        submission=name,
        digest=name,
        attempt=1,
        state="graded",
        verdict=found,
        rates={"/chatter": hz},
    )


@pytest.fixture(scope="module")
def pages(tmp_path_factory: pytest.TempPathFactory) -> list[Path]:
    """One page of every kind."""
    folder = tmp_path_factory.mktemp("pages")
    refused = GradingResult(
        submission="eve",
        digest="e",
        attempt=1,
        state="refused",
        reason="There is no ROS package in it:\nno package.xml.",
        next_step="Give the folder.",
    )
    with gradebook(folder, "topics") as book:
        book.write(graded("ada", verdict(), 2.0))
        book.write(graded("a_long_name_of_a_student_who_failed", too_slow(), 1.0))
        book.write(refused)
        hand_out(book, TOPICS, folder)
    return [*_verdicts(folder), *sorted(folder.rglob("*.html"))]


def _verdicts(folder: Path) -> Iterator[Path]:
    seen = evidence(talking(messages(steady(1.0, 12))))
    own = Own(CommandLine("topics"), "file:///site")
    for number, found in enumerate((full_score(), too_slow(), three_faults(), inconclusive())):
        page = folder / f"verdict-{number}.htm"
        page.write_text(html_of(found, seen, ASKED, own), "utf-8")
        yield page


@pytest.mark.parametrize(("width", "scheme"), LOOKS)
def test_no_page_of_the_engine_breaks_a_rule(
    browser: Any, pages: list[Path], width: int, scheme: str
) -> None:
    """axe-core, best practices included; inside the screen; nobody else is asked."""
    context = browser.new_context(viewport={"width": width, "height": 900}, color_scheme=scheme)
    asked, found = list[str](), list[str]()
    context.on("request", lambda request: asked.append(request.url))
    page = context.new_page()
    for file in pages:
        page.goto(file.as_uri())
        found += [f"{file.name}: {x}" for x in Axe().run(page).generate_snapshot().splitlines()]
        if page.evaluate("document.documentElement.scrollWidth") > width:
            found.append(f"{file.name} is wider than the screen")
    context.close()
    assert len(pages) >= 8
    assert found == []
    assert [url for url in asked if not url.startswith(("file:", "data:"))] == []


HIDDEN_PARTS = """
[...document.querySelectorAll('.holder, table.class, table.class :is(th, td)')]
    .filter(part => part.scrollWidth > part.clientWidth + 1).map(part => part.textContent)
"""


def test_on_a_phone_the_page_of_a_class_is_whole(browser: Any, pages: list[Path]) -> None:
    """No table is moved sideways, and no text is cut off; at a desk a line stays one line."""
    context = browser.new_context(viewport={"width": 390, "height": 900})
    page = context.new_page()
    page.goto(next(file for file in pages if file.name == "class.html").as_uri())
    assert page.evaluate(HIDDEN_PARTS) == []
    page.set_viewport_size({"width": 1200, "height": 900})
    heights = page.locator("table.class tbody tr").evaluate_all(
        "rows => rows.map(row => row.clientHeight)"
    )
    assert max(heights) - min(heights) <= 1
    context.close()
