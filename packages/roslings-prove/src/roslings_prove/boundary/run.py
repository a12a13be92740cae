"""`./roslings prove LAB --boundary`: what goes wrong between a node and ROS must be seen."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path

from roslings import course
from roslings.course import Lab
from roslings_class.gradebook import Gradebook, gradebook
from roslings_class.grading import unpacked
from roslings_class.result import GradingResult
from roslings_class.scheduler import Watcher
from roslings_class.worker_pool import GRADING
from roslings_prove.boundary.choice import tried
from roslings_prove.boundary.faults import BoundaryFault, neutral
from roslings_prove.boundary.layer import MARK
from roslings_prove.generated.explained import Explanation, explained
from roslings_prove.generated.keeping import BOOK, graded_in, how_far, kept_in
from roslings_prove.generated.packages import Fate, GeneratedPackage, fate_of
from roslings_prove.generated.table import GeneratedOutcome, TableLine, told
from roslings_prove.generated.wrongness import Wrongness
from roslings_prove.prove import Proof

LEAST_RATE = 0.98
Reasons = Mapping[str, Explanation]


@dataclass(frozen=True)
class BoundaryOutcome:
    """What came of the packages of a lab."""

    lab: Lab
    results: Mapping[BoundaryFault, GradingResult]
    idle: Collection[BoundaryFault]
    """Those whose fault never acted: they are no wrong packages."""

    def outcomes(self, reasons: Reasons) -> Iterator[GeneratedOutcome]:
        """Of all, and of those alone that are of kinds which have found holes."""
        acted = [fault for fault in self.results if fault not in self.idle]
        yield self._outcome(self.lab.name, acted, reasons)
        aimed = [fault for fault in acted if fault.is_aimed]
        yield replace(self._outcome("  aimed alone", aimed, reasons), is_part=True)

    def _outcome(
        self, name: str, faults: Collection[BoundaryFault], reasons: Reasons
    ) -> GeneratedOutcome:
        fates: dict[Wrongness, Fate] = {fault: fate_of(self.results[fault]) for fault in faults}
        names = {fault.name for fault in faults}
        why = {name: reason for name, reason in reasons.items() if name in names}
        return GeneratedOutcome(name, fates, why, LEAST_RATE)


def usual_place() -> Path:
    """Beside the course; git does not see it."""
    return course.root() / ".roslings" / "boundary"


def proofs_for(
    keep: Path | None, so_far: bool
) -> Callable[[Sequence[Lab], Watcher, int | None], Iterator[Proof | TableLine]]:
    """Proves labs as the command's options say."""
    return partial(prove_boundary, keep=keep or usual_place(), so_far=so_far)


def prove_boundary(
    labs: Sequence[Lab], watcher: Watcher, jobs: int | None, keep: Path, so_far: bool
) -> Iterator[Proof | TableLine]:
    """What came of the faults of labs.

    Raises BadCourseFile and UnknownInterface before anything is run, and AlreadyProving.
    """
    faults = {lab.name: tried(lab) for lab in labs}
    reasons = {lab.name: explained(lab, faults[lab.name], at_the_boundary=True) for lab in labs}
    whole = {lab.name: GeneratedPackage(neutral(lab)) for lab in labs}
    packages = [
        *whole.values(),
        *(GeneratedPackage(each) for lab in labs for each in faults[lab.name]),
    ]
    if so_far:
        results = kept_in(keep)
        yield how_far(packages, results)
    else:
        results = graded_in(packages, watcher, jobs, keep, GRADING)
    yield from (_of_neutral(lab, results.get(whole[lab.name].name)) for lab in labs)
    outcomes: list[GeneratedOutcome] = []
    for lab in labs:
        known = _known(lab, faults[lab.name], results, keep)
        outcomes += known.outcomes(reasons[lab.name])
        yield TableLine(f"{lab.name}: {len(known.idle)} faults never acted, and are not counted")
    yield from told(outcomes)


def _of_neutral(lab: Lab, result: GradingResult | None) -> Proof:
    """A layer that changes something by itself proves nothing."""
    about = f"{lab.name}: the layer without a fault has 100"
    if result is None:
        return Proof(about, "it was not graded yet", is_open=True)
    fate = fate_of(result)
    problems = {Fate.SURVIVED: "", Fate.UNCLEAR: "prove it again: it could not be told"}
    return Proof(about, problems.get(fate, _failed(result)), is_open=fate is Fate.UNCLEAR)


def _failed(result: GradingResult) -> str:
    checks = result.verdict.checks if result.verdict else ()
    failed = ", ".join(each.id for each in checks if each.outcome == "fail")
    return f"these checks fail: {failed}"


def _known(
    lab: Lab, faults: Collection[BoundaryFault], results: Mapping[str, GradingResult], keep: Path
) -> BoundaryOutcome:
    graded = {
        fault: results[name]
        for fault in faults
        if (name := GeneratedPackage(fault).name) in results
    }
    with gradebook(keep, BOOK) as book:
        idle = [fault for fault, result in graded.items() if not _has_acted(book, result)]
    return BoundaryOutcome(lab, graded, idle)


def _has_acted(book: Gradebook, result: GradingResult) -> bool:
    """Where the evidence says so; of what has none it is believed: it was refused or broke off."""
    content = book.evidence(result)
    return content is None or MARK in unpacked(content).model_dump_json()
