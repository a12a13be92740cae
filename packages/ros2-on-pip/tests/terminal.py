"""`ros2` in processes of its own, on a domain of its own, beside real nodes."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from sources import code_of, python_path

HERE = Path(__file__).parent
MORTAL = code_of("ros2_on_pip") / "mortal.py"
"""Becomes a program that ends when this process does: pytest that is ended tidies nothing up."""

PATIENCE_S = 60.0
"""Only a test that fails waits so long."""

Environment = dict[str, str]


@dataclass(frozen=True)
class Ran:
    """What a command did."""

    code: int
    out: str
    err: str

    @property
    def lines(self) -> list[str]:
        """Its output, line by line."""
        return self.out.splitlines()


def eventually(condition: Callable[[], bool], pause_s: float = 0.01) -> None:
    """Wait until `condition()` holds; a test in which it never does fails."""
    end_s = time.monotonic() + PATIENCE_S
    while not condition():
        assert time.monotonic() < end_s, "what is waited for never comes"
        time.sleep(pause_s)


class Running:
    """A process whose lines are read as they come."""

    def __init__(
        self,
        command: list[str],
        environment: Environment,
        folder: Path,
        keys: int = subprocess.DEVNULL,
    ) -> None:
        """`keys` is a descriptor that it reads from."""
        self.lines: list[str] = []
        mortal = [sys.executable, "-I", "-S", str(MORTAL), str(os.getpid())]
        self.process = subprocess.Popen(
            [*mortal, *command],
            env=environment,
            cwd=folder,
            text=True,
            start_new_session=True,
            stdin=keys,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
        )
        self._changed = threading.Condition()
        self._reader = threading.Thread(target=self._read, daemon=True)
        self._reader.start()

    def _read(self) -> None:
        assert self.process.stdout
        for line in self.process.stdout:
            with self._changed:
                self.lines.append(line.rstrip("\n"))
                self._changed.notify_all()

    @property
    def text(self) -> str:
        """All lines so far."""
        return "\n".join(self.lines)

    def wait_for(self, pattern: str, times: int = 1) -> None:
        """Wait until `times` lines hold `pattern`."""
        expression = re.compile(pattern)
        with self._changed:
            seen = self._changed.wait_for(
                lambda: sum(bool(expression.search(line)) for line in self.lines) >= times,
                PATIENCE_S,
            )
        assert seen, f"no line with {pattern!r} in:\n{self.text}"

    def interrupt(self, whole_group: bool = False) -> int:
        """Press Ctrl-C; the exit code."""
        if whole_group:
            os.killpg(self.process.pid, signal.SIGINT)
        else:
            self.process.send_signal(signal.SIGINT)
        return self.wait()

    def wait(self) -> int:
        """Wait for the end; the exit code."""
        code = self.process.wait(PATIENCE_S)
        self._reader.join(PATIENCE_S)
        return code

    def end(self) -> None:
        """Nothing of it is left."""
        with_group = self.process.poll() is None
        if with_group:
            os.killpg(self.process.pid, signal.SIGKILL)
        self.process.wait()


class Shell:
    """A terminal of a student: one environment, one folder."""

    def __init__(self, environment: Environment, folder: Path) -> None:
        self.environment, self.folder = environment, folder
        self.nodes: Running | None = None

    def __call__(self, *words: str, **changes: str) -> Ran:
        """Run `ros2 words...` to its end; `changes` are environment variables."""
        done = subprocess.run(
            ours(*words),
            env=self.environment | changes,
            cwd=self.folder,
            text=True,
            capture_output=True,
            stdin=subprocess.DEVNULL,
            timeout=PATIENCE_S,
            check=False,
        )
        print(done.stderr, end="")  # pytest shows it where a test fails
        return Ran(done.returncode, done.stdout, done.stderr)

    @contextmanager
    def start(
        self, *words: str, keys: int = subprocess.DEVNULL, **changes: str
    ) -> Iterator[Running]:
        """`ros2 words...` while the block runs; `keys` is a descriptor that it reads from."""
        with self.program(ours(*words), keys, **changes) as running:
            yield running

    @contextmanager
    def program(
        self, command: list[str], keys: int = subprocess.DEVNULL, **changes: str
    ) -> Iterator[Running]:
        """Any program while the block runs."""
        running = Running(command, self.environment | changes, self.folder, keys)
        try:
            yield running
        finally:
            running.end()

    def wait_heard(self, text: str, times: int = 1) -> None:
        """Wait until the node /ear of the stage has heard `text`."""
        assert self.nodes
        self.nodes.wait_for(f"^heard {text}$", times)


DEAF = ("sh", "-c", 'trap "" INT; exec "$@"', "sh")
"""Put before a command: it starts as from a script in the background, where Ctrl-C is ignored."""


def ours(*words: str) -> list[str]:
    """The command line of our own `ros2`."""
    return [sys.executable, str(HERE / "ours.py"), *words]


def surroundings(domain: int, home: Path) -> Environment:
    """A clean terminal: nothing of ROS is set but the domain, and home is empty."""
    kept = {
        name: value
        for name, value in os.environ.items()
        if not name.startswith(("ROS", "RMW", "RCUTILS", "FAST", "AMENT"))
    }
    return kept | {
        "ROS_DOMAIN_ID": str(domain),
        "HOME": str(home),
        "ROS_LOG_DIR": str(home / "log"),
        "PYTHONPATH": python_path(),
        "COLUMNS": "80",
        "LC_ALL": "C.UTF-8",
    }
