"""Judge what is kept: today's graders must find in it what the packages are there to show."""

from __future__ import annotations

import lzma
from collections.abc import Iterator
from pathlib import Path

from roslings.course import Lab
from roslings.evidence import Evidence
from roslings.judge import judge
from roslings.verdict import Verdict
from roslings_class.grading import unpacked
from roslings_class.result import Result
from roslings_prove.proofs.kept import (
    LARGEST_BYTES,
    Folder,
    KeptProof,
    Words,
    digest_of_evidence,
    name_in,
    words_of,
)
from roslings_prove.prove import Package, Proof, proof_of


def judge_kept(lab: Lab, folder: Folder) -> Iterator[Proof]:
    """All that is kept of a lab: each line with its file, judged by what now judges."""
    lines, packages = folder.lines(lab), folder.packages(lab)
    named = {name_in(lab, package): package for package in packages}
    for name in sorted(lines.keys() - named.keys()):
        yield Proof(f"{lab.name}: {name}", f"a line of it is kept, and it is gone. {MEND}")
    strangers = folder.files(lab) - {folder.evidence(lab, name) for name in lines}
    for file in sorted(strangers):
        yield Proof(f"{lab.name}: {file.name}", f"evidence that no line tells of. {MEND}")
    for name, package in named.items():
        if line := lines.get(name):
            yield judged_again(package, line, folder)


MEND = "Write it anew: ./roslings prove --record LAB"


def judged_again(package: Package, line: KeptProof, folder: Folder) -> Proof:
    """Whether the evidence is the one that the line tells of, and shows what it must."""
    try:
        verdict = judge(package.lab, evidence_of(package.lab, line, folder))
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


def words_now(package: Package, line: KeptProof, folder: Folder) -> Words | None:
    """What is judged today in kept evidence; None where that is not what it must be."""
    try:
        verdict = judge(package.lab, evidence_of(package.lab, line, folder))
    except UnlikeItsFiles:
        return None
    holds = proof_of(package, _result(package, line, verdict)).holds
    return words_of(verdict) if holds else None


def _result(package: Package, line: KeptProof, verdict: Verdict) -> Result:
    return Result(
        submission=package.name, digest=line.content, attempt=1, state="graded", verdict=verdict
    )


class UnlikeItsFiles(Exception):
    """A line and its evidence do not belong together."""


def evidence_of(lab: Lab, line: KeptProof, folder: Folder) -> Evidence:
    """The evidence that a line tells of. Raises UnlikeItsFiles."""
    if line.core not in folder.states:
        raise UnlikeItsFiles(f"no line of measuring.jsonl tells of what measured it. {MEND}")
    evidence = _read(folder.evidence(lab, line.package), line)
    if evidence.package.content != line.content or evidence.lab != lab.name:
        raise UnlikeItsFiles(f"its evidence is that of another package. {MEND}")
    return evidence


def _read(file: Path, line: KeptProof) -> Evidence:
    if not file.is_file():
        raise UnlikeItsFiles(f"its evidence is not there. {MEND}")
    if file.stat().st_size > LARGEST_BYTES:
        raise UnlikeItsFiles(f"its evidence has more than {LARGEST_BYTES:,} bytes")
    if digest_of_evidence(file) != line.evidence:
        raise UnlikeItsFiles(f"its evidence is not the one that was judged. {MEND}")
    try:
        return unpacked(file.read_bytes())
    except (lzma.LZMAError, ValueError) as error:
        raise UnlikeItsFiles(f"its evidence cannot be read: {str(error)[:200]}") from error
