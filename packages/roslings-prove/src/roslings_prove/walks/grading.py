"""The solution, graded again and again by a card that asks for more walks than a check makes.

Each grading draws its own. So an author sees whether the model in the grader and the solution say
the same, before a student's package is held against the model.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import ceil
from pathlib import Path

from roslings.course import CourseError, Lab
from roslings.course.files import read_tree
from roslings.course.grader import Clock
from roslings.course.variants import LabVariant, Variants, VariantWord
from roslings.experiment.run_folder import run_folder
from roslings.verdict import CheckResult
from roslings_class.result import GradingResult
from roslings_class.scheduler import Watcher
from roslings_prove.prove import Proof, failing, graded, proof_of

WALKS = "walks"
"""The word of a node, on a card, that says how many there are."""
MORE = 4
"""So many more are drawn in each grading than in a check: one after the other, some 12 s each."""
LEAST_DRAWN = 100


class DrawsNoWalks(CourseError):
    """A lab whose nodes have no states."""

    def __init__(self, lab: Lab) -> None:
        super().__init__(f"{lab.name}: no node of its card says {WALKS!r}: nothing is walked there")


@dataclass(frozen=True)
class WalkedSolution:
    """The solution, in orders of events that one grading draws."""

    lab: Lab
    number: int
    course: Path
    clock: Clock = "auto"

    @property
    def name(self) -> str:
        """By its number."""
        return f"{self.lab.name}: walks {self.number}"

    @property
    def about(self) -> str:
        """It does what the model says."""
        return f"{self.name}, the solution gets 100 of 100 with {MORE} more orders of events"

    def make(self, folder: Path) -> Path:
        """It is there."""
        return self.lab.solution

    def problem(self, result: GradingResult) -> str:
        """Where it loses points, with the order that shows it."""
        if result.score in (None, 100):
            return ""
        told = [f"{each.measured} ({each.expected})" for each in _failed(result)]
        return "; ".join([f"{result.score:g} of 100", failing(result), *told])


@dataclass(frozen=True)
class WalkScore:
    """How many gradings of a lab's solution found nothing."""

    lab: str
    right: int
    made: int

    @property
    def line(self) -> str:
        """In words."""
        walks = self.made * MORE
        return (
            f"{self.lab}: {self.right} of {self.made} gradings of the solution get 100; each drew"
            f" {MORE} orders of events more than a check does, {walks} in all"
        )


def prove_walks(
    labs: Sequence[Lab], watcher: Watcher, jobs: int | None = None
) -> Iterator[Proof | WalkScore]:
    """A proof for each grading, and the sum. Raises DrawsNoWalks and BadCourseFile."""
    with run_folder() as scratch:
        packages = {lab.name: walked_solutions(lab, scratch / "courses" / lab.name) for lab in labs}
        every = [each for found in packages.values() for each in found]
        results = graded(every, scratch, watcher, jobs, book=WALKS)
    for name, found in packages.items():
        proofs = [proof_of(each, results[each.name]) for each in found]
        yield from proofs
        yield WalkScore(name, sum(proof.holds for proof in proofs), len(proofs))


def walked_solutions(lab: Lab, folder: Path) -> list[WalkedSolution]:
    """As many as it takes, by one card in `folder`. Raises DrawsNoWalks and BadCourseFile."""
    course = _longer(lab).make(folder)
    return [WalkedSolution(lab, number, course) for number in range(ceil(LEAST_DRAWN / MORE))]


def _longer(lab: Lab) -> LabVariant:
    """The lab by a card that asks for more."""
    nodes = read_tree(lab.folder / "card.yaml")["nodes"]
    counts = {f"nodes.{n}.{WALKS}": node[WALKS] for n, node in enumerate(nodes) if WALKS in node}
    if not counts:
        raise DrawsNoWalks(lab)
    longer = {place: count + MORE for place, count in counts.items()}
    words = {
        place: VariantWord(at={place: "{value}"}, values=(count, longer[place]))
        for place, count in counts.items()
    }
    return LabVariant(lab, Variants(words=words), longer)


def _failed(result: GradingResult) -> list[CheckResult]:
    checks = result.verdict.checks if result.verdict else ()
    return [each for each in checks if each.outcome == "fail"]
