"""Measure packages for real; what shows what it must can be kept.

A few are measured at a time, and what they showed is written before the next ones begin. Who ends
the command keeps what was done.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field

from roslings.course import Lab
from roslings.evidence import Evidence, thin_json
from roslings.experiment.run_folder import run_folder
from roslings.judge import judge
from roslings.workspace.normal import digest_of
from roslings_class.gradebook import gradebook
from roslings_class.grading import unpacked
from roslings_class.scheduler import Watcher, always
from roslings_prove.anonymous import for_judging, without_machine
from roslings_prove.proofs.archives import ArchiveTooLarge
from roslings_prove.proofs.digests import MeasuringCode, card_digest
from roslings_prove.proofs.judging import KeptEvidence, words_now
from roslings_prove.proofs.kept import Folder, KeptProof, name_in, words_of
from roslings_prove.proofs.kills import kills_in, write_kills
from roslings_prove.prove import Proof, ProvenPackage, graded, mixed, proof_of

AT_A_TIME = 16


@dataclass(frozen=True)
class CountLine:
    """Something counted."""

    text: str

    @property
    def line(self) -> str:
        """It in words."""
        return self.text


BOOK = "book"


@dataclass(frozen=True)
class MeasuredPackage:
    """A package that was graded for real, whether it shows what it must, and what was seen."""

    package: ProvenPackage
    proof: Proof
    evidence: Evidence | None
    """None where the package was refused before anything was run."""


def measured(
    packages: Iterable[ProvenPackage],
    watcher: Watcher,
    jobs: int | None = None,
    still: Callable[[], bool] = always,
) -> Iterator[MeasuredPackage]:
    """Grade packages; what is wrong beside others is tried once more, alone.

    Once `still()` is false no package is begun: those that are left are not among the results.
    """
    waiting = mixed(packages)
    while waiting and still():
        few, waiting = waiting[:AT_A_TIME], waiting[AT_A_TIME:]
        found = list(_graded(few, watcher, jobs, still))
        doubtful = [each.package for each in found if not each.proof.holds]
        again = {each.package.name: each for each in _graded(doubtful, watcher, 1, always)}
        yield from (again.get(each.package.name, each) for each in found)


def _graded(
    packages: Sequence[ProvenPackage],
    watcher: Watcher,
    jobs: int | None,
    still: Callable[[], bool],
) -> Iterator[MeasuredPackage]:
    if not packages:
        return
    with run_folder() as scratch:
        results = graded(
            packages, scratch, watcher, jobs, book=BOOK, keeps_evidence=True, still=still
        )
        with gradebook(scratch / BOOK, "labs") as book:
            for package in packages:
                if result := results.get(package.name):
                    content = book.evidence(result)
                    seen = unpacked(content) if content else None
                    yield MeasuredPackage(package, proof_of(package, result), seen)


@dataclass(frozen=True)
class ProofRecorder:
    """Writes proofs into their folder, and the state of what measured them."""

    folder: Folder
    measuring: MeasuringCode
    _orders: dict[str, list[str]] = field(default_factory=dict)

    def keep(self, found: Iterable[MeasuredPackage]) -> Iterator[Proof]:
        """Write down what holds; of each package, whether it does."""
        for each in found:
            yield each.proof
            if each.proof.holds and each.evidence:
                yield from self._put(each.package, each.evidence)

    def _put(self, package: ProvenPackage, evidence: Evidence) -> Iterator[Proof]:
        lab, kept = package.lab, for_judging(without_machine(evidence))
        name, content = name_in(lab, package), thin_json(kept)
        line = KeptProof(
            package=name,
            content=kept.package.content,
            card=card_digest(lab),
            experiments=self.measuring.experiments(lab),
            core=self.measuring.core,
            evidence=digest_of(content),
            checks=words_of(judge(lab, kept)),
        )
        self.folder.note_state(self.measuring.core)
        try:
            self.folder.archives(lab).put(name, content)
        except ArchiveTooLarge as error:
            yield Proof(package.about, f"its evidence is not kept: {error}")
        else:
            self.write(lab, {**self.folder.lines(lab), name: line})

    def write(self, lab: Lab, lines: Mapping[str, KeptProof]) -> None:
        """The lines of a lab, in the order of its packages; what is gone from the lab goes."""
        if lab.name not in self._orders:  # all files of a lab's mutants are read for it
            self._orders[lab.name] = [name_in(lab, each) for each in self.folder.packages(lab)]
        self.folder.write(lab, lines, self._orders[lab.name])

    def judge_anew(self, labs: Iterable[Lab]) -> None:
        """Write what is judged today into lines whose evidence shows what it must.

        A line whose evidence is not there goes: its package counts as never measured.
        """
        for lab in labs:
            kept = KeptEvidence(lab, self.folder)
            lines = {n: each for n, each in self.folder.lines(lab).items() if kept.has(each)}
            packages = {name_in(lab, each): each for each in self.folder.packages(lab)}
            for name in lines.keys() & packages.keys():
                if now := words_now(packages[name], lines[name], kept):
                    lines[name] = lines[name].model_copy(update={"checks": now})
            self.write(lab, lines)

    def forget_dead_kills(self, labs: Iterable[Lab]) -> Iterator[CountLine]:
        """A kill is none once the solution has its line no longer."""
        for lab in labs:
            known = kills_in(self.folder.path, lab)
            alive = [each for each in known if each.applies(lab)]
            if dead := len(known) - len(alive):
                write_kills(self.folder.path, lab, alive)
                yield CountLine(
                    f"{lab.name}: {dead} of its known kills fit the solution no longer, and go."
                    f" ./roslings prove {lab.name} --generated --keep-kills names others."
                )
