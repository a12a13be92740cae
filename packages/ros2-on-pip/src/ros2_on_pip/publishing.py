"""`ros2 topic pub`: send one message, or one again and again."""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable
from typing import Any

from ros2_on_pip import qos
from ros2_on_pip.discovery import DirectNode
from ros2_on_pip.interfaces import class_of, full_name
from ros2_on_pip.listening import topic_in
from ros2_on_pip.names import checked_node
from ros2_on_pip.problem import CommandProblem, did_you_mean
from ros2_on_pip.shared_options import values_in
from ros2_on_pip.words import OK
from ros2_on_pip.yaml_in import filled

SAY_EVERY_S = 1.0

ARRIVED_EVERY_S = 0.05
ASKED_TO_ARRIVE = 60
"""We know of a subscription before its node knows of our publisher. That asks for what it missed
after 70 ms, then after 140 ms, 280 ms and so on: 2.2 s after five such questions. We ask so often,
and do not look at a clock: on a busy computer, where everybody is slow, it takes longer too."""


class TooFewListen(CommandProblem):
    """The time to wait for subscriptions is over."""

    def __init__(self, topic: str, wanted: int, there: int) -> None:
        super().__init__(
            f"Timed out waiting for subscribers: Expected {wanted} subscribers but only got"
            f" {there} subscribers. Start the node that listens, or look: ros2 topic info {topic}"
        )


def publish(options: argparse.Namespace) -> int:
    """`ros2 topic pub TOPIC TYPE [VALUES]`."""
    topic = topic_in(options)
    type_name = full_name(options.message_type, "msg")
    message = class_of(type_name, "msg")()
    stamps = filled(message, values_in(options, options.values))
    name = checked_node(options.node_name) if options.node_name else ""
    times = 1 if options.once else options.times
    with DirectNode.asked_by(options, name, speaks=True) as direct_node:
        publisher = _publisher(direct_node, topic, type(message), options)
        _warn(direct_node, topic, type_name)
        _await(direct_node, topic, publisher, _wanted(options, times), options.max_wait_time_secs)
        print("publisher: beginning loop")
        beat = (SimBeat if options.use_sim_time else Beat)(1 / options.rate, times)
        beat.run(
            direct_node,
            lambda count: _send(direct_node, publisher, message, stamps, count, options.print),
        )
        if times:
            _arrive(direct_node, topic, publisher)
            direct_node.until(lambda: False, options.keep_alive)
    return OK


def _arrive(direct_node: DirectNode, topic: str, publisher: Any) -> None:
    """Wait until each reliable subscription has all: who was too early is asked for it again.

    Who is best effort acknowledges nothing, and nobody waits for that.
    """
    from rclpy.duration import Duration

    for _ in range(ASKED_TO_ARRIVE):
        if publisher.wait_for_all_acked(Duration(seconds=ARRIVED_EVERY_S)):
            return
        direct_node.spin_some()
    print(
        f"WARNING: a node that subscribes to '{topic}' did not take the last message."
        f" It is stopped, or has ended: ros2 topic info -v {topic}",
        file=sys.stderr,
    )


def _publisher(
    direct_node: DirectNode, topic: str, cls: type[Any], options: argparse.Namespace
) -> Any:
    """The publisher; an incompatible subscription is said at once."""
    from rclpy.event_handler import PublisherEventCallbacks

    profile = qos.chosen(options)

    def tell(_: Any) -> None:
        for info in direct_node.subscriptions(topic):
            for why in qos.mismatches(info.qos_profile, profile):
                print(
                    f"WARNING: Node {info.node_name} cannot hear this: {_turned(why)}.",
                    file=sys.stderr,
                )

    return direct_node.node.create_publisher(
        cls,
        topic,
        profile,
        event_callbacks=PublisherEventCallbacks(incompatible_qos=tell, use_default_callbacks=False),
    )


def _turned(why: str) -> str:
    return why.replace("it offers", "we offer").replace("its ", "our ")


def _warn(direct_node: DirectNode, topic: str, type_name: str) -> None:
    """Another type on the topic is never what one wants: the two cannot hear each other."""
    direct_node.settle()
    others = [kind for kind in direct_node.topics().get(topic, []) if kind != type_name]
    if others:
        print(
            f"WARNING: other nodes use '{topic}' with {others[0]}, not {type_name}:"
            " they cannot hear this.",
            file=sys.stderr,
        )


def _wanted(options: argparse.Namespace, times: int) -> int:
    """How many subscriptions to wait for: one, where a fixed number of messages is sent."""
    wanted = options.wait_matching_subscriptions
    return (1 if times else 0) if wanted is None else int(wanted)


def _await(
    direct_node: DirectNode, topic: str, publisher: Any, wanted: int, within_s: float | None
) -> None:
    end_s = None if within_s is None else time.monotonic() + within_s
    near_told = False
    while publisher.get_subscription_count() < wanted:
        print(f"Waiting for at least {wanted} matching subscription(s)...")
        if not near_told:
            near_told = True
            _say_near(direct_node, topic)
        if end_s is not None and time.monotonic() >= end_s:
            raise TooFewListen(topic, wanted, publisher.get_subscription_count())
        direct_node.until(lambda: publisher.get_subscription_count() >= wanted, SAY_EVERY_S)


def _say_near(direct_node: DirectNode, topic: str) -> None:
    heard = [name for name in direct_node.topics(hidden=False) if direct_node.subscriptions(name)]
    near = "" if topic in heard else did_you_mean(topic, heard)
    if near:
        print(f"No node subscribes to '{topic}'.{near}", file=sys.stderr)


def _send(
    direct_node: DirectNode,
    publisher: Any,
    message: Any,
    stamps: list[Any],
    count: int,
    print_every: int,
) -> None:
    now = direct_node.node.get_clock().now().to_msg() if stamps else None
    for stamp in stamps:
        stamp(now)
    if print_every and count % print_every == 0:
        print(f"publishing #{count}: {message!r}\n")
    publisher.publish(message)


class Beat:
    """A steady beat that does not drift: each time is counted from the first."""

    def __init__(self, period_s: float, times: int) -> None:
        """`times` is how often to beat; 0 is without end."""
        self._period_s, self._times = period_s, times

    def run(self, direct_node: DirectNode, act: Callable[[int], None]) -> None:
        """Call `act(1)`, `act(2)`, ... on the beat."""
        first_s = time.monotonic() + (self._period_s if not self._times else 0)
        count = 0
        while not self._times or count < self._times:
            due_s = first_s + count * self._period_s
            direct_node.spin_to(due_s)
            count += 1
            act(count)


class SimBeat(Beat):
    """A beat in the time of /clock, as a timer of a node has it."""

    def run(self, direct_node: DirectNode, act: Callable[[int], None]) -> None:
        """Call `act(1)`, `act(2)`, ... on the beat; where /clock stands still, nothing happens."""
        count = 0

        def turn() -> None:
            nonlocal count
            if not self._times or count < self._times:
                count += 1
                act(count)

        timer = direct_node.node.create_timer(self._period_s, turn)
        direct_node.until(lambda: self._times and count >= self._times)
        direct_node.node.destroy_timer(timer)
