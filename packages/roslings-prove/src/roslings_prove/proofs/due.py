"""Which proofs have to be measured anew, and why. The rules of the gate stand here, and only here.

- Solutions and starters: always, so that each experiment of the course is made.
- What has no proof, or whose package, card or experiments are others now: always.
- What measures all labs has measured a fifth of all. Where it is another than before, as many are
  due as that takes, the oldest first. Where some are of one age, the digest of what measures draws
  lots: another state, another fifth.
- Twenty more at each landing; the commit draws them.

No rule looks at the calendar, or at what git tells of the past.
"""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from roslings.course import Lab
from roslings_prove.proofs.digests import MeasuringCode, card_digest
from roslings_prove.proofs.kept import Folder, KeptProof, content_of, name_in
from roslings_prove.prove import ProvenPackage, Solution, StarterPackage

PART = 5
"""Where what measures all labs is another, one of so many is measured."""
AT_EACH_LANDING = 20


@dataclass(frozen=True)
class Due:
    """A package that has to be measured, and the rule that says so."""

    package: ProvenPackage
    why: str


@dataclass(frozen=True)
class ProofStanding:
    """A package beside what is kept of it."""

    package: ProvenPackage
    line: KeptProof | None
    age: int
    """How many states of what measures came after the one that measured it."""
    stale: str
    """What is another now than when it was measured; empty where nothing is."""


@dataclass(frozen=True)
class Proofs:
    """All packages of some labs, with what is kept of each."""

    labs: Sequence[Lab]
    folder: Folder
    measuring: MeasuringCode

    @cached_property
    def standings(self) -> list[ProofStanding]:
        """Of every package, in the order of the labs."""
        return [standing for lab in self.labs for standing in self._of(lab)]

    @cached_property
    def _states(self) -> tuple[str, ...]:
        return self.folder.states

    def _of(self, lab: Lab) -> list[ProofStanding]:
        lines, card = self.folder.lines(lab), card_digest(lab)
        experiments = self.measuring.experiments(lab)
        return [
            self._standing(package, lines.get(name_in(lab, package)), card, experiments)
            for package in self.folder.packages(lab)
        ]

    def _standing(
        self, package: ProvenPackage, line: KeptProof | None, card: str, experiments: str
    ) -> ProofStanding:
        if line is None:
            return ProofStanding(package, None, len(self._states), "it was never measured")
        now = {"package": content_of(package), "card": card, "experiments": experiments}
        then = {"package": line.content, "card": line.card, "experiments": line.experiments}
        other = [name for name in now if now[name] != then[name]]
        stale = f"another {' and '.join(other)}" if other else ""
        return ProofStanding(package, line, self._age(line), stale)

    def _age(self, line: KeptProof) -> int:
        states = self._states
        return len(states) - 1 - states.index(line.core) if line.core in states else len(states)

    def stale(self) -> list[ProofStanding]:
        """Those whose package, card or experiments are others now, or that were never measured."""
        return [each for each in self.standings if each.stale]

    def due(self, commit: str) -> list[Due]:
        """All that has to be measured before this commit lands."""
        found = {each.package.name: Due(each.package, each.stale) for each in self.stale()}
        for each in self.standings:
            if isinstance(each.package, Solution | StarterPackage):
                found.setdefault(each.package.name, Due(each.package, "at each landing"))
        for each in self._for_the_core():
            found.setdefault(each.package.name, Due(each.package, "what measures is another"))
        for each in self._by_lot(commit, found):
            found[each.package.name] = Due(each.package, "drawn by the commit")
        return list(found.values())

    def _for_the_core(self) -> list[ProofStanding]:
        """What is missing of a fifth, the oldest first; those of one age in an order by lot."""
        older = [each for each in self.standings if not self._is_of_this_core(each)]
        missing = -(-len(self.standings) // PART) - (len(self.standings) - len(older))
        drawn = _shuffled(older, self.measuring.core)
        return sorted(drawn, key=lambda each: -each.age)[: max(missing, 0)]

    def _is_of_this_core(self, each: ProofStanding) -> bool:
        return each.line is not None and each.line.core == self.measuring.core

    def _by_lot(self, commit: str, but: Mapping[str, Due]) -> list[ProofStanding]:
        left = [each for each in self.standings if each.package.name not in but]
        return _shuffled(left, commit)[:AT_EACH_LANDING]


def _shuffled(standings: Sequence[ProofStanding], seed: str) -> list[ProofStanding]:
    found = sorted(standings, key=lambda each: each.package.name)
    random.Random(seed).shuffle(found)
    return found
