"""Real kernels for the tests: what a cell prints, shows and raises."""

from __future__ import annotations

import os
import re
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from jupyter_client.kernelspec import KernelSpecManager
from jupyter_client.manager import KernelManager

from ros2_on_pip.domain_lease import leased_domain
from roslings_learn.jupyter.server import KERNEL, write_kernel
from sources import python_path

PATIENCE_S = 60.0
"""Only a test that fails waits so long."""

FORGOTTEN = ("PYTEST_CURRENT_TEST", "ROS_AUTOMATIC_DISCOVERY_RANGE", "ROS_DOMAIN_ID", "ROSLINGS_WS")


@dataclass
class Ran:
    """What a cell did."""

    text: str = ""
    shown: list[dict[str, Any]] = field(default_factory=list)
    error: str = ""
    """The name of the exception; empty where there was none."""
    said: str = ""
    """The error's text."""
    trace: list[str] = field(default_factory=list)

    @property
    def told(self) -> str:
        """The error as the student sees it, without colours."""
        return re.sub(r"\x1b\[[0-9;]*m", "", "\n".join(self.trace))


class Kernel:
    """A kernel, and its cells one after the other."""

    def __init__(self, folder: Path, **variables: str) -> None:
        kept = {key: value for key, value in os.environ.items() if key not in FORGOTTEN}
        names = {
            "HOME": str(folder),
            "IPYTHONDIR": str(folder),
            "PYTHONPATH": python_path(),
            "XDG_CACHE_HOME": str(Path("~/.cache").expanduser()),  # matplotlib's list of fonts
        }
        self.manager = KernelManager(
            kernel_name=KERNEL,
            kernel_spec_manager=_specs(folder),
            connection_file=str(folder / f"connection-{time.monotonic_ns()}.json"),
        )
        self.manager.start_kernel(
            cwd=str(folder), env={**kept, **names, "ROSLINGS_WS": str(folder / "ws"), **variables}
        )
        self._client = self.manager.client()
        self._client.start_channels()
        self._client.wait_for_ready(timeout=PATIENCE_S)

    def run(self, code: str) -> Ran:
        """Run a cell to its end."""
        return self.result_of(self.begin(code))

    def begin(self, code: str) -> str:
        """Begin a cell; returns its id."""
        return str(self._client.execute(code))

    def result_of(self, cell: str) -> Ran:
        """Wait for the end of a cell."""
        ran = Ran()
        while True:
            message = self._client.get_iopub_msg(timeout=PATIENCE_S)
            if message["parent_header"].get("msg_id") != cell:
                continue
            if not _take(ran, message["msg_type"], message["content"]):
                return ran

    def wait_for(self, text: str) -> None:
        """Wait until the running cell has printed `text`."""
        while True:
            message = self._client.get_iopub_msg(timeout=PATIENCE_S)
            if text in message["content"].get("text", ""):
                return

    def end(self) -> None:
        """No kernel is left."""
        self._client.stop_channels()
        self.manager.shutdown_kernel(now=True)


def _specs(folder: Path) -> KernelSpecManager:
    import sys

    prefix = folder / "prefix"
    (prefix / "bin").mkdir(parents=True, exist_ok=True)
    if not (prefix / "bin" / "python").exists():
        python = prefix / "bin" / "python"
        python.write_text(f'#!/bin/sh\nexec "{sys.executable}" "$@"\n', encoding="utf-8")
        python.chmod(0o755)
    write_kernel(prefix, prefix)
    return KernelSpecManager(kernel_dirs=[str(prefix / "share" / "jupyter" / "kernels")])


def _take(ran: Ran, kind: str, content: dict[str, Any]) -> bool:
    """Whether more is to come."""
    if kind == "stream":
        ran.text += content["text"]
    elif kind in ("display_data", "execute_result"):
        ran.shown.append(content["data"])
    elif kind == "error":
        ran.error, ran.said, ran.trace = content["ename"], content["evalue"], content["traceback"]
    return not (kind == "status" and content["execution_state"] == "idle")


def free_domain() -> str:
    """A domain where nobody is; the kernel leases it itself."""
    with leased_domain() as domain:
        return str(domain)


@contextmanager
def kernel(folder: Path, **variables: str) -> Iterator[Kernel]:
    """A kernel on a domain of its own, with the names of a lesson imported."""
    opened = Kernel(folder, **{"ROS_DOMAIN_ID": free_domain(), **variables})
    try:
        opened.run(IMPORTS)
        yield opened
    finally:
        opened.end()


IMPORTS = """
from roslings_learn.notebook import *
import os, threading, time
from rclpy.node import Node
from std_msgs.msg import Int32, String
from std_srvs.srv import Trigger
class Talker(Node):
    def __init__(self, text="hi"):
        super().__init__("talker")
        self.declare_parameter("period", 0.02)
        self.publisher = self.create_publisher(String, "words", 10)
        self.text, self.number = text, 0
        self.create_timer(self.get_parameter("period").value, self.tell)
    def tell(self):
        self.number += 1
        self.publisher.publish(String(data=f"{self.text} {self.number}"))
"""

__all__ = ["Kernel", "Ran", "free_domain", "kernel"]
