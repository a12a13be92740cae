"""`prove LAB --walks`: a card that asks for more, and what is said of a solution that fails."""

from __future__ import annotations

from pathlib import Path

import pytest

from roslings.course import Lab, all_labs, lab
from roslings.course.files import read_tree
from roslings_prove.prove import gradings_fit
from roslings_prove.walks import DrawsNoWalks, walked_solutions
from roslings_prove.walks.grading import LEAST_DRAWN, MORE, WALKS, WalkScore

WALKED = [each for each in all_labs() if WALKS in each.folder.joinpath("card.yaml").read_text()]
E_STOP = lab("e-stop")


def quiet(standing: object) -> None:
    """Nobody watches."""


def test_a_hundred_are_drawn_by_a_longer_card(tmp_path: Path) -> None:
    """Everything else of the card stays as it is."""
    made = walked_solutions(E_STOP, tmp_path)
    assert len(made) * MORE >= LEAST_DRAWN
    assert len({each.name for each in made}) == len(made)
    before = read_tree(E_STOP.folder / "card.yaml")
    after = read_tree(made[0].course / "labs/e-stop/card.yaml")
    asked = after["nodes"][1].pop(WALKS)
    assert asked == before["nodes"][1].pop(WALKS) + MORE
    assert after == before


def test_a_lab_without_states_is_refused(tmp_path: Path) -> None:
    """Its name and the missing word are told."""
    with pytest.raises(DrawsNoWalks, match=r"topics: no node of its card says 'walks'"):
        walked_solutions(lab("topics"), tmp_path)


def test_the_sum_is_told() -> None:
    """How many gradings, and how many walks."""
    line = WalkScore("e-stop", 24, 25).line
    assert line.startswith("e-stop: 24 of 25 gradings of the solution get 100")
    assert line.endswith("100 in all")


@pytest.mark.slow
@pytest.mark.parametrize("walked", WALKED, ids=[each.name for each in WALKED])
def test_a_solution_keeps_its_word_in_orders_that_are_drawn(walked: Lab, tmp_path: Path) -> None:
    """One grading of those that the command makes."""
    first, *_ = walked_solutions(walked, tmp_path)
    (proof,) = gradings_fit([first], quiet)
    assert proof.holds, proof.line
