"""What a mistake costs: the sums are those of the kept verdicts, and they are told."""

from __future__ import annotations

from pathlib import Path

import pytest

from roslings.course import Lab, all_labs, lab
from roslings_launcher.cli import main
from roslings_prove.prices import NOT_DONE, RIGHT, points_of, price_list, priced
from roslings_prove.proofs.kept import Folder, KeptProof, kept_here

LABS = all_labs()


@pytest.mark.parametrize("each", LABS, ids=[lab.name for lab in LABS])
def test_nothing_that_was_lost_is_left_out(each: Lab) -> None:
    """Failed and skipped together are what the verdict has less than the solution's."""
    lines = kept_here().lines(each)
    full = sum(points_of(lines[RIGHT].checks).values())
    prices = {price.package: price for price in price_list(each, kept_here()).prices}
    assert prices.keys() == lines.keys() - {RIGHT, NOT_DONE}
    for name, price in prices.items():
        assert price.points == pytest.approx(full - sum(points_of(lines[name].checks).values()))
        assert price.failed, f"{name} is wrong, and no check failed"


def test_what_fails_and_what_is_not_judged_are_told_apart() -> None:
    """A check that gives a part of its points has lost the rest."""
    line = KeptProof(
        package="mutant late",
        content="",
        card="",
        experiments="",
        core="",
        evidence="",
        checks={"runs": "pass 3", "rate": "fail 2 TooSlow", "text": "skip 0"},
    )
    (price,) = priced([line], {"runs": 3.0, "rate": 14.0, "text": 10.0})
    assert (price.points, price.own_points, price.skipped) == (22.0, 12.0, {"text": 10.0})
    assert price.line == "22 = 12 + 10      mutant late: rate; 1 skipped"


def test_a_lab_without_proofs_says_how_they_are_made(tmp_path: Path) -> None:
    """As a lab of one's own has none at first."""
    (line,) = price_list(lab("topics"), Folder(tmp_path)).lines()
    assert line == "topics: no proof of it is kept. ./roslings prove --record topics makes them"


def test_the_list_is_told_in_80_columns(capsys: pytest.CaptureFixture[str]) -> None:
    """Of one lab; the dearest first."""
    assert main(["prove", "topics", "--prices"]) == 0
    first, *lines = capsys.readouterr().out.splitlines()
    found = price_list(lab("topics"), kept_here())
    kept = len(found.prices) - len(found.dear)
    assert first == (
        f"topics: {len(found.prices)} wrong packages; {kept} cost only the checks that fail"
    )
    assert all(len(line) <= 80 for line in [first, *lines])
    assert lines[0].startswith("93 = 5 + 88")
