"""Each starter fails for the reason that it teaches, and says so first; each solution passes."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from fresh import in_fresh_process

from asked_for import MADE_FOR_ALL
from once import once
from roslings_learn.drills import Drill, all_drills, drill
from roslings_prove.drills import prove_drills
from roslings_prove.prove import Proof


def proofs_of(drills: list[Drill]) -> list[Proof]:
    """All that must hold of them."""
    return in_fresh_process(_proofs, drills)


def _proofs(drills: list[Drill]) -> list[Proof]:
    return list(prove_drills(drills))


def wrong(proofs: list[Proof]) -> list[str]:
    """What does not hold."""
    return [proof.line for proof in proofs if not proof.holds]


def test_some_drills_are_proven() -> None:
    """One that ends, one that runs no callback, one to foretell, one that is told things."""
    names = ("brackets", "deaf_to_ros", "private_name", "doubler")
    proofs = proofs_of([drill(name) for name in names])
    assert wrong(proofs) == []
    assert len(proofs) == 4 * 3 + 1


@pytest.mark.slow
@MADE_FOR_ALL
def test_all_drills_are_proven(shared_folder: Path) -> None:
    """Every program of every drill, run for real."""

    def prove() -> str:
        return json.dumps(wrong(proofs_of(list(all_drills()))))

    assert json.loads(once(shared_folder / "drills.json", prove)) == []
