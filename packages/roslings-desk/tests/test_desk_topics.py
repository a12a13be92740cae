"""The tab of topics, in a real browser, with real nodes beside it."""

from __future__ import annotations

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
    found.goto(f"{opened.base}/topics")
    expect(found.get_by_role("heading", name="Topics", level=2)).to_be_visible()
    return found


def says(nodes: Nodes, topic: str, words: Any, cls: Any = None) -> Any:
    """A node that says something ten times a second; its publisher."""
    from std_msgs.msg import String

    made = cls or String
    publisher = nodes.node.create_publisher(made, topic, 10)
    message = made(data=words)
    nodes.node.create_timer(0.1, lambda: publisher.publish(message))
    return publisher


def value(page: Any) -> Any:
    """The newest message, as the page shows it."""
    return page.get_by_role("region", name="The newest message")


def test_a_topic_is_chosen_by_keys_and_shows_what_a_node_says(page: Any, nodes: Nodes) -> None:
    """Its rate, its value; and nothing is subscribed before and after."""
    publisher = says(nodes, "/news", "hello")
    row = page.get_by_role("button", name="/news")
    expect(row).to_be_visible()
    assert nodes.listeners("/news") == []
    row.focus()
    page.keyboard.press("Enter")
    expect(value(page)).to_have_text("data: hello")
    expect(page.get_by_text("messages/s")).to_be_visible()
    until(lambda: len(nodes.listeners("/news")) == 1, "a subscription")
    page.goto(page.url.replace("/topics", "/plot"))
    until(lambda: not nodes.listeners("/news"), "no subscription")
    nodes.node.destroy_publisher(publisher)


def test_the_form_publishes_what_a_node_hears(page: Any, nodes: Nodes) -> None:
    """All done by keys: a topic that nobody has, its fields, once and again."""
    from geometry_msgs.msg import Twist

    heard = nodes.hear(Twist, "/told")
    page.get_by_role("button", name="/told").focus()
    page.keyboard.press("Enter")
    field = page.get_by_label("linear.x (double)")
    field.focus()
    page.keyboard.press("Control+A")
    page.keyboard.type("0.25")
    expect(field).to_have_value("0.25")
    once = page.get_by_role("button", name="Publish once")
    once.focus()
    until(lambda: heard or page.keyboard.press("Enter"), "a Twist")
    assert heard[-1].linear.x == 0.25
    page.get_by_label("Rate, Hz").fill("20")
    page.get_by_role("button", name="Publish at this rate").press("Enter")
    expect(page.get_by_role("status")).to_contain_text("20 Hz")
    count = len(heard)
    until(lambda: len(heard) > count + 10, "ten more")
    page.get_by_role("button", name="Stop publishing").press("Enter")
    expect(page.get_by_role("status")).to_contain_text("Nothing is published any more")


@pytest.mark.parametrize(
    ("label", "typed", "said"),
    [
        ("linear.x (double)", "fast", "linear.x: it needs a number"),
        ("linear.x (double)", "[1", "linear.x"),
        ("Rate, Hz", "nan", "'nan' is no rate"),
        ("Rate, Hz", "0", "'0' is no rate"),
    ],
)
def test_what_cannot_be_published_is_said_at_the_field(
    page: Any, nodes: Nodes, label: str, typed: str, said: str
) -> None:
    """And nothing is published."""
    from geometry_msgs.msg import Twist

    heard = nodes.hear(Twist, "/told")
    page.get_by_role("button", name="/told").click()
    page.get_by_label(label).fill(typed)
    page.get_by_role("button", name="Publish at this rate").click()
    expect(page.get_by_role("alert").filter(has_text=said)).to_be_visible()
    assert heard == []


def test_a_topic_that_changes_its_type_is_followed(page: Any, opened: Desk) -> None:
    """Two types at once are told by name. One participant of DDS has one type for a topic."""
    from std_msgs.msg import Float64

    with Nodes(opened.domain, "new") as new:
        with Nodes(opened.domain, "old") as old:
            says(old, "/changes", "words")
            page.get_by_role("button", name="/changes").click()
            expect(value(page)).to_have_text("data: words")
            says(new, "/changes", 1.5, Float64)
            expect(page.get_by_role("alert").filter(has_text="more than one")).to_be_visible()
        expect(value(page)).to_have_text("data: 1.5")


def test_what_was_kept_for_late_listeners_is_shown(page: Any, nodes: Nodes) -> None:
    """Said once and early; then a publisher comes that keeps nothing, and is heard as well."""
    from rclpy.qos import DurabilityPolicy, QoSProfile
    from std_msgs.msg import String

    page.get_by_label("Name", exact=True).fill("/kept")
    page.get_by_role("button", name="Choose this one").click()
    until(lambda: nodes.listeners("/kept"), "a subscription")
    kept = QoSProfile(depth=1, durability=DurabilityPolicy.TRANSIENT_LOCAL)
    nodes.node.create_publisher(String, "/kept", kept).publish(String(data="once"))
    expect(value(page)).to_have_text("data: once")
    says(nodes, "/kept", "often")
    expect(value(page)).to_have_text("data: often")


def test_a_string_of_a_megabyte_is_cut(page: Any, nodes: Nodes) -> None:
    """And its bandwidth is told."""
    says(nodes, "/long", "x" * 1_000_000)
    page.get_by_role("button", name="/long").click()
    expect(value(page)).to_contain_text("data: xxxx")
    expect(page.get_by_text("MB/s")).to_be_visible()
    assert len(value(page).text_content()) < 7_000


def test_of_five_hundred_topics_a_hundred_are_shown(page: Any, nodes: Nodes) -> None:
    """And all are found."""
    from std_msgs.msg import Bool

    publishers = [nodes.node.create_publisher(Bool, f"/many/t{n}", 1) for n in range(500)]
    expect(page.get_by_text("100 of them shown. Type more of the name.")).to_be_visible()
    page.get_by_label("Find a topic").fill("t499")
    expect(page.get_by_role("button", name="/many/t499")).to_be_visible()
    assert page.get_by_role("row").count() == 2
    for each in publishers:
        nodes.node.destroy_publisher(each)


@pytest.mark.parametrize(
    ("name", "kind", "said"),
    [
        ("/x", "no_such_msgs/msg/Thing", "'no_such_msgs/msg/Thing' is not installed here"),
        ("/x", "String", "Did you mean std_msgs/msg/String?"),
        ("no spaces", "std_msgs/msg/String", "is no valid name in ROS"),
    ],
)
def test_a_type_that_is_not_installed_is_told(page: Any, name: str, kind: str, said: str) -> None:
    """With the next step; so is a name that ROS does not allow."""
    page.get_by_label("Name", exact=True).fill(name)
    page.get_by_label("Type", exact=True).fill(kind)
    page.get_by_role("button", name="Choose this one").click()
    expect(page.get_by_role("alert").filter(has_text=said)).to_be_visible()


def test_a_page_that_slept_is_made_anew_when_it_wakes(
    page: Any, nodes: Nodes, context: Any
) -> None:
    """The desk has let it go, and what it listened to; then it shows what is there now."""
    says(nodes, "/news", "hello")
    page.get_by_role("button", name="/news").click()
    expect(value(page)).to_have_text("data: hello")
    session = context.new_cdp_session(page)
    session.send("Debugger.enable")
    session.send("Debugger.pause")  # its script stands still, as on a computer that sleeps
    until(lambda: not nodes.listeners("/news"), "the end of the subscription")
    says(nodes, "/later", "good morning")
    session.send("Debugger.disable")
    page.get_by_role("button", name="/later").click()
    expect(value(page)).to_have_text("data: good morning")
