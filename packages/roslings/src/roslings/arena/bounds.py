"""What one sandbox may take of this machine, so that the next submission finds it as it was."""

from __future__ import annotations

import os
import platform
from dataclasses import dataclass

MB = 1024 * 1024
COUNTS_BY_NAMESPACE = (5, 14)
"""Since this Linux, RLIMIT_NPROC counts the processes of a user namespace, not all of a user's."""
BUSY_A_PROCESSOR = 8
"""Fewer are busy where a build compiles on each processor, or all nodes of a robot start."""


@dataclass(frozen=True)
class Bounds:
    """Far more than a lab's nodes or its build take, and far less than would hurt."""

    memory_bytes: int = 2048 * MB
    """Of all processes of the sandbox together, their temporary files included."""
    tasks: int = 256
    """Processes and threads; a node of rclpy has about 10."""
    weight: int = 2
    """As many processes as this one's share of busy processors is worth, however many it starts."""
    home_bytes: int = 256 * MB
    files: int = 50_000
    """In its home, /tmp and /dev/shm together; an empty one takes memory of the kernel too."""
    file_bytes: int = 256 * MB
    open_files: int = 1024
    cpu_s: int = 600
    """Of all processes of the sandbox together, in seconds of one processor."""
    busy: int = BUSY_A_PROCESSOR * max(2, os.cpu_count() or 1)
    """Threads that want a processor at once, for longer than a start takes."""

    @property
    def watch(self) -> dict[str, int]:
        """What the guardian watches in every sandbox: who meets these is ended, all of it."""
        return {"memory": self.memory_bytes, "pids": self.tasks, "cpu_s": self.cpu_s}

    def limits(self) -> dict[str, int]:
        """As the guardian gives them to the process: names of the module `resource`."""
        limits = {
            "RLIMIT_FSIZE": self.file_bytes,
            "RLIMIT_NOFILE": self.open_files,
            "RLIMIT_CPU": self.cpu_s,
            "RLIMIT_CORE": 0,
            "RLIMIT_DATA": self.memory_bytes,
        }
        if kernel_counts_by_namespace():
            limits["RLIMIT_NPROC"] = self.tasks
        return limits


def kernel_counts_by_namespace() -> bool:
    """Whether a bound on processes would hold a sandbox, and not the user's whole desktop."""
    words = platform.release().split(".")[:2]
    return all(map(str.isdecimal, words)) and tuple(map(int, words)) >= COUNTS_BY_NAMESPACE
