"""Grade all that is to be graded: as many at once as the machine bears, the unclear ones last."""

from __future__ import annotations

import random
import time
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sized
from dataclasses import dataclass, field
from pathlib import Path
from typing import Protocol

from roslings.course.contract import Plain
from roslings_class.capacity import Capacity
from roslings_class.gradebook import Gradebook
from roslings_class.own_cards import OwnCards
from roslings_class.result import GradingOrder, GradingResult
from roslings_class.room_secret import RoomSecret
from roslings_class.submissions import Submission, digest_of
from roslings_class.worker_pool import GRADING, EndedGrading, GradingLimits, worker_pool

SEEDS = 10**9
TURN_S = 0.5


@dataclass(frozen=True)
class GradingRequest:
    """How to grade, the same for all."""

    lab: str
    scratch: Path
    """A private folder, held by a lock as long as the command lives."""
    lock: Path
    hidden: Path | None = None
    clock: str = "auto"
    keeps_evidence: bool = True
    soak_s: float = 0.0
    """How long the nodes are left running besides; 0: not at all."""
    strangers: bool = False
    limits: GradingLimits = field(default_factory=GradingLimits)
    entry_point: str = GRADING
    """What each process does: MODULE:FUNCTION."""
    cards: OwnCards | None = None
    """Each student's own card; None: everybody has the same."""
    rooms: RoomSecret | None = None
    """What rooms are drawn from; None: no secret ones."""

    def words(self, submission: Submission) -> dict[str, Plain]:
        """What is the student's own in the card that it is graded by."""
        return self.cards.words(submission.name) if self.cards else {}

    def order(self, submission: Submission, digest: str, attempt: int) -> GradingOrder:
        """The order for one try of a submission."""
        room = self.scratch / "rooms" / f"{random.SystemRandom().getrandbits(64):016x}"
        seed = random.SystemRandom().randrange(SEEDS)
        return GradingOrder.model_validate(
            {
                "lab": self.lab,
                "submission": submission.name,
                "digest": digest,
                "attempt": attempt,
                "path": submission.path.absolute(),
                "room": room,
                "seed": seed,
                "clock": self.clock,
                "hidden": self.hidden,
                "builds": self.scratch / "builds",
                "keeps_evidence": self.keeps_evidence,
                "strangers": self.strangers,
                "soak_s": self.soak_s,
                "words": self.words(submission),
                "room_secret": self.rooms.of(submission.name) if self.rooms else "",
                **self._by_own_card(submission),
            }
        )

    def _by_own_card(self, submission: Submission) -> dict[str, object]:
        if self.cards is None:
            return {}
        name = submission.name
        return {"course": self.cards.course(name), "whose": self.cards.whose[name]}


@dataclass(frozen=True)
class BatchProgress:
    """How far the work is."""

    all: int
    done: int
    """Conclusive ones, those of earlier runs too."""
    working: int
    unclear: int
    left_s: float | None
    """An estimate; None before the first one is done."""


Watcher = Callable[[BatchProgress], None]


def always() -> bool:
    """There is no end to the time."""
    return True


@dataclass(frozen=True)
class _Todo:
    """What a run has to do."""

    fresh: list[tuple[Submission, str]]
    known: dict[str, tuple[Submission, str]]
    unclear: set[str]


class Workers(Protocol):
    """Who grades: a pool of this machine, or of a cluster."""

    @property
    def workers(self) -> Sized:
        """Those at work."""

    @property
    def soaking(self) -> int:
        """How many of them only wait."""

    def start(self, order: GradingOrder) -> None:
        """Begin one more."""

    def wait(self, most_s: float) -> Iterator[EndedGrading]:
        """Those that end within `most_s`."""


class HowMany(Protocol):
    """How many may work at once."""

    fixed: int | None

    def now(self, working: int, soaking: int) -> int:
        """Of whom `working` do already, and of these `soaking` only wait."""


class Scheduler:
    """One run of the command over all submissions."""

    def __init__(
        self,
        request: GradingRequest,
        book: Gradebook,
        capacity: HowMany,
        watcher: Watcher,
        still: Callable[[], bool] = always,
    ) -> None:
        """Nothing is begun any more once `still()` is false."""
        self._request, self._book, self._still = request, book, still
        self._capacity, self._watcher = capacity, watcher
        self._began_s = time.monotonic()
        self._graded = 0
        self._standing = BatchProgress(0, 0, 0, 0, None)

    def run(self, submissions: Iterable[Submission], workers: Workers | None = None) -> None:
        """Grade what the gradebook has not; what stays unclear is tried once more, alone.

        A verdict whose evidence is not what was measured here is none: it is graded anew.
        """
        known = {each.name: (each, digest_of(each.path)) for each in submissions}
        latest = self._book.latest()
        forged = self._book.forged()
        done = {
            name
            for name in known
            if name not in forged and self._is_done(latest.get(name), known[name])
        }
        unclear = {
            name
            for name in known
            if name not in {*done, *forged} and self._was_tried(latest.get(name), known[name])
        }
        fresh = [name for name in known if name not in done | unclear]
        self._standing = BatchProgress(len(known), len(done), 0, len(unclear), None)
        todo = _Todo([known[name] for name in fresh], known, unclear)
        if workers:
            self._all(workers, todo)
            return
        with worker_pool(
            self._request.lock, self._request.limits, self._request.entry_point
        ) as workers:
            self._all(workers, todo)

    def _was_tried(self, result: GradingResult | None, known: tuple[Submission, str]) -> bool:
        """With this content, and by the card that is the student's today."""
        submission, digest = known
        return (
            result is not None
            and result.digest == digest
            and result.words == self._request.words(submission)
        )

    def _is_done(self, result: GradingResult | None, known: tuple[Submission, str]) -> bool:
        return result is not None and result.is_conclusive and self._was_tried(result, known)

    def _all(self, workers: Workers, todo: _Todo) -> None:
        for ended in self._work(workers, todo.fresh, self._capacity):
            if not ended.result.is_conclusive:
                todo.unclear.add(ended.order.submission)
        again = [todo.known[name] for name in sorted(todo.unclear)]
        for _ in self._work(workers, again, Capacity(fixed=1, alone=True)):
            pass

    def _work(
        self, workers: Workers, todo: Iterable[tuple[Submission, str]], capacity: HowMany
    ) -> Iterator[EndedGrading]:
        waiting = deque(todo)
        while waiting or len(workers.workers):
            if not self._still():
                waiting.clear()
            while waiting and self._has_room(workers, capacity):
                submission, digest = waiting.popleft()
                attempt = self._book.attempts(submission.name, digest) + 1
                workers.start(self._request.order(submission, digest, attempt))
                if not capacity.fixed:
                    break  # look at the machine again before the next one
            self._tell(len(workers.workers))
            for ended in workers.wait(TURN_S):
                self._book.write(ended.result, ended.evidence)
                self._count(ended.result)
                yield ended

    def _has_room(self, workers: Workers, capacity: HowMany) -> bool:
        working = len(workers.workers)
        return working < capacity.now(working, workers.soaking)

    def _count(self, result: GradingResult) -> None:
        """One more is over."""
        self._graded += 1
        was = self._standing
        again = result.attempt > 1 and was.unclear > 0
        unclear = was.unclear - again + (not result.is_conclusive)
        done = was.done + result.is_conclusive
        self._standing = BatchProgress(was.all, done, was.working, unclear, self._left_s(done))

    def _left_s(self, done: int) -> float:
        """As long for each of the rest as for those of this run."""
        each_s = (time.monotonic() - self._began_s) / self._graded
        return each_s * (self._standing.all - done)

    def _tell(self, working: int) -> None:
        was = self._standing
        self._watcher(BatchProgress(was.all, was.done, working, was.unclear, was.left_s))
