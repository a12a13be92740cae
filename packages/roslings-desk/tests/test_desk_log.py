"""The tab of the log, in a real browser, with a real node that says lines."""

from __future__ import annotations

from typing import Any

import pytest
from desk_program import Desk, Nodes

from skips import imported

expect = imported("playwright.sync_api").expect
expect.set_options(timeout=120_000)
pytestmark = pytest.mark.slow


@pytest.fixture
def page(context: Any, opened: Desk) -> Any:
    """The tab, open."""
    found = context.new_page()
    found.goto(f"{opened.base}/log")
    expect(found.get_by_role("heading", name="Log", level=2)).to_be_visible()
    return found


def line(page: Any, words: str) -> Any:
    """The row with these words."""
    return page.get_by_role("row").filter(has_text=words)


def test_lines_are_found_by_level_node_and_text(page: Any, nodes: Nodes) -> None:
    """All filters are done by keys."""
    nodes.node.get_logger().info("the battery is full")
    nodes.node.get_logger().error("the wheel is stuck")
    expect(line(page, "the battery is full")).to_be_visible()
    expect(line(page, "the wheel is stuck")).to_contain_text("ERROR")
    expect(line(page, "the wheel is stuck")).to_contain_text("tester")
    page.get_by_label("Least level").select_option("WARN")
    expect(line(page, "the battery is full")).to_have_count(0)
    expect(line(page, "the wheel is stuck")).to_be_visible()
    page.get_by_label("Text", exact=True).fill("battery")
    expect(line(page, "the wheel is stuck")).to_have_count(0)
    page.get_by_label("Least level").select_option("DEBUG")
    expect(line(page, "the battery is full")).to_be_visible()
    page.get_by_label("Node", exact=True).fill("nobody")
    expect(page.get_by_role("status")).to_contain_text("0 of")


def test_pause_holds_the_table_and_what_came_meanwhile_is_shown_after(
    page: Any, nodes: Nodes
) -> None:
    """Nothing is lost by it."""
    nodes.node.get_logger().info("before")
    expect(line(page, "before")).to_be_visible()
    pause = page.get_by_role("button", name="Pause")
    pause.press("Enter")
    expect(pause).to_have_attribute("aria-pressed", "true")
    nodes.node.get_logger().info("meanwhile")
    other = page.context.new_page()
    other.goto(page.url)
    expect(line(other, "meanwhile")).to_be_visible()
    assert line(page, "meanwhile").count() == 0
    pause.press("Enter")
    expect(line(page, "meanwhile")).to_be_visible()


def test_a_line_of_a_megabyte_is_cut(page: Any, nodes: Nodes) -> None:
    """It does not fill the page."""
    nodes.node.get_logger().warn("x" * 1_000_000)
    expect(line(page, "xxxx")).to_be_visible()
    assert len(line(page, "xxxx").text_content()) < 700
