"""Hear a topic: find its type, ask for a quality that fits, say at once what cannot work."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Iterable
from typing import Any

from ros2_on_pip import qos
from ros2_on_pip.discovery import DirectNode
from ros2_on_pip.interfaces import class_of
from ros2_on_pip.names import checked_topic
from ros2_on_pip.problem import CommandProblem, did_you_mean

NOT_YET = "WARNING: topic [{}] does not appear to be published yet"


class UnknownTopic(CommandProblem):
    """Nobody publishes or hears the topic, so its type is not known either."""

    def __init__(self, topic: str, there: Iterable[str]) -> None:
        super().__init__(
            "Could not determine the type for the passed topic:"
            f" no node has '{topic}'.{did_you_mean(topic, there)}\n"
            "To see what there is: ros2 topic list"
        )


class BadFilter(CommandProblem):
    """`--filter` is no Python expression, or it does not fit the messages."""

    def __init__(self, expression: str, fault: Exception) -> None:
        super().__init__(
            f"--filter '{expression}': {fault}. It must be an expression of Python in which m is"
            " the message, for example: m.linear.x > 0"
        )


class SeveralTypes(CommandProblem):
    """Two nodes use one name for two types."""

    def __init__(self, topic: str, types: list[str]) -> None:
        super().__init__(
            f"Cannot echo topic '{topic}', as it contains more than one type: [{', '.join(types)}]"
            f"\nSee which node has which: ros2 topic info -v {topic}. Then name the type:"
            f" ros2 topic echo {topic} {types[0]}"
        )


def type_of(direct_node: DirectNode, topic: str) -> str | None:
    """The type of `topic`; None where nobody has it. Raises SeveralTypes."""
    types = direct_node.topics().get(topic, [])
    if len(types) > 1:
        raise SeveralTypes(topic, types)
    return types[0] if types else None


def known_type(direct_node: DirectNode, topic: str) -> str:
    """The type of `topic`. Raises UnknownTopic, SeveralTypes."""
    found = type_of(direct_node, topic)
    if found is None:
        print(NOT_YET.format(topic), file=sys.stderr)
        raise UnknownTopic(topic, direct_node.topics(hidden=False))
    return found


def awaited_type(direct_node: DirectNode, topic: str) -> str:
    """The type of `topic`, as soon as somebody has it: a word is said while we wait."""
    if type_of(direct_node, topic) is None:
        near = did_you_mean(topic, direct_node.topics(hidden=False))
        print(NOT_YET.format(topic) + ("." + near if near else ""), file=sys.stderr)
        direct_node.until(lambda: type_of(direct_node, topic))
        direct_node.settle()
    return known_type(direct_node, topic)


def subscribe(
    direct_node: DirectNode,
    topic: str,
    type_name: str,
    profile: Any,
    hear: Callable[..., None],
    raw: bool = False,
    lost: Callable[[Any], None] | None = None,
) -> Any:
    """Subscribe with the quality `profile`; `lost` is told of messages that were lost.

    What cannot match is said on stderr, now and for publishers that come later.
    """
    from rclpy.event_handler import SubscriptionEventCallbacks

    publishers = direct_node.publishers(topic)
    told = {bytes(info.endpoint_gid) for info in publishers}
    _say(qos.said_about(publishers, profile))

    def tell_of_new(_: Any) -> None:
        new = [
            info for info in direct_node.publishers(topic) if bytes(info.endpoint_gid) not in told
        ]
        told.update(bytes(info.endpoint_gid) for info in new)
        _say(qos.said_about(new, profile))

    return direct_node.node.create_subscription(
        class_of(type_name, "msg"),
        topic,
        hear,
        profile,
        raw=raw,
        event_callbacks=SubscriptionEventCallbacks(
            incompatible_qos=tell_of_new, message_lost=lost, use_default_callbacks=False
        ),
    )


def _say(sentences: list[str]) -> None:
    for sentence in sentences:
        print(f"WARNING: {sentence}", file=sys.stderr)


def filter_in(options: argparse.Namespace) -> Callable[[Any], bool]:
    """Whether a message passes `--filter`. Raises BadFilter, now and for a message."""
    if not options.filter:
        return lambda _: True
    try:
        code = compile(options.filter, "--filter", "eval")
    except (SyntaxError, ValueError) as fault:
        raise BadFilter(options.filter, fault) from None

    def passes(message: Any) -> bool:
        try:
            return bool(eval(code, {"m": message}))  # the student's own words, on purpose
        except Exception as fault:
            raise BadFilter(options.filter, fault) from None

    return passes


def topic_in(options: argparse.Namespace) -> str:
    """The absolute name of the topic in `options`. Raises BadName."""
    return checked_topic(options.topic_name)
