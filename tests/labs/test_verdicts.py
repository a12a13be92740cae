"""Every lab, graded for real: solution, starter and mutants, each with the verdict it must get."""

from __future__ import annotations

import json
import subprocess
import sys
from collections.abc import Collection
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

from roslings.course import Lab, Mutant, all_labs
from roslings.judge.sheet import dependants

MOST_TRIES = 3
EXAMPLE = "topics"


@dataclass(frozen=True)
class Answer:
    """What the command said of a package."""

    status: int
    verdict: dict[str, Any]

    def ids(self, outcome: str) -> set[str]:
        """Names of the checks with an outcome."""
        return {c["id"] for c in self.verdict["checks"] if c["outcome"] == outcome}

    def faults(self) -> dict[str, str]:
        """Failed check to kind of fault."""
        return {c["id"]: c["fault"] for c in self.verdict["checks"] if c["outcome"] == "fail"}

    def beyond(self, named: Collection[str]) -> list[dict[str, Any]]:
        """All that is known of the failed checks that nobody named."""
        return [
            {name: check[name] for name in ("id", "expected", "measured", "log")}
            for check in self.verdict["checks"]
            if check["outcome"] == "fail" and check["id"] not in named
        ]


def check(lab: Lab, package: Path, folder: Path, clock: str = "auto") -> Answer:
    """Grade a package with the command that a student types."""
    file = folder / "verdict.json"
    command = [
        sys.executable,
        "-m",
        "roslings",
        "check",
        lab.name,
        str(package),
        "--json",
        str(file),
        "--clock",
        clock,
    ]
    ran = subprocess.run(command, capture_output=True, text=True, check=False, cwd=folder)
    assert file.is_file(), ran.stderr
    return Answer(ran.returncode, json.loads(file.read_text("utf-8")))


def conclusive(lab: Lab, package: Path, folder: Path) -> Answer:
    """Grade it, and again while the answer is that it could not be told.

    That is what a student is told to do then; a wrong answer is never asked for twice.
    """
    for _ in range(MOST_TRIES):
        answer = check(lab, package, folder)
        if answer.verdict["outcome"] != "inconclusive":
            break
    return answer


def labs() -> list[Any]:
    """Each lab once."""
    return [pytest.param(lab, id=lab.name) for lab in all_labs()]


def mutants() -> list[Any]:
    """Each mutant of each lab; those of one lab stand for all where time is short."""
    return [
        pytest.param(lab, mutant, id=f"{lab.name}-{mutant.name}", marks=marks)
        for lab in all_labs()
        for marks in [() if lab.name == EXAMPLE else pytest.mark.slow]
        for mutant in lab.mutants()
    ]


def timed_mutants() -> list[Any]:
    """Those that a clock can touch: nothing keeps their nodes from running."""
    ends_early = {"well_formed", "builds"}
    return [
        pytest.param(lab, mutant, id=f"{lab.name}-{mutant.name}")
        for lab in all_labs()
        if lab.name == EXAMPLE
        for mutant in lab.mutants()
        if not ends_early & set(mutant.fails)
    ]


@pytest.mark.parametrize("lab", labs())
def test_the_solution_gets_the_full_score(lab: Lab, tmp_path: Path) -> None:
    """Nothing in the card asks for more than the solution does."""
    answer = conclusive(lab, lab.solution, tmp_path)
    assert answer.faults() == {}
    assert answer.verdict["score"] == 100
    assert answer.status == 0


@pytest.mark.parametrize("lab", labs())
def test_the_starter_does_not_pass(lab: Lab, tmp_path: Path) -> None:
    """Who has done nothing has not done the lab."""
    answer = conclusive(lab, lab.starter, tmp_path)
    assert answer.verdict["outcome"] == "fail"
    assert answer.status == 1


@pytest.mark.parametrize(("lab", "mutant"), mutants())
def test_a_mutant_fails_where_it_says(lab: Lab, mutant: Mutant, tmp_path: Path) -> None:
    """The failed checks are exactly those that it names; the skipped ones are their dependants."""
    package = mutant.make(lab.solution, tmp_path / "src" / lab.card.package)
    answer = conclusive(lab, package, tmp_path)
    assert answer.ids("fail") == set(mutant.fails), answer.beyond(mutant.fails)
    assert answer.ids("inconclusive") == set()
    assert answer.ids("skip") == dependants(lab, set(mutant.fails)) | set(mutant.skips)
    assert mutant.faults.items() <= answer.faults().items()


@pytest.mark.slow
@pytest.mark.parametrize(("lab", "mutant"), timed_mutants())
def test_a_mutant_gets_the_same_verdict_in_real_time(
    lab: Lab, mutant: Mutant, tmp_path: Path
) -> None:
    """`--clock wall` and the simulated clock agree; a busy computer may only keep a rate back."""
    package = mutant.make(lab.solution, tmp_path / "src" / lab.card.package)
    answer = check(lab, package, tmp_path, "wall")
    assert answer.ids("fail") <= set(mutant.fails), answer.faults()
    assert set(mutant.fails) <= answer.ids("fail") | answer.ids("inconclusive")
