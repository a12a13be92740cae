"""Evidence of the time when a guard was seen as a part of quality of service."""

from __future__ import annotations

from graders.e_stop.record import EStopSeen
from roslings.capabilities.qos.record import QosSeen
from roslings.evidence import ExperimentSeen

OLD = {
    "v": 1,
    "joins": [{"after": "the start", "wanted": True, "said": 1, "heard": [True]}],
    "presses": [{"asked": {"data": False}, "began_ns": 1, "until_ns": 2}],
    "sent_ns": [5, 6],
}


def seen_in(parts: dict[str, object]) -> ExperimentSeen:
    """An experiment, as it was kept."""
    return ExperimentSeen.model_validate({"name": "x", "clock": "wall", "parts": parts})


def test_it_is_two_parts_now() -> None:
    """Each field is where it is looked for, and nothing is lost."""
    seen = seen_in({"qos": OLD})
    assert [join.after for join in seen.part(QosSeen).joins] == ["the start"]
    assert [press.asked for press in seen.part(EStopSeen).presses] == [{"data": False}]
    assert seen.part(EStopSeen).sent_ns == [5, 6]
    assert seen.part(QosSeen).v == 2 and seen.part(EStopSeen).v == 1


def test_what_was_not_seen_makes_no_part() -> None:
    """As today, where nobody pressed anything."""
    seen = seen_in({"qos": {"v": 1, "joins": []}})
    assert [*seen.parts] == ["qos"]


def test_what_is_new_stays_as_it_is() -> None:
    """Both parts are read as they were written."""
    new = seen_in({"qos": {"v": 2, "joins": []}, "e_stop": {"v": 1, "sent_ns": [7]}})
    assert new.part(EStopSeen).sent_ns == [7]
