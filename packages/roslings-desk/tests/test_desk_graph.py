"""The tab of the running graph, in a real browser, with real nodes; and its parts alone."""

from __future__ import annotations

from typing import Any

import pytest
from desk_program import Desk, Nodes

from ros2_on_pip.graph.seen import PUBLISHER, SUBSCRIPTION, EndpointNow, GraphNow, misfits
from ros2_on_pip.graph.shape import shape_of
from roslings_desk.tabs.graph import MOST_DRAWN, around
from skips import imported

expect = imported("playwright.sync_api").expect
expect.set_options(timeout=120_000)

STRING, BOOL = "std_msgs/msg/String", "std_msgs/msg/Bool"


def qos(**policies: str) -> Any:
    """An rclpy profile; reliable and volatile where nothing else is said."""
    rclpy_qos = imported("rclpy.qos")
    kinds = {
        "reliability": rclpy_qos.ReliabilityPolicy,
        "durability": rclpy_qos.DurabilityPolicy,
    }
    return rclpy_qos.QoSProfile(
        depth=10, **{name: kinds[name][word] for name, word in policies.items()}
    )


def graph(*ends: tuple[str, str, str, str, Any]) -> GraphNow:
    """One of these endpoints."""
    return GraphNow(sorted({end[1] for end in ends}), [EndpointNow(*end) for end in ends])


def test_what_does_not_fit_is_told_once_with_its_reason() -> None:
    """A quality that is not offered, and another type; what fits is not told."""
    best_effort, reliable = qos(reliability="BEST_EFFORT"), qos()
    seen = graph(
        (PUBLISHER, "/camera", "/image", STRING, best_effort),
        (SUBSCRIPTION, "/viewer", "/image", STRING, reliable),
        (SUBSCRIPTION, "/viewer", "/image", STRING, reliable),
        (SUBSCRIPTION, "/easy", "/image", STRING, best_effort),
        (PUBLISHER, "/a", "/on", STRING, reliable),
        (SUBSCRIPTION, "/b", "/on", BOOL, reliable),
    )
    assert misfits(seen) == [
        "On /image no message goes from /camera to /viewer: it offers reliability BEST_EFFORT, and"
        " RELIABLE is asked for.",
        "On /on no message goes from /a to /b: it has the type std_msgs/msg/String, and"
        " std_msgs/msg/Bool is asked for.",
    ]


def test_around_a_name_stands_what_is_right_beside_it() -> None:
    """Of a chain, a node with its topics, and a topic with its nodes; no more."""
    fits = qos()
    whole = shape_of(
        graph(
            (PUBLISHER, "/camera", "/image", STRING, fits),
            (SUBSCRIPTION, "/finder", "/image", STRING, fits),
            (PUBLISHER, "/finder", "/ball", STRING, fits),
            (SUBSCRIPTION, "/driver", "/ball", STRING, fits),
        )
    )
    assert around(whole, "") is whole
    near = around(whole, "ima")
    assert [node.name for node in near.nodes] == ["/camera", "/finder"]
    assert [topic.name for topic in near.topics] == ["/image"]
    assert [topic.name for topic in around(whole, "/finder").topics] == ["/ball", "/image"]
    assert around(whole, "nobody").nodes == ()


@pytest.fixture
def page(context: Any, opened: Desk) -> Any:
    """The tab, open."""
    found = context.new_page()
    found.goto(f"{opened.base}/graph")
    expect(found.get_by_role("heading", name="Graph", level=2)).to_be_visible()
    return found


@pytest.mark.slow
def test_a_node_that_comes_and_goes_is_drawn_and_told(
    page: Any, opened: Desk, nodes: Nodes
) -> None:
    """In the picture and in the list; the desk itself is in none of them."""
    from std_msgs.msg import String

    picture = page.get_by_role("region", name="The picture").get_by_role("img")
    words = page.get_by_role("region", name="Nodes and topics")
    expect(picture).to_have_accessible_name(
        "A ROS graph with 1 node and 0 topics. /tester has no topic."
    )
    nodes.node.create_publisher(String, "/chatter", 10)
    expect(words).to_contain_text("publishes /chatter, std_msgs/msg/String; it is heard by nobody")
    with Nodes(opened.domain, "listener") as others:
        others.hear(String, "/chatter")
        expect(picture).to_have_accessible_name(
            "A ROS graph with 2 nodes and 1 topic. /tester publishes on /chatter"
            " (std_msgs/msg/String), and /listener subscribes to it."
        )
        expect(words).to_contain_text("it is published by /tester")
        assert picture.locator("ellipse").count() == 2
        assert "desk_" not in page.locator("main, body").first.inner_text()
    expect(words).not_to_contain_text("/listener")


@pytest.mark.slow
def test_it_is_read_by_keys_alone(page: Any, nodes: Nodes) -> None:
    """Narrowed by a name, shown with the parts of ROS, and spoken when that is asked for."""
    from std_msgs.msg import Bool, String

    nodes.node.create_publisher(String, "/chatter", 10)
    nodes.node.create_publisher(Bool, "/light", 10)
    words = page.get_by_role("region", name="Nodes and topics")
    expect(words).to_contain_text("publishes /light")
    page.get_by_label("Only around names with").press_sequentially("chat")
    expect(words).not_to_contain_text("/light")
    expect(page.get_by_text("1 node, 1 topic of 1 node, 2 topics")).to_be_visible()
    page.get_by_role("button", name="Say the graph").press("Enter")
    expect(
        page.get_by_role("status").filter(has_text="/tester publishes on /chatter")
    ).to_be_visible()
    page.get_by_label("Only around names with").fill("")
    page.get_by_label("Also /rosout and other parts of ROS").press("Space")
    expect(words).to_contain_text("publishes /rosout, rcl_interfaces/msg/Log")


@pytest.mark.slow
def test_a_quality_that_does_not_fit_is_an_alarm(page: Any, opened: Desk, nodes: Nodes) -> None:
    """It names both nodes, and is gone when the node is."""
    from std_msgs.msg import String

    nodes.node.create_publisher(String, "/image", qos(reliability="BEST_EFFORT"))
    alarm = page.get_by_role("alert").filter(has_text="On /image")
    with Nodes(opened.domain, "viewer") as others:
        others.hear(String, "/image")
        expect(alarm).to_contain_text("no message goes from /tester to /viewer: it offers")
        expect(alarm).to_contain_text("Give both the same type and the same QoS profile")
    expect(alarm).to_have_count(0)


@pytest.mark.slow
def test_a_graph_too_large_to_draw_is_told_in_words(page: Any, nodes: Nodes) -> None:
    """A name that is typed makes it small enough again."""
    from std_msgs.msg import String

    for number in range(MOST_DRAWN):
        nodes.node.create_publisher(String, f"/topic_{number}", 10)
    expect(page.get_by_text("too many to draw")).to_be_visible()
    expect(page.get_by_role("img")).to_have_count(0)
    expect(page.get_by_role("region", name="Nodes and topics")).to_contain_text("/topic_119")
    page.get_by_label("Only around names with").fill("topic_11")
    expect(page.get_by_role("img")).to_have_count(1)
