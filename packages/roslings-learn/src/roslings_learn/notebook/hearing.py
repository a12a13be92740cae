"""Messages of a topic, with the moments at which they were sent."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

from ros2_on_pip.near_names import nearest
from roslings_learn.notebook.errors import NothingHeard, OtherType, listed

TURN_S = 0.05
DEPTH = 1000
NS_PER_S = 1e9


@dataclass(frozen=True)
class HeardMessage:
    """One message, and when it was sent."""

    message: Any
    sent_s: float
    """By the sender's clock, in seconds since 1970."""


@dataclass(frozen=True)
class ListenRequest:
    """What to listen for."""

    topic: str
    kind: Any | None
    """The class of the messages; None: whatever the topic has."""
    count: int
    timeout_s: float


class TopicListener:
    """A hidden node of its own that hears one topic. Its callbacks run in the caller's thread."""

    def __init__(self, node: Any, executor: Any, check: Callable[[], None]) -> None:
        self._node, self._executor, self._check = node, executor, check

    def hear(self, request: ListenRequest) -> Iterator[HeardMessage]:
        """As many messages as asked, as they come. Raises NothingHeard, or what a callback does."""
        from ros2_on_pip.names import checked_topic

        topic = checked_topic(request.topic)
        came: list[HeardMessage] = []
        told = 0
        end_s = time.monotonic() + request.timeout_s
        listening = None
        while told < request.count:
            if listening is None and (kind := request.kind or self._kind_of(topic)) is not None:
                listening = self._listen(topic, kind, came)
            self._check()
            self._executor.spin_once(timeout_sec=TURN_S)
            yield from came[told : request.count]
            told = min(len(came), request.count)
            if told < request.count and time.monotonic() > end_s:
                hint = self._why_so_few(topic, request.kind, told)
                raise NothingHeard(topic, told, request.count, request.timeout_s, hint)

    def _kind_of(self, topic: str) -> Any | None:
        from ros2_on_pip.interfaces import class_of

        types = dict(self._node.get_topic_names_and_types()).get(topic)
        return class_of(types[0], "msg") if types else None

    def _listen(self, topic: str, kind: Any, came: list[HeardMessage]) -> Any:
        def hear(message: Any, info: Any) -> None:
            came.append(HeardMessage(message, info["source_timestamp"] / NS_PER_S))

        offered = self._node.get_publishers_info_by_topic(topic)
        with one_type(self._node, topic, kind):
            return self._node.create_subscription(kind, topic, hear, fitting(offered))

    def _why_so_few(self, topic: str, kind: Any | None, came: int) -> str:
        from ros2_on_pip.interfaces import name_of

        publishers = self._node.get_publishers_info_by_topic(topic)
        types = {info.topic_type for info in publishers}
        if not publishers:
            return self._nobody_publishes(topic)
        if kind is not None and name_of(kind) not in types:
            return f"{topic} has the type {listed(types)}, and {name_of(kind)} was asked for."
        if came:
            return "It comes more slowly than that: ask for fewer, or give a longer timeout_s."
        return "Its publisher is there and says nothing: look at its timer and its callback."

    def _nobody_publishes(self, topic: str) -> str:
        there = {
            name
            for name, _ in self._node.get_topic_names_and_types()
            if name not in ("/rosout", "/parameter_events")
            and self._node.get_publishers_info_by_topic(name)
        }
        near = nearest(topic, there)
        meant = f" Did you mean {near.found}?" if near and near.how != "other" else ""
        return f"Nobody publishes on {topic}.{meant} Topics with a publisher: {listed(there)}."


def fitting(publishers: list[Any]) -> Any:
    """A quality of service that every one of `publishers` can give.

    Where nobody is there yet, the one that fits everybody: best effort and volatile.
    """
    from rclpy.qos import DurabilityPolicy, QoSProfile, ReliabilityPolicy

    reliable = {info.qos_profile.reliability for info in publishers} == {ReliabilityPolicy.RELIABLE}
    kept = {info.qos_profile.durability for info in publishers}
    latched = kept == {DurabilityPolicy.TRANSIENT_LOCAL}
    return QoSProfile(
        depth=DEPTH,
        reliability=ReliabilityPolicy.RELIABLE if reliable else ReliabilityPolicy.BEST_EFFORT,
        durability=DurabilityPolicy.TRANSIENT_LOCAL if latched else DurabilityPolicy.VOLATILE,
    )


@contextmanager
def one_type(node: Any, topic: str, kind: Any) -> Iterator[None]:
    """A block that opens `topic` with `kind`: DDS refuses a second type in one process.

    Raises OtherType.
    """
    from rclpy._rclpy_pybind11 import RCLError

    from ros2_on_pip.interfaces import name_of

    try:
        yield
    except RCLError as error:
        there = set(dict(node.get_topic_names_and_types()).get(topic, ())) - {name_of(kind)}
        if not there:
            raise
        raise OtherType(topic, name_of(kind), there) from error


@contextmanager
def topic_listener(context: Any, check: Callable[[], None]) -> Iterator[TopicListener]:
    """A listener in `context`, until the block ends."""
    from rclpy.executors import SingleThreadedExecutor

    node = quiet_node("_notebook_ear", context)
    executor = SingleThreadedExecutor(context=context)
    executor.add_node(node)
    try:
        yield TopicListener(node, executor, check)
    finally:
        executor.shutdown()
        node.destroy_node()


def quiet_node(name: str, context: Any) -> Any:
    """A node that the graph's tools hide, and that offers nothing itself.

    It does not offer its type descriptions either. The reason is that rclpy 7.1 does not take that
    service down with the node. Who looks at the graph then waits for a node that has ended.
    """
    from rclpy.node import Node
    from rclpy.parameter import Parameter

    return Node(
        name,
        context=context,
        enable_rosout=False,
        start_parameter_services=False,
        use_global_arguments=False,
        parameter_overrides=[Parameter("start_type_description_service", value=False)],
    )
