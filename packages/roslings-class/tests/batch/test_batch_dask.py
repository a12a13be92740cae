"""The same work on a cluster: here a scheduler and two workers on one machine."""

from __future__ import annotations

import os
import shutil
import signal
import socket
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path

import pytest

from roslings.course import lab
from roslings_class.command import GradeOptions, grade
from roslings_class.dask_pool import NoCluster, UnfitWorkers
from roslings_class.gradebook import gradebook
from roslings_class.result import GradingResult
from roslings_class.signed_gradebook import take_key
from skips import imported

pytestmark = pytest.mark.slow
imported("distributed")

TOPICS = lab("topics")
LONG_S = 300.0


@contextmanager
def running(*words: str, **more: str) -> Iterator[subprocess.Popen[bytes]]:
    """A part of the cluster, ended with the block."""
    command = [sys.executable, "-m", "roslings", "cluster", *words]
    with subprocess.Popen(
        command,
        env={**os.environ, **more},
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    ) as process:
        try:
            yield process
        finally:
            end(process)


def end(process: subprocess.Popen[bytes]) -> None:
    """Ask the command, which has ended Dask when it ends."""
    started = children(process.pid)
    process.terminate()
    process.wait(LONG_S)
    assert not any(map(alive, started))


def children(pid: int) -> list[int]:
    """What a process has started; nothing where it has ended."""
    with suppress(OSError):
        return list(map(int, Path(f"/proc/{pid}/task/{pid}/children").read_text().split()))
    return []


def alive(pid: int) -> bool:
    """It runs, or could."""
    with suppress(OSError):
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    return False


@contextmanager
def cluster(*workers: dict[str, str]) -> Iterator[tuple[str, list[subprocess.Popen[bytes]]]]:
    """A scheduler, and a worker for each set of variables."""
    with socket.socket() as free:
        free.bind(("127.0.0.1", 0))
        port = free.getsockname()[1]
    address = f"tcp://127.0.0.1:{port}"
    with ExitStack() as stack:
        words = ("scheduler", "--host", "127.0.0.1", "--port", str(port), "--no-dashboard")
        stack.enter_context(running(*words))
        until(lambda: answers(port))
        options = ("--nthreads", "1", "--no-nanny", "--host", "127.0.0.1", "--no-dashboard")
        started = [
            stack.enter_context(running("worker", address, *options, **more)) for more in workers
        ]
        wait_for_workers(address, len(workers))
        yield address, started


def answers(port: int) -> bool:
    """Somebody listens."""
    with socket.socket() as tried:
        return tried.connect_ex(("127.0.0.1", port)) == 0


def wait_for_workers(address: str, count: int) -> None:
    """Until the scheduler knows them."""
    from distributed import Client

    with Client(address, set_as_default=False) as client:
        client.wait_for_workers(count, timeout=LONG_S)


def until(condition: Callable[[], bool]) -> None:
    """Wait for a condition, not for a time."""
    end_s = time.monotonic() + LONG_S
    while not condition():
        assert time.monotonic() < end_s
        time.sleep(0.05)


def handed_in(folder: Path) -> Path:
    """A good one, as folder and as archive; the starter; one that is refused."""
    shutil.copytree(TOPICS.solution, folder / "anna" / "chatter")
    shutil.make_archive(str(folder / "ben"), "zip", TOPICS.starter.parent)
    (folder / "cleo").mkdir()
    return folder


def graded(folder: Path, address: str, out: Path) -> dict[str, GradingResult]:
    """Grade on the cluster."""
    grade(GradeOptions("topics", folder, out, trust=True, dask=address, keeps_evidence=False))
    with gradebook(out, "topics") as book:
        return book.latest()


def test_two_workers_grade_as_one_machine_does(tmp_path: Path) -> None:
    """Folder, archive and refusal; only small results come back, and nothing stays behind."""
    (tmp_path / "tmp").mkdir()
    more = {"TMPDIR": str(tmp_path / "tmp")}
    with cluster(more, more) as (address, _):
        latest = graded(handed_in(tmp_path / "in"), address, tmp_path / "out")
        assert {name: result.word for name, result in latest.items()} == {
            "anna": "pass",
            "ben": "fail",
            "cleo": "refused",
        }
        assert latest["anna"].score == 100
        with gradebook(tmp_path / "out", "topics") as book:
            assert book.evidence(latest["anna"]) is None
    assert not list((tmp_path / "tmp").glob("roslings-*"))


def test_a_worker_that_dies_loses_nothing(tmp_path: Path) -> None:
    """The other one takes over."""
    handed_in(tmp_path / "in")
    (tmp_path / "tmp").mkdir()
    more = {"TMPDIR": str(tmp_path / "tmp")}
    with cluster(more, {}) as (address, (first, _)):
        command = [
            sys.executable,
            "-m",
            "roslings",
            "grade",
            "topics",
            str(tmp_path / "in"),
            "--out",
            str(tmp_path / "out"),
            "--trust",
            "--evidence",
            "--dask",
            address,
        ]
        with subprocess.Popen(command, stderr=subprocess.DEVNULL) as grading:
            until(lambda: any((tmp_path / "tmp").glob("roslings-*/room")) or bool(grading.poll()))
            first.kill()
            assert grading.wait(LONG_S) == 0
        with gradebook(tmp_path / "out", "topics") as book:
            words = {name: result.word for name, result in book.latest().items()}
            assert (take_key(book, tmp_path / "out"), book.forged()) == ([], {})
            assert book.evidence(book.latest()["anna"])  # signed where it arrived
    assert words == {"anna": "pass", "ben": "fail", "cleo": "refused"}


def test_a_worker_with_another_course_is_refused(tmp_path: Path) -> None:
    """Before anything is sent."""
    shutil.copytree(TOPICS.folder, tmp_path / "course/labs/topics")
    (tmp_path / "course/graders").mkdir()
    shutil.copy(TOPICS.grader, tmp_path / "course/graders")
    card = tmp_path / "course/labs/topics/card.yaml"
    card.write_text(card.read_text("utf-8").replace("hz: 2.0", "hz: 3.0"), "utf-8")
    handed_in(tmp_path / "in")
    with cluster({"ROSLINGS_COURSE": str(tmp_path / "course")}) as (address, _):
        with pytest.raises(UnfitWorkers, match="another version"):
            graded(tmp_path / "in", address, tmp_path / "out")
        with gradebook(tmp_path / "out", "topics") as book:
            assert book.latest() == {}


STUBBORN = """
import sys
from roslings_class.cluster import run_until_asked
shell = "trap '' TERM INT; echo $$; while :; do sleep 1; done"
sys.exit(run_until_asked(["/bin/sh", "-c", shell], 0.5))
"""


@pytest.mark.parametrize("sent", [signal.SIGTERM, signal.SIGINT, signal.SIGKILL])
def test_what_does_not_end_is_ended(sent: signal.Signals) -> None:
    """Dask's worker may wait for a task of its own for ever; and the command may be killed."""
    command = [sys.executable, "-c", STUBBORN]
    with subprocess.Popen(command, stdout=subprocess.PIPE) as process:
        assert process.stdout
        pid = int(process.stdout.readline())
        process.send_signal(sent)
        assert process.wait(LONG_S) == (-sent if sent == signal.SIGKILL else 0)
    until(lambda: not alive(pid))


def test_a_part_that_cannot_start_says_so() -> None:
    """With Dask's own words, and its exit code."""
    words = ["-m", "roslings", "cluster", "worker", "no address at all", "--no-such-option"]
    ran = subprocess.run([sys.executable, *words], capture_output=True, text=True, check=False)
    assert ran.returncode == 2
    assert "no-such-option" in ran.stderr


def test_no_scheduler_is_said(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """With how to start one."""
    monkeypatch.setattr("roslings_class.dask_pool.CONNECT_WITHIN_S", 1.0)
    handed_in(tmp_path / "in")
    with pytest.raises(NoCluster, match="cluster scheduler"):
        graded(tmp_path / "in", "tcp://127.0.0.1:1", tmp_path / "out")
