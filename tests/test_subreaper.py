"""What a test starts ends with the run, also where any process of it is killed."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import textwrap
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path

import pytest

from sources import python_path

pytestmark = pytest.mark.slow

TESTS = Path(__file__).parent
PATIENCE_S = 60.0
"""Only a test that fails waits so long."""

STARTS = """
    import os, subprocess, sys, time
    from pathlib import Path

    DAEMON = "import os, subprocess as s; print(s.Popen({sleep}, stdout=s.DEVNULL).pid)"

    def test_it():
        sleep = ["sleep", "86400"]
        bare = {"PATH": os.defpath}
        node = subprocess.Popen(sleep, env=bare, start_new_session=True)
        source = DAEMON.format(sleep=sleep)
        said = subprocess.run([sys.executable, "-c", source], stdout=subprocess.PIPE, env=bare)
        orphan = int(said.stdout)
        part = Path("started.part")
        part.write_text(f"{os.getpid()} {node.pid} {orphan}")
        part.rename("started")
        while not Path("goes_on").exists():
            time.sleep(0.01)
"""


def parent_of(pid: int) -> int:
    """The process above."""
    return int(Path(f"/proc/{pid}/stat").read_text("utf-8").rpartition(")")[2].split()[1])


def lives(pid: int) -> bool:
    """It has not ended; one that nobody has waited for has."""
    with suppress(OSError):
        return Path(f"/proc/{pid}/stat").read_text("utf-8").rpartition(")")[2].split()[0] != "Z"
    return False


def until(condition: Callable[[], bool], missing: str) -> None:
    """Wait for a condition."""
    late_s = time.monotonic() + PATIENCE_S
    while not condition():
        assert time.monotonic() < late_s, missing
        time.sleep(0.01)


class Running:
    """A small run of pytest with the conftest of these tests; its test has started two processes.

    One has lost its parent, both are in a session and with an environment of their own.
    """

    def __init__(self, folder: Path, *more: str) -> None:
        (folder / "test_it.py").write_text(textwrap.dedent(STARTS), "utf-8")
        plugins = ["-p", "xdist.plugin", "-p", "conftest"]
        command = [sys.executable, "-m", "pytest", "-q", *plugins, "-c", os.devnull]
        path = os.pathsep.join([str(TESTS), python_path()])
        self._folder = folder
        self.process = subprocess.Popen(
            [*command, "--rootdir", str(folder), *more, "test_it.py"],
            cwd=folder,
            env={**os.environ, "PYTHONPATH": path, "PYTEST_DISABLE_PLUGIN_AUTOLOAD": "1"},
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            start_new_session=True,
        )
        self.started: list[int] = []

    def wait_started(self) -> None:
        """Until all of it runs."""
        file = self._folder / "started"
        until(lambda: file.exists() or self.process.poll() is not None, "no test began")
        assert file.exists(), self.process.communicate()[0]
        self.test, *self.started = map(int, file.read_text("utf-8").split())

    def chain(self) -> list[int]:
        """The processes from the one that was started down to the test's own."""
        found = [self.test]
        while found[0] != self.process.pid:
            found.insert(0, parent_of(found[0]))
        return found

    def goes_on(self) -> None:
        """Let the test pass."""
        (self._folder / "goes_on").touch()

    def end(self) -> None:
        """Nothing of it is left, whatever the tests below find."""
        for pid in (self.process.pid, *self.started):
            with suppress(ProcessLookupError):
                os.kill(pid, signal.SIGKILL)
        self.process.communicate()


@pytest.fixture
def run(tmp_path: Path) -> Iterator[Callable[..., Running]]:
    """One, whose test has started its processes."""
    made: list[Running] = []

    def begin(*more: str) -> Running:
        made.append(Running(tmp_path, *more))
        made[-1].wait_started()
        return made[-1]

    yield begin
    for each in made:
        each.end()


@pytest.mark.parametrize("workers", ["0", "1"])
def test_all_ends_with_the_run(run: Callable[..., Running], workers: str) -> None:
    """Its exit code is that of the tests."""
    running = run("-n", workers)
    assert all(map(lives, running.started))
    running.goes_on()
    assert running.process.wait(PATIENCE_S) == 0
    assert [pid for pid in running.started if lives(pid)] == []


@pytest.mark.parametrize("sent", [signal.SIGTERM, signal.SIGKILL, signal.SIGHUP])
@pytest.mark.parametrize("place", [0, 1, 2])
def test_all_ends_where_any_process_of_it_is_killed(
    run: Callable[..., Running], place: int, sent: signal.Signals
) -> None:
    """The one that was started, the one below it, and pytest itself; told as the signal it was."""
    running = run("-n", "0")
    chain = running.chain()
    assert len(chain) == 3
    os.kill(chain[place], sent)
    until(lambda: not any(map(lives, [*chain, *running.started])), "not all of it has ended")
    assert running.process.wait(PATIENCE_S) == -sent


def test_workers_end_too(run: Callable[..., Running]) -> None:
    """A worker of pytest-xdist is one process more."""
    running = run("-n", "1")
    chain = running.chain()
    os.kill(chain[2], signal.SIGKILL)
    until(lambda: not any(map(lives, [*chain, *running.started])), "not all of it has ended")


def test_ctrl_c_ends_the_tests_as_ever(run: Callable[..., Running]) -> None:
    """Sent to the command alone: pytest tells of it, and ends with its own exit code."""
    running = run("-n", "0")
    os.kill(running.process.pid, signal.SIGINT)
    said, _ = running.process.communicate(timeout=PATIENCE_S)
    assert "KeyboardInterrupt" in said
    assert running.process.returncode == pytest.ExitCode.INTERRUPTED
    assert [pid for pid in running.started if lives(pid)] == []
