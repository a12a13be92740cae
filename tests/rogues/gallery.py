"""Grade rogues, each beside an honest neighbour, and write down what every witness saw."""

from __future__ import annotations

import random
import re
import shutil
import time
from collections.abc import Iterable, Sequence

from parcels import Parcel
from pydantic import BaseModel
from rogue import LAB, Attempt, Truth, apply
from stage import (
    LONG_S,
    Stage,
    abandoned_groups,
    adopting,
    files_in,
    known,
    listening,
    living,
    quiet,
    robot,
    said,
    signs_of,
    stage,
)

from ros2_on_pip.domain_lease import leased_domain
from roslings.course import Edit
from roslings.judge.sheet import dependants
from roslings.verdict import CheckResult
from roslings_class.result import GradingResult
from roslings_prove.proofs.command import newest_commit

Entry = Attempt | Parcel

A_FEW = 3
"""Rogues that are graded in one go where the time may not be enough for all."""


class Seen(BaseModel):
    """What came of one rogue and its neighbour."""

    word: str
    reason: str = ""
    score: float | None = None
    outcomes: dict[str, str] = {}
    """Check to outcome."""
    faults: dict[str, str] = {}
    reached: list[str] = []
    """Its own words."""
    held_off: list[str] = []
    last_words: list[str] = []
    """Of the build, or of its last process."""
    neighbour: Seen | None = None
    """The honest one; it has none itself."""
    seconds: float = 0.0


class Gallery(BaseModel):
    """What came of all, and what was seen outside."""

    seen: dict[str, Seen]
    status: int
    words: str
    """Of the command."""
    running: dict[int, str]
    """What still ran in the end."""
    left: list[str]
    """Files that were not there before."""
    changed: list[str]
    """What is the instructor's, and is not as it was."""
    heard: list[str]
    """On the machine's network, and in its ROS domain."""

    def and_also(self, other: Gallery) -> Gallery:
        """Both, as if they had been graded in one go."""
        return Gallery(
            seen={**self.seen, **other.seen},
            status=max(self.status, other.status),
            words=self.words + other.words,
            running={**self.running, **other.running},
            left=[*self.left, *other.left],
            changed=[*self.changed, *other.changed],
            heard=[*self.heard, *other.heard],
        )


def hang(
    entries: Sequence[Entry], ordinary: bool, jobs: int, without: Sequence[Edit] = ()
) -> Gallery:
    """Grade all of them in one go, `without` walls whose code the edits take away."""
    with stage(ordinary) as made, leased_domain() as domain:
        for edit in without:
            apply(edit, made.course / edit.file)
        with listening(made.mark, made.home) as listener, robot(domain, made.folder) as heard:
            for entry in entries:
                _hand_in(entry, made, listener.port, domain)
            made.give_away()
            gallery = _grade(entries, made, jobs)
        gallery.heard = [*listener.heard, *heard]
        return gallery


def hang_in_turns(entries: Sequence[Entry], ordinary: bool, jobs: int, until_s: float) -> Gallery:
    """As `hang`, some at a time; after the moment `until_s` of time.time() no more begin."""
    whole = Gallery(seen={}, status=0, words="", running={}, left=[], changed=[], heard=[])
    for some in turns(entries, seed=newest_commit()):
        if time.time() >= until_s:
            break
        whole = whole.and_also(hang(some, ordinary, jobs))
    return whole


def turns(entries: Sequence[Entry], seed: str) -> list[list[Entry]]:
    """A few at a time, in an order of chance: all places of a rogue, which share a neighbour.

    Where there is no time for all, those that are left out are others the next time.
    """
    of_one: dict[str, list[Entry]] = {}
    for entry in entries:
        of_one.setdefault(next_to(entry), []).append(entry)
    names = sorted(of_one)
    random.Random(seed).shuffle(names)
    some = [names[begin : begin + A_FEW] for begin in range(0, len(names), A_FEW)]
    return [[entry for name in few for entry in of_one[name]] for few in some]


def _hand_in(entry: Entry, made: Stage, port: int, domain: int) -> None:
    """The rogue, and the honest package after it."""
    place = made.submissions / entry.name
    if isinstance(entry, Attempt):
        entry.make(place / LAB.card.package, known(made, token_of(made, entry), port, domain))
    else:
        entry.make(place.with_name(place.name + entry.ending))
    honest = made.submissions / next_to(entry) / LAB.card.package
    if not honest.exists():
        shutil.copytree(LAB.solution, honest)


def next_to(entry: Entry) -> str:
    """The honest package that is graded after it, one for all places of a rogue.

    Parcels of one kind, which run nothing, share one too. Submissions are graded by name, and `~`
    comes after all letters.
    """
    if isinstance(entry, Attempt):
        return f"{entry.rogue.name}~next"
    return f"{entry.name.partition('_')[0]}_~next"


def token_of(made: Stage, entry: Entry) -> str:
    """Names every file that a rogue leaves."""
    return f"{made.mark}.{entry.name}"


def _grade(entries: Sequence[Entry], made: Stage, jobs: int) -> Gallery:
    mine = (made.home, made.course, made.submissions)
    before = {folder: files_in(folder) for folder in mine}
    groups = abandoned_groups()
    with adopting() as children:
        command = made.begin("--jobs", str(jobs), "--hidden", str(made.hidden))
        words, _ = command.communicate(timeout=LONG_S)
        running = quiet(lambda: {**children(), **living(made.mark)})
    changed = [
        each.rpartition(" ")[0] for folder in mine for each in files_in(folder) ^ before[folder]
    ]
    left = [
        *map(str, made.scratch.iterdir()),
        *signs_of(made.mark),
        *sorted(abandoned_groups() - groups),
    ]
    seen = {entry.name: _seen(entry, made) for entry in entries}
    return Gallery(
        seen=seen,
        status=command.returncode,
        words=words,
        running=running,
        left=left,
        changed=changed,
        heard=[],
    )


def _seen(entry: Entry, made: Stage) -> Seen:
    results = made.results()
    neighbour = seen_of(results[next_to(entry)], made)
    return seen_of(results[entry.name], made).model_copy(update={"neighbour": neighbour})


def seen_of(result: GradingResult, made: Stage) -> Seen:
    """What stands in the gradebook of one submission."""
    evidence = made.evidence(result)
    lines = list(said(evidence)) if evidence else []
    checks = result.verdict.checks if result.verdict else ()
    return Seen(
        word=result.word,
        reason=result.reason,
        score=result.score,
        outcomes={check.id: check.outcome for check in checks},
        faults={
            check.id: told(check) for check in checks if check.outcome in ("fail", "inconclusive")
        },
        reached=sorted({line for line in lines if line.startswith("GOT")}),
        held_off=sorted({line for line in lines if line.startswith("held off")})[:40],
        last_words=lines[-12:],
        seconds=result.seconds,
    )


def told(check: CheckResult) -> str:
    """What the verdict says of a check, and the node's last lines."""
    return "\n".join((f"{check.fault}: {check.measured or check.why}", *check.log))


def untrue(truth: Truth, seen: Seen) -> list[str]:
    """What of the verdict is not true; empty where all is."""
    if truth.refused:
        fits = seen.word == "refused" and re.search(truth.refused, seen.reason)
        return (
            [] if fits else [f"it was to be refused ({truth.refused}): {seen.word} {seen.reason}"]
        )
    if truth.score and seen.score != truth.score:
        return [f"its score was to be {truth.score}: {seen.score} {seen.reason} {seen.faults}"]
    return list(_untrue_checks(truth, seen))


def _untrue_checks(truth: Truth, seen: Seen) -> Iterable[str]:
    failed, skipped, unclear = (
        {check for check, outcome in seen.outcomes.items() if outcome == word}
        for word in ("fail", "skip", "inconclusive")
    )
    free = unclear | dependants(LAB, unclear) if truth.may_be_unclear else set()
    if not seen.outcomes:
        yield f"there is no verdict: {seen.word} {seen.reason}"
    elif missing := set(truth.fails) - failed - free:
        yield f"did not fail: {missing}"
    if more := unclear - free - set(truth.unclear):
        yield f"inconclusive: {[seen.faults[check] for check in more]}"
    if more := failed - set(truth.fails) - set(truth.may_fail):
        yield f"failed as well: { {check: seen.faults[check] for check in more} }"
    waiting = dependants(LAB, failed | (unclear & set(truth.unclear)))
    if more := skipped - waiting - free - set(truth.may_fail):
        yield f"was not judged: {more}"
