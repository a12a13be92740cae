"""Other qualities of service that the card allows: longer queues, and all that fits."""

from __future__ import annotations

import libcst as cst
import libcst.matchers as m

from roslings.course.card import TopicContract
from roslings_prove.rewritten.source import Sources
from roslings_prove.rewritten.trees import (
    all_of,
    called,
    expression,
    importing,
    swapped,
)

LONGER = 5
"""So many times as long is the queue."""
OFFERS = ("durability", "DurabilityPolicy", "TRANSIENT_LOCAL")
"""Who offers to keep messages for those that come late fits those that do not ask for it."""
ASKS = ("reliability", "ReliabilityPolicy", "BEST_EFFORT")
"""Who asks for less fits those that offer more."""


def longer_queues(sources: Sources) -> Sources:
    """`QoSProfile(depth=50)` for `10`."""
    return sources.mapped(lambda tree: _with_profiles(tree, sources, fitting=False))


def another_qos_that_fits(sources: Sources) -> Sources:
    """Publishers also keep their messages for who comes late; subscriptions ask for best effort."""
    return sources.mapped(lambda tree: _with_profiles(tree, sources, fitting=True))


def _with_profiles(tree: cst.Module, sources: Sources, fitting: bool) -> cst.Module:
    others: dict[cst.CSTNode, cst.CSTNode] = {}
    needed = {"QoSProfile"}
    for call in all_of(tree, cst.Call):
        depth = next((x.value for x in call.args if m.matches(x.value, m.Integer())), None)
        words = _words(call, sources) if fitting else ()
        if depth is None or words is None or not called(call).startswith("create_"):
            continue
        if called(call) in ("create_publisher", "create_subscription"):
            others[depth] = _profile(cst.ensure_type(depth, cst.Integer), words)
            needed |= {words[1]} if words else set()
    new = swapped(tree, others)
    for name in sorted(needed) if others else ():
        new = importing(new, "rclpy.qos", name)
    return new


def _profile(depth: cst.Integer, words: tuple[str, ...]) -> cst.BaseExpression:
    if not words:
        return expression(f"QoSProfile(depth={depth.evaluated_value * LONGER})")
    keyword, policy, value = words
    return expression(f"QoSProfile(depth={depth.value}, {keyword}={policy}.{value})")


def _words(call: cst.Call, sources: Sources) -> tuple[str, ...] | None:
    """What else may be said of a topic; None where the card leaves nothing free."""
    topics = {
        _as_said(each.topic): each
        for node in sources.card.nodes
        for each in (*node.publishes, *node.subscribes)
    }
    said = [
        topics[x.evaluated_value]
        for x in all_of(call, cst.SimpleString)
        if x.evaluated_value in topics
    ]
    if called(call) == "create_publisher":
        return OFFERS if said and all(_is_free(each) for each in said) else None
    return ASKS if said and all(_is_free(each) for each in said) else None


def _as_said(topic: str) -> str | bytes:
    return topic.removeprefix("/")


def _is_free(contract: TopicContract) -> bool:
    """What the card says is what the other side has, and that is the default."""
    asked = contract.qos
    return not asked.exact and (asked.reliability, asked.durability) == ("reliable", "volatile")
