"""When two values are the same, and how they are told: once, for every lab and drill."""

from __future__ import annotations

import math
from typing import Any

import pytest

from roslings.capabilities.topics.act import nested
from roslings.course.contract import NUMBERS_WITHIN
from roslings.evidence import ExperimentSeen, MessageSeen, TopicSeen
from roslings.judge.values import field_of, looks_of, same, shown

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
        (45.0, 45, True),
        (1921, 1920, False),
        (1920.0001, 1920, True),
        (0.785, math.pi / 4, False),
        (0.0005, 0.001, False),
        (1e-9, 0.0, True),
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
        (120.0, 1.2, "in cm, or in percent?"),
        (1200.0, 1.2, "in mm?"),
        (-1.2, 1.2, "wrong sign"),
        (90.0, math.pi / 2, "in degrees?"),
        (0.012, 1.2, "divided by 100"),
        (1.3, 1.2, ""),
        ("NaN", 1.2, ""),
        (0.0, 0.0, ""),
        ("Infinity", 1.2, "compare the units"),
    ],
)
def test_what_a_wrong_number_looks_like(found: Any, wanted: float, words: str) -> None:
    """Units, mostly."""
    looks = looks_of(found, wanted)
    assert words in str(looks or "")
    assert bool(words) == bool(looks)


@pytest.mark.parametrize("wanted", [0.001, 0.3, 1.0, 343.0, -2.5e6])
def test_so_far_off_a_number_still_counts(wanted: float) -> None:
    """Both ways: just inside, and just outside."""
    for within in (NUMBERS_WITHIN, 0.001):
        off = within * max(1.0, abs(wanted))
        for side in (-1, 1):
            assert same(wanted + 0.9 * side * off, wanted, within)
            assert not same(wanted + 1.1 * side * off, wanted, within)
