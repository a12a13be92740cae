"""The tab of the rover, in a real browser, with the real rover and nodes beside it."""

from __future__ import annotations

import math
import re
import signal
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from desk_program import PATIENCE_S, Desk, Nodes, program, until

from roslings_rover.models.world import default_world
from roslings_rover.rover.moving_map import place_under
from skips import imported

expect = imported("playwright.sync_api").expect
expect.set_options(timeout=120_000)
pytestmark = pytest.mark.slow

PLACE = re.compile(r"^x (-?[\d.]+) m, y (-?[\d.]+) m, heading (-?\d+) degrees$")
BALL = (2.0, 0.6)
TOUCHES_M = 0.25
"""Centre of the rover to centre of the ball, where their rims meet: 0.12 + 0.10, and a little."""


@pytest.fixture
def rover(opened: Desk, home: Path) -> Iterator[Any]:
    """The real rover, in its own process."""
    with program("roslings_rover", ["rover", "--view", "lines"], opened.domain, home) as process:
        yield process
        process.send_signal(signal.SIGINT)  # it says goodbye: the next rover is the only one
        process.wait(PATIENCE_S)


@pytest.fixture
def page(context: Any, opened: Desk) -> Any:
    """The tab, open."""
    found = context.new_page()
    found.goto(f"{opened.base}/rover")
    return found


def place(page: Any) -> tuple[float, float, float]:
    """Where the page says that it is: x, y, and its heading in radians."""
    words = until(
        lambda: PLACE.match(page.get_by_text(re.compile("^x .* degrees$")).first.text_content()),
        "a place",
    )
    return float(words[1]), float(words[2]), math.radians(float(words[3]))


def twists(nodes: Nodes) -> list[Any]:
    """What is said on /cmd_vel."""
    from geometry_msgs.msg import Twist

    return nodes.hear(Twist, "/cmd_vel")


def is_zero(twist: Any) -> bool:
    """It stops."""
    return not (twist.linear.x or twist.angular.z)


def hold_ahead(page: Any, heard: list[Any]) -> None:
    """Hold the key until a node hears it."""
    page.get_by_role("application", name="Drive by arrow keys").focus()
    page.keyboard.down("ArrowUp")
    until(lambda: any(twist.linear.x > 0 for twist in heard), "a Twist ahead")


def stops(heard: list[Any]) -> None:
    """The last Twist is zero; nothing but zeros comes after the first of them."""
    until(lambda: is_zero(heard[-1]), "a zero Twist")
    at = max(number for number, twist in enumerate(heard) if not is_zero(twist))
    assert len(heard) > at + 1


def test_a_key_that_is_held_drives_and_its_end_stops(rover: Any, page: Any, nodes: Nodes) -> None:
    """The page shows where the rover has gone; a node hears what the page says."""
    heard = twists(nodes)
    before = place(page)
    picture = page.get_by_role("img", name="Map of the room")
    source = picture.get_attribute("src")
    hold_ahead(page, heard)
    until(lambda: place(page)[0] > before[0] + 0.3, "the rover ahead")
    page.keyboard.up("ArrowUp")
    stops(heard)
    assert heard[0].linear.x == pytest.approx(0.3)
    expect(picture).not_to_have_attribute("src", source)
    expect(picture).to_have_attribute("alt", re.compile("The rover is at x 0"))


def test_closing_the_page_stops_it(rover: Any, page: Any, nodes: Nodes) -> None:
    """With a key still held."""
    heard = twists(nodes)
    hold_ahead(page, heard)
    page.close()
    stops(heard)


def test_a_page_that_is_lost_stops_it(rover: Any, page: Any, nodes: Nodes, context: Any) -> None:
    """Its script stands still, and its connection is open: as on a computer that sleeps."""
    heard = twists(nodes)
    hold_ahead(page, heard)
    session = context.new_cdp_session(page)
    session.send("Debugger.enable")
    session.send("Debugger.pause")
    stops(heard)
    session.send("Debugger.disable")


def test_ending_the_desk_stops_it(browser: Any, tmp_path: Path) -> None:
    """By Ctrl-C in its terminal, while it drives."""
    from desk_program import desk

    from ros2_on_pip.domain_lease import leased_domain

    with leased_domain() as domain, desk(domain, tmp_path) as own, Nodes(domain) as nodes:
        heard = twists(nodes)
        page = browser.new_page()
        page.goto(own.file.as_uri())
        hold_ahead(page, heard)
        assert own.interrupt() == 0
        stops(heard)
        page.close()


def test_escape_stops_from_anywhere_and_other_keys_drive_in_the_pad_alone(
    rover: Any, page: Any, nodes: Nodes
) -> None:
    """Escape is heard with the focus in a list; an arrow key there drives nothing."""
    heard = twists(nodes)
    speed = page.get_by_label("Speed, m/s")
    speed.focus()
    page.keyboard.press("ArrowDown")
    until(lambda: heard or page.keyboard.press("Escape"), "the Twist of Escape")
    assert all(map(is_zero, heard))
    page.get_by_role("button", name="Stop").focus()
    heard.clear()
    until(lambda: heard or page.keyboard.press("Enter"), "the Twist of the button")
    assert all(map(is_zero, heard))


def test_it_is_driven_to_the_ball_by_what_a_screen_reader_has(
    rover: Any, page: Any, nodes: Nodes
) -> None:
    """Names of buttons and one line of text: no picture, no key, nothing dragged."""
    expect(page.locator("#state")).to_be_empty()
    page.get_by_label("Turn, rad/s").select_option("0.5")
    until(
        lambda: math.dist(place(page)[:2], BALL) < TOUCHES_M or press_towards(page, BALL),
        "the ball",
    )
    page.get_by_role("button", name="Say where it is").click()
    expect(page.get_by_role("status")).to_have_text(PLACE)


def press_towards(page: Any, goal: tuple[float, float]) -> bool:
    """One press of the button that leads nearer; it is over when the rover stands."""
    x_m, y_m, heading_rad = place(page)
    off_rad = math.remainder(math.atan2(goal[1] - y_m, goal[0] - x_m) - heading_rad, math.tau)
    word = "Ahead" if abs(off_rad) < 0.2 else "Left" if off_rad > 0 else "Right"
    page.get_by_role("button", name=word).click()
    until(lambda: place(page) != (x_m, y_m, heading_rad), "a move")
    seen: list[Any] = []
    until(lambda: seen.append(place(page)) or _rests(seen), "a rest")
    return False


def _rests(seen: list[Any]) -> bool:
    return len(seen) > 40 and len(set(seen[-40:])) == 1


def test_nothing_is_subscribed_that_no_page_shows(
    page: Any, nodes: Nodes, opened: Desk, context: Any
) -> None:
    """Two pages, one subscription; it ends with the second page. Nor is anything, before there is
    somebody to hear."""
    from nav_msgs.msg import Odometry

    expect(page.get_by_text("No node publishes /odom")).to_be_visible()
    topics = dict(nodes.node.get_topic_names_and_types())
    assert not {"/odom", "/cmd_vel", "/goal_pose"} & topics.keys()
    nodes.node.create_publisher(Odometry, "/odom", 10)
    second = context.new_page()
    second.goto(f"{opened.base}/rover")
    expect(second.get_by_role("heading", name="Rover")).to_be_visible()
    until(lambda: len(nodes.listeners("/odom")) == 1, "one subscription")
    page.close()
    expect(second.get_by_text(re.compile("No node listens|Nothing comes"))).to_be_visible()
    assert len(nodes.listeners("/odom")) == 1
    second.close()
    until(lambda: not nodes.listeners("/odom"), "the end of the subscription")


def test_numbers_that_are_not_finite_are_told(page: Any, nodes: Nodes) -> None:
    """The map stands as it did."""
    from nav_msgs.msg import Odometry

    publisher = nodes.node.create_publisher(Odometry, "/odom", 10)
    wrong = Odometry()
    wrong.pose.pose.position.x = math.nan
    timer = nodes.node.create_timer(0.1, lambda: publisher.publish(wrong))
    expect(page.get_by_text("The numbers of /odom are not finite.")).to_be_visible()
    right = Odometry()
    right.pose.pose.position.x = 1.5
    right.pose.pose.orientation.w = 1.0
    nodes.node.destroy_timer(timer)
    nodes.node.create_timer(0.1, lambda: publisher.publish(right))
    expect(page.get_by_text("x 1.50 m, y 0.00 m, heading 0 degrees")).to_be_visible()


GAMEPAD = """
let stick = [0, 0];
window.pressed = false;
Object.defineProperty(window, "stick", {set: (axes) => { stick = axes; window.polled = 0; }});
navigator.getGamepads = () => {
  window.polled += 1;
  return [null, {connected: true, axes: stick, buttons: [{pressed: window.pressed}]}];
};
"""
"""A browser without one has an empty list; where one is plugged in, this is its form."""


def test_a_gamepad_drives_while_the_pad_has_the_focus(
    context: Any, opened: Desk, nodes: Nodes
) -> None:
    """Half the stick is half the speed. It stops where the stick is let go, and by Escape or its
    button, and then drives no more before the stick was let go."""
    heard = twists(nodes)
    page = context.new_page()
    page.add_init_script(GAMEPAD)
    page.goto(f"{opened.base}/rover")
    pad = page.get_by_role("application", name="Drive by arrow keys")
    page.evaluate("window.stick = [0, -0.5]")
    expect(page.get_by_text("A gamepad drives")).to_be_visible()
    pad.focus()
    until(lambda: any(twist.linear.x == pytest.approx(0.15) for twist in heard), "half the speed")
    page.evaluate("window.stick = [0.1, 0.05]")
    stops(heard)
    page.evaluate("window.stick = [-1, 0]")
    until(lambda: heard[-1].angular.z == pytest.approx(1.0), "a turn to the left")
    page.keyboard.press("Escape")
    stops(heard)
    for stick in ([0, 0], [-1, 0]):
        page.evaluate(f"window.stick = {stick}")
        page.wait_for_function("window.polled > 2")
    until(lambda: not is_zero(heard[-1]), "a turn again, after the stick was let go")
    page.evaluate("window.pressed = true")
    until(lambda: is_zero(heard[-1]), "the button's stop")
    page.evaluate("window.pressed = false; window.stick = [0, 0]")
    page.wait_for_function("window.polled > 2")
    page.evaluate("window.stick = [0, -1]")
    until(lambda: not is_zero(heard[-1]), "a drive ahead")
    page.get_by_label("Speed, m/s").focus()
    until(lambda: is_zero(heard[-1]), "the stop of a field that lost the focus")
    page.close()


def goals(nodes: Nodes) -> list[Any]:
    """What is said on /goal_pose; the page knows that somebody hears it."""
    from geometry_msgs.msg import PoseStamped

    heard = nodes.hear(PoseStamped, "/goal_pose")
    until(lambda: nodes.node.count_publishers("/goal_pose"), "the page's publisher")
    return heard


def test_a_click_on_the_map_is_a_goal(rover: Any, page: Any, nodes: Nodes) -> None:
    """Where the rover stands, a click says just that place; its frame is that of /odom."""
    heard = goals(nodes)
    here = place(page)
    page.locator("img.map").click(position=in_pixels(page, *in_picture(*here[:2])))
    until(lambda: heard, "a goal")
    position = heard[0].pose.position
    assert math.dist((position.x, position.y), here[:2]) < 0.05
    assert heard[0].header.frame_id == "odom" and heard[0].header.stamp.sec > 0
    expect(page.get_by_role("status")).to_contain_text("is published on /goal_pose")


def in_pixels(page: Any, right: float, down: float) -> dict[str, float]:
    """Where parts of the picture are on the page: it stands in the middle of its place, whole."""
    wide, high, own_wide, own_high = page.locator("img.map").evaluate(
        "(map) => [map.clientWidth, map.clientHeight, map.naturalWidth, map.naturalHeight]"
    )
    scale = min(wide / own_wide, high / own_high)
    return {
        "x": wide / 2 + (right - 0.5) * own_wide * scale,
        "y": high / 2 + (down - 0.5) * own_high * scale,
    }


def in_picture(x_m: float, y_m: float) -> tuple[float, float]:
    """Parts of the map's width and height, found without the desk: both grow evenly."""
    west, north = place_under(default_world(), 0, 0)
    east, south = place_under(default_world(), 1, 1)
    return (x_m - west) / (east - west), (north - y_m) / (north - south)


def test_a_goal_is_typed_and_a_wrong_one_is_told(page: Any, nodes: Nodes) -> None:
    """By keys alone; who hears it is said."""
    heard = goals(nodes)
    page.get_by_label("Goal x, m").fill("far")
    page.get_by_role("button", name="Send the goal").press("Enter")
    expect(page.get_by_role("alert").filter(has_text="'far' is no place")).to_be_visible()
    page.get_by_label("Goal x, m").fill("1.5")
    page.get_by_label("Goal y, m").fill("-0.5")
    page.get_by_role("button", name="Send the goal").press("Enter")
    until(lambda: heard, "a goal")
    assert (heard[0].pose.position.x, heard[0].pose.position.y) == (1.5, -0.5)
    expect(page.get_by_role("status")).to_contain_text("1 subscription hears it")
