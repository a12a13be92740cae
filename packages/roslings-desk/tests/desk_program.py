"""A desk that runs in a process of its own, nodes of the test beside it, and a browser's page."""

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
from dataclasses import dataclass, field
from html import unescape
from pathlib import Path
from types import TracebackType
from typing import Any

from sources import python_path

PATIENCE_S = 120.0
"""Only a test that fails waits so long."""


def until(condition: Callable[[], Any], missing: str) -> Any:
    """Ask again and again, until it holds; what it then is."""
    late_s = time.monotonic() + PATIENCE_S
    while not (found := condition()):
        assert time.monotonic() < late_s, f"never: {missing}"
        time.sleep(0.01)
    return found


@dataclass
class Desk:
    """A running `./roslings desk`."""

    process: subprocess.Popen[str]
    domain: int
    lines: list[str] = field(default_factory=list)

    @property
    def file(self) -> Path:
        """The file that it has named: it leads a browser to the page."""
        found = until(lambda: re.search(r"file://(\S+)", "\n".join(self.lines)), str(self.lines))
        return Path(found[1])

    @property
    def url(self) -> str:
        """The address in that file, with the key."""
        (found,) = set(re.findall(r'http://[^"]+', self.file.read_text("utf-8")))
        return unescape(found)

    @property
    def base(self) -> str:
        """Where it listens: http://127.0.0.1:PORT."""
        return self.url.partition("/enter")[0]

    def let_in(self, page: Any) -> None:
        """Open the file, as a browser of this user does; the page then shows the tab Rover."""
        page.goto(self.file.as_uri())
        page.wait_for_url(f"{self.base}/rover")

    def read(self) -> None:
        """Keep what it prints."""
        assert self.process.stdout
        for line in self.process.stdout:
            self.lines.append(line.rstrip("\n"))

    def interrupt(self, number: signal.Signals = signal.SIGINT) -> int:
        """Press Ctrl-C, or end it by another signal; the exit code."""
        self.process.send_signal(number)
        return self.process.wait(PATIENCE_S)


def environment(domain: int, home: Path) -> dict[str, str]:
    """A new terminal: nothing of the test's own environment but what Python needs."""
    kept = {k: os.environ[k] for k in ("PATH", "LD_LIBRARY_PATH", "LANG") if k in os.environ}
    own = {"ROS_DOMAIN_ID": str(domain), "HOME": str(home), "PYTHONPATH": python_path()}
    quiet = {"ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST", "BROWSER": "true"}  # opens nothing
    return kept | own | quiet


@contextmanager
def program(
    module: str, words: list[str], domain: int, home: Path, more: Path | None = None
) -> Iterator[Any]:
    """A module that runs while the block does; nothing of it is left afterwards.

    It sees packages that lie in `more`, too.
    """
    seen = environment(domain, home)
    if more:
        seen["PYTHONPATH"] += f"{os.pathsep}{more}"
    process = subprocess.Popen(
        [sys.executable, "-m", module, *words],
        env=seen,
        cwd=home,
        text=True,
        start_new_session=True,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
    )
    try:
        yield process
    finally:
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGKILL)
        process.wait()


@contextmanager
def desk(domain: int, home: Path, *words: str, more: Path | None = None) -> Iterator[Desk]:
    """The desk, as soon as it has said where its page is."""
    with program("roslings_desk", ["--no-browser", *words], domain, home, more) as process:
        found = Desk(process, domain)
        threading.Thread(target=found.read, daemon=True).start()
        until(lambda: len(found.lines) >= 2 or process.poll() is not None, "the desk's words")
        yield found


class Nodes:
    """One context of the test's, with a node that spins in a thread."""

    def __init__(self, domain: int, name: str = "tester") -> None:
        self._domain, self._name = domain, name

    def __enter__(self) -> Nodes:
        import rclpy
        from rclpy.executors import SingleThreadedExecutor
        from rclpy.signals import SignalHandlerOptions

        self.context = rclpy.Context()
        rclpy.init(
            args=["--ros-args", "--disable-external-lib-logs"],
            context=self.context,
            domain_id=self._domain,
            signal_handler_options=SignalHandlerOptions.NO,
        )
        self.node = rclpy.create_node(self._name, context=self.context)
        self._executor = SingleThreadedExecutor(context=self.context)
        self._executor.add_node(self.node)
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._spin)
        self._thread.start()
        return self

    def _spin(self) -> None:
        while not self._ended.is_set():
            self._executor.spin_once(timeout_sec=0.02)

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._ended.set()
        self._thread.join()
        self._executor.shutdown()
        self.node.destroy_node()
        self.context.try_shutdown()

    def hear(self, cls: Any, topic: str) -> list[Any]:
        """The messages of a topic, as they come."""
        found: list[Any] = []
        self.node.create_subscription(cls, topic, found.append, 10)
        return found

    def listeners(self, topic: str) -> list[str]:
        """The nodes of others that subscribe to a topic."""
        infos = self.node.get_subscriptions_info_by_topic(topic)
        return [info.node_name for info in infos if info.node_name != self._name]
