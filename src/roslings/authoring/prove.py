"""`./roslings prove LAB`: the solution passes, the starter does not, each mutant is caught.

All are graded for real, as many at once as the machine bears, by the same path as submissions.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from roslings.batch.capacity import Capacity
from roslings.batch.gradebook import gradebook
from roslings.batch.result import Result
from roslings.batch.shift import Shift, Watcher, Wish
from roslings.batch.submissions import Submission
from roslings.course import Lab, Mutant
from roslings.course.task import is_current
from roslings.experiment.run_folder import LOCK, run_folder
from roslings.judge.sheet import dependants

SOLUTION, STARTER = "solution", "starter"


@dataclass(frozen=True)
class Proof:
    """One thing that must hold of a lab, and whether it does."""

    about: str
    problem: str = ""
    """What is wrong; empty where it holds."""
    is_open: bool = False
    """The machine could not tell."""

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


def prove(lab: Lab, watcher: Watcher, jobs: int | None = None) -> Iterator[Proof]:
    """All that must hold: what the files tell first, then what the gradings tell."""
    yield from files_fit(lab)
    yield from gradings_fit(lab, watcher, jobs)


def files_fit(lab: Lab) -> Iterator[Proof]:
    """What can be seen without running anything."""
    stale = f"bring it up to date: python -m roslings.course.task {lab.name}"
    yield Proof("task.md says what the card says", "" if is_current(lab) else stale)
    without = [check for check in lab.card.points if check not in lab.hints]
    yield Proof("each check has a hint", f"without one: {_all(without)}" if without else "")
    caught = {check for mutant in lab.mutants() for check in mutant.fails}
    unseen = [check for check in lab.card.points if check not in caught]
    problem = f"nobody has seen these fail: {_all(unseen)}" if unseen else ""
    yield Proof("each check is shown at work by a mutant", problem)


def gradings_fit(lab: Lab, watcher: Watcher, jobs: int | None) -> Iterator[Proof]:
    """Grade all of them, and hold the verdicts against what they must be."""
    mutants = {mutant.name: mutant for mutant in lab.mutants()}
    with run_folder() as scratch, gradebook(scratch, lab.name) as book:
        packages = list(_packages(lab, mutants, scratch / "made"))
        wish = Wish(lab.name, scratch, scratch / LOCK, keeps_evidence=False)
        Shift(wish, book, Capacity(fixed=jobs), watcher).run(packages)
        latest = book.latest()
    yield _solution_passes(latest[SOLUTION])
    yield _starter_fails(latest[STARTER])
    for name, mutant in mutants.items():
        yield _is_caught(lab, mutant, latest[_submission(name)])


def _packages(lab: Lab, mutants: dict[str, Mutant], folder: Path) -> Iterator[Submission]:
    yield Submission(SOLUTION, lab.solution)
    yield Submission(STARTER, lab.starter)
    for name, mutant in mutants.items():
        package = folder / name / lab.card.package
        package.parent.mkdir(parents=True)
        yield Submission(_submission(name), mutant.make(lab.solution, package).parent)


def _submission(mutant: str) -> str:
    return f"mutant {mutant}"


def _solution_passes(result: Result) -> Proof:
    about = "the solution gets 100 of 100"
    if open_ := _open(about, result):
        return open_
    if result.score == 100:
        return Proof(about)
    return Proof(about, f"{result.score:g} of 100; {_failing(result)}" if result.verdict else "")


def _starter_fails(result: Result) -> Proof:
    about = "the starter does not pass"
    problem = "it passes: who has done nothing has done the lab" if result.word == "pass" else ""
    return _open(about, result) or Proof(about, problem)


def _is_caught(lab: Lab, mutant: Mutant, result: Result) -> Proof:
    about = f"{mutant.name} fails {_all(mutant.fails)}"
    if (open_ := _open(about, result)) or result.verdict is None:
        return open_ or Proof(about, "no verdict")
    failed = {check.id: check.fault for check in result.verdict.failed()}
    skipped = {check.id for check in result.verdict.checks if check.outcome == "skip"}
    must_skip = dependants(lab, set(mutant.fails)) | set(mutant.skips)
    if set(failed) != set(mutant.fails):
        return Proof(about, _failing(result))
    if skipped != must_skip:
        return Proof(about, f"skipped: {_all(sorted(skipped))}; must be: {_all(sorted(must_skip))}")
    other = {name: failed[name] for name, kind in mutant.faults.items() if failed[name] != kind}
    return Proof(about, f"other faults: {other}" if other else "")


def _open(about: str, result: Result) -> Proof | None:
    """Nothing can be said where the machine could not tell, or where nothing was graded."""
    if result.word == "inconclusive":
        return Proof(about, "not everything could be told; prove it again", is_open=True)
    if result.word == "refused":
        return Proof(about, result.reason)
    return None


def _failing(result: Result) -> str:
    failed = [check.id for check in result.verdict.failed()] if result.verdict else []
    return f"it fails: {_all(failed)}" if failed else "it passes every check"


def _all(names: list[str] | tuple[str, ...]) -> str:
    return ", ".join(names) or "none"
