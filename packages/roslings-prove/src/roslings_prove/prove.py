"""`./roslings prove LAB ...`: the solution passes, the starter does not, each mutant is caught.

All are graded for real, as many at once as the machine bears, by the same path as submissions.
What could not be told is graded again; what can never be told is not proven.
"""

from __future__ import annotations

import tempfile
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cache
from operator import itemgetter
from pathlib import Path
from typing import Protocol

from roslings.capabilities.templates import told_classes
from roslings.course import CourseError, Lab, Mutant
from roslings.course.grader import Clock
from roslings.experiment.run_folder import LOCK, run_folder
from roslings.judge.faults import Fault
from roslings.judge.sheet import dependants, explained
from roslings_class.capacity import Capacity
from roslings_class.gradebook import gradebook
from roslings_class.result import GradingOrder, GradingResult
from roslings_class.scheduler import GradingRequest, Scheduler, Watcher, always
from roslings_class.submissions import Submission
from roslings_class.worker_pool import GRADING

AS_ABOVE = "the grader breaks off as it does above"
DOES_NOT_APPLY = (CourseError, OSError, ValueError)
"""What making a mutant raises: an edit that does not fit, a file that is not there, or no text."""


@dataclass(frozen=True)
class Proof:
    """One thing that must hold of a lab, and whether it does."""

    about: str
    problem: str = ""
    """What is wrong; empty where it holds."""
    is_open: bool = False
    """The machine could not tell."""
    package: str = ""
    """The name of the package that was graded for it; empty where none was."""

    @property
    def holds(self) -> bool:
        """It is as it must be."""
        return not self.problem

    @property
    def line(self) -> str:
        """It on one line, and what is wrong below."""
        if self.holds:
            return f"ok     {self.about}"
        return f"{'open ' if self.is_open else 'WRONG'}  {self.about}\n       {self.problem}"


class HasLine(Protocol):
    """What `prove` prints: a proof, or how much of something is proven."""

    @property
    def line(self) -> str:
        """It in words."""


# --- the packages, and what must come of each --------------------------------------------------


class ProvenPackage(Protocol):
    """One package of a lab that must get a certain verdict."""

    @property
    def lab(self) -> Lab:
        """Whose it is."""

    @property
    def clock(self) -> Clock:
        """By which its experiments run."""

    @property
    def course(self) -> Path | None:
        """Where the files lie by which it is graded; None: here."""

    @property
    def name(self) -> str:
        """Of no other package of any lab."""

    @property
    def about(self) -> str:
        """What must hold of it."""

    def make(self, folder: Path) -> Path:
        """Where it lies; `folder` is for what has to be made."""

    def problem(self, result: GradingResult) -> str:
        """What is wrong with a conclusive result; empty where nothing is."""


@dataclass(frozen=True)
class Solution:
    """It gets the full score."""

    lab: Lab
    clock: Clock = "auto"
    course: None = None

    @property
    def name(self) -> str:
        """It is the only one."""
        return f"{self.lab.name}: solution"

    @property
    def about(self) -> str:
        """Nothing in the card asks for more than the solution does."""
        return f"{self.lab.name}: the solution gets 100 of 100"

    def make(self, folder: Path) -> Path:
        """It is there."""
        return self.lab.solution

    def problem(self, result: GradingResult) -> str:
        """Where it loses points."""
        if result.score is None or result.score == 100:
            return ""
        return f"{result.score:g} of 100; {failing(result)}"


@dataclass(frozen=True)
class StarterPackage:
    """It does not pass."""

    lab: Lab
    clock: Clock = "auto"
    course: None = None

    @property
    def name(self) -> str:
        """It is the only one."""
        return f"{self.lab.name}: starter"

    @property
    def about(self) -> str:
        """Who has done nothing has not done the lab."""
        return f"{self.lab.name}: the starter does not pass"

    def make(self, folder: Path) -> Path:
        """It is there."""
        return self.lab.starter

    def problem(self, result: GradingResult) -> str:
        """That it passes."""
        return "it passes: who has done nothing has done the lab" if result.word == "pass" else ""


@dataclass(frozen=True)
class MutantPackage:
    """A mutant: it fails in the checks that it names, and in no other."""

    lab: Lab
    mutant: Mutant
    clock: Clock = "auto"
    course: None = None

    @property
    def name(self) -> str:
        """Those that run by another clock have it in their name."""
        clock = "" if self.clock == "auto" else f" by the clock {self.clock}"
        return f"{self.lab.name}: mutant {self.mutant.name}{clock}"

    @property
    def about(self) -> str:
        """Which checks catch it."""
        return f"{self.name} fails {_all(self.mutant.fails)}".replace(": mutant ", ": ")

    def make(self, folder: Path) -> Path:
        """The solution, injured."""
        return injured(self.lab, self.mutant, folder / self.name)

    def problem(self, result: GradingResult) -> str:
        """Where its failed checks, their faults, or the skipped ones are others.

        What one of the failed checks explains may be skipped besides.
        """
        checks = result.verdict.checks if result.verdict else ()
        failed = {check.id: check.fault for check in checks if check.outcome == "fail"}
        skipped = {check.id for check in checks if check.outcome == "skip"}
        blocking = {name for name, fault in failed.items() if fault not in lone_faults()}
        must_skip = dependants(self.lab, blocking) | set(self.mutant.skips)
        if set(failed) != set(self.mutant.fails):
            return failing(result)
        if skipped - explained(self.lab, failed) != must_skip - explained(self.lab, failed):
            return f"skipped: {_all(sorted(skipped))}; must be: {_all(sorted(must_skip))}"
        wanted = self.mutant.faults
        other = {name: failed[name] for name, kind in wanted.items() if failed[name] != kind}
        return f"other faults: {other}" if other else ""


@cache
def lone_faults() -> frozenset[str]:
    """Names of faults that keep no other check from being judged."""
    told = (kind for kind in told_classes() if issubclass(kind, Fault))
    return frozenset(kind.__name__ for kind in told if not kind.blocks)


def injured(lab: Lab, mutant: Mutant, folder: Path) -> Path:
    """The solution of a lab with one thing wrong, in a new folder. Raises CourseError."""
    folder.mkdir(parents=True)
    mutant.make(lab.solution, folder / lab.card.package)
    return folder


def packages_of(lab: Lab) -> list[ProvenPackage]:
    """All that is graded to prove a lab."""
    return [
        Solution(lab),
        StarterPackage(lab),
        *(MutantPackage(lab, mutant) for mutant in lab.mutants()),
    ]


# --- the proofs --------------------------------------------------------------------------------


def prove(labs: Sequence[Lab], watcher: Watcher, jobs: int | None = None) -> Iterator[Proof]:
    """What the gradings tell; a mutant that cannot be made was told before (`consistency.py`)."""
    packages = [package for lab in labs for package in packages_of(lab) if can_be_made(package)]
    yield from gradings_fit(packages, watcher, jobs)


def can_be_made(package: ProvenPackage) -> bool:
    """Whether there is anything to grade."""
    with tempfile.TemporaryDirectory(prefix="roslings-") as scratch:
        try:
            package.make(Path(scratch))
        except DOES_NOT_APPLY:
            return False
    return True


def gradings_fit(
    packages: Collection[ProvenPackage],
    watcher: Watcher,
    jobs: int | None = None,
    still: Callable[[], bool] = always,
) -> Iterator[Proof]:
    """Grade packages of any labs at once, and hold the verdicts against what they must be.

    What could not be told is tried twice more, alone. Once `still()` is false no package is begun:
    there is no proof of those that are left.
    """
    with run_folder() as scratch:
        results = graded(mixed(packages), scratch, watcher, jobs, still=still)
    told = set[str]()
    for package in packages:
        if result := results.get(package.name):
            yield proof_of(package, result, told)
            told.add(result.grader_broke)


def mixed(packages: Iterable[ProvenPackage]) -> list[ProvenPackage]:
    """Each lab's packages spread over the whole: beside those that wait, others compute.

    The robot of one lab drives in its own time, and the pictures of another fill a processor.
    """
    of_lab: dict[str, list[ProvenPackage]] = {}
    for package in packages:
        of_lab.setdefault(package.lab.name, []).append(package)
    placed = [(n / len(group), each) for group in of_lab.values() for n, each in enumerate(group)]
    return [each for _, each in sorted(placed, key=itemgetter(0))]


@dataclass(frozen=True)
class _ManyLabs(GradingRequest):
    """Grade each submission for its own lab, by its own clock."""

    packages: Mapping[str, ProvenPackage] = field(default_factory=dict)

    def order(self, submission: Submission, digest: str, attempt: int) -> GradingOrder:
        """The order for one try of a submission."""
        package = self.packages[submission.name]
        own = {
            "lab": package.lab.name,
            "clock": package.clock,
            "course": package.course,
            "builds_from_cache": True,
            "soak_s": _soak_s_of(package),
        }
        return super().order(submission, digest, attempt).model_copy(update=own)


def _soak_s_of(package: ProvenPackage) -> float:
    """Nothing is left running but a mutant that shows what is found by that."""
    shows = isinstance(package, MutantPackage) and "soak_s" in package.mutant.proves
    return package.lab.card.soak_s if shows else 0.0


def graded(
    packages: Collection[ProvenPackage],
    scratch: Path,
    watcher: Watcher,
    jobs: int | None,
    *,
    book: str = "book",
    keeps_evidence: bool = False,
    entry_point: str = GRADING,
    still: Callable[[], bool] = always,
) -> dict[str, GradingResult]:
    """Package's name to what came of it; the gradebook lies in `scratch`, a run's folder."""
    submissions = [Submission(each.name, each.make(scratch / "made")) for each in packages]
    request = _ManyLabs(
        "",
        scratch,
        scratch / LOCK,
        keeps_evidence=keeps_evidence,
        entry_point=entry_point,
        packages={each.name: each for each in packages},
    )
    (scratch / book).mkdir(exist_ok=True)  # a place outside of the scratch keeps what it has
    with gradebook(scratch / book, "labs") as results:
        scheduler = Scheduler(request, results, Capacity(fixed=jobs), watcher, still)
        scheduler.run(submissions)
        left = [each for each in results.latest().values() if not each.is_conclusive]
        if any(not each.grader_broke for each in left):
            scheduler.run(submissions)
        return results.latest()


def proof_of(package: ProvenPackage, result: GradingResult, told: Collection[str] = ()) -> Proof:
    """Nothing can be said where the machine could not tell, or where nothing was graded.

    A mistake of the grader that was `told` is told no second time.
    """
    if mistake := result.grader_broke:
        text = AS_ABOVE if mistake in told else mistake.replace("\n", "\n       ")
        return Proof(package.about, text, package=package.name)
    if result.word == "inconclusive":
        unclear = _told(result, "inconclusive") or result.reason
        problem = f"not everything could be told, prove it again: {unclear}"
        return Proof(package.about, problem, is_open=True, package=package.name)
    problem = result.reason if result.word == "refused" else package.problem(result)
    return Proof(package.about, problem, package=package.name)


def failing(result: GradingResult) -> str:
    """Which checks fail or are skipped, in one line."""
    failed, skipped = _told(result, "fail"), _told(result, "skip")
    if not failed and skipped:
        return f"no check fails, and these are skipped: {skipped}"
    return f"it fails: {failed}" if failed else "it passes every check"


def _told(result: GradingResult, outcome: str) -> str:
    """The checks with an outcome, and what is said of each."""
    checks = result.verdict.checks if result.verdict else ()
    return "; ".join(
        f"{check.id} ({check.measured or check.why})"
        for check in checks
        if check.outcome == outcome
    )


def _all(names: list[str] | tuple[str, ...]) -> str:
    return ", ".join(names) or "none"
