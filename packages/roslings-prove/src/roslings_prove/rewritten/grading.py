"""`./roslings prove LAB --rewritten`: what does the same as the solution gets 100 as well."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from roslings.course import Lab
from roslings.course.grader import Clock
from roslings.experiment.run_folder import run_folder
from roslings_class.result import GradingResult
from roslings_class.scheduler import Watcher
from roslings_class.version import version_of
from roslings_prove.prove import Proof, Solution, graded, mixed, proof_of
from roslings_prove.rewritten.keeping import kept_results
from roslings_prove.rewritten.source import Sources
from roslings_prove.rewritten.table import RewrittenSources, made_from


@dataclass(frozen=True)
class Score:
    """How many of a lab's rewritten solutions get 100."""

    lab: str
    right: int
    made: int

    @property
    def line(self) -> str:
        """In words."""
        part = self.right / self.made if self.made else 0.0
        return f"{self.lab}: {self.right} of {self.made} rewritten solutions get 100 ({part:.0%})"


@dataclass(frozen=True)
class Rewritten:
    """The solution in other words."""

    lab: Lab
    number: int
    made: RewrittenSources
    clock: Clock = "auto"
    course: None = None

    @property
    def name(self) -> str:
        """It names the engine and the lab too: what an older one said is not asked.

        A number, because what was rewritten together would be too long for a folder's name.
        """
        return f"{self.lab.name}: rewritten {self.number} by {version_of(self.lab)}"

    @property
    def about(self) -> str:
        """What was rewritten."""
        return f"{self.lab.name}: the solution gets 100 with {self.made.name}"

    def make(self, folder: Path) -> Path:
        """Written where nothing is yet."""
        return self.made.sources.write(
            self.lab.solution, folder / self.name / self.lab.card.package
        )

    def problem(self, result: GradingResult) -> str:
        """Where it loses points, and all that is not as in the solution."""
        problem = Solution(self.lab).problem(result)
        return f"{problem}\n{textwrap.indent(self._difference(), ' ' * 7)}" if problem else ""

    def _difference(self) -> str:
        return Sources.read(self.lab.solution, self.lab.card).difference(self.made.sources)


def rewritten(lab: Lab) -> list[Rewritten]:
    """All that is made of a lab's solution. Raises CannotRewrite."""
    made = made_from(Sources.read(lab.solution, lab.card))
    return [Rewritten(lab, number, each) for number, each in enumerate(made, 1)]


def prove_rewritten(
    labs: Sequence[Lab], watcher: Watcher, jobs: int | None = None
) -> Iterator[Proof | Score]:
    """A proof for each rewritten solution of each lab, and how many hold.

    Raises CannotRewrite, and AlreadyRewriting.
    """
    packages = {lab.name: rewritten(lab) for lab in labs}
    every = mixed([each for made in packages.values() for each in made])
    with kept_results() as kept, run_folder() as scratch:
        results = graded(every, scratch, watcher, jobs, book=str(kept.absolute()))
    for lab in labs:
        yield from _proofs(lab, packages[lab.name], results)


def _proofs(
    lab: Lab, made: Sequence[Rewritten], results: Mapping[str, GradingResult]
) -> Iterator[Proof | Score]:
    problem = "" if made else "no rewrite fits it, so nothing is shown"
    yield Proof(f"{lab.name}: the solution can be rewritten", problem)
    proofs = [proof_of(each, results[each.name]) for each in made]
    yield from proofs
    yield Score(lab.name, sum(proof.holds for proof in proofs), len(made))
