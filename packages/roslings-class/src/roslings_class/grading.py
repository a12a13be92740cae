"""Grade one submission, in a process of its own: unpack, measure, judge, answer."""

from __future__ import annotations

import lzma
import os
import signal
import time
import zlib
from dataclasses import dataclass
from pathlib import Path
from types import FrameType

from pydantic import BaseModel

from roslings import course
from roslings.arena import NoFreeDomain, NoFreeUser
from roslings.capabilities.rooms.seeds import SECRET
from roslings.course import Lab
from roslings.evidence import Evidence, PackageSeen, read_json, thin_json
from roslings.experiment import MeasuringFailed, MeasuringOptions, measure
from roslings.experiment.soaking import SOAKING
from roslings.grading.checking import mistakes_told
from roslings.grading.saving import required_rates
from roslings.hand_in.errors import HandInRefused
from roslings.hand_in.unpack import in_its_own_words, package_in
from roslings.judge.grader_mistakes import GraderBroke
from roslings.judge.loaded import judge_for
from roslings.report.html.intervals import watched
from roslings.report.whole_file import write_whole
from roslings.verdict import Verdict
from roslings.workspace.bounded import Bookmark
from roslings.workspace.errors import MachineTrouble, WorkspaceError
from roslings.workspace.inspect import read_bounded, read_package
from roslings_class.fingerprints import Fingerprint, fingerprint
from roslings_class.result import GradingOrder, GradingResult, broken
from roslings_class.unusual import unusual
from roslings_class.version import version_of

NO_FINGERPRINT = Fingerprint("", frozenset())


class GradingStopped(BaseException):
    """The command wants this process to end: leave every block, and end what it started."""


@dataclass(frozen=True)
class MeasuredSubmission:
    """A verdict, the evidence for it, and the code's fingerprint."""

    verdict: Verdict
    evidence: Evidence
    fingerprint: Fingerprint


def main(order: GradingOrder) -> None:
    """The process's whole life."""
    signal.signal(signal.SIGTERM, _stop)
    if order.course:
        os.environ["ROSLINGS_COURSE"] = str(order.course)
    if order.room_secret:
        os.environ[SECRET] = order.room_secret
    answer(order)


def _stop(number: int, frame: FrameType | None) -> None:
    raise GradingStopped


def answer(order: GradingOrder) -> GradingResult:
    """Grade, and put the answer into the order's room: evidence first, then the result, whole."""
    result, evidence = grade(order)
    if evidence and order.keeps_evidence:
        order.evidence.write_bytes(packed(evidence))
    put(result, order)
    return result


def put(result: GradingResult, order: GradingOrder) -> None:
    """The result into the order's room, where the command looks for it."""
    write_whole(order.answer, result.model_dump_json(by_alias=True).encode())


QUICKLY, THOROUGHLY = 0, 6
"""Presets of xz: what every grading keeps, and what is kept for years in a repository."""
_XZ = b"\xfd7zXZ\0"


def packed(evidence: Evidence, preset: int = QUICKLY) -> bytes:
    """The evidence as the gradebook keeps it: in columns, packed by xz."""
    return lzma.compress(thin_json(evidence), preset=preset)


def unpacked(content: bytes) -> Evidence:
    """The same evidence; gradebooks of before columns hold it packed by zlib."""
    unpack = lzma.decompress if content.startswith(_XZ) else zlib.decompress
    return read_json(unpack(content))


def grade(order: GradingOrder) -> tuple[GradingResult, Evidence | None]:
    """Grade one submission; what goes wrong with it is a result as well."""
    began_s = time.monotonic()
    try:
        lab = course.lab(order.lab, order.hidden)
        found = _measured(order, lab)
    except HandInRefused as refusal:
        return _refused(order, refusal, time.monotonic() - began_s), None
    except (MeasuringFailed, MachineTrouble, NoFreeDomain, NoFreeUser) as trouble:
        return broken(order, str(trouble), time.monotonic() - began_s), None
    except GraderBroke as mistake:
        seconds = time.monotonic() - began_s
        return broken(order, str(mistake), seconds, by_the_grader=True), None
    result = GradingResult(
        submission=order.submission,
        digest=order.digest,
        attempt=order.attempt,
        state="graded",
        verdict=found.verdict,
        seconds=time.monotonic() - began_s,
        lab_version=version_of(lab),
        source=found.fingerprint.whole,
        marks=tuple(sorted(found.fingerprint.marks)),
        rates=rates_of(found.evidence, lab),
        unusual=unusual(found.evidence),
        whose=order.whose,
        words=order.words,
    )
    return result, found.evidence


def _measured(order: GradingOrder, lab: Lab) -> MeasuredSubmission:
    """The way of `check`: read, measure, judge."""
    began_ns = time.monotonic_ns()
    package = package_in(order.path, lab.card.package, order.room)
    read = _read(package, lab, order)
    files = read.seen
    files.handed_in_as = order.handed_in_as
    choices = MeasuringOptions(
        order.seed,
        order.clock,
        hidden=order.hidden,
        builds=order.builds,
        builds_from_cache=order.builds_from_cache,
        strangers=order.strangers,
        for_others=order.strangers,
        soak_s=order.soak_s,
    )

    def note(step: str) -> None:
        if step == SOAKING:
            order.soaking.touch()

    with judge_for(lab, order.strangers) as judge:
        with mistakes_told(lab):
            evidence = measure(lab.name, package, files, choices, note)
        verdict = judge(evidence, began_ns)
    return MeasuredSubmission(verdict, evidence, Fingerprint(read.whole, frozenset(read.marks)))


class Read(BaseModel):
    """What stands in a package's files; `whole` and `marks` are of its fingerprint."""

    seen: PackageSeen
    whole: str
    marks: list[int]


def _read(package: Path, lab: Lab, order: GradingOrder) -> Read:
    """All that is read of it, by one child.

    Raises HandInRefused, and what has to do with the disk.
    """

    def read(bookmark: Bookmark) -> str:
        seen = read_package(package, lab.card, bookmark)
        print_of_it = _fingerprint(package, bookmark)
        found = Read(seen=seen, whole=print_of_it.whole, marks=sorted(print_of_it.marks))
        return found.model_dump_json()

    try:
        return Read.model_validate_json(read_bounded(package, read))
    except MachineTrouble:
        raise
    except WorkspaceError as error:
        raise in_its_own_words(error, (order.path, order.room)) from error


def _fingerprint(package: Path, bookmark: Bookmark) -> Fingerprint:
    """A package that cannot be tokenised is graded all the same."""
    try:
        return fingerprint(package, bookmark.put)
    except (OSError, RecursionError):
        return NO_FINGERPRINT


def rates_of(evidence: Evidence, lab: Lab) -> dict[str, float]:
    """Topic of the card to the rate that was measured, in Hz; the first experiment counts."""
    found: dict[str, float] = {}
    for each in watched(evidence, required_rates(lab)):
        if each.asked and each.rate:
            found.setdefault(each.asked.topic, round(each.rate.hz, 4))
    return found


def _refused(order: GradingOrder, refusal: HandInRefused, seconds: float) -> GradingResult:
    return GradingResult(
        submission=order.submission,
        digest=order.digest,
        attempt=order.attempt,
        state="refused",
        reason=refusal.reason,
        next_step=refusal.next_step,
        seconds=seconds,
        whose=order.whose,
        words=order.words,
    )
