"""Read a stranger's files in a child that may take so much and no more: it may end, we do not.

It is a fork, which has loaded all that its parent has, so that a package costs milliseconds more.
"""

from __future__ import annotations

import json
import mmap
import os
import resource
import signal
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal, NoReturn

from roslings.arena import kernel
from roslings.arena.bounds import MB
from roslings.workspace import errors
from roslings.workspace.errors import WorkspaceError

NO_MEMORY = 3
"""The child's status where it may have no more; to say it in other ways would take memory."""
LAST_BYTES = 64 * MB
"""One piece that a parser asks for is smaller: then this much at most is free when it fails."""
LONGEST_NAME_BYTES = mmap.PAGESIZE
MEMORY_OF_PROCESS = Path("/proc/self/statm")


@dataclass(frozen=True)
class ReadingBounds:
    """For all files of a package together; an honest one takes a hundredth of it."""

    cpu_s: int = 20
    memory_bytes: int = 256 * MB
    """Besides what the process had before: Python alone, with ROS in it, has more than that."""
    answer_bytes: int = 16 * MB


class Bookmark:
    """Names the file that is being read. Whoever waits sees it, when the reader is gone, too."""

    def __init__(self) -> None:
        self._page = mmap.mmap(-1, LONGEST_NAME_BYTES)

    def put(self, name: str) -> None:
        """This file comes next."""
        text = name.encode("utf-8", "surrogateescape")[: LONGEST_NAME_BYTES - 1]
        self._page[: len(text) + 1] = text + b"\0"

    @property
    def name(self) -> str:
        """The last one; empty where none was begun."""
        return self._page[:].partition(b"\0")[0].decode("utf-8", "replace")


Met = Literal["time", "memory", "crash", ""]
CRASHES = (-signal.SIGSEGV, -signal.SIGBUS, -signal.SIGABRT)
"""So ends who finds no memory in the middle of C: a parser, or Python itself."""


class ReaderEnded(Exception):
    """The child met a bound, or what it read was too much for it in another way."""

    def __init__(self, at: str, met: Met, words: str = "") -> None:
        self.at, self.met, self.words = at, met, words
        super().__init__(f"{at}: {met or words}")


def read_in_child(read: Callable[[Bookmark], str], bounds: ReadingBounds | None = None) -> str:
    """What `read` returns. Raises ReaderEnded, and of what it raises WorkspaceError and OSError."""
    bounds, bookmark = bounds or ReadingBounds(), Bookmark()
    ours, theirs = os.pipe()
    pid = os.fork()
    if pid == 0:
        _live(read, bounds, bookmark, theirs)
    os.close(theirs)
    content, status = _heard(ours, pid, bounds.answer_bytes)
    return _understood(content, status, bookmark.name)


# --- in the child ------------------------------------------------------------------------------


def _live(
    read: Callable[[Bookmark], str], bounds: ReadingBounds, bookmark: Bookmark, answer: int
) -> NoReturn:
    """To its end: nothing of the parent's is closed, flushed or told."""
    status = 1
    try:
        _be_bounded(bounds)
        _write(answer, json.dumps(_told(read, bookmark)).encode())
        status = 0
    except MemoryError:
        status = NO_MEMORY
    finally:
        os._exit(status)


def _be_bounded(bounds: ReadingBounds) -> None:
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, signal.SIG_DFL)
    kernel.die_with_parent()
    _take_at_most(resource.RLIMIT_CORE, 0)
    _take_at_most(resource.RLIMIT_CPU, bounds.cpu_s)
    if MEMORY_OF_PROCESS.is_file():
        _take_at_most(resource.RLIMIT_AS, _address_space_bytes() + bounds.memory_bytes)


def _take_at_most(number: int, most: int) -> None:
    """Who has less already keeps that: nobody may take more than is given."""
    _, given = resource.getrlimit(number)
    least = most if given == resource.RLIM_INFINITY else min(most, given)
    resource.setrlimit(number, (least, least if least == given else least + 1))


def _address_space_bytes() -> int:
    return int(MEMORY_OF_PROCESS.read_text("ascii").split()[0]) * mmap.PAGESIZE


def is_memory_full() -> bool:
    """Whether a MemoryError is meant: Python raises one for what is nested too deeply, too."""
    most, _ = resource.getrlimit(resource.RLIMIT_AS)
    if most == resource.RLIM_INFINITY or not MEMORY_OF_PROCESS.is_file():
        return False
    return peak_bytes() > most - LAST_BYTES


def peak_bytes() -> int:
    """Of the address space: proc(5)."""
    lines = MEMORY_OF_PROCESS.with_name("status").read_text("utf-8", "replace").splitlines()
    return next((int(line.split()[1]) * 1024 for line in lines if line.startswith("VmPeak")), 0)


def _told(read: Callable[[Bookmark], str], bookmark: Bookmark) -> dict[str, Any]:
    """The answer, or what hindered it, as what JSON knows."""
    try:
        return {"answer": read(bookmark)}
    except WorkspaceError as error:
        return {"refused": [type(error).__name__, error.problem, error.next_step]}
    except OSError as error:
        return {"system": [error.errno, error.strerror, str(error.filename or "")]}
    except MemoryError:
        raise
    except Exception as error:  # whatever a parser says of a file that nobody would write
        return {"ended": type(error).__name__}


def _write(descriptor: int, content: bytes) -> None:
    with os.fdopen(descriptor, "wb") as file:
        file.write(content)


# --- in the parent -----------------------------------------------------------------------------


def _heard(ours: int, pid: int, most_bytes: int) -> tuple[bytes, int]:
    """What the child says, and its status at its end; it does not outlive this."""
    try:
        with os.fdopen(ours, "rb") as file:
            content = file.read(most_bytes + 1)
        if len(content) <= most_bytes:
            return content, os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1])
    except BaseException:
        _end(pid)
        raise
    _end(pid)
    return b"", NO_MEMORY


def _end(pid: int) -> None:
    os.kill(pid, signal.SIGKILL)
    os.waitpid(pid, 0)


def _understood(content: bytes, status: int, at: str) -> str:
    if status == NO_MEMORY:
        raise ReaderEnded(at, "memory")
    if status in (-signal.SIGXCPU, -signal.SIGKILL):
        raise ReaderEnded(at, "time")
    if status in CRASHES:
        raise ReaderEnded(at, "crash")
    if status:
        raise ReaderEnded(at, "", f"status {status}")
    return _answer(json.loads(content), at)


def _answer(told: dict[str, Any], at: str) -> str:
    if "refused" in told:
        raise _again(*told["refused"])
    if "system" in told:
        raise OSError(*told["system"])
    if "ended" in told:
        raise ReaderEnded(at, "", told["ended"])
    return str(told["answer"])


def _again(kind: str, problem: str, next_step: str) -> WorkspaceError:
    """The same error in this process."""
    cls = getattr(errors, kind, WorkspaceError)
    error: WorkspaceError = cls.__new__(cls)
    WorkspaceError.__init__(error, problem, next_step)
    return error
