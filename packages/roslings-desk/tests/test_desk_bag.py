"""A bag in the desk, in a real browser: the same tabs show it, at any place in it."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from desk_program import PATIENCE_S, Desk, Nodes, desk, until

from ros2_on_pip.domain_lease import leased_domain
from ros2_on_pip.rosbag2.metadata import Topic
from ros2_on_pip.rosbag2.writing import BagWriter, BagWriterOptions
from skips import imported

expect = imported("playwright.sync_api").expect
expect.set_options(timeout=120_000)
pytestmark = pytest.mark.slow

LASTS_S, RATE_HZ, METRES_A_S = 600, 10, 0.01
FIRST_NS = 1_700_000_000 * 10**9


def write(folder: Path, topics: dict[str, str], messages: Any) -> Path:
    """A bag of these topics, name to type, and of messages (topic, ns since 1970, content)."""
    from rclpy.serialization import serialize_message

    writer = BagWriter(folder, BagWriterOptions())
    for name, kind in topics.items():
        writer.add_topic(Topic(name, kind))
    for topic, time_ns, message in messages:
        writer.write(topic, time_ns, serialize_message(message))
    writer.close()
    return folder


def odometry(x_m: float) -> Any:
    """A rover that stands there."""
    from nav_msgs.msg import Odometry

    message = Odometry()
    message.pose.pose.position.x = x_m
    message.pose.pose.orientation.w = 1.0
    return message


@pytest.fixture(scope="module")
def bag(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Ten minutes of a rover that goes ahead by a centimetre a second."""
    times_s = [number / RATE_HZ for number in range(LASTS_S * RATE_HZ)]
    said = (
        ("/odom", FIRST_NS + round(at_s * 1e9), odometry(at_s * METRES_A_S)) for at_s in times_s
    )
    folder = tmp_path_factory.mktemp("bags") / "drive"
    return write(folder, {"/odom": "nav_msgs/msg/Odometry"}, said)


@pytest.fixture(scope="module")
def opened(tmp_path_factory: pytest.TempPathFactory, bag: Path) -> Iterator[Desk]:
    """A desk that plays it."""
    home = tmp_path_factory.mktemp("home")
    with leased_domain() as domain, desk(domain, home, "--bag", str(bag)) as found:
        yield found


@pytest.fixture
def page(context: Any, opened: Desk) -> Any:
    """The rover's tab."""
    found = context.new_page()
    found.goto(f"{opened.base}/rover")
    expect(found.get_by_role("group", name="The bag")).to_be_visible()
    return found


def place_m(page: Any) -> float:
    """Where the rover's tab says that it is."""
    words = page.locator("p.value").filter(has_text="heading").text_content()
    return float(words.split()[1])


def go(page: Any, place_s: float) -> None:
    """Move the slider."""
    page.get_by_label("Place in the bag, s").fill(str(place_s))


def test_it_stands_and_jumps_and_goes_on(page: Any) -> None:
    """By keys alone; the map shows what was true at the place, also where the bag stands."""
    pause = page.get_by_role("group", name="The bag").get_by_role("button")
    expect(pause).to_have_text("Pause")
    pause.press("Enter")
    expect(pause).to_have_text("Go on")
    for place_s in (450, 150):
        go(page, place_s)
        expect(page.get_by_text(f"x {place_s * METRES_A_S:.2f} m")).to_be_visible()
        expect(page.get_by_text(f"{place_s}.0 s of 599.9 s")).to_be_visible()
    before_m = place_m(page)
    pause.press("Enter")
    until(lambda: place_m(page) > before_m, "a move")
    assert place_m(page) < 450 * METRES_A_S


def test_at_its_end_it_stands_and_begins_anew(page: Any) -> None:
    """It says so on the button."""
    pause = page.get_by_role("group", name="The bag").get_by_role("button")
    go(page, 599.5)
    expect(page.get_by_text("599.9 s of 599.9 s")).to_be_visible()
    expect(pause).to_have_text("Go on")
    pause.click()
    expect(page.get_by_text("x 0.0")).to_be_visible()


def test_other_tabs_hear_it_and_nobody_else_does(page: Any, opened: Desk, tmp_path: Path) -> None:
    """It is played in a domain of its own: a robot of this computer does not drive by it."""
    page.get_by_role("link", name="Topics").click()
    page.get_by_role("button", name="/odom").click()
    expect(page.get_by_role("region", name="The newest message")).to_contain_text("child_frame_id")
    with Nodes(opened.domain) as nodes:
        assert "/odom" not in dict(nodes.node.get_topic_names_and_types())


@pytest.mark.parametrize(
    ("made", "said"),
    [
        ("nothing", "there is nothing of that name"),
        ("text", "neither .mcap nor .db3"),
        ("broken", "bag"),
        ("empty", "no message of a type that is installed here"),
    ],
)
def test_what_is_no_bag_is_told(made: str, said: str, tmp_path: Path) -> None:
    """With the next step, and it ends with 2."""
    place = tmp_path / made
    if made == "text":
        place.write_text("no bag")
    if made == "broken":
        place = tmp_path / "broken.mcap"
        place.write_bytes(b"\x89MCAP0\r\n" + bytes(100))
    if made == "empty":
        write(place, {"/odom": "nav_msgs/msg/Odometry"}, [])
    with leased_domain() as domain, desk(domain, tmp_path, "--bag", str(place)) as found:
        assert found.process.wait(PATIENCE_S) == 2
    lines = "\n".join(found.lines)
    assert said in lines and "Traceback" not in lines
