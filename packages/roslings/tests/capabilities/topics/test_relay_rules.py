"""Values that are told and values that are shown: equal, nearly equal, and not at all."""

from __future__ import annotations

import math
from typing import Any

import pytest

from roslings.capabilities.topics.act import nested
from roslings.capabilities.topics.faults.relay import MoreThanAsked, WrongAtFirst
from roslings.capabilities.topics.record import TOLD
from roslings.capabilities.topics.relay import (
    Shown,
    answer_each_once,
    field_of,
    remark,
    same,
    show_at_first,
    shown,
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

INFINITY = math.inf


@pytest.mark.parametrize(
    ("found", "wanted", "equal"),
    [
        (1.5, 1.5, True),
        (0.30000001192092896, 0.3, True),
        (1.5, 1.52, False),
        ("NaN", math.nan, True),
        (math.nan, math.nan, True),
        (1.0, math.nan, False),
        ("NaN", 1.0, False),
        ("Infinity", INFINITY, True),
        ("-Infinity", INFINITY, False),
        (4.0, INFINITY, False),
        (True, True, True),
        (1, True, True),
        (None, 1.0, False),
        (None, False, False),
        ("sonar_link", "sonar_link", True),
        ("", "sonar_link", False),
    ],
)
def test_a_value_is_the_same_or_not(found: Any, wanted: Any, equal: bool) -> None:
    """32 bits of a number, NaN, infinities as evidence writes them, texts."""
    assert same(found, wanted) is equal


def test_values_in_words() -> None:
    """As a student reads them."""
    words = [shown(each) for each in (True, "NaN", "-Infinity", INFINITY, 0.123456, "a")]
    assert words == ["true", "NaN", "-infinity", "+infinity", "0.1235", "'a'"]


def test_a_dot_leads_into_a_field_and_back() -> None:
    """Written nested, read flat."""
    message = nested({"header.frame_id": "sonar", "header.stamp.sec": 3, "range": 1.0})
    assert message == {"header": {"frame_id": "sonar", "stamp": {"sec": 3}}, "range": 1.0}
    assert field_of(message, "header.stamp.sec") == 3
    assert field_of(message, "header.nothing.sec") is None


def test_evidence_keeps_what_json_has_no_number_for() -> None:
    """NaN and the infinities come back from a file as what they were."""
    told = {"a": math.nan, "b": [INFINITY, -INFINITY], "c": 1.5}
    message = MessageSeen(source_ns=None, sequence=None, arrival_ns=0, size=1, content=told)
    topic = TopicSeen(name="/t", type="x", messages=[message])
    written = ExperimentSeen(name="x", clock="wall", topics={"/t": topic}).model_dump_json()
    content = ExperimentSeen.model_validate_json(written).topics["/t"].messages[0].content
    assert same(content["a"], math.nan)
    assert [same(content["b"][0], INFINITY), same(content["b"][1], -INFINITY)] == [True, True]
    assert content["c"] == 1.5


@pytest.mark.parametrize(
    ("found", "wanted", "words"),
    [
        (120.0, 1.2, "in cm?"), (1200.0, 1.2, "in mm?"), (-1.2, 1.2, "wrong sign"),
        (90.0, math.pi / 2, "in degrees?"), (0.012, 1.2, "divided by 100"), (1.3, 1.2, ""),
        ("NaN", 1.2, ""), (0.0, 0.0, ""), ("Infinity", 1.2, "compare the units"),
    ],
)  # fmt: skip
def test_what_a_wrong_number_looks_like(found: Any, wanted: float, words: str) -> None:
    """Units, mostly."""
    assert words in remark(found, wanted)
    assert bool(words) == bool(remark(found, wanted))


HEAT = TopicContract(topic="/heat", type="std_msgs/msg/Float64")
PLACE = Shown(NodeContract(node="/oven", executable="oven"), "data", HEAT, "data")
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
        topic="/wood", type=HEAT.type, content={"data": 1.0}, sent_ns=TOLD_NS, matched=True,
        offered=Qos(),
    )  # fmt: skip
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
