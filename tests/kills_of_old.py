"""Evidence of wrong packages as gradebooks of earlier schemas hold it: `tests/evidence/kills`
of the engine.

Each lab's `kills.json` says which check failed, and which lines were changed. New kills are kept
with the proofs (`tests/proofs`); these stay as they are, since old gradebooks do.
"""

from __future__ import annotations

import zlib
from collections.abc import Iterator
from pathlib import Path

from pydantic import BaseModel, TypeAdapter

from roslings.evidence import Evidence, read_json

FOLDER = Path(__file__).resolve().parents[1] / "packages/roslings/tests/evidence/kills"
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
        yield kill, read_json(zlib.decompress((FOLDER / lab / kill.file).read_bytes()))
