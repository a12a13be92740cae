"""The command itself, killed in the middle and begun again: nothing lost, doubled or left."""

from __future__ import annotations

import os
import shutil
import signal
import sqlite3
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from roslings.course import lab

pytestmark = pytest.mark.slow

TOPICS = lab("topics")
LONG_S = 300.0


@pytest.fixture
def place(tmp_path: Path) -> Iterator[Path]:
    """Submissions that are quickly graded: a setup.py that ends at once, and no package at all."""
    (tmp_path / "tmp").mkdir()
    for number in range(4):
        package = tmp_path / "handed in" / f"broken-{number}" / "chatter"
        shutil.copytree(TOPICS.starter, package)
        (package / "setup.py").write_text(f"raise SystemExit({number})\n")
    for number in range(4):
        (tmp_path / "handed in" / f"empty-{number}").mkdir()
    yield tmp_path
    left = processes_of(tmp_path)
    for pid in left:
        os.kill(pid, signal.SIGKILL)


def begin(place: Path, *more: str) -> subprocess.Popen[str]:
    """The command, in a group of its own, with its temporary files inside the test's folder."""
    words = ["grade", "topics", "handed in", "--out", "out", "--trust", "--jobs", "3", *more]
    environment = {**os.environ, "TMPDIR": str(place / "tmp"), "HOME": str(place)}
    return subprocess.Popen(
        [sys.executable, "-m", "roslings", *words],
        cwd=place,
        env=environment,
        text=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        start_new_session=True,
    )


def processes_of(place: Path) -> list[int]:
    """Every process that works in the test's folder, guardians and nodes too."""
    found = []
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit() and int(entry.name) != os.getpid() and _works_in(entry, place):
            found.append(int(entry.name))
    return found


def _works_in(process: Path, place: Path) -> bool:
    try:
        cwd = (process / "cwd").readlink()
        words = (process / "cmdline").read_text(errors="replace")
    except OSError:
        return False
    return cwd.is_relative_to(place) or str(place) in words


def results(place: Path) -> list[tuple[str, str, int]]:
    """Submission, outcome and attempt of every result."""
    file = place / "out" / "gradebook.sqlite"
    if not file.is_file():
        return []
    connection = sqlite3.connect(file)
    try:
        query = "SELECT submission, word, attempt FROM results ORDER BY submission"
        return list(connection.execute(query))
    except sqlite3.OperationalError:  # not yet made
        return []
    finally:
        connection.close()


def until(condition: Callable[[], bool]) -> None:
    """Wait for a condition, not for a time."""
    end_s = time.monotonic() + LONG_S
    while not condition():
        assert time.monotonic() < end_s
        time.sleep(0.02)


def reach(moment: Callable[[], bool], command: subprocess.Popen[str]) -> None:
    """Wait for a moment of a command's life, or for its end."""
    until(lambda: moment() or command.poll() is not None)


def a_build_runs(place: Path) -> bool:
    """Some submission is being built."""
    return any(
        b"colcon" in (Path("/proc") / str(pid) / "cmdline").read_bytes()
        for pid in processes_of(place)
        if (Path("/proc") / str(pid)).exists()
    )


def test_killed_at_any_moment_the_same_command_goes_on(place: Path) -> None:
    """Three times kill -9: before anything, when a result is there, in the middle of a build."""
    moments: list[Callable[[], bool]] = [
        lambda: (place / "out").exists(),
        lambda: bool(results(place)),
        lambda: a_build_runs(place),
    ]
    for moment in moments:
        killed = begin(place)
        reach(moment, killed)
        before = results(place)
        killed.kill()
        killed.communicate()
        assert set(before) <= set(results(place))
        until(lambda: not processes_of(place))
    last = begin(place)
    out, errors = last.communicate(timeout=LONG_S)
    assert last.returncode == 0, errors
    expected = [(f"broken-{n}", "fail", 1) for n in range(4)]
    expected += [(f"empty-{n}", "refused", 1) for n in range(4)]
    assert results(place) == expected
    assert "8 of 8 submissions graded" in out
    until(lambda: not processes_of(place))
    assert list((place / "tmp").iterdir()) == []


def test_ctrl_c_ends_all_that_was_started(place: Path) -> None:
    """With exit code 130, and what is graded stays."""
    command = begin(place)
    until(lambda: a_build_runs(place))
    command.send_signal(signal.SIGINT)
    _, errors = command.communicate(timeout=LONG_S)
    assert command.returncode == 130
    assert "The same command goes on" in errors
    assert "Traceback" not in errors
    assert not processes_of(place)
    assert list((place / "tmp").iterdir()) == []


def test_without_a_sandbox_it_asks_for_trust(place: Path) -> None:
    """And runs nothing until it has it."""
    words = ["grade", "topics", "handed in", "--out", "out"]
    done = subprocess.run(
        [sys.executable, "-m", "roslings", *words],
        cwd=place,
        capture_output=True,
        text=True,
        env={**os.environ, "ROSLINGS_ISOLATION": "domain"},
        check=False,
    )
    assert done.returncode == 2
    assert "Leave that variable out" in done.stderr
    assert "--trust" in done.stderr
    assert not (place / "out").exists()


def test_two_commands_do_not_share_a_gradebook(place: Path) -> None:
    """The second says so."""
    first = begin(place)
    until(lambda: (place / "out" / "gradebook.sqlite").exists())
    second = begin(place)
    _, errors = second.communicate(timeout=LONG_S)
    assert second.returncode == 2
    assert "Another ./roslings grade" in errors
    first.send_signal(signal.SIGINT)
    first.communicate(timeout=LONG_S)


@pytest.mark.parametrize(
    ("out", "says"), [("handed in/out", "among the submissions"), ("/dev/null/x", "cannot be made")]
)
def test_a_gradebook_has_a_place_of_its_own(place: Path, out: str, says: str) -> None:
    """Not among the submissions, and where it can be written."""
    command = begin(place, "--out", out)
    _, errors = command.communicate(timeout=LONG_S)
    assert command.returncode == 2
    assert says in errors
    assert len(list((place / "handed in").iterdir())) == 8
