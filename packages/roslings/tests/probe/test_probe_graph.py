"""The graph is read when something in it has changed, and then all of it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import pytest

from ros2_on_pip.domain_lease import leased_domain
from roslings.evidence import ExperimentSeen, GraphSeen
from roslings.probe import Probe
from roslings.probe.graph import Looker
from skips import imported

imported("rclpy")
WITHIN_S = 20.0
WORD = ("publisher", "/talker", "/word")


@pytest.fixture
def domain(monkeypatch: pytest.MonkeyPatch) -> Iterator[int]:
    """A domain where nothing runs."""
    monkeypatch.setenv("ROS_AUTOMATIC_DISCOVERY_RANGE", "LOCALHOST")
    with leased_domain() as number:
        yield number


@pytest.fixture
def probe(domain: int) -> Iterator[Probe]:
    """Eyes on it."""
    seen = ExperimentSeen(name="graph", clock="wall")
    with Probe(domain, seen, record=False) as running:
        yield running


@pytest.fixture
def talker(domain: int) -> Iterator[Any]:
    """Somebody else's node."""
    import rclpy
    from rclpy.node import Node

    context = rclpy.Context()
    rclpy.init(context=context, domain_id=domain, signal_handler_options=None)
    node = Node("talker", context=context)
    yield node
    node.destroy_node()
    context.try_shutdown()


def parts(graph: GraphSeen) -> set[tuple[str, str, str]]:
    """What each endpoint is, and whose."""
    return {(each.kind, each.node, each.topic) for each in graph.endpoints}


def test_it_is_read_again_when_it_has_changed(probe: Probe, talker: Any) -> None:
    """A publisher that is new, with its node's name, and one that is gone."""
    from std_msgs.msg import String

    looker = Looker(probe.node)
    found = looker.read()

    def look() -> GraphSeen:
        nonlocal found
        found = looker.changed() or found
        return found

    assert probe.until(lambda: "/talker" in look().nodes, WITHIN_S)
    publisher = talker.create_publisher(String, "/word", 10)
    assert probe.until(lambda: WORD in parts(look()), WITHIN_S)
    assert probe.until(lambda: looker.changed() is None, WITHIN_S)
    assert WORD in parts(looker.read())
    talker.destroy_publisher(publisher)
    assert probe.until(lambda: WORD not in parts(look()), WITHIN_S)


def test_what_has_gone_meanwhile_found_room(probe: Probe, talker: Any) -> None:
    """A publisher that was counted, and is gone when its details are asked for."""
    from std_msgs.msg import String

    class Late:
        """Counts one publisher more than there is left to read."""

        def __getattr__(self, name: str) -> Any:
            return getattr(probe.node, name)

        def count_publishers(self, topic: str) -> int:
            """As it was a moment ago."""
            return int(probe.node.count_publishers(topic)) + (topic == "/word")

    talker.create_publisher(String, "/word", 10)
    looker = Looker(Late())
    assert probe.until(lambda: WORD in parts(looker.read()), WITHIN_S)
    assert looker.left_out == 0
