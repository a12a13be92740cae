"""What the choice tells pytest: which test files are left out, and of which a part runs by lot."""

from __future__ import annotations

import json
import math
import random
from collections import Counter
from collections.abc import Collection, Iterable
from dataclasses import asdict, dataclass
from pathlib import Path

KEPT = "kept"
"""It passed before, with all that it needs as it is now."""
UNDRAWN = "undrawn"
"""Of what it needs, only the core of measuring or a list of names is another, and the lot fell on
others."""

TOLD = {
    KEPT: "{} tests were run before with all that they need as it is",
    UNDRAWN: "{} tests not drawn: of what they need, only the core of measuring or a list of names"
    " is another",
}


@dataclass(frozen=True)
class LeftOut:
    """A test file of which not all runs."""

    file: str
    outcome: str
    """`KEPT` or `UNDRAWN`."""
    part: int = 0
    """One of so many of its tests runs all the same; 0: none."""
    seed: str = ""
    skipped: tuple[str, ...] = ()
    """Tests that were skipped when the others passed: they run, and say what is missing here."""

    def drawn(self, tests: Collection[str]) -> set[str]:
        """Those of these tests that run."""
        return drawn(tests, self.seed, self.part) if self.part else set()


def drawn(names: Collection[str], seed: str, part: int) -> set[str]:
    """One of so many, by lot: at least one, where there are any. Another seed, others."""
    found = sorted(names)
    random.Random(seed).shuffle(found)
    return set(found[: math.ceil(len(found) / part)])


def write(file: Path, left_out: Iterable[LeftOut]) -> None:
    """A line of JSON each."""
    file.write_text("".join(f"{json.dumps(asdict(each))}\n" for each in left_out), "utf-8")


def read(file: Path) -> dict[str, LeftOut]:
    """By test file. Where no choice was made, nothing is left out."""
    lines = file.read_text("utf-8").splitlines() if file.exists() else []
    return {each.file: each for each in map(_read, lines)}


def _read(line: str) -> LeftOut:
    found = json.loads(line)
    return LeftOut(**{**found, "skipped": tuple(found["skipped"])})


def told(outcomes: Iterable[str]) -> list[str]:
    """How many were left out by which rule."""
    found = Counter(outcomes)
    return [words.format(found[name]) for name, words in TOLD.items() if found[name]]
