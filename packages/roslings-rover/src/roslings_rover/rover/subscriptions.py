"""What a rover hears beside /cmd_vel when it was asked to listen: sentences, and its speed limit.

The node has a hidden name, so the lists and pictures that leave hidden nodes out stay as they
were. A topic is only subscribed to while somebody publishes on it: the rover makes none appear.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from functools import partial
from typing import Any

from roslings_rover.rover.rover import Rover

NAME = "_rover_ears"
SENTENCE_TYPE = "std_msgs/msg/String"
LIMIT_TOPIC, LIMIT_TYPE = "/motor_state", "std_msgs/msg/Float64"
LOOK_EVERY_S = 0.5
SENTENCE_LASTS_S = 3.0
LONGEST_SENTENCE = 60


@dataclass(frozen=True)
class HeardSentence:
    """What somebody said, and where."""

    text: str
    topic: str


@dataclass
class RoverSubscriptions:
    """The subscriptions of a rover that listens."""

    node: Any
    rover: Rover
    _heard: HeardSentence | None = None
    _heard_s: float = -math.inf
    _open: dict[str, Any] = field(default_factory=dict)

    @property
    def sentence(self) -> HeardSentence | None:
        """The newest one; None when it is some seconds old."""
        fresh = time.monotonic() - self._heard_s < SENTENCE_LASTS_S
        return self._heard if fresh else None

    def look(self) -> None:
        """Listen to who has come, and no longer to who has gone."""
        wanted = self._wanted()
        for topic in [*self._open]:
            if topic not in wanted:
                self.node.destroy_subscription(self._open.pop(topic))
                self._forget(topic)
        for topic, (kind, take) in wanted.items():
            if topic not in self._open:
                self._open[topic] = self._subscription(topic, kind, take)

    def _wanted(self) -> dict[str, tuple[str, Callable[[Any], None]]]:
        found: dict[str, tuple[str, Callable[[Any], None]]] = {}
        for topic, kinds in self.node.get_topic_names_and_types():
            if not self.node.count_publishers(topic):
                continue
            if topic == LIMIT_TOPIC and LIMIT_TYPE in kinds:
                found[topic] = LIMIT_TYPE, self._take_limit
            elif SENTENCE_TYPE in kinds:
                found[topic] = SENTENCE_TYPE, partial(self._take_sentence, topic)
        return found

    def _subscription(self, topic: str, kind: str, take: Callable[[Any], None]) -> Any:
        from rclpy.qos import QoSProfile, ReliabilityPolicy
        from std_msgs.msg import Float64, String

        # What asks for least is offered by every publisher.
        least = QoSProfile(depth=1, reliability=ReliabilityPolicy.BEST_EFFORT)
        message = Float64 if kind == LIMIT_TYPE else String
        return self.node.create_subscription(message, topic, take, least)

    def _take_sentence(self, topic: str, said: Any) -> None:
        line = " ".join(said.data.split())
        text = "".join(letter for letter in line if letter.isprintable())
        short = text if len(text) <= LONGEST_SENTENCE else f"{text[: LONGEST_SENTENCE - 4]} ..."
        self._heard, self._heard_s = HeardSentence(short, topic), time.monotonic()

    def _take_limit(self, said: Any) -> None:
        """A limit that is none, or that would let it only stand, is not followed."""
        if math.isfinite(said.data) and said.data > 0:
            self.rover.limit(said.data)

    def _forget(self, topic: str) -> None:
        if topic == LIMIT_TOPIC:
            self.rover.limit(math.inf)


@contextmanager
def subscribing(context: Any, executor: Any, rover: Rover) -> Iterator[RoverSubscriptions]:
    """The subscriptions in the process of the rover, spun by its executor, until the block ends."""
    import rclpy

    node = rclpy.create_node(
        NAME, context=context, enable_rosout=False, start_parameter_services=False
    )
    executor.add_node(node)
    subscriptions = RoverSubscriptions(node, rover)
    node.create_timer(LOOK_EVERY_S, subscriptions.look)
    try:
        yield subscriptions
    finally:
        executor.remove_node(node)
        node.destroy_node()
