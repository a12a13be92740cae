"""The tab of pictures, in a real browser, with a real node that films."""

from __future__ import annotations

import re
from typing import Any

import pytest
from desk_program import Desk, Nodes, until

from skips import imported

expect = imported("playwright.sync_api").expect
expect.set_options(timeout=120_000)
pytestmark = pytest.mark.slow

COLOUR = (
    "() => { const picture = document.querySelector('.picture');"
    " const canvas = document.createElement('canvas'); const drawn = canvas.getContext('2d');"
    " drawn.drawImage(picture, 0, 0); return [...drawn.getImageData(1, 1, 1, 1).data]; }"
)


@pytest.fixture
def page(context: Any, opened: Desk) -> Any:
    """The tab, open."""
    found = context.new_page()
    found.goto(f"{opened.base}/image")
    expect(found.get_by_role("heading", name="Image", level=2)).to_be_visible()
    return found


class Camera:
    """A node that publishes one colour, 64 x 48, ten times a second."""

    def __init__(self, nodes: Nodes) -> None:
        from sensor_msgs.msg import Image

        self.message = Image(encoding="rgb8", width=64, height=48, step=192)
        self.paint(51, 51, 51)
        publisher = nodes.node.create_publisher(Image, "/camera", 10)
        nodes.node.create_timer(0.1, lambda: publisher.publish(self.message))

    def paint(self, *colour: int) -> None:
        """Another colour."""
        self.message.data = bytes(colour) * (64 * 48)


def test_a_picture_is_shown_and_its_brightness_is_spoken(page: Any, nodes: Nodes) -> None:
    """By keys; what the node films next is seen in the pixels."""
    camera = Camera(nodes)
    topic = page.get_by_label("Topic", exact=True)
    expect(topic.get_by_text("/camera", exact=True)).to_be_attached()
    assert nodes.listeners("/camera") == []
    topic.select_option("/camera")
    expect(page.get_by_text("Brightness 51 of 255")).to_be_visible()
    until(lambda: page.evaluate(COLOUR)[:3] == [51, 51, 51], "grey")
    camera.paint(255, 0, 0)
    until(lambda: page.evaluate(COLOUR)[:3] == [255, 0, 0], "red")
    page.get_by_role("button", name="Say the brightness").press("Enter")
    expect(page.get_by_role("status")).to_have_text("Brightness 85 of 255")
    expect(page.get_by_role("img", name="Picture of /camera, 64 x 48, rgb8")).to_be_visible()
    expect(page.get_by_text(re.compile(r"pictures/s; \d+ came"))).to_be_visible()


def test_a_wrong_step_is_told_and_the_next_picture_is_shown(page: Any, nodes: Nodes) -> None:
    """The page goes on."""
    camera = Camera(nodes)
    camera.message.step = 10
    topic = page.get_by_label("Topic", exact=True)
    expect(topic.get_by_text("/camera", exact=True)).to_be_attached()
    topic.select_option("/camera")
    said = page.get_by_role("alert").filter(has_text="its step is 10, and a row has 192 bytes")
    expect(said).to_be_visible()
    camera.message.step = 192
    expect(page.get_by_text("Brightness 51 of 255")).to_be_visible()
    page.close()
    until(lambda: not nodes.listeners("/camera"), "no subscription")
