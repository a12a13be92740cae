"""Each starter fails for the reason that it teaches, and says so first; each solution passes."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from fresh import proofs_of
from once import once

from roslings.authoring.prove import Proof
from roslings.drills import all_drills, drill


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
def test_all_drills_are_proven(shared_folder: Path) -> None:
    """Every program of every drill, run for real."""

    def prove() -> str:
        return json.dumps(wrong(proofs_of(list(all_drills()))))

    assert json.loads(once(shared_folder / "drills.json", prove)) == []
