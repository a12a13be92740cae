"""Many gradings at once: each written down, none touched by another, all ended at the end."""

from __future__ import annotations

import fcntl
import os
import sqlite3
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pytest

from roslings_class.capacity import Capacity, MachineLoad
from roslings_class.errors import BadGradebook
from roslings_class.gradebook import Gradebook, gradebook, lab_of
from roslings_class.result import GradingResult
from roslings_class.scheduler import BatchProgress, GradingRequest, Scheduler
from roslings_class.submissions import Submission
from roslings_class.worker_pool import GradingLimits, worker_pool

HERE = Path(__file__).parent


@pytest.fixture(autouse=True)
def lives_can_be_imported(monkeypatch: pytest.MonkeyPatch) -> None:
    """By the processes that the tests start."""
    paths = [str(HERE), *filter(None, [os.environ.get("PYTHONPATH")])]
    monkeypatch.setenv("PYTHONPATH", os.pathsep.join(paths))


@contextmanager
def held_lock(folder: Path) -> Iterator[Path]:
    """A lock as the command holds one."""
    path = folder / "lock"
    with path.open("w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        yield path


def submitted(folder: Path, *names: str) -> list[Submission]:
    """Submissions that hold their own name."""
    for name in names:
        (folder / name).write_text(name)
    return [Submission(name, folder / name) for name in names]


def run(
    folder: Path, book: Gradebook, submissions: list[Submission], jobs: int = 3, limit_s: float = 60
) -> list[BatchProgress]:
    """One run; what it told on its way."""
    told: list[BatchProgress] = []
    with held_lock(folder) as lock:
        request = GradingRequest(
            "topics",
            folder / "scratch",
            lock,
            limits=GradingLimits(limit_s, 0.5),
            entry_point="lives:by_name",
        )
        Scheduler(request, book, Capacity(fixed=jobs), told.append).run(submissions)
    assert not any((folder / "scratch" / "rooms").glob("*"))
    return told


def rows(book: Gradebook) -> list[tuple[str, int]]:
    """Submission and attempt of every result."""
    query = "SELECT submission, attempt FROM results ORDER BY submission, attempt"
    return list(book._connection.execute(query))


def test_each_is_written_once(tmp_path: Path) -> None:
    """A second run finds nothing to do; a submission handed in anew is graded anew."""
    names = [f"refuse-{number}" for number in range(12)]
    all_of_them = submitted(tmp_path, *names)
    with gradebook(tmp_path, "topics") as book:
        told = run(tmp_path, book, all_of_them)
        assert rows(book) == [(name, 1) for name in sorted(names)]
        assert told[-1].all == 12
        assert max(each.working for each in told) <= 3
        run(tmp_path, book, all_of_them)
        assert len(rows(book)) == 12
        (tmp_path / "refuse-3").write_text("better")
        run(tmp_path, book, all_of_them)
        assert rows(book).count(("refuse-3", 1)) == 2


def test_what_breaks_touches_no_other(tmp_path: Path) -> None:
    """A traceback and a kill are told, and the others are graded."""
    found = submitted(tmp_path, "raise-1", "vanish-1", "refuse-1", "refuse-2")
    with gradebook(tmp_path, "topics") as book:
        run(tmp_path, book, found)
        latest = book.latest()
    assert "the disk is on fire" in latest["raise-1"].reason
    assert "status -9" in latest["vanish-1"].reason
    assert {latest[name].word for name in ("raise-1", "vanish-1")} == {"inconclusive"}
    assert {latest[name].word for name in ("refuse-1", "refuse-2")} == {"refused"}


def test_the_unclear_are_tried_again_alone(tmp_path: Path) -> None:
    """At the end, when nothing else runs."""
    names = ("busy-1", "busy-2", *(f"refuse-{number}" for number in range(6)))
    with gradebook(tmp_path, "topics") as book:
        told = run(tmp_path, book, submitted(tmp_path, *names), jobs=4)
        latest = book.latest()
        assert {latest[name].attempt for name in ("busy-1", "busy-2")} == {2}
        assert {latest[name].reason for name in ("busy-1", "busy-2")} == {"1 at work"}
        assert len(rows(book)) == len(names) + 2
    assert (told[-1].done, told[-1].unclear) == (len(names) - 1, 1)


def test_one_that_hangs_is_ended(tmp_path: Path) -> None:
    """Also where it ignores the first signal; it and its child are gone."""
    with gradebook(tmp_path, "topics") as book:
        run(tmp_path, book, submitted(tmp_path, "hang-1", "refuse-1"), limit_s=1.0)
        latest = book.latest()
    assert latest["hang-1"].reason == "The grading did not end within 1 s."
    assert latest["refuse-1"].word == "refused"
    until(lambda: none_of_them_lives(tmp_path))


def test_leaving_the_block_ends_all(tmp_path: Path) -> None:
    """Ctrl-C, or anything else that ends it."""
    (submission,) = submitted(tmp_path, "hang-1")
    with held_lock(tmp_path) as lock, pytest.raises(KeyboardInterrupt):
        request = GradingRequest("topics", tmp_path / "scratch", lock)
        with worker_pool(lock, GradingLimits(ending_s=0.5), "lives:by_name") as workers:
            workers.start(request.order(submission, "d", 1))
            until(lambda: (tmp_path / "hangs").exists())
            raise KeyboardInterrupt
    until(lambda: none_of_them_lives(tmp_path))


def none_of_them_lives(folder: Path) -> bool:
    """The process that hangs, and its child."""
    return not any(Path("/proc", pid).exists() for pid in (folder / "hangs").read_text().split())


def until(condition: object) -> None:
    """Wait for a condition, not for a time."""
    assert callable(condition)
    for _ in range(600):
        if condition():
            return
        time.sleep(0.05)
    raise AssertionError("it did not come")


# --- how many at once --------------------------------------------------------------------------


class Machine:
    """A machine whose processors and memory follow a script."""

    def __init__(self, *idle: float, free_bytes: int = 10**11) -> None:
        self._idle, self._free = list(idle), free_bytes
        self._at_s = self._idle_s = 0.0

    def __call__(self) -> MachineLoad:
        """Four seconds later."""
        cores = os.cpu_count() or 1
        self._at_s += 4.0
        self._idle_s += 4.0 * cores * (self._idle.pop(0) if self._idle else 0.1)
        return MachineLoad(self._at_s, self._idle_s, self._free)


def test_idle_processors_let_more_in() -> None:
    """One by one, up to a bound, and back when nothing is left to spare."""
    capacity = Capacity(cores=2, look=Machine(0, *[0.6] * 20, *[0.0] * 30))
    found = [capacity.now(working) for working in [2, *[99] * 50]]
    assert found[:3] == [2, 3, 4]
    assert max(found) == 4
    assert found[-1] == 2


def test_a_busy_moment_sends_nobody_out() -> None:
    """Those that build at the same time wait at the same time."""
    capacity = Capacity(cores=2, look=Machine(0, *[0.3, 0.0] * 10))
    found = [capacity.now(99) for _ in range(20)]
    assert found == sorted(found)
    assert found[-1] == 4


def test_nobody_is_let_in_while_there_is_room() -> None:
    """Idle processors mean nothing where fewer work than may."""
    capacity = Capacity(cores=2, look=Machine(0, *[0.9] * 5))
    assert [capacity.now(1) for _ in range(5)] == [2] * 5


def test_who_only_waits_takes_nobodys_place() -> None:
    """Its nodes run on, and cost next to nothing: the others compute meanwhile."""
    capacity = Capacity(cores=2, look=Machine(*[0.0] * 20))
    assert [capacity.now(working, working - 2) for working in (2, 5, 9)] == [2, 5, 9]
    assert Capacity(fixed=1, look=Machine()).now(3, 3) == 4
    assert Capacity(fixed=1, alone=True, look=Machine()).now(1, 1) == 1


def test_memory_and_number_bound_those_who_wait() -> None:
    """At half a gigabyte for the next one; and there is an end to it."""
    assert Capacity(cores=2, look=Machine(free_bytes=10**8)).now(7, 7) == 7
    assert Capacity(cores=2, look=Machine()).now(32, 32) == 32


def test_memory_bounds_it() -> None:
    """But one is always graded."""
    assert Capacity(cores=8, look=Machine(free_bytes=1_200_000_000)).now(0) == 2
    assert Capacity(cores=8, look=Machine(free_bytes=0)).now(0) == 1


# --- the gradebook -----------------------------------------------------------------------------


def result(name: str, attempt: int = 1) -> GradingResult:
    """A short result."""
    return GradingResult(submission=name, digest="d", attempt=attempt, state="refused", reason="r")


def test_a_result_and_its_evidence_are_one(tmp_path: Path) -> None:
    """The same result twice is one; a newer attempt is the latest."""
    with gradebook(tmp_path, "topics") as book:
        book.write(result("anna"), b"seen")
        book.write(result("anna"), b"seen")
        book.write(result("anna", 2))
        assert rows(book) == [("anna", 1), ("anna", 2)]
        assert book.latest()["anna"].attempt == 2
        assert book.evidence(result("anna", 2)) == b"seen"
        assert book.attempts("anna", "d") == 2
        assert book.attempts("anna", "other") == 0


def test_an_override_keeps_its_reason_and_the_verdict(tmp_path: Path) -> None:
    """The newest counts; nothing is deleted."""
    with gradebook(tmp_path, "topics") as book:
        book.write(result("anna"))
        book.override("anna", 70, "showed it in class", "M. Tutor")
        book.override("anna", 80, "and explained it", "M. Tutor")
        found = book.overrides()["anna"]
        assert (found.score, found.reason, found.by) == (80, "and explained it", "M. Tutor")
        assert book.latest()["anna"].word == "refused"
        assert len(list(book._connection.execute("SELECT * FROM overrides"))) == 2


def test_a_gradebook_belongs_to_one_lab(tmp_path: Path) -> None:
    """Another lab's submissions do not get into it."""
    with gradebook(tmp_path, "topics"):
        pass
    assert lab_of(tmp_path) == "topics"
    with (
        pytest.raises(BadGradebook, match="'topics', not of 'nodes'"),
        gradebook(tmp_path, "nodes"),
    ):
        pass


def test_a_newer_or_broken_gradebook_is_refused(tmp_path: Path) -> None:
    """With the next step, and without a change."""
    with gradebook(tmp_path, "topics"):
        pass
    connection = sqlite3.connect(tmp_path / "gradebook.sqlite")
    connection.execute("PRAGMA user_version=99")
    connection.close()
    with pytest.raises(BadGradebook, match="newer"), gradebook(tmp_path, "topics"):
        pass
    (tmp_path / "gradebook.sqlite").write_bytes(b"no database" * 100)
    with pytest.raises(BadGradebook), gradebook(tmp_path, "topics"):
        pass
