"""The tab of the rover, while a rover drives in a room from a seed."""

from __future__ import annotations

import base64
import io
from pathlib import Path
from typing import Any

import pytest
from desk_program import Desk, Nodes, program, until
from PIL import Image

from roslings_rover.models.rooms import room_of
from roslings_rover.models.world import default_world
from roslings_rover.rover.picture import ROVER
from roslings_rover.rover.room_markers import markers_of_room
from skips import imported

expect = imported("playwright.sync_api").expect
expect.set_options(timeout=120_000)
pytestmark = pytest.mark.slow

SEED = 5
WORDS = ["rover", "--room", str(SEED), "--view", "lines"]
OWN = len(default_world().obstacles)
NOSE_M = 0.05
"""The rover's line makes the middle of its colour lie so far ahead."""
LEGEND_PX = 25
MOVES = 'fill="#c2571a"'


@pytest.fixture
def page(context: Any, opened: Desk) -> Any:
    """The tab, open."""
    found = context.new_page()
    found.goto(f"{opened.base}/rover")
    return found


def drawn(page: Any) -> str:
    """The map, as SVG."""
    source = page.locator("img.map").get_attribute("src")
    return base64.b64decode(source.partition(",")[2]).decode()


def obstacles(page: Any) -> int:
    """How many the map shows."""
    return drawn(page).count('class="obstacle"')


def test_the_map_is_that_of_the_room_as_long_as_the_rover_is_there(
    page: Any, opened: Desk, nodes: Nodes, home: Path
) -> None:
    """What stands, what moves, and again the course's own room when the rover has ended."""
    assert obstacles(page) == OWN
    assert nodes.listeners("/room") == []  # no topic appears by looking
    with program("roslings_rover", WORDS, opened.domain, home):
        until(lambda: obstacles(page) == len(room_of(SEED).world.obstacles), "the room")
        until(lambda: drawn(page).count(MOVES) == len(room_of(SEED).tracks) + 1, "what moves")
        first = drawn(page)
        until(lambda: drawn(page) != first, "a move, though the rover stands")
        expect(page.get_by_text("x 0.00 m, y 0.00 m, heading 0 degrees")).to_be_visible()
    until(lambda: obstacles(page) == OWN and MOVES not in drawn(page), "the course's room")


@pytest.mark.parametrize("size", [(1280, 720), (1280, 1600), (600, 900)])
def test_a_click_on_the_rover_is_the_place_where_it_is(
    page: Any, opened: Desk, nodes: Nodes, home: Path, size: tuple[int, int]
) -> None:
    """One clicks what one sees, on a map of any shape in a window of any size."""
    from geometry_msgs.msg import PoseStamped

    page.set_viewport_size({"width": size[0], "height": size[1]})
    heard = nodes.hear(PoseStamped, "/goal_pose")
    with program("roslings_rover", WORDS, opened.domain, home):
        until(lambda: obstacles(page) == len(room_of(SEED).world.obstacles), "the room")
        until(lambda: nodes.node.count_publishers("/goal_pose"), "the page's publisher")
        page.locator("img.map").click(position=_rover_seen(page))
        until(lambda: heard, "a goal")
    place = heard[0].pose.position
    assert abs(place.x - NOSE_M) < 0.1 and abs(place.y) < 0.1


def _rover_seen(page: Any) -> dict[str, float]:
    """The middle of all that has the rover's colour, but for the sign in the legend above."""
    shot = Image.open(io.BytesIO(page.locator("img.map").screenshot())).convert("RGB")
    wanted = tuple(bytes.fromhex(ROVER.lstrip("#")))
    found = [
        (x, y)
        for y in range(shot.height)
        for x in range(shot.width)
        if shot.getpixel((x, y)) == wanted
    ]
    top = min(y for _, y in found)
    below = [(x, y) for x, y in found if y > top + LEGEND_PX]
    columns, rows = zip(*below, strict=True)
    return {"x": sum(columns) / len(columns), "y": sum(rows) / len(rows)}


def test_what_tells_no_room_is_not_shown(page: Any, nodes: Nodes) -> None:
    """Anybody may publish on /room: a room is drawn, and after a floor of no size the usual one."""
    from rclpy.qos import DurabilityPolicy, QoSProfile
    from visualization_msgs.msg import Marker, MarkerArray

    kept = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    publisher = nodes.node.create_publisher(MarkerArray, "/room", kept)
    room = room_of(SEED)
    publisher.publish(markers_of_room(room.world, nodes.node.get_clock().now().to_msg()))
    until(lambda: obstacles(page) == len(room.world.obstacles), "the room")
    publisher.publish(MarkerArray(markers=[Marker(ns="floor", type=Marker.CUBE)]))
    until(lambda: obstacles(page) == OWN, "the course's room")
