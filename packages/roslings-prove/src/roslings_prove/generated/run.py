"""`./roslings prove LAB --generated`: make wrong packages, grade them, keep what came of each."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from roslings import course
from roslings.course import Lab
from roslings_class.gradebook import gradebook
from roslings_class.result import GradingResult
from roslings_class.scheduler import Watcher
from roslings_prove.generated.choice import Generated, generated
from roslings_prove.generated.explained import Explanation, explained
from roslings_prove.generated.keeping import BOOK, graded_in, how_far, kept_in
from roslings_prove.generated.kills import keep_kills
from roslings_prove.generated.packages import Fate, GeneratedPackage, fate_of
from roslings_prove.generated.table import GeneratedOutcome, TableLine, told
from roslings_prove.generated.wrongness import Wrongness
from roslings_prove.proofs.kept import kept_here
from roslings_prove.prove import Proof


@dataclass(frozen=True)
class Keeping:
    """Where results stay, so that an interrupted run goes on."""

    folder: Path
    kills: Path | None = None
    """The folder of kept proofs, where some kills are named."""
    so_far: bool = False
    """Nothing is graded: what is known is told."""


def usual_place() -> Path:
    """Beside the course; git does not see it."""
    return course.root() / ".roslings" / "generated"


def proofs_for(
    keep: Path | None, so_far: bool, keep_kills: bool
) -> Callable[[Sequence[Lab], Watcher, int | None], Iterator[Proof | TableLine]]:
    """Proves labs as the command's options say."""
    kills = kept_here().path if keep_kills else None
    return partial(prove_generated, keeping=Keeping(keep or usual_place(), kills, so_far))


def prove_generated(
    labs: Sequence[Lab], watcher: Watcher, jobs: int | None, keeping: Keeping
) -> Iterator[Proof | TableLine]:
    """What came of the generated packages of labs.

    Raises BadCourseFile before anything is run, and AlreadyProving.
    """
    made = {lab.name: generated(lab) for lab in labs}
    reasons = {lab.name: explained(lab, made[lab.name]) for lab in labs}
    packages = [GeneratedPackage(each) for lab in labs for each in made[lab.name]]
    if keeping.so_far:
        results = kept_in(keeping.folder)
        yield how_far(packages, results)
    else:
        results = graded_in(packages, watcher, jobs, keeping.folder)
    known = {each.change: results[each.name] for each in packages if each.name in results}
    yield from told([_outcome(lab, known, reasons[lab.name]) for lab in labs])
    if keeping.kills:
        yield from _kept_kills(labs, known, keeping.folder, keeping.kills)


def _outcome(
    lab: Lab, known: Mapping[Generated, GradingResult], reasons: Mapping[str, Explanation]
) -> GeneratedOutcome:
    """Of those that were graded."""
    fates: dict[Wrongness, Fate] = {
        each: fate_of(result) for each, result in known.items() if each.lab == lab
    }
    names = {each.name for each in fates}
    return GeneratedOutcome(
        lab.name, fates, {name: why for name, why in reasons.items() if name in names}
    )


def _kept_kills(
    labs: Sequence[Lab], results: Mapping[Generated, GradingResult], kept: Path, folder: Path
) -> Iterator[TableLine]:
    with gradebook(kept, BOOK) as book:
        for lab in labs:
            killed = [
                (each, result)
                for each, result in results.items()
                if each.lab == lab and fate_of(result) is Fate.KILLED
            ]
            count = keep_kills(lab, killed, book, folder)
            yield TableLine(
                f"{lab.name}: {count} kills are named. ./roslings prove --record {lab.name}"
                " measures them."
            )
