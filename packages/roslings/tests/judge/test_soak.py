"""What ends where nodes are left running fails the check that says so, and no other."""

from __future__ import annotations

from pathlib import Path

import pytest
from real_run import evidence_of_solution

from roslings.course import CourseError, lab
from roslings.course.soak import SOAK, soak_seconds
from roslings.evidence import Evidence, LogLine, ProcessSeen, SoakSeen
from roslings.judge import judge
from roslings.verdict import CheckResult, Verdict

NS = 10**9
TRACE = ("Traceback (most recent call last):", "RuntimeError: my battery is empty")


@pytest.fixture(scope="module")
def evidence(tmp_path_factory: pytest.TempPathFactory) -> Evidence:
    """What was seen of a real run of the solution, without a soak."""
    return evidence_of_solution("topics", tmp_path_factory.mktemp("evidence"))


def left(executable: str, died_after_s: float | None = None) -> ProcessSeen:
    """A node that was left running for half a minute, or ended before."""
    lines = [LogLine(arrival_ns=0, text=text, source="terminal") for text in TRACE]
    if died_after_s is None:
        return ProcessSeen(executable=executable, started_ns=0, asked_to_end_ns=31 * NS, status=0)
    return ProcessSeen(
        executable=executable,
        started_ns=0,
        ended_ns=round(died_after_s * NS),
        status=1,
        ended_by_itself=True,
        lines=lines,
    )


def soaked(evidence: Evidence, *processes: ProcessSeen) -> Verdict:
    """The verdict with a soak of these."""
    seen = SoakSeen(for_s=30.0, processes={each.executable: each for each in processes})
    return judge(lab("topics"), evidence.model_copy(update={"soak": seen}))


def check_of(verdict: Verdict, name: str) -> CheckResult:
    """One check of a verdict."""
    return next(check for check in verdict.checks if check.id == name)


def test_a_death_in_the_soak_costs_one_check(evidence: Evidence) -> None:
    """What the node did before it was right: its rate and texts are judged all the same."""
    verdict = soaked(evidence, left("talker", 20.25), left("listener"))
    other = {check.id: check.outcome for check in verdict.checks if check.outcome != "pass"}
    assert other == {"talker_stays": "fail"}
    stays = check_of(verdict, "talker_stays")
    assert stays.fault == "EndedInTheSoak"
    assert stays.measured == "it ended by itself after 20.2 s (exit code 1)"
    assert stays.log[-1] == TRACE[-1]


def test_a_check_that_passes_says_how_long_and_by_which_clock(evidence: Evidence) -> None:
    """Simulated seconds are told apart from ours."""
    simulated = evidence.experiments["talking"].clock == "sim"
    alone, long = judge(lab("topics"), evidence), soaked(evidence, left("talker"), left("listener"))
    said = check_of(alone, "talker_stays").measured or ""
    assert said.startswith("ran ")
    assert said.endswith(" s simulated" if simulated else " s")
    assert check_of(long, "talker_stays").measured == f"{said}; 31 s left alone"
    assert (check_of(long, "listener_runs").measured or "").endswith(" s; 31 s left alone")
    assert (alone.soak_s, long.soak_s) == (0.0, 30.0)
    assert check_of(alone, "talker_name").measured is None


def test_what_an_experiment_saw_end_is_not_told_twice(evidence: Evidence) -> None:
    """The listener ended beside the talker too: who looks there tells of it."""
    there = evidence.model_copy(deep=True)
    there.experiments["together"].processes["listener"].ended_by_itself = True
    verdict = soaked(there, left("talker"), left("listener", 20.0))
    assert check_of(verdict, "listener_runs").outcome == "pass"


def test_seconds_are_the_cards_the_environments_or_those_asked_for(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """In this order; what is no number is told."""
    card = lab("topics").card
    monkeypatch.delenv(SOAK, raising=False)
    assert soak_seconds(card) == card.soak_s == 30.0
    monkeypatch.setenv(SOAK, "12")
    assert (soak_seconds(card), soak_seconds(card, 0.0)) == (12.0, 0.0)
    monkeypatch.setenv(SOAK, "long")
    with pytest.raises(CourseError, match="'long' is no number"):
        soak_seconds(card)


def test_each_lab_says_which_nodes_stay() -> None:
    """A client that has one task is not left running."""
    stays = {
        node.executable: node.stays
        for name in ("services", "actions")
        for node in lab(name).card.nodes
    }
    assert stays == {
        "motor_controller": True,
        "motor_client": False,
        "drive_server": True,
        "drive_client": False,
    }


def test_old_evidence_has_no_soak(evidence: Evidence, tmp_path: Path) -> None:
    """What was saved before there was one is read as it is."""
    text = evidence.model_dump_json(by_alias=True, exclude={"soak"})
    assert Evidence.model_validate_json(text).soak is None
