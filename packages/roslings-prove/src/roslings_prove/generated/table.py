"""What came of a lab's generated packages: a line of the table, and each survivor with its diff."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from operator import attrgetter

from roslings_prove.generated.explained import FILE, Explanation
from roslings_prove.generated.packages import Fate
from roslings_prove.generated.wrongness import Wrongness
from roslings_prove.prove import Proof

LEAST_RATE = 0.95
MOST_EXPLAINED = 0.1
HEAD = (
    f"{'lab':16}{'made':>6}{'killed':>8}{'survived':>10}{'explained':>11}{'unclear':>9}"
    f"{'kill rate':>11}{'raw':>8}"
)


@dataclass(frozen=True)
class TableLine:
    """Something to say."""

    line: str


@dataclass(frozen=True)
class GeneratedOutcome:
    """What came of all generated packages of a lab."""

    lab: str
    fates: Mapping[Wrongness, Fate]
    explained: Mapping[str, Explanation]
    least_rate: float = LEAST_RATE
    is_part: bool = False
    """Of packages that another outcome tells of already."""

    @property
    def made(self) -> int:
        """How many there are."""
        return len(self.fates)

    def of(self, fate: Fate) -> list[Wrongness]:
        """The packages that nobody explains, and of which this came; by name."""
        found = [
            each
            for each, came in self.fates.items()
            if came is fate and (fate is Fate.KILLED or each.name not in self.explained)
        ]
        return sorted(found, key=attrgetter("name"))

    @property
    def kill_rate(self) -> float:
        """Of those that are not explained."""
        rest = self.made - len(self.explained)
        return len(self.of(Fate.KILLED)) / rest if rest else 1.0

    @property
    def raw_rate(self) -> float:
        """Of all."""
        return len(self.of(Fate.KILLED)) / self.made if self.made else 1.0

    @property
    def row(self) -> str:
        """The lab in the table: 79 letters."""
        counts = [len(self.of(fate)) for fate in (Fate.KILLED, Fate.SURVIVED, Fate.UNCLEAR)]
        killed, survived, unclear = counts
        return (
            f"{self.lab:16}{self.made:6}{killed:8}{survived:10}{len(self.explained):11}"
            f"{unclear:9}{self.kill_rate:11.1%}{self.raw_rate:8.1%}"
        )

    def proofs(self) -> Iterator[Proof]:
        """What must hold."""
        if not self.is_part:
            yield from self._can_be_believed()
        enough = self.kill_rate >= self.least_rate
        problem = f"{self.kill_rate:.1%}: see the survivors above"
        about = f"{self.lab}: {self.least_rate:.0%} of the others are caught"
        is_open = bool(self.of(Fate.UNCLEAR)) and self._could_be()
        yield Proof(about, "" if enough else problem, is_open=is_open)

    def _can_be_believed(self) -> Iterator[Proof]:
        yield from self._strangely_explained()
        explained = len(self.explained)
        problem = f"{explained} of {self.made} are: close the holes instead"
        few = explained <= self.made * MOST_EXPLAINED
        yield Proof(f"{self.lab}: at most one in ten is explained", "" if few else problem)
        unclear = ", ".join(each.name for each in self.of(Fate.UNCLEAR))
        problem = f"run it again for: {unclear}" if unclear else ""
        yield Proof(f"{self.lab}: of each one something could be told", problem, is_open=True)

    def _could_be(self) -> bool:
        """Whether enough are caught if all that are unclear turn out to be."""
        missed = len(self.of(Fate.SURVIVED))
        return missed <= (1 - self.least_rate) * (self.made - len(self.explained))

    def _strangely_explained(self) -> Iterator[Proof]:
        for each in self.of(Fate.KILLED):
            if each.name in self.explained:
                problem = f"it is caught: take it out of {FILE}"
                yield Proof(f"{each.name} is explained", problem)


def told(outcomes: Sequence[GeneratedOutcome]) -> Iterator[TableLine | Proof]:
    """Survivors with their diffs, what must hold, and the table last."""
    for outcome in outcomes:
        for each in () if outcome.is_part else outcome.of(Fate.SURVIVED):
            yield TableLine(f"\nNothing catches {each.name}\n{_cut(each.diff)}\n")
    for outcome in outcomes:
        yield from outcome.proofs()
    yield TableLine("\n".join(["", HEAD, *(outcome.row for outcome in outcomes), ""]))


def _cut(diff: str) -> str:
    """Lines as a terminal of 80 columns shows them whole."""
    return "\n".join(line if len(line) < 80 else f"{line[:76]}..." for line in diff.splitlines())
