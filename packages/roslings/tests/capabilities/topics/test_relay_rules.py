"""What a node shows before and after it is told something, and what its messages hold."""

from __future__ import annotations

import math
from typing import Any

import pytest

from roslings.capabilities.topics.faults.relay import MoreThanAsked, WrongAtFirst, WrongField
from roslings.capabilities.topics.record import TOLD
from roslings.capabilities.topics.relay import (
    RelayedValue,
    answer_each_once,
    hold_its_fields,
    show_at_first,
)
from roslings.course import NodeContract, TopicContract
from roslings.evidence import (
    Endpoint,
    ExperimentSeen,
    GraphSeen,
    MessageSeen,
    Qos,
    Spoken,
    StageMark,
    TopicSeen,
)
from roslings.judge import ExperimentView

HEAT = TopicContract(topic="/heat", type="std_msgs/msg/Float64")
PLACE = RelayedValue(NodeContract(node="/oven", executable="oven"), "data", HEAT, "data")
TOLD_NS = 1000


def oven(values: list[Any], every_ns: int = 400, told: int = 2) -> ExperimentView:
    """A node that publishes these values; it is told some, from 1000 ns on."""
    end = Endpoint(
        kind="publisher", node="/oven", topic="/heat", type=HEAT.type, qos=Qos(), gid="1"
    )
    messages = [
        MessageSeen(
            source_ns=None, sequence=n, arrival_ns=n * every_ns, size=8, content={"data": value}
        )
        for n, value in enumerate(values)
    ]
    said = Spoken(
        topic="/wood",
        type=HEAT.type,
        content={"data": 1.0},
        sent_ns=TOLD_NS,
        matched=True,
        offered=Qos(),
    )
    seen = ExperimentSeen(
        name="x",
        clock="wall",
        graph=GraphSeen(nodes=["/oven"], endpoints=[end]),
        topics={"/heat": TopicSeen(name="/heat", type=HEAT.type, messages=messages)},
        spoken=[said] * told,
        stages=[StageMark(part=TOLD, at_ns=TOLD_NS)],
    )
    return ExperimentView(seen)


def test_what_is_shown_before_anything_is_told() -> None:
    """Three messages come before the first value, and one after it."""
    show_at_first(PLACE, math.nan)(oven(["NaN", "NaN", "NaN", 3.0]))
    with pytest.raises(WrongAtFirst, match="before anything was heard"):
        show_at_first(PLACE, math.nan)(oven(["NaN", "NaN", 0.0, 3.0]))


@pytest.mark.parametrize(("count", "right"), [(1, True), (2, True), (3, True), (4, False)])
def test_one_message_for_each_value(count: int, right: bool) -> None:
    """Two values count; the first was told once before that."""
    if right:
        answer_each_once(PLACE)(oven([1.0] * count))
        return
    with pytest.raises(MoreThanAsked):
        answer_each_once(PLACE)(oven([1.0] * count))


@pytest.mark.parametrize(
    ("within", "right"), [(1e-6, False), (0.0004, False), (0.0006, True), (0.01, True)]
)
def test_a_card_says_how_far_off_a_number_may_be(within: float, right: bool) -> None:
    """Of a topic; half a thousandth is measured."""
    heat = HEAT.model_copy(update={"fields": {"data": 0.3}, "numbers_within": within})
    messages = oven([0.3005]).topic(heat)
    if right:
        hold_its_fields(messages)
        return
    with pytest.raises(WrongField, match="field data is"):
        hold_its_fields(messages)
