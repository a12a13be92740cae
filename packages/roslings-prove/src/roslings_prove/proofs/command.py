"""`./roslings prove --kept`, `--record`, `--due`: what is judged, measured and told."""

from __future__ import annotations

import os
import subprocess
import time
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from itertools import chain
from multiprocessing import get_context
from pathlib import Path
from typing import Literal

from pydantic import BaseModel

from roslings.course import Lab, all_labs, root
from roslings.course import lab as lab_named
from roslings_class.scheduler import Watcher
from roslings_prove.proofs.digests import measuring
from roslings_prove.proofs.due import Due, Proofs, ProofStanding
from roslings_prove.proofs.judging import judge_kept
from roslings_prove.proofs.kept import kept_here
from roslings_prove.proofs.record import CountLine, MeasuredPackage, ProofRecorder, measured
from roslings_prove.prove import HasLine, Proof, ProvenPackage

UNTIL = "ROSLINGS_MUTANTS_UNTIL"
"""Seconds since 1970: `.ci/run` says how long it has."""


def labs_or_all(names: Sequence[str]) -> list[Lab]:
    """The labs that were named; without a name all of the course."""
    return [lab_named(name) for name in dict.fromkeys(names)] if names else all_labs()


def kept(labs: Sequence[Lab]) -> Iterator[HasLine]:
    """Judge all that is kept, and say what is stale."""
    yield from judged(labs)
    yield from told_stale(_proofs(labs).stale())


def judged(labs: Sequence[Lab]) -> Iterator[Proof]:
    """All kept proofs, on all processors."""
    names = [lab.name for lab in labs]
    with ProcessPoolExecutor(os.cpu_count(), get_context("fork")) as pool:
        yield from chain.from_iterable(pool.map(_judged, names))


def _judged(name: str) -> list[Proof]:
    return list(judge_kept(lab_named(name), kept_here()))


def told_stale(found: Sequence[ProofStanding]) -> Iterator[CountLine]:
    """How many of each lab, and why."""
    whose = Counter((each.package.lab.name, each.stale) for each in found)
    for (lab, why), number in sorted(whose.items()):
        yield CountLine(f"{lab}: {number} to be measured anew: {why}")
    if found:
        yield CountLine("./roslings prove --record measures them, and writes their proofs.")


def recorded(
    labs: Sequence[Lab], watcher: Watcher, jobs: int | None, *, due: bool = False
) -> Iterator[HasLine]:
    """Measure what is stale, or all that is due, and write it down."""
    proofs, before = _proofs(labs), kept_here().bytes
    recorder = ProofRecorder(proofs.folder, proofs.measuring)
    yield from recorder.forget_dead_kills(labs)
    recorder.judge_anew(labs)
    wanted = _due(proofs) if due else [each.package for each in proofs.stale()]
    yield from recorder.keep(measured(wanted, watcher, jobs))
    after = proofs.folder.bytes
    yield CountLine(f"{after - before:+,} bytes; {after:,} bytes are kept in all")


class DueOutcome(BaseModel):
    """One line of the file that `--told` names: a package that was due, and what came of it."""

    package: str
    why: str
    outcome: Literal["passed", "failed", "unclear", "unmeasured"]
    """`unclear` where it could not be told; `unmeasured` where no time was left for it."""


def due(
    labs: Sequence[Lab], watcher: Watcher, jobs: int | None, file: Path | None = None
) -> Iterator[HasLine]:
    """Measure all that is due, as the gate does, and write no proof.

    What no time was left for is wrong: what is due is never let through unmeasured.
    `file` gets a line of JSON for each package, as `DueOutcome` has it.
    """
    asked = _proofs(labs).due(newest_commit())
    found = {
        each.package.name: each for each in measured(_packages(asked), watcher, jobs, _time_is_left)
    }
    proofs = {each.package.name: _proof_of(each.package, found) for each in asked}
    if file:
        answers = [_answer(each, found.get(each.package.name)) for each in asked]
        file.write_text("".join(f"{each.model_dump_json()}\n" for each in answers), "utf-8")
    yield from proofs.values()
    yield from _told_due(asked, found)


def _answer(each: Due, found: MeasuredPackage | None) -> DueOutcome:
    name = each.package.name
    if found is None:
        return DueOutcome(package=name, why=each.why, outcome="unmeasured")
    if found.proof.holds:
        return DueOutcome(package=name, why=each.why, outcome="passed")
    unclear = found.proof.is_open
    return DueOutcome(package=name, why=each.why, outcome="unclear" if unclear else "failed")


def _proof_of(package: ProvenPackage, found: dict[str, MeasuredPackage]) -> Proof:
    if package.name in found:
        return found[package.name].proof
    problem = "it is due, and no time was left to measure it. ./roslings prove --record --due does"
    return Proof(package.about, problem, package=package.name)


def _told_due(asked: Sequence[Due], found: dict[str, MeasuredPackage]) -> Iterator[CountLine]:
    whose = Counter(each.why for each in asked)
    done = Counter(each.why for each in asked if each.package.name in found)
    for why, number in whose.items():
        yield CountLine(f"measured: {done[why]} of {number}, {why}")


def _due(proofs: Proofs) -> list[ProvenPackage]:
    return _packages(proofs.due(newest_commit()))


def _packages(asked: Iterable[Due]) -> list[ProvenPackage]:
    return [each.package for each in asked]


def _proofs(labs: Sequence[Lab]) -> Proofs:
    return Proofs(labs, kept_here(), measuring())


def _time_is_left() -> bool:
    return time.time() < float(os.environ.get(UNTIL, "inf"))


def newest_commit() -> str:
    """What git calls it; nothing where there is no git."""
    words = ["git", "-C", str(root()), "rev-parse", "HEAD"]
    return subprocess.run(words, capture_output=True, text=True, check=False).stdout.strip()
