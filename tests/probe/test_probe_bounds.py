"""No node fills the memory of those who watch it, and none sings in the canary's place."""

from __future__ import annotations

import pytest

from roslings.course.card import RateContract
from roslings.evidence import CanarySeen, ExperimentSeen, MessageSeen
from roslings.experiment.on_the_wall import trouble
from roslings.probe import recorder
from roslings.probe.recorder import LARGEST_CONTENT, Store

MANY_HZ = 15


def test_a_store_is_shared_by_all_topics(monkeypatch: pytest.MonkeyPatch) -> None:
    """Small messages and large ones each have their room."""
    monkeypatch.setattr(recorder, "MOST_RAW_BYTES", 100)
    store = Store(large_bytes=LARGEST_CONTENT + 1)
    assert [store.keeps(bytes(size)) for size in (60, 60, 40, 1)] == [True, False, True, False]
    large = bytes(LARGEST_CONTENT + 1)
    assert [store.keeps(large), store.keeps(large)] == [True, False]


def seen(imitated: bool) -> ExperimentSeen:
    """A canary that sang 15 times a second, and was asked for 2."""
    stamps = [1 + number * 10**9 // MANY_HZ for number in range(60)]
    messages = [
        MessageSeen(source_ns=ns, sequence=number, arrival_ns=ns, size=4)
        for number, ns in enumerate(stamps)
    ]
    canary = CanarySeen(wanted_hz=2.0, messages=messages, imitated=imitated)
    return ExperimentSeen(name="it", clock="wall", canary=canary)


def test_a_canary_that_is_imitated_excuses_nothing() -> None:
    """Or a wrong rate could hide behind a wrong song."""
    limit = RateContract(hz=2.0, within=0.05)
    assert "known to be good" in (trouble(seen(imitated=False), None, limit) or "")
    assert trouble(seen(imitated=True), None, limit) is None
