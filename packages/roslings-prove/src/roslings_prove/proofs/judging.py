"""Judge what is kept: today's graders must find in it what the packages are there to show."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

from roslings.course import Lab
from roslings.evidence import Evidence, read_json
from roslings.judge import judge
from roslings.verdict import Verdict
from roslings.workspace.normal import digest_of
from roslings_class.result import GradingResult
from roslings_prove.proofs.archives import Archives, UnreadableArchive
from roslings_prove.proofs.kept import Folder, KeptProof, Words, name_in, words_of
from roslings_prove.prove import Proof, ProvenPackage, proof_of


def judge_kept(lab: Lab, folder: Folder) -> Iterator[Proof]:
    """All that is kept of a lab: each line with its evidence, judged by what now judges."""
    lines, packages, kept = folder.lines(lab), folder.packages(lab), KeptEvidence(lab, folder)
    named = {name_in(lab, package): package for package in packages}
    for name in sorted(lines.keys() - named.keys()):
        yield Proof(f"{lab.name}: {name}", f"a line of it is kept, and it is gone. {MEND}")
    for stranger in kept.archives.strangers(lines):
        yield Proof(f"{lab.name}: {stranger}", f"evidence that no line tells of. {MEND}")
    for name, package in named.items():
        if line := lines.get(name):
            yield judged_again(package, line, kept)


MEND = "Write it anew: ./roslings prove --record LAB"


class UnlikeItsFiles(Exception):
    """A line and its evidence do not belong together."""


@dataclass(frozen=True)
class KeptEvidence:
    """What is kept of a lab: each archive is read once for all its packages."""

    lab: Lab
    folder: Folder

    @cached_property
    def archives(self) -> Archives:
        """Of the lab."""
        return self.folder.archives(self.lab)

    @cached_property
    def _states(self) -> tuple[str, ...]:
        return self.folder.states

    def of(self, line: KeptProof) -> Evidence:
        """The evidence that a line tells of. Raises UnlikeItsFiles."""
        if line.core not in self._states:
            raise UnlikeItsFiles(f"no line of measuring.jsonl tells of what measured it. {MEND}")
        evidence = self._read(line)
        if evidence.package.content != line.content or evidence.lab != self.lab.name:
            raise UnlikeItsFiles(f"its evidence is that of another package. {MEND}")
        return evidence

    def has(self, line: KeptProof) -> bool:
        """Whether the very evidence that a line tells of is there."""
        try:
            return bool(self._content(line))
        except UnlikeItsFiles:
            return False

    def _read(self, line: KeptProof) -> Evidence:
        content = self._content(line)
        try:
            return read_json(content)
        except ValueError as error:
            file = self.archives.label(line.package)
            told = f"its evidence in {file} cannot be read: {str(error)[:200]}"
            raise UnlikeItsFiles(told) from error

    def _content(self, line: KeptProof) -> bytes:
        file = self.archives.label(line.package)
        try:
            content = self.archives.evidence(line.package)
        except UnreadableArchive as error:
            raise UnlikeItsFiles(f"{file}, where its evidence is, {error}. {MEND}") from error
        if content is None:
            raise UnlikeItsFiles(f"its evidence is not there, in {file}. {MEND}")
        if digest_of(content) != line.evidence:
            raise UnlikeItsFiles(f"its evidence in {file} is not the one that was judged. {MEND}")
        return content


def judged_again(package: ProvenPackage, line: KeptProof, kept: KeptEvidence) -> Proof:
    """Whether the evidence is the one that the line tells of, and shows what it must."""
    try:
        verdict = judge(package.lab, kept.of(line))
    except UnlikeItsFiles as unlike:
        return Proof(package.about, str(unlike), package=package.name)
    proof = proof_of(package, _result(package, line, verdict))
    now = words_of(verdict)
    if not proof.holds or now == line.checks:
        return proof
    other = [
        each for each in sorted({*now, *line.checks}) if now.get(each) != line.checks.get(each)
    ]
    told = f"its line tells of another verdict in: {', '.join(other)}. {MEND}"
    return Proof(package.about, told, package=package.name)


def words_now(package: ProvenPackage, line: KeptProof, kept: KeptEvidence) -> Words | None:
    """What is judged today in kept evidence; None where that is not what it must be."""
    try:
        verdict = judge(package.lab, kept.of(line))
    except UnlikeItsFiles:
        return None
    holds = proof_of(package, _result(package, line, verdict)).holds
    return words_of(verdict) if holds else None


def _result(package: ProvenPackage, line: KeptProof, verdict: Verdict) -> GradingResult:
    return GradingResult(
        submission=package.name, digest=line.content, attempt=1, state="graded", verdict=verdict
    )
