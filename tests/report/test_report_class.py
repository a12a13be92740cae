"""The page of a class of 120 in a browser: sorted by any column, searched, and no one else's."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from written_verdicts import full_score, too_slow

from roslings.course import lab
from roslings_class.gradebook import gradebook
from roslings_class.handing_out import Settings, hand_out, keep
from roslings_class.overview import overview
from roslings_class.overview_page import write_overview
from roslings_class.result import GradingResult

TOPICS = lab("topics")
COUNT = 120
RUNS = "<script>document.title = 'taken'</script>"
"""What a hand-in may be called; a page that ran it would have another title."""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Every fourth was too slow, every tenth handed in nothing, one was refused."""
    folder = tmp_path_factory.mktemp("class")
    lines = [f"Student {number},{number_of(number)}" for number in range(COUNT)]
    lines[7] = f"Zoë Ångström,{number_of(7)}"
    (folder / "class.csv").write_text("\n".join(["name,id", *lines]), "utf-8")
    with gradebook(folder, "topics") as book:
        keep(book, Settings(roster=folder / "class.csv"))
        for number in range(COUNT):
            if number % 10:
                book.write(_result(number))
        book.write(_result(1).model_copy(update={"submission": RUNS}))
        hand_out(book, TOPICS, folder)
    return folder


def number_of(number: int) -> str:
    """What a school numbers a student with."""
    return f"s{1000 + number}"


def _result(number: int) -> GradingResult:
    words: dict[str, Any] = {"submission": number_of(number), "digest": "d", "attempt": 1}
    if number == 9:
        return GradingResult(**words, state="refused", reason="No package is in it. " * 20)
    found = full_score() if number % 4 else too_slow()
    return GradingResult(**words, state="graded", verdict=found)


@pytest.fixture
def page(browser: Any, folder: Path) -> Iterator[Any]:
    """The page, at a desk."""
    context = browser.new_context(viewport={"width": 1200, "height": 900})
    page = context.new_page()
    page.goto((folder / "class.html").as_uri())
    yield page
    context.close()


def column(page: Any, name: str) -> list[str]:
    """The texts of a column, of the lines that are shown."""
    cells = page.locator(f"table.class tbody tr:not([hidden]) .{name}")
    return [text.strip() for text in cells.all_inner_texts()]


def test_any_column_sorts_both_ways(page: Any) -> None:
    """Numbers by their value; who has none comes last, whichever way."""
    assert len(column(page, "who")) == COUNT + 1
    heads = page.locator("table.class thead button")
    for place in range(heads.count()):
        head = heads.nth(place)
        name = page.locator("table.class thead th").nth(place).get_attribute("class")
        head.click()
        up = column(page, name)
        assert page.locator("th[aria-sort=ascending]").count() == 1
        head.click()
        down = column(page, name)
        assert page.locator("th[aria-sort=descending]").count() == 1
        assert sorted(up) == sorted(down)
        if name == "mend":  # by how many: none is a number, too
            assert (up[0], down[0]) == ("", "rate")
            continue
        full = [text for text in up if text]
        assert up == full + [""] * (len(up) - len(full))
        assert next(text for text in down if text) == full[-1]
    heads.nth(1).click()
    ids = [text for text in column(page, "id") if text]
    assert ids == [number_of(number) for number in range(COUNT)]


def test_a_search_finds_names_outcomes_and_failed_checks(page: Any) -> None:
    """Without accents too; it says how many."""
    field = page.get_by_role("searchbox")
    field.fill("zoe angstrom")
    assert column(page, "who") == ["Zoë Ångström"]
    field.fill("missing")
    assert len(column(page, "who")) == COUNT // 10
    assert page.locator(".search output").inner_text() == f"12 of {COUNT + 1}"
    field.fill("")
    page.locator("a[data-find=rate]").click()
    assert set(column(page, "outcome-of")) == {"fail"}
    assert len(column(page, "who")) == sum(n % 10 > 0 and n % 4 == 0 for n in range(COUNT))


def test_a_line_stays_one_line_and_opens_under_the_mouse(page: Any) -> None:
    """A long reason is cut off until somebody points at it."""
    line = page.locator("table.class tbody tr", has_text="refused")
    height = line.evaluate("row => row.clientHeight")
    heights = page.locator("table.class tbody tr").evaluate_all(
        "rows => rows.map(row => row.clientHeight)"
    )
    assert max(heights) - min(heights) <= 1
    line.hover()
    assert line.evaluate("row => row.clientHeight") > 1.5 * height


def test_a_script_in_a_hand_ins_name_is_not_run(page: Any, folder: Path) -> None:
    """It is text; and no script but ours, known by its digest, is allowed."""
    assert page.title() == f"The class: {TOPICS.card.title}"
    assert RUNS in column(page, "who")
    text = (folder / "class.html").read_text("utf-8")
    policy = re.search(r"script-src ([^\"]+)", text)
    assert policy and re.fullmatch(r"&#x27;sha256-[\w+/]{43}=&#x27;", policy[1])
    page.evaluate(
        "document.body.append(Object.assign(document.createElement('script'),"
        " {textContent: 'document.title = 1'}))"
    )
    assert page.title() == f"The class: {TOPICS.card.title}"


def test_without_scripts_the_table_is_whole(browser: Any, folder: Path) -> None:
    """The lowest score first, and no field that does nothing."""
    context = browser.new_context(java_script_enabled=False)
    page = context.new_page()
    page.goto((folder / "class.html").as_uri())
    assert page.locator("table.class tbody tr").count() == COUNT + 1
    assert not page.locator(".search").is_visible()
    assert page.locator("table.class button").count() == 0
    context.close()


def test_all_labs_in_one_table_are_whole_on_a_phone(browser: Any, folder: Path) -> None:
    """Nothing is cut off; who has not begun is found."""
    out = folder / "term"
    out.mkdir()
    write_overview(overview([folder], None), out)
    context = browser.new_context(viewport={"width": 390, "height": 900})
    page = context.new_page()
    page.goto((out / "overview.html").as_uri())
    assert page.evaluate("document.documentElement.scrollWidth") == 390
    cut = "cells => cells.filter(cell => cell.scrollWidth > cell.clientWidth + 1).length"
    assert page.locator("table.class :is(th, td)").evaluate_all(cut) == 0
    page.get_by_role("searchbox").fill("not begun")
    assert len(column(page, "who")) == COUNT // 10
    page.get_by_role("searchbox").fill("student 11")
    page.locator("table.class tbody .lab a").nth(1).click()
    assert page.url.endswith("/report.html")
    context.close()
