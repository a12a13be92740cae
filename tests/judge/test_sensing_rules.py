"""Values that are told and values that are shown: equal, nearly equal, and not at all."""

from __future__ import annotations

import math
from typing import Any

import pytest

from roslings.evidence import ExperimentSeen, MessageSeen, TopicSeen
from roslings.experiment.telling import nested
from roslings.judge.sensing import field_of, remark, same, shown

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
        ("NaN", 1.2, ""), (0.0, 0.0, ""),
    ],
)  # fmt: skip
def test_what_a_wrong_number_looks_like(found: Any, wanted: float, words: str) -> None:
    """Units, mostly."""
    assert words in remark(found, wanted)
    assert bool(words) == bool(remark(found, wanted))
