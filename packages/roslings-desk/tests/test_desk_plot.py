"""The tab of curves, in a real browser, with a real node whose numbers it draws."""

from __future__ import annotations

import math
from typing import Any

import pytest
from desk_program import Desk, Nodes, until

from skips import imported

expect = imported("playwright.sync_api").expect
expect.set_options(timeout=120_000)
pytestmark = pytest.mark.slow


@pytest.fixture
def page(context: Any, opened: Desk) -> Any:
    """The tab, open."""
    found = context.new_page()
    found.goto(f"{opened.base}/plot")
    expect(found.get_by_role("heading", name="Plot", level=2)).to_be_visible()
    return found


class Numbers:
    """A node that says one number, 50 times a second."""

    def __init__(self, nodes: Nodes, topic: str) -> None:
        from std_msgs.msg import Float64

        self.value = 1.25
        publisher = nodes.node.create_publisher(Float64, topic, 10)
        nodes.node.create_timer(0.02, lambda: publisher.publish(Float64(data=self.value)))


def add(page: Any, topic: str, path: str) -> None:
    """Add a curve, by keys."""
    lists = page.get_by_label("Topic", exact=True)
    expect(lists.get_by_text(topic, exact=True)).to_be_attached()
    lists.select_option(topic)
    page.get_by_label("Or type a field").fill(path)
    page.get_by_role("button", name="Add the curve").press("Enter")


def cells(page: Any) -> list[str]:
    """Of the first curve's row."""
    return [
        str(each) for each in page.get_by_role("row").nth(1).get_by_role("cell").all_text_contents()
    ]


def drawn(page: Any) -> list[Any]:
    """The values of the first curve, as ECharts has them."""
    return page.evaluate(  # type: ignore[no-any-return]
        "() => { const at = document.querySelector('.curves');"
        " const chart = getElement(Number(at.id.slice(1))).chart;"
        " return chart.getOption().series[0].data.map((point) => point[1]); }"
    )


def test_a_rate_and_a_value_are_plotted_by_keys_and_read_in_the_table(
    page: Any, nodes: Nodes
) -> None:
    """A change that the node makes is seen in the curve and in the row."""
    numbers = Numbers(nodes, "/level")
    lists = page.get_by_label("Topic", exact=True)
    expect(lists.get_by_text("/level", exact=True)).to_be_attached()
    lists.select_option("/level")
    page.get_by_label("Field", exact=True).select_option("data")
    page.get_by_role("button", name="Add the curve").press("Enter")
    until(lambda: len(cells(page)) == 6 and cells(page)[:2] == ["/level data", "1.25"], "1.25")
    numbers.value = 7.5
    until(lambda: cells(page)[1:4] == ["7.5", "1.25", "7.5"], "newest, least and most")
    until(lambda: {1.25, 7.5} <= set(drawn(page)), "both values in the curve")
    until(lambda: float(cells(page)[4]) > 0, "a rate")
    page.get_by_role("button", name="Say the values").press("Enter")
    expect(page.get_by_role("status")).to_have_text("/level data: 7.5")


def test_pause_keeps_what_is_drawn(page: Any, nodes: Nodes) -> None:
    """And going on shows the newest."""
    numbers = Numbers(nodes, "/level")
    add(page, "/level", "data")
    until(lambda: len(cells(page)) == 6 and cells(page)[1] == "1.25", "a value")
    pause = page.get_by_role("button", name="Pause")
    pause.press("Space")
    expect(pause).to_have_attribute("aria-pressed", "true")
    numbers.value = 3.0
    said, says = page.get_by_role("status"), page.get_by_role("button", name="Say the values")
    until(lambda: said.text_content() == "/level data: 3" or says.press("Enter"), "it is heard")
    assert cells(page)[1] == "1.25"
    pause.press("Space")
    until(lambda: cells(page)[1] == "3", "the newest")


def test_nan_and_infinity_are_counted_and_break_the_curve(page: Any, nodes: Nodes) -> None:
    """They are never drawn."""
    numbers = Numbers(nodes, "/level")
    add(page, "/level", "data")
    until(lambda: len(cells(page)) == 6 and cells(page)[1] == "1.25", "a value")
    numbers.value = math.nan
    until(lambda: "not finite" in cells(page)[5], "NaN")
    numbers.value = math.inf
    until(lambda: None in drawn(page), "a gap")
    numbers.value = 2.0
    until(lambda: cells(page)[1:4] == ["2", "1.25", "2"], "the curve goes on")


@pytest.mark.parametrize("path", ["", "no_such", "data.more", "data[0]", "__class__"])
def test_what_is_no_number_is_told(page: Any, nodes: Nodes, path: str) -> None:
    """And nothing is subscribed for it."""
    Numbers(nodes, "/level")
    add(page, "/level", path)
    expect(page.get_by_role("alert").filter(has_text="has no number at")).to_be_visible()
    until(lambda: not nodes.listeners("/level"), "nobody listens; the page before was just closed")


def test_taking_all_away_ends_the_subscriptions(page: Any, nodes: Nodes) -> None:
    """So does nothing else here: a paused curve is still listened to."""
    Numbers(nodes, "/level")
    add(page, "/level", "data")
    until(lambda: len(nodes.listeners("/level")) == 1, "a subscription")
    page.get_by_role("button", name="Take all away").press("Enter")
    until(lambda: not nodes.listeners("/level"), "no subscription")
