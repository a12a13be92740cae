"""`ros2 topic pub`: send one message, or one again and again."""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Callable
from typing import Any

from ros2_on_pip import qos
from ros2_on_pip.discovery import Eye
from ros2_on_pip.interfaces import class_of, full_name
from ros2_on_pip.listening import topic_in
from ros2_on_pip.names import checked_node
from ros2_on_pip.problem import Problem, did_you_mean
from ros2_on_pip.shared_options import values_in
from ros2_on_pip.words import OK
from ros2_on_pip.yaml_in import filled

SAY_EVERY_S = 1.0


class TooFewListen(Problem):
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
    with Eye.asked_by(options, name) as eye:
        voice = _voice(eye, topic, type(message), options)
        _warn(eye, topic, type_name)
        _await(eye, topic, voice, _wanted(options, times), options.max_wait_time_secs)
        print("publisher: beginning loop")
        beat = (SimBeat if options.use_sim_time else Beat)(1 / options.rate, times)
        beat.run(eye, lambda count: _send(eye, voice, message, stamps, count, options.print))
        if times:
            eye.until(lambda: False, options.keep_alive)
    return OK


def _voice(eye: Eye, topic: str, cls: type[Any], options: argparse.Namespace) -> Any:
    """The publisher; an incompatible subscription is said at once."""
    from rclpy.event_handler import PublisherEventCallbacks

    profile = qos.chosen(options)

    def tell(_: Any) -> None:
        for info in eye.ears(topic):
            for why in qos.mismatches(info.qos_profile, profile):
                print(
                    f"WARNING: Node {info.node_name} cannot hear this: {_turned(why)}.",
                    file=sys.stderr,
                )

    return eye.node.create_publisher(
        cls,
        topic,
        profile,
        event_callbacks=PublisherEventCallbacks(incompatible_qos=tell, use_default_callbacks=False),
    )


def _turned(why: str) -> str:
    return why.replace("it offers", "we offer").replace("its ", "our ")


def _warn(eye: Eye, topic: str, type_name: str) -> None:
    """Another type on the topic is never what one wants: the two cannot hear each other."""
    eye.settle()
    others = [kind for kind in eye.topics().get(topic, []) if kind != type_name]
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


def _await(eye: Eye, topic: str, voice: Any, wanted: int, within_s: float | None) -> None:
    end_s = None if within_s is None else time.monotonic() + within_s
    near_told = False
    while voice.get_subscription_count() < wanted:
        print(f"Waiting for at least {wanted} matching subscription(s)...")
        if not near_told:
            near_told = True
            _say_near(eye, topic)
        if end_s is not None and time.monotonic() >= end_s:
            raise TooFewListen(topic, wanted, voice.get_subscription_count())
        eye.until(lambda: voice.get_subscription_count() >= wanted, SAY_EVERY_S)


def _say_near(eye: Eye, topic: str) -> None:
    heard = [name for name in eye.topics(hidden=False) if eye.ears(name)]
    near = "" if topic in heard else did_you_mean(topic, heard)
    if near:
        print(f"No node subscribes to '{topic}'.{near}", file=sys.stderr)


def _send(
    eye: Eye, voice: Any, message: Any, stamps: list[Any], count: int, print_every: int
) -> None:
    now = eye.node.get_clock().now().to_msg() if stamps else None
    for stamp in stamps:
        stamp(now)
    if print_every and count % print_every == 0:
        print(f"publishing #{count}: {message!r}\n")
    voice.publish(message)


class Beat:
    """A steady beat that does not drift: each time is counted from the first."""

    def __init__(self, period_s: float, times: int) -> None:
        """`times` is how often to beat; 0 is without end."""
        self._period_s, self._times = period_s, times

    def run(self, eye: Eye, act: Callable[[int], None]) -> None:
        """Call `act(1)`, `act(2)`, ... on the beat."""
        first_s = time.monotonic() + (self._period_s if not self._times else 0)
        count = 0
        while not self._times or count < self._times:
            due_s = first_s + count * self._period_s
            eye.spin_to(due_s)
            count += 1
            act(count)


class SimBeat(Beat):
    """A beat in the time of /clock, as a timer of a node has it."""

    def run(self, eye: Eye, act: Callable[[int], None]) -> None:
        """Call `act(1)`, `act(2)`, ... on the beat; where /clock stands still, nothing happens."""
        count = 0

        def turn() -> None:
            nonlocal count
            if not self._times or count < self._times:
                count += 1
                act(count)

        timer = eye.node.create_timer(self._period_s, turn)
        eye.until(lambda: self._times and count >= self._times)
        eye.node.destroy_timer(timer)
