"""Two records of verdicts, compared: what differs is found, and what nobody could tell is not."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import pytest
from verdicts import (
    Difference,
    Said,
    Verdicts,
    compare,
    differences,
    keep,
    verdicts_in,
    verdicts_of,
)

from roslings.course import all_labs
from roslings_prove.prove import Solution

PASSED, LOST, UNTOLD = (
    Said("pass", 4.0, None),
    Said("fail", 0.0, "TooSlow"),
    Said("inconclusive", 0.0, None),
)
BEFORE: Verdicts = {"nodes: solution": {"runs": PASSED, "rate": LOST}, "nodes: gone": {}}


def changed(check: str, said: Said) -> Verdicts:
    """The record from before, with one check of the solution judged otherwise."""
    return {"nodes: solution": {**BEFORE["nodes: solution"], check: said}}


@pytest.mark.parametrize(
    "said", [LOST, replace(PASSED, points=3.0), replace(LOST, fault="TooFast")], ids=str
)
def test_another_outcome_other_points_and_another_fault_differ(
    said: Said, capsys: pytest.CaptureFixture[str]
) -> None:
    """Any of the three is told with both sides, and ends with 1."""
    before = changed("runs", replace(said, outcome="pass") if said == LOST else PASSED)
    after = changed("runs", said)
    assert compare(before, after) == 1
    assert (
        f"runs: {before['nodes: solution']['runs']} before, {said} after" in capsys.readouterr().out
    )


def test_a_check_that_is_gone_differs() -> None:
    """A check without a verdict is not a check that passes."""
    found = list(differences(BEFORE, {"nodes: solution": {"runs": PASSED}}))
    assert found == [Difference("nodes: solution", "rate", LOST, None)]


def test_what_nobody_could_tell_is_named_and_is_no_difference(
    capsys: pytest.CaptureFixture[str],
) -> None:
    """A busy machine is no change of the engine."""
    assert compare(BEFORE, changed("runs", UNTOLD)) == 0
    said = capsys.readouterr().out
    assert "not told  nodes: solution: runs" in said
    assert "only before: nodes: gone" in said


def test_a_record_is_read_as_it_was_written(tmp_path: Path) -> None:
    """And half a line at its end is left out."""
    file = tmp_path / "record.jsonl"
    keep(file, BEFORE)
    with file.open("a", encoding="utf-8") as lines:
        lines.write('{"package": "nodes: half')
    assert verdicts_in(file) == BEFORE


@pytest.mark.slow
def test_a_package_is_graded_for_the_record() -> None:
    """Every check of the card is in it, with its points."""
    lab = next(lab for lab in all_labs() if lab.name == "nodes")
    said = verdicts_of([Solution(lab)], 1)["nodes: solution"]
    assert {check: each.points for check, each in said.items()} == dict(lab.card.points)
