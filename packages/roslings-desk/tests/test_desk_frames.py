"""The tab of the frames, in a real browser, beside nodes that say some."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from desk_program import Desk, Nodes, desk

from ros2_on_pip.domain_lease import leased_domain
from skips import imported, skip_without

skip_without("module tf2_msgs")
expect = imported("playwright.sync_api").expect
expect.set_options(timeout=120_000)
pytestmark = pytest.mark.slow

SAID_EVERY_S = 0.05


class Teller:
    """A node's frames: a body that moves, and a laser on it."""

    def __init__(self, nodes: Nodes) -> None:
        import tf2_ros

        self._node = nodes.node
        self._moving = tf2_ros.TransformBroadcaster(nodes.node)
        self._fixed = tf2_ros.StaticTransformBroadcaster(nodes.node)
        self.parent = "odom"
        self._fixed.sendTransform(self._step("base_link", "laser", 0.1))
        self.timer = nodes.node.create_timer(SAID_EVERY_S, self._say)

    def _say(self) -> None:
        self._moving.sendTransform(self._step(self.parent, "base_link", 1.25))

    def _step(self, parent: str, child: str, x_m: float) -> Any:
        from geometry_msgs.msg import TransformStamped

        step = TransformStamped(child_frame_id=child)
        step.header.frame_id = parent
        step.header.stamp = self._node.get_clock().now().to_msg()
        step.transform.translation.x = x_m
        step.transform.rotation.w = 1.0
        return step


@pytest.fixture
def page(context: Any, opened: Desk) -> Any:
    """The tab, open."""
    found = context.new_page()
    found.goto(f"{opened.base}/frames")
    expect(found.get_by_role("heading", name="Frames", level=2)).to_be_visible()
    return found


def row(page: Any, frame: str) -> Any:
    """The row of one frame."""
    return page.get_by_role("row").filter(has=page.get_by_role("rowheader", name=frame, exact=True))


def test_the_tree_is_shown_and_what_goes_wrong_is_said(page: Any, nodes: Nodes) -> None:
    """First nobody says any; then a rover does, then a second parent comes, then all is silent."""
    expect(page.get_by_text("No node says frames now")).to_be_visible()
    assert nodes.node.count_subscribers("/tf") == 0, "the tab makes a topic appear"
    teller = Teller(nodes)
    expect(row(page, "odom")).to_contain_text("root")
    expect(row(page, "laser")).to_contain_text("static")
    expect(row(page, "laser")).to_contain_text("0.100, 0.000, 0.000")
    body = row(page, "base_link")
    for words in ("Hz", "s old", "1.250, 0.000, 0.000", "0.0", "/tester"):
        expect(body).to_contain_text(words)
    expect(page.get_by_text("3 frames")).to_be_visible()
    alert = page.get_by_role("alert").filter(has_text="base_link")
    expect(alert).to_have_count(0)
    page.get_by_role("button", name="Say the tree").press("Enter")
    expect(page.get_by_role("status").filter(has_text="odom is a root.")).to_be_visible()

    teller.parent = "map"
    expect(alert).to_contain_text("'base_link' has several parents")
    teller.parent = "odom"
    expect(alert).to_have_count(0)

    nodes.node.destroy_timer(teller.timer)
    expect(alert).to_contain_text("'base_link' has ceased")
    expect(body).to_contain_text("ceased")


def test_a_late_page_knows_what_never_moves(context: Any, opened: Desk, nodes: Nodes) -> None:
    """And a telephone's width is enough for it."""
    teller = Teller(nodes)
    page = context.new_page()
    page.set_viewport_size({"width": 390, "height": 800})
    page.goto(f"{opened.base}/frames")
    expect(row(page, "laser")).to_contain_text("static")
    expect(row(page, "base_link")).to_contain_text("Hz")
    axe = imported("axe_playwright_python.sync_playwright").Axe().run(page)
    assert [(each["id"], each["nodes"]) for each in axe.response["violations"]] == []
    assert page.evaluate("document.documentElement.scrollWidth") <= 390
    nodes.node.destroy_timer(teller.timer)


@pytest.fixture
def poor(tmp_path: Path) -> Iterator[Desk]:
    """A desk in whose environment tf2_msgs cannot be loaded."""
    (tmp_path / "tf2_msgs").mkdir()
    (tmp_path / "tf2_msgs/__init__.py").write_text("raise ImportError('it was never built')\n")
    with leased_domain() as domain, desk(domain, tmp_path, more=tmp_path) as found:
        yield found


def test_without_its_type_a_line_says_how_to_get_it(browser: Any, poor: Desk) -> None:
    """And nothing else is wrong."""
    page = browser.new_page()
    poor.let_in(page)
    page.goto(f"{poor.base}/frames")
    expect(page.get_by_text("Type once: ./roslings ready rover --tf")).to_be_visible()
    assert page.get_by_role("alert").filter(has_text="TFMessage").count() == 0
    page.close()
