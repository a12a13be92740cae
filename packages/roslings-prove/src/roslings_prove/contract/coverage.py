"""Which words of a card are judged, and which are not: every one has its proof.

A word is judged where the unchanged solution loses a point by a card that says another one. It is
judged, too, where a mutant that fails names it (`proves:`). What is not judged stands under
`not_judged`.
"""

from __future__ import annotations

import shutil
from collections.abc import Collection, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import yaml

from roslings.course import Lab
from roslings.course.files import read_tree
from roslings.course.grader import Clock
from roslings.experiment.run_folder import run_folder
from roslings_changes.card_words import CardWord, words_of
from roslings_class.gradebook import gradebook
from roslings_class.result import GradingResult
from roslings_class.scheduler import Watcher
from roslings_prove.contract.changes import CardChange, changes_of
from roslings_prove.contract.promises import PromiseAccount, not_judged_words, prove_promises
from roslings_prove.contract.reworded import ENTRY_POINT, NOTE, WantedVerdict
from roslings_prove.prove import Proof, Solution, graded, proof_of

SEEN = "seen"
MADE = shutil.ignore_patterns("solution", "starter", "mutants")


@dataclass(frozen=True)
class Coverage:
    """How many words of a lab's card are judged, of those that are to be."""

    lab: str
    judged: int
    words: int
    on_purpose: int = 0
    """So many more are not judged, and the task says so."""

    @property
    def line(self) -> str:
        """In words."""
        part = self.judged / self.words if self.words else 1.0
        more = f"; {self.on_purpose} more not, on purpose" if self.on_purpose else ""
        return (
            f"{self.lab}: {self.judged} of {self.words} words of the card are judged"
            f" ({part:.0%}){more}"
        )


@dataclass(frozen=True)
class Reworded:
    """The solution, judged by a card with one change."""

    lab: Lab
    change: CardChange
    course: Path
    """Where that card lies."""
    clock: Clock = "auto"

    @property
    def name(self) -> str:
        """A change of one word."""
        return f"{self.lab.name}: {self.change.word.name}, {self.change.about}"

    @property
    def about(self) -> str:
        """What must come of it."""
        ends = "does not pass" if self.change.must_fail else "passes"
        return f"{self.name}: the solution {ends}"

    def make(self, folder: Path) -> Path:
        """It is there."""
        return self.lab.solution

    def problem(self, result: GradingResult) -> str:
        """That nothing noticed the change, or that something did which should not."""
        failed = failed_in(result)
        if self.change.must_fail:
            return "" if failed else f"with `{self.change.about}` the solution passes as before"
        if failed:
            return f"with `{self.change.about}` the solution fails: {', '.join(failed)}"
        return ""


def failed_in(result: GradingResult) -> list[str]:
    """The checks that fail."""
    checks = result.verdict.checks if result.verdict else ()
    return [check.id for check in checks if check.outcome == "fail"]


def contract_is_told(lab: Lab) -> Iterator[Proof | PromiseAccount]:
    """What can be seen without running anything.

    It is a proof for each sentence of the task. Of each word that a mutant names it tells whether
    the card has it.
    """
    yield from prove_promises(lab)
    known = {word.place for word in words_of(lab.folder / "card.yaml")}
    yield from _strange(lab, mutants_by_word(lab).keys() - known)


def prove_contract(
    labs: Sequence[Lab], watcher: Watcher, jobs: int | None = None
) -> Iterator[Proof | Coverage]:
    """A proof for each word of each card, and how many hold."""
    with run_folder() as scratch:
        seen = _evidence_of([Solution(lab) for lab in labs], scratch, watcher, jobs)
        unseen = [lab for lab in labs if lab.name not in seen]
        changed = [
            each
            for lab in labs
            if lab.name in seen
            for each in _changed(lab, seen[lab.name], scratch / "courses" / lab.name)
        ]
        results = graded(changed, scratch, watcher, jobs, book="reworded", entry_point=ENTRY_POINT)
    for lab in unseen:
        problem = "it must get 100 of 100 before its card can be proven"
        yield Proof(f"{lab.name}: the solution is measured", problem)
    for lab in labs:
        if lab.name in seen:
            yield from _proofs(lab, [each for each in changed if each.lab == lab], results)


def _evidence_of(
    solutions: Collection[Solution], scratch: Path, watcher: Watcher, jobs: int | None
) -> dict[str, Path]:
    """Lab to what was seen of its solution, packed; those that got the full score."""
    results = graded(solutions, scratch, watcher, jobs, book=SEEN, keeps_evidence=True)
    found = {}
    with gradebook(scratch / SEEN, "labs") as book:
        for solution in solutions:
            result = results[solution.name]
            if result.score == 100 and (packed := book.evidence(result)):
                found[solution.lab.name] = scratch / SEEN / f"{solution.lab.name}.evidence"
                found[solution.lab.name].write_bytes(packed)
    return found


def _changed(lab: Lab, seen: Path, folder: Path) -> Iterator[Reworded]:
    """A course for each change of the lab's card."""
    tree = read_tree(lab.folder / "card.yaml")
    changes = [each for word in _to_be_judged(lab) for each in changes_of(word)]
    for number, change in enumerate(changes):
        course = folder / f"{number}"
        shutil.copytree(lab.folder, course / "labs" / lab.name, ignore=MADE)
        (course / "graders").mkdir()
        grader = change.grader(lab.grader.read_text("utf-8"))
        (course / "graders" / lab.grader.name).write_text(grader, "utf-8")
        if lab.beside.is_dir():
            (course / "graders" / lab.beside.name).symlink_to(lab.beside)
        card = yaml.safe_dump(change.apply(tree), allow_unicode=True, sort_keys=False)
        (course / "labs" / lab.name / "card.yaml").write_text(card, "utf-8")
        wanted = WantedVerdict(seen=seen, must_fail=change.must_fail)
        (course / NOTE).write_text(wanted.model_dump_json(), "utf-8")
        yield Reworded(lab, change, course)


def _proofs(
    lab: Lab, changed: Collection[Reworded], results: Mapping[str, GradingResult]
) -> Iterator[Proof | Coverage]:
    words = _to_be_judged(lab)
    all_words = words_of(lab.folder / "card.yaml")
    by_mutants = mutants_by_word(lab)
    proofs = []
    for word in words:
        own = [(each, results[each.name]) for each in changed if each.change.word == word]
        proofs.append(_proof(lab, word, own, by_mutants.get(word.place, [])))
    yield from proofs
    hold = sum(proof.holds for proof in proofs)
    yield Coverage(lab.name, hold, len(words), len(all_words) - len(words))


def _to_be_judged(lab: Lab) -> list[CardWord]:
    """Without those that the task says are not."""
    free = not_judged_words(lab.folder)
    return [word for word in words_of(lab.folder / "card.yaml") if word.place not in free]


def mutants_by_word(lab: Lab) -> dict[str, list[str]]:
    """Place of a word to the mutants that name it."""
    found: dict[str, list[str]] = {}
    for mutant in lab.mutants():
        for word in mutant.proves:
            found.setdefault(word, []).append(mutant.name)
    return found


def _proof(
    lab: Lab, word: CardWord, own: Sequence[tuple[Reworded, GradingResult]], mutants: Sequence[str]
) -> Proof:
    """By the mutants that name the word, else by all of its changes."""
    about = f"{lab.name}: card.yaml:{word.line}: {word.name}"
    if mutants:
        return Proof(f"{about} is judged: mutant {', '.join(mutants)}")
    broken = [result.reason for _, result in own if result.state == "broken"]
    if broken or not own:
        why = f"another word breaks the grader ({broken[0]}), and " if broken else ""
        return Proof(f"{about} is judged", f"{why}no mutant names it (`proves: [{word.place}]`)")
    proofs = [proof_of(each, result) for each, result in own if result.state != "refused"]
    if wrong := [proof for proof in proofs if not proof.holds]:
        is_open = all(proof.is_open for proof in wrong)
        return Proof(f"{about} is judged", wrong[0].problem, is_open)
    noticed = {
        check for each, result in own if each.change.must_fail for check in failed_in(result)
    }
    return Proof(f"{about} is judged: {', '.join(sorted(noticed)) or 'nothing else is taken'}")


def _strange(lab: Lab, names: Collection[str]) -> Iterator[Proof]:
    """Mutants name words as the card has them."""
    for name in sorted(names):
        about = f"{lab.name}: a mutant proves {name}"
        yield Proof(about, "the card says nothing at that place")
