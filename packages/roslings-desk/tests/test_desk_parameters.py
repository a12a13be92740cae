"""The tab of parameters, in a real browser, with a real node that has some."""

from __future__ import annotations

import re
from typing import Any

import pytest
from desk_program import Desk, Nodes, until

from skips import imported

expect = imported("playwright.sync_api").expect
expect.set_options(timeout=120_000)
pytestmark = pytest.mark.slow


def with_parameters(node: Any) -> Any:
    """The node, with a parameter of each kind."""
    from rcl_interfaces.msg import (
        FloatingPointRange,
        IntegerRange,
        ParameterDescriptor,
        SetParametersResult,
    )

    speed = FloatingPointRange(from_value=0.0, to_value=1.0, step=0.1)
    node.declare_parameter(
        "speed",
        0.5,
        ParameterDescriptor(description="How fast, in m/s", floating_point_range=[speed]),
    )
    count = IntegerRange(from_value=0, to_value=10, step=1)
    node.declare_parameter("count", 3, ParameterDescriptor(integer_range=[count]))
    node.declare_parameter("on", False)
    node.declare_parameter("word", "hello")
    node.declare_parameter("list", [1, 2])
    node.declare_parameter("serial", "A1", ParameterDescriptor(read_only=True))

    def judge(parameters: Any) -> Any:
        bad = any(each.value == "bad" for each in parameters)
        return SetParametersResult(successful=not bad, reason="bad is a bad word" if bad else "")

    node.add_on_set_parameters_callback(judge)
    return node


@pytest.fixture
def owner(nodes: Nodes) -> Any:
    """The node, as long as a test runs."""
    return with_parameters(nodes.node)


@pytest.fixture
def page(context: Any, opened: Desk, owner: Any) -> Any:
    """The tab, open, with the node chosen."""
    found = context.new_page()
    open_tab(found, opened)
    return found


def open_tab(page: Any, opened: Desk) -> None:
    """Choose the node."""
    page.goto(f"{opened.base}/parameters")
    node = page.get_by_label("Node", exact=True)
    expect(node.get_by_text("/tester", exact=True)).to_be_attached()
    node.select_option("/tester")
    expect(page.get_by_role("status")).to_contain_text("/tester has")


def test_a_slider_and_a_switch_are_moved_by_keys(page: Any, owner: Any) -> None:
    """The node has the new values at once; undo brings the old one back."""
    slider = page.get_by_role("slider", name="speed (double)")
    slider.focus()
    page.keyboard.press("ArrowRight")
    until(lambda: owner.get_parameter("speed").value == pytest.approx(0.6), "0.6")
    page.get_by_role("checkbox", name="on (boolean)").press("Space")
    until(lambda: owner.get_parameter("on").value is True, "true")
    page.get_by_role("slider", name="count (integer)").press("End")
    until(lambda: owner.get_parameter("count").value == 10, "10")
    undo = page.get_by_role("button", name="Undo the last change")
    undo.press("Enter")
    until(lambda: owner.get_parameter("count").value == 3, "3 again")
    undo.press("Enter")
    until(lambda: owner.get_parameter("on").value is False, "false again")
    expect(page.get_by_role("checkbox", name="on (boolean)")).not_to_be_checked()


def test_what_is_typed_is_set_by_its_button(page: Any, owner: Any) -> None:
    """A text and a list; the line below says what the node has."""
    page.get_by_label("word (string)").fill("good day")
    page.get_by_role("button", name="Set word").press("Enter")
    until(lambda: owner.get_parameter("word").value == "good day", "the text")
    page.get_by_label("list (integer array)").fill("[3, 4, 5]")
    page.get_by_role("button", name="Set list").press("Enter")
    until(lambda: list(owner.get_parameter("list").value) == [3, 4, 5], "the list")
    expect(page.get_by_text("now good day")).to_be_visible()
    expect(page.get_by_role("button", name="Set serial")).to_have_count(0)
    expect(page.get_by_label("serial (string)")).to_be_disabled()


def test_what_others_set_is_shown(page: Any, owner: Any, opened: Desk, context: Any) -> None:
    """By the node itself, and by a second page with the same slider."""
    from rclpy.parameter import Parameter

    owner.set_parameters([Parameter("speed", value=0.9)])
    expect(page.get_by_role("slider", name="speed (double)")).to_have_value("0.9")
    second = context.new_page()
    open_tab(second, opened)
    second.get_by_role("slider", name="speed (double)").press("Home")
    expect(page.get_by_role("slider", name="speed (double)")).to_have_value(
        re.compile(r"^0(\.0)?$")
    )
    until(lambda: owner.get_parameter("speed").value == 0.0, "0")


@pytest.mark.parametrize(
    ("label", "typed", "said"),
    [
        ("word (string)", "bad", "The node did not take word: bad is a bad word"),
        ("list (integer array)", "three", "list is a parameter of type integer array, and 'three'"),
        ("list (integer array)", "[1", "The values are no valid YAML"),
    ],
)
def test_what_the_node_cannot_take_is_told(
    page: Any, owner: Any, label: str, typed: str, said: str
) -> None:
    """And what was typed still stands there, to be mended."""
    page.get_by_label(label).fill(typed)
    page.get_by_role("button", name=f"Set {label.split()[0]}").click()
    expect(page.get_by_role("alert").filter(has_text=said)).to_be_visible()
    expect(page.get_by_label(label)).to_have_value(typed)
    assert owner.get_parameter("word").value == "hello"


def test_a_node_that_ends_while_its_slider_is_moved_is_told(context: Any, opened: Desk) -> None:
    """By its name; the page goes on."""
    page = context.new_page()
    with Nodes(opened.domain) as nodes:
        with_parameters(nodes.node)
        open_tab(page, opened)
    page.get_by_role("slider", name="speed (double)").press("ArrowRight")
    expect(page.get_by_role("alert").filter(has_text="'/tester").first).to_be_visible()
    page.get_by_role("link", name="Topics").click()
    expect(page.get_by_role("heading", name="Topics", level=2)).to_be_visible()
