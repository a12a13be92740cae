"""Evidence of wrong packages as gradebooks of earlier schemas hold it: tests/evidence/kills.

Each lab's `kills.json` says which check failed, and which lines were changed. New kills are kept
with the proofs (`tests/proofs`); these stay as they are, since old gradebooks do.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from pydantic import BaseModel, TypeAdapter

from roslings.batch.grading import unpacked
from roslings.evidence import Evidence

FOLDER = Path(__file__).parent / "evidence" / "kills"
LABS = sorted(folder.name for folder in FOLDER.iterdir())


class OldKill(BaseModel):
    """One wrong package that was caught."""

    package: str
    check: str
    diff: str

    @property
    def file(self) -> str:
        """Where its packed evidence lies, beside the index."""
        return f"{self.package.replace(':', '-')}.evidence"


def read_kills(lab: str) -> Iterator[tuple[OldKill, Evidence]]:
    """The kills of a lab, each with its evidence."""
    index = TypeAdapter(tuple[OldKill, ...]).validate_json(
        (FOLDER / lab / "kills.json").read_bytes()
    )
    for kill in index:
        yield kill, unpacked((FOLDER / lab / kill.file).read_bytes())
