"""What `prove` makes of a result: nothing but the verdict that a package must get is a proof."""

from __future__ import annotations

from pathlib import Path

import pytest

from roslings.course import Mutant, lab
from roslings.verdict import CheckOutcome, CheckResult, Environment, Timings, Verdict, outcome_of
from roslings_class.result import GradingResult
from roslings_prove.prove import (
    MutantPackage,
    ProvenPackage,
    Solution,
    StarterPackage,
    packages_of,
    proof_of,
)

TOPICS = lab("topics")
SLOW = Mutant(name="slow", what="Half as fast.", fails=("rate",), faults={"rate": "TooSlow"})
UNNAMED = Mutant(name="unnamed", what="No node.", fails=("talker_runs",))
SOLUTION, STARTER = Solution(TOPICS), StarterPackage(TOPICS)


def graded(fault: str = "TooSlow", **outcomes: CheckOutcome) -> GradingResult:
    """A result where all other checks pass; what fails is too slow, or has another fault."""
    checks = tuple(
        CheckResult(
            id=name,
            title=name,
            outcome=(outcome := outcomes.get(name, "pass")),
            points=points if outcome == "pass" else 0,
            max_points=points,
            fault=fault if outcome == "fail" else None,
            measured="1 Hz",
        )
        for name, points in TOPICS.card.points.items()
    )
    verdict = Verdict(
        lab="topics",
        package="chatter",
        outcome=outcome_of(checks),
        score=sum(check.points for check in checks),
        checks=checks,
        seconds=Timings(total=1.0),
        environment=Environment.model_construct(),
    )
    return GradingResult(submission="it", digest="0", attempt=1, state="graded", verdict=verdict)


@pytest.mark.parametrize(
    ("package", "result"),
    [
        (SOLUTION, graded()),
        (STARTER, graded(text="fail")),
        (MutantPackage(TOPICS, SLOW), graded(rate="fail")),
        (MutantPackage(TOPICS, UNNAMED), graded("EndedInTheSoak", talker_runs="fail")),
    ],
    ids=["solution", "starter", "mutant", "a fault that keeps nothing from being judged"],
)
def test_what_must_come_of_it_is_a_proof(package: ProvenPackage, result: GradingResult) -> None:
    """The score of 100, no pass, the named checks."""
    assert proof_of(package, result).holds


WRONG: dict[str, tuple[ProvenPackage, GradingResult, str]] = {
    "a solution that loses a point": (SOLUTION, graded(figure="fail"), "98 of 100; it fails: fig"),
    "a starter that passes": (STARTER, graded(), "it passes"),
    "a mutant that passes": (MutantPackage(TOPICS, SLOW), graded(), "it passes every check"),
    "one that fails elsewhere": (
        MutantPackage(TOPICS, SLOW),
        graded(text="fail"),
        "it fails: text (1 Hz)",
    ),
    "one that fails there too": (
        MutantPackage(TOPICS, SLOW),
        graded(rate="fail", text="fail"),
        "rate (1 Hz); text (1 Hz)",
    ),
    "one where more is skipped": (
        MutantPackage(TOPICS, SLOW),
        graded(rate="fail", hears="skip"),
        "skipped: hears; must be: none",
    ),
    "one where less is skipped": (
        MutantPackage(TOPICS, UNNAMED),
        graded(talker_runs="fail"),
        "skipped: none; must be: clean_exit",
    ),
    "one with another fault": (
        MutantPackage(TOPICS, SLOW.model_copy(update={"faults": {"rate": "Bursts"}})),
        graded(rate="fail"),
        "other faults: {'rate': 'TooSlow'}",
    ),
}


@pytest.mark.parametrize(("package", "result", "words"), WRONG.values(), ids=WRONG)
def test_what_must_not_come_of_it_is_told(
    package: ProvenPackage, result: GradingResult, words: str
) -> None:
    """With the checks that failed, and what was measured there."""
    proof = proof_of(package, result)
    assert not proof.holds and not proof.is_open
    assert words in proof.problem


@pytest.mark.parametrize("package", [SOLUTION, STARTER, MutantPackage(TOPICS, SLOW)], ids=str)
def test_what_could_not_be_told_is_no_proof(package: ProvenPackage) -> None:
    """Neither beside a failed check that is named, nor alone."""
    proof = proof_of(package, graded(rate="fail", text="inconclusive"))
    assert proof.is_open and not proof.holds
    assert "text (1 Hz)" in proof.line


def test_all_packages_of_a_lab_have_names_of_their_own(tmp_path: Path) -> None:
    """By either clock; and each is there, or can be made."""
    named = [
        *packages_of(TOPICS),
        *(MutantPackage(TOPICS, each, "wall") for each in TOPICS.mutants()),
    ]
    assert len({each.name for each in named}) == len(named) == 2 + 2 * len(TOPICS.mutants())
    assert all(each.make(tmp_path).is_dir() for each in named)
