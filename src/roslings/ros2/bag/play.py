"""`ros2 bag play`: say again what a bag holds, at the pace at which it was said."""

from __future__ import annotations

import argparse
import time
from collections.abc import Iterator
from typing import Any

from roslings.ros2.bag.quality import offered
from roslings.ros2.bag.reading import opened
from roslings.ros2.bag.speech import tell
from roslings.ros2.discovery import Eye
from roslings.ros2.interfaces import UnknownInterface, class_of
from roslings.ros2.names import absolute
from roslings.ros2.problem import Problem, did_you_mean
from roslings.ros2.words import OK

PLAYER = "rosbag2_player"
MATCHED_WITHIN_S = 1.0
GONE_WITHIN_S = 0.5


class NotInBag(Problem):
    """The bag has no such topic."""

    def __init__(self, topic: str, there: list[str]) -> None:
        super().__init__(
            f"[ERROR] [ros2bag]: the bag has no topic '{topic}'.{did_you_mean(topic, there)}"
            f" It has: {', '.join(there)}"
        )


def play(options: argparse.Namespace) -> int:
    """`ros2 bag play BAG`."""
    with opened(options.bag_path) as reader, Eye() as eye:
        connections = _chosen(reader, options)
        voices = dict(_voices(eye, connections))
        tell(PLAYER, f"Set rate to {options.rate:g}")
        _await_listeners(eye, voices)
        eye.until(lambda: False, options.delay)
        while True:
            _play_once(eye, reader, connections, voices, options)
            if not options.loop:
                break
        eye.until(lambda: False, GONE_WITHIN_S)
    return OK


def _chosen(reader: Any, options: argparse.Namespace) -> list[Any]:
    """The connections to play. Raises NotInBag."""
    there = sorted({c.topic for c in reader.connections})
    wanted = [absolute(name) for name in options.topics or there]
    for topic in wanted:
        if topic not in there:
            raise NotInBag(topic, there)
    return [c for c in reader.connections if c.topic in wanted]


def _voices(eye: Eye, connections: list[Any]) -> Iterator[tuple[int, Any]]:
    """A publisher for each connection whose type is installed here."""
    for connection in connections:
        try:
            cls = class_of(connection.msgtype, "msg")
        except UnknownInterface as problem:
            tell(PLAYER, f"Topic '{connection.topic}' is left out. {problem}", "WARN")
            continue
        profile = offered(connection.ext.offered_qos_profiles)
        yield connection.id, eye.node.create_publisher(cls, connection.topic, profile)


def _await_listeners(eye: Eye, voices: dict[int, Any]) -> None:
    """Those who listen now shall not miss the first messages."""
    eye.settle()
    waiting = [voice for voice in voices.values() if eye.ears(voice.topic_name)]
    eye.until(lambda: all(voice.get_subscription_count() for voice in waiting), MATCHED_WITHIN_S)


def _play_once(
    eye: Eye,
    reader: Any,
    connections: list[Any],
    voices: dict[int, Any],
    options: argparse.Namespace,
) -> None:
    """Each time is counted from the first message, so that the pace does not drift."""
    begin_ns = reader.start_time + round(options.start_offset * 1e9)
    began_s = time.monotonic()
    for connection, stamp_ns, raw in reader.messages(connections, start=begin_ns):
        due_s = began_s + (stamp_ns - begin_ns) / 1e9 / options.rate
        eye.spin_to(due_s)
        if connection.id in voices:
            voices[connection.id].publish(bytes(raw))
