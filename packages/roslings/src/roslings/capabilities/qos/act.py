"""Experiments with quality of service: subscribe late, and see what is kept."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from roslings.capabilities.qos.record import JoinSeen, QosSeen
from roslings.course import TopicContract
from roslings.course.contract import Plain
from roslings.evidence import Endpoint
from roslings.experiment.missed import publishes
from roslings.experiment.scene import Scene
from roslings.probe.content import message_class, to_plain
from roslings.probe.events import no_subscription_events
from roslings.seen.matching import nearest_endpoint

SHOWS_WITHIN_S, QUIET_S = 3.0, 0.4
"""For the first message that was kept, and for all others."""


def come_late(
    scene: Scene, topic: TopicContract, after: str, wanted: Plain | None, said: int
) -> None:
    """Subscribe now to a latched topic, and listen to what is there already.

    `after` says in words what was done before. `wanted` is what the field `data` of the last
    message should be. `said` is how many messages there should be so far.

    >>> come_late(scene, E_STOP, "the start", wanted=True, said=1)
    """
    seen = JoinSeen(after=after, wanted=wanted, said=said)
    scene.appears(lambda: _publisher(scene, topic) is not None, publishes(topic))
    end = _publisher(scene, topic)
    if end is None:
        return
    with _late(scene, end.topic, end.type, seen.heard) as subscription:
        scene.until(lambda: bool(seen.heard), SHOWS_WITHIN_S)
        scene.until(lambda: False, QUIET_S)
        seen.matched = subscription.get_publisher_count() > 0
    scene.seen.recording(QosSeen).joins.append(seen)


def _publisher(scene: Scene, topic: TopicContract) -> Endpoint | None:
    return nearest_endpoint(scene.seen.graph, "publisher", topic.topic, topic.type)


@contextmanager
def _late(scene: Scene, topic: str, type_: str, heard: list[Any]) -> Iterator[Any]:
    """A subscription that asks for what was said before it came."""
    from rclpy.qos import DurabilityPolicy, QoSProfile

    probe_node, kind = scene.probe.node, message_class(type_)
    kept = QoSProfile(depth=100, durability=DurabilityPolicy.TRANSIENT_LOCAL)

    def hear(message: Any) -> None:
        heard.append(to_plain(message).get("data"))
        scene.probe.notify()

    subscription = probe_node.create_subscription(
        kind, topic, hear, kept, event_callbacks=no_subscription_events()
    )
    try:
        yield subscription
    finally:
        probe_node.destroy_subscription(subscription)
