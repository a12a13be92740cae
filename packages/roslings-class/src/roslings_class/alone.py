"""One command at a time in a folder of results."""

from __future__ import annotations

import fcntl
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path

from roslings_class.errors import BatchError


@contextmanager
def alone_in(folder: Path, taken: Callable[[Path], BatchError]) -> Iterator[None]:
    """Two commands in one folder would grade everything twice.

    Raises what `taken` makes where another command is at work there.
    """
    folder.mkdir(parents=True, exist_ok=True)
    with (folder / ".lock").open("w") as lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            raise taken(folder) from None
        yield
