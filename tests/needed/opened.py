"""Which files of a clone are opened: the kernel tells (inotify), whichever process it is.

A hook in Python sees no shell, no compiler, no process with a cleared environment and none behind a
wall. inotify sees an open of the file itself, also where it is mounted in another place.

It does not see who looked for a file and found none. What it tells of a folder is that somebody
opened it, as everybody does who lists it.
"""

from __future__ import annotations

import ctypes
import errno
import os
import re
import select
import struct
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from pathlib import Path
from threading import Thread
from types import TracebackType

IN_OPEN, IN_CREATE, IN_ISDIR, IN_Q_OVERFLOW = 0x20, 0x100, 0x40000000, 0x4000
IN_CLOSE_WRITE, IN_MOVED_TO, IN_DELETE, IN_MOVED_FROM = 0x8, 0x80, 0x200, 0x40
CHANGED = IN_CLOSE_WRITE | IN_MOVED_TO | IN_MOVED_FROM | IN_DELETE
WATCHED = IN_OPEN | IN_CREATE | CHANGED
HEAD = struct.Struct("iIII")
"""struct inotify_event: watch, mask, cookie, and how many bytes of a name follow."""
READ_BYTES = 1 << 20
BYTECODE = re.compile(r"(?:(?P<folder>.+)/)?__pycache__/(?P<module>[^./]+)\.cpython-3\d+[^/]*\.pyc")


class CannotWatch(Exception):
    """The kernel refuses, or it has forgotten some of what it saw."""


@dataclass(frozen=True)
class Opened:
    """What was opened of a folder, by names in it."""

    files: frozenset[str]
    """By their own name."""
    modules: frozenset[str]
    """Python files whose bytecode was read in their place."""
    folders: frozenset[str]
    changed: frozenset[str]
    """Files that were written, moved or taken away."""


@dataclass
class Watch:
    """Sees what is opened of these folders while its block runs; then `opened` tells it."""

    root: Path
    folders: Iterable[str]
    """By their names in `root`, which itself is the empty one."""
    _names: dict[int, str] = field(default_factory=dict)
    _seen: set[tuple[int, int, str]] = field(default_factory=set)

    def __enter__(self) -> Watch:
        self._libc = ctypes.CDLL(None, use_errno=True)
        self._told = self._libc.inotify_init1(os.O_NONBLOCK | os.O_CLOEXEC)
        if self._told < 0:
            raise CannotWatch(f"inotify: {os.strerror(ctypes.get_errno())}")
        self._over, self._end = os.pipe2(os.O_CLOEXEC)
        for name in self.folders:
            self._add(name)
        self._thread = Thread(target=self._read_to_the_end, daemon=True)
        self._thread.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        os.close(self._end)
        self._thread.join()
        os.close(self._told)
        os.close(self._over)

    def _add(self, name: str) -> None:
        """What went away meanwhile needs no watch."""
        place = os.fsencode(self.root / name)
        watch = self._libc.inotify_add_watch(self._told, place, WATCHED)
        if watch >= 0:
            self._names[watch] = name
        elif ctypes.get_errno() not in (errno.ENOENT, errno.ENOTDIR):
            raise CannotWatch(f"inotify, {name or '.'}: {os.strerror(ctypes.get_errno())}")

    def _read_to_the_end(self) -> None:
        """All that stands in the queue when the block ends was done in it."""
        is_over = False
        while not is_over:
            ready, _, _ = select.select([self._told, self._over], [], [])
            is_over = self._over in ready
            self._read_all()

    def _read_all(self) -> None:
        while True:
            try:
                events = os.read(self._told, READ_BYTES)
            except BlockingIOError:
                return
            for event in _events(events):
                self._note(event)

    def _note(self, event: tuple[int, int, str]) -> None:
        """Bytecode may be written for the first time meanwhile, into a new folder."""
        self._seen.add(event)
        watch, mask, name = event
        if mask & IN_CREATE and mask & IN_ISDIR and name == "__pycache__":
            self._add(_joined(self._names[watch], name))

    def opened(self) -> Opened:
        """All that was seen, when the block is over. Raises CannotWatch."""
        if any(mask & IN_Q_OVERFLOW for _, mask, _ in self._seen):
            raise CannotWatch("the kernel's queue was too short: so much was opened at once")
        return Opened(
            files=frozenset(self._named(IN_OPEN)),
            modules=frozenset(filter(None, map(module_of, self._named(IN_OPEN)))),
            folders=frozenset(
                self._names[watch]
                for watch, mask, name in self._seen
                if mask & IN_OPEN and mask & IN_ISDIR and not name
            ),
            changed=frozenset(self._named(CHANGED)),
        )

    def _named(self, kinds: int) -> Iterator[str]:
        for watch, mask, name in self._seen:
            if mask & kinds and not mask & IN_ISDIR and name:
                yield _joined(self._names[watch], name)


def _events(told: bytes) -> Iterator[tuple[int, int, str]]:
    place = 0
    while place < len(told):
        watch, mask, _, length = HEAD.unpack_from(told, place)
        place += HEAD.size + length
        yield watch, mask, os.fsdecode(told[place - length : place].rstrip(b"\0"))


def _joined(folder: str, name: str) -> str:
    return f"{folder}/{name}" if folder else name


def module_of(name: str) -> str | None:
    """The source of some bytecode; None where it is none."""
    found = BYTECODE.fullmatch(name)
    return _joined(found["folder"] or "", f"{found['module']}.py") if found else None
