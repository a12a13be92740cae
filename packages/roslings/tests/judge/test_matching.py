"""What a student probably meant."""

from __future__ import annotations

import pytest

from ros2_on_pip.near_names import nearest
from roslings.evidence import Endpoint, GraphSeen, Qos
from roslings.seen.matching import nearest_endpoint

STRING = "std_msgs/msg/String"


@pytest.mark.parametrize(
    ("names", "found", "how"),
    [
        (["/chatter", "/chater"], "/chatter", "exact"),
        (["/chater", "/odom"], "/chater", "spelling"),
        (["/robot/chatter", "/chater"], "/robot/chatter", "namespace"),
        (["/Chatter"], "/Chatter", "case"),
        (["/odom"], "/odom", "other"),
    ],
)
def test_the_nearest_name_is_found(names: list[str], found: str, how: str) -> None:
    """The very name, then its namespace, capitals, spelling, and at last whatever is there."""
    near = nearest("/chatter", names)
    assert near is not None
    assert (near.found, near.how) == (found, how)


def test_no_name_is_near_to_nothing() -> None:
    """An empty graph."""
    assert nearest("/chatter", []) is None


def endpoint(topic: str, type_: str = STRING) -> Endpoint:
    """A publisher."""
    return Endpoint(kind="publisher", node="/a", topic=topic, type=type_, qos=Qos(), gid=topic)


def test_the_right_type_comes_before_the_like_name() -> None:
    """Of two wrong names, the one that carries the right type is meant."""
    ends = [endpoint("/chater", "std_msgs/msg/Int32"), endpoint("/words")]
    graph = GraphSeen(nodes=["/a"], endpoints=ends)
    found = nearest_endpoint(graph, "publisher", "/chatter", STRING)
    assert found is not None
    assert found.topic == "/words"


def test_what_ros_adds_itself_is_nobodys_slip() -> None:
    """/rosout is not a near miss of anything."""
    graph = GraphSeen(nodes=["/a"], endpoints=[endpoint("/rosout", "rcl_interfaces/msg/Log")])
    assert nearest_endpoint(graph, "publisher", "/chatter", STRING) is None
