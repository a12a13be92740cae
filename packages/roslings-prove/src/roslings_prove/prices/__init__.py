"""What a mistake costs: of each kept proof, the points that its package lost, and by what.

A check that fails takes its own points. Checks that need it are skipped, and take theirs with them.
That is right where what they judge is not there, as of a node that never starts. Where it is there,
one mistake costs more than it should.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass

from roslings.course import Lab
from roslings_prove.proofs.kept import Folder, KeptProof, Words

RIGHT, NOT_DONE = "solution", "starter"
"""Packages that hold no mistake."""
INDENT = " " * 18
"""Of the lines that a price goes on in: below its package."""


@dataclass(frozen=True)
class CheckOutcome:
    """What one check said."""

    outcome: str
    points: float


@dataclass(frozen=True)
class Price:
    """What one package lost, in points."""

    package: str
    failed: Mapping[str, float]
    """Checks that failed: what each of them took."""
    skipped: Mapping[str, float]
    """Checks that were not judged because of those."""

    @property
    def points(self) -> float:
        """All of it."""
        return self.own_points + sum(self.skipped.values())

    @property
    def own_points(self) -> float:
        """What the checks took that failed."""
        return sum(self.failed.values())

    @property
    def line(self) -> str:
        """`95 = 5 + 90  mutant init_missing: well_formed; 14 skipped`."""
        sum_of_two = f"{self.points:g} = {self.own_points:g} + {self.points - self.own_points:g}"
        told = f"{sum_of_two:{len(INDENT)}}{self.package}: {', '.join(self.failed)}"
        return f"{told}; {len(self.skipped)} skipped" if self.skipped else told


@dataclass(frozen=True)
class PriceList:
    """The prices of a lab, the highest first."""

    lab: str
    prices: tuple[Price, ...]

    @property
    def dear(self) -> tuple[Price, ...]:
        """Those that cost more than the checks that failed."""
        return tuple(each for each in self.prices if each.skipped)

    def lines(self) -> Iterator[str]:
        """For a terminal."""
        if not self.prices:
            mend = f"./roslings prove --record {self.lab} makes them"
            yield f"{self.lab}: no proof of it is kept. {mend}"
            return
        count, dear = len(self.prices), len(self.dear)
        yield f"{self.lab}: {count} wrong packages; {count - dear} cost only the checks that fail"
        yield from (each.line for each in self.prices)


def price_list(lab: Lab, folder: Folder) -> PriceList:
    """What each kept wrong package of a lab lost."""
    lines = folder.lines(lab)
    full = points_of(lines[RIGHT].checks) if RIGHT in lines else {}
    wrong = (line for name, line in lines.items() if name not in (RIGHT, NOT_DONE))
    prices = sorted(priced(wrong, full), key=lambda each: (-each.points, each.package))
    return PriceList(lab.name, tuple(prices))


def points_of(checks: Words) -> dict[str, float]:
    """What each check gave."""
    return {name: read(word).points for name, word in checks.items()}


def priced(lines: Iterable[KeptProof], full: Mapping[str, float]) -> Iterator[Price]:
    """Against what the solution has for each check."""
    for line in lines:
        words = {name: read(word) for name, word in line.checks.items()}
        yield Price(line.package, lost(words, full, "fail"), lost(words, full, "skip"))


def lost(
    words: Mapping[str, CheckOutcome], full: Mapping[str, float], outcome: str
) -> dict[str, float]:
    """What the checks of this outcome took."""
    return {
        name: full.get(name, 0.0) - word.points
        for name, word in words.items()
        if word.outcome == outcome
    }


def read(word: str) -> CheckOutcome:
    """`fail 0 TooSlow`, as a line of kept proofs has it."""
    outcome, points, *_ = word.split(" ")
    return CheckOutcome(outcome, float(points))
