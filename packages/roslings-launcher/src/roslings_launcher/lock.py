"""One `./roslings` at a time changes an environment; the second waits."""

import fcntl
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from roslings_launcher.errors import say


@contextmanager
def locked(file: Path) -> Iterator[None]:
    """Holds `file` until the block ends, or until the last process started in it ends.

    The lock is handed on to pip on purpose: where this process is killed and pip goes on alone,
    the next one waits for it.
    """
    opened = os.open(file, os.O_RDONLY | os.O_CREAT, 0o666)
    os.set_inheritable(opened, True)
    try:
        _wait(opened)
        yield
    finally:
        os.close(opened)


def _wait(opened: int) -> None:
    try:
        fcntl.flock(opened, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        say("Another ./roslings is making this environment: waiting until it is done.")
        fcntl.flock(opened, fcntl.LOCK_EX)
