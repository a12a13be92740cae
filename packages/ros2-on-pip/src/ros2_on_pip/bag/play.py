"""`ros2 bag play`: say again what a bag holds, at the pace at which it was said."""

from __future__ import annotations

import argparse
import time
from collections.abc import Iterable, Iterator
from typing import Any

from ros2_on_pip.bag.clock import STEP, BagClock
from ros2_on_pip.bag.keys import DOWN, RIGHT, SPACE, UP, KeySource, pressed
from ros2_on_pip.bag.problem import NotInBag, WrongBagOptions, told
from ros2_on_pip.bag.speech import tell
from ros2_on_pip.discovery import DirectNode
from ros2_on_pip.interfaces import UnknownInterface, class_of
from ros2_on_pip.names import absolute, checked_topic
from ros2_on_pip.rosbag2.choosing import TopicFilter
from ros2_on_pip.rosbag2.metadata import Topic
from ros2_on_pip.rosbag2.quality import offered, overrides, same
from ros2_on_pip.rosbag2.reading import BagReader, Message, opened
from ros2_on_pip.words import OK

PLAYER = "rosbag2_player"
MATCHED_WITHIN_S = 1.0
ARRIVED_WITHIN_S = 1.0
LOOK_EVERY_S = 0.05
"""However many messages there are, keys and the clock get their turn."""

KEYS = (
    "Press SPACE for Pause/Resume",
    "Press CURSOR_RIGHT for Play Next Message",
    "Press CURSOR_UP for Increase Rate 10%",
    "Press CURSOR_DOWN for Decrease Rate 10%",
)


def play(options: argparse.Namespace) -> int:
    """`ros2 bag play BAG`."""
    names = renamed(options.remap)
    with (
        told(),
        opened(options.bag_path) as reader,
        DirectNode(PLAYER) as direct_node,
        pressed(not options.disable_keyboard_controls) as keyboard,
    ):
        profiles = overrides(options.qos_profile_overrides_path)
        publishers = dict(_publishers_for(direct_node, chosen(reader, options), names, profiles))
        player = BagPlayback(direct_node, reader, publishers, keyboard, options)
        player.run()
        arrive(publishers.values(), options.wait_for_all_acked)
    return OK


def renamed(rules: Iterable[str]) -> dict[str, str]:
    """`old:=new` of each rule, as full names. Raises WrongBagOptions, BadName."""
    found = {}
    for rule in rules:
        old, mark, new = rule.partition(":=")
        if not (old and mark and new):
            raise WrongBagOptions(f"'{rule}' is no rule for a name. Write OLD:=NEW, e.g. /a:=/b")
        found[checked_topic(old)] = checked_topic(new)
    return found


def chosen(reader: BagReader, options: argparse.Namespace) -> list[Topic]:
    """The topics to play. Raises NotInBag, BadExpression."""
    there = sorted(topic.name for topic in reader.metadata.topics)
    wanted = [absolute(name) for name in options.topics]
    for name in wanted:
        if name not in there:
            raise NotInBag(name, there)
    choice = TopicFilter(
        names=wanted,
        regex=options.regex,
        without_regex=options.exclude_regex,
        without=[absolute(name) for name in options.exclude_topics],
        whole_names=True,
    )
    return [each for each in reader.metadata.topics if choice.takes(each.name, each.type)]


def _publishers_for(
    direct_node: DirectNode, topics: list[Topic], names: dict[str, str], profiles: dict[str, Any]
) -> Iterator[tuple[str, Any]]:
    """A publisher for each topic whose type is installed here, by the topic's name in the bag."""
    for topic in topics:
        try:
            cls = class_of(topic.type, "msg")
        except UnknownInterface as problem:
            tell(PLAYER, f"Topic '{topic.name}' is left out. {problem}", "WARN")
            continue
        name = names.get(topic.name, topic.name)
        yield topic.name, direct_node.node.create_publisher(cls, name, _profile(topic, profiles))


def _profile(topic: Topic, profiles: dict[str, Any]) -> Any:
    if topic.name in profiles:
        tell(PLAYER, f"Overriding publisher profile for {topic.name}")
        return profiles[topic.name]
    if not same(topic.qos):
        tell(
            "ROSBAG2_TRANSPORT",
            f'Not all original publishers on topic "{topic.name}" offered the same QoS profiles.'
            " It is played as reliable and volatile.",
            "WARN",
        )
    return offered(topic.qos)


def _clock_publisher(direct_node: DirectNode) -> Any:
    from rosgraph_msgs.msg import Clock

    return direct_node.node.create_publisher(Clock, "/clock", 10)


def arrive(publishers: Iterable[Any], within_ms: int) -> None:
    """Wait until whoever listens has all messages. Without a word about it, a second."""
    from rclpy.duration import Duration

    within_s = ARRIVED_WITHIN_S if within_ms < 0 else within_ms / 1000
    for publisher in publishers:
        if within_ms == 0:
            publisher.wait_for_all_acked()
        else:
            publisher.wait_for_all_acked(Duration(seconds=within_s))


class BagPlayback:
    """Plays a bag once, or again and again."""

    def __init__(
        self,
        direct_node: DirectNode,
        reader: BagReader,
        publishers: dict[str, Any],
        keyboard: KeySource | None,
        options: argparse.Namespace,
    ) -> None:
        self._direct_node, self._reader, self._publishers = direct_node, reader, publishers
        self._keyboard, self._options = keyboard, options
        span = reader.metadata.span
        self._begin_ns = span.first_ns + round(options.start_offset * 1e9) if span.count else 0
        self._end_ns = self._begin_ns + round(options.playback_duration * 1e9)
        self._clock = BagClock(self._begin_ns, options.rate, options.start_paused)
        self._clock_publisher: Any = _clock_publisher(direct_node) if options.clock else None
        self._ticking: Any = None
        self._looked_s = 0.0
        self._next = False

    def run(self) -> None:
        """Until the end, or with `--loop` until Ctrl-C."""
        tell(PLAYER, f"Set rate to {self._options.rate:g}")
        for line in KEYS if self._keyboard else ():
            tell(PLAYER, line)
        self._await_listeners()
        while True:
            self._direct_node.until(lambda: False, self._options.delay)
            self._clock.set(self._begin_ns)
            self._tell_time()
            if not (self._once() and self._options.loop):
                return

    def _await_listeners(self) -> None:
        """Those who listen now shall not miss the first messages."""
        self._direct_node.settle()
        publishers = [
            *self._publishers.values(),
            *([self._clock_publisher] if self._clock_publisher else []),
        ]
        waiting = [
            publisher
            for publisher in publishers
            if self._direct_node.subscriptions(publisher.topic_name)
        ]
        self._direct_node.until(
            lambda: all(v.get_subscription_count() for v in waiting), MATCHED_WITHIN_S
        )

    def _tell_time(self) -> None:
        """From the first message on, as often as it was asked for."""
        if self._clock_publisher and not self._ticking:
            self._say_time()
            self._ticking = self._direct_node.node.create_timer(
                1 / self._options.clock, self._say_time
            )

    def _say_time(self) -> None:
        """Publish the bag's time on /clock."""
        from rosgraph_msgs.msg import Clock

        message = Clock()
        message.clock.sec, message.clock.nanosec = divmod(self._clock.now_ns(), 10**9)
        self._clock_publisher.publish(message)

    def _once(self) -> int:
        """How many messages were played."""
        count = 0
        for topic, time_ns, raw in self._messages():
            if self._options.playback_duration >= 0 and time_ns > self._end_ns:
                break
            self._wait_for(time_ns)
            self._publishers[topic].publish(raw)
            count += 1
        return count

    def _messages(self) -> Iterator[Message]:
        return self._reader.messages(lambda name, _: name in self._publishers, self._begin_ns)

    def _wait_for(self, time_ns: int) -> None:
        """Until the clock says so, or until somebody asks for the next message."""
        while (left_s := self._clock.left_s(time_ns)) > 0 and not self._next:
            self._look(min(left_s, LOOK_EVERY_S))
        if self._next:
            self._next = False
            self._clock.set(time_ns)
        if time.monotonic() - self._looked_s > LOOK_EVERY_S:
            self._look(0.0)

    def _look(self, within_s: float) -> None:
        self._direct_node.spin_to(time.monotonic() + within_s)
        self._direct_node.spin_some()
        self._looked_s = time.monotonic()
        if self._keyboard and (key := self._keyboard.next(0.0)):
            self._press(key)

    def _press(self, key: str) -> None:
        if key == SPACE:
            self._clock.pause(not self._clock.paused)
            tell(PLAYER, "Pausing play." if self._clock.paused else "Resuming play.")
        elif key == RIGHT:
            self._next = self._clock.paused
        elif key in (UP, DOWN):
            self._clock.hurry(self._clock.rate * (1 + STEP if key == UP else 1 - STEP))
            tell(PLAYER, f"Set rate to {self._clock.rate:g}")
