"""Parts of evidence: what a capability saw, with a version of its own."""

from __future__ import annotations

import json
from collections.abc import Iterator
from typing import Any

import pytest
from judged_words import HERE, LABS, evidence_of

from roslings import capability
from roslings.capabilities.services.record import ServicesSeen
from roslings.capability import Capability
from roslings.course import lab
from roslings.evidence import Evidence, evidence_json, read_json
from roslings.judge import judge
from roslings.record import PartSeen


@pytest.fixture
def services() -> dict[str, Any]:
    """Evidence of the lab about services, as JSON has it today."""
    evidence: dict[str, Any] = json.loads(evidence_json(dict(evidence_of("services"))["solution"]))
    return evidence


def test_old_evidence_is_kept_for_each_lab() -> None:
    """And each has the solution."""
    assert all((HERE / "schema1" / name / "solution.json.xz").is_file() for name in LABS)


@pytest.mark.parametrize("name", LABS)
def test_evidence_survives_a_round_trip(name: str) -> None:
    """Written and read, nothing is lost."""
    for _, evidence in evidence_of(name):
        assert read_json(evidence_json(evidence)) == evidence


def test_a_part_that_nobody_knows_is_kept(services: dict[str, Any]) -> None:
    """Another course's capability wrote it; here it is read, written, and not looked at."""
    strange = {"v": 3, "states": [{"node": "/lamp", "state": "active"}]}
    services["experiments"]["asking"]["parts"]["weather"] = strange
    evidence = read_json(json.dumps(services).encode())
    assert json.loads(evidence_json(evidence)) == services
    assert judge(lab("services"), evidence).score == 100


def test_checks_of_a_newer_part_are_inconclusive(services: dict[str, Any]) -> None:
    """Its fields may mean something else now: nobody loses a point, nobody gets one."""
    newer = services["experiments"]["asking"]["parts"]["services"]
    newer |= {"v": 99, "who": "knows"}
    evidence = read_json(json.dumps(services).encode())
    assert json.loads(evidence_json(evidence)) == services
    verdict = judge(lab("services"), evidence)
    unclear = {check.id: check for check in verdict.checks if check.outcome == "inconclusive"}
    assert "client_asks" in unclear
    assert "version 99" in (unclear["client_asks"].why or "")
    assert not any(check.outcome == "fail" for check in verdict.checks)


class Second(PartSeen):
    """A record whose first version had its one field under another name."""

    NAME = "lamps"
    v: int = 2
    bright: tuple[str, ...] = ()


@pytest.fixture
def lamps(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """A capability with two versions."""
    made = Capability("lamps", Second, upgrade={1: lambda old: {"bright": old["lit"]}})
    known = capability.capability
    monkeypatch.setattr(
        "roslings.evidence.capability", lambda name: made if name == "lamps" else known(name)
    )
    yield


@pytest.mark.usefixtures("lamps")
def test_a_part_is_brought_up_to_date(services: dict[str, Any]) -> None:
    """Step by step, whatever the schema of the evidence around it."""
    services["experiments"]["asking"]["parts"]["lamps"] = {"v": 1, "lit": ["/left"]}
    seen = read_json(json.dumps(services).encode()).experiments["asking"]
    assert seen.part(Second) == Second(bright=("/left",))


def test_reading_a_part_keeps_nothing() -> None:
    """An experiment in which nobody called anything has no record of calls."""
    text = Evidence.model_json_schema()  # the schema can be drawn, whatever parts there are
    assert text
    evidence = dict(evidence_of("topics"))["solution"]
    seen = next(iter(evidence.experiments.values()))
    assert seen.part(ServicesSeen).calls == []
    assert seen.parts == {}
