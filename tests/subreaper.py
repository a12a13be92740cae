"""Nothing that a test run has started outlives it, also where the run is killed.

Two more processes stand above the tests. What loses its parent becomes a child of theirs
(PR_SET_CHILD_SUBREAPER), so when the tests have ended, all that is left is found and ended. They
are two because one of them may be killed as well: the other one is still there.
"""

from __future__ import annotations

import ctypes
import os
import signal
import sys
from contextlib import suppress
from pathlib import Path
from typing import NoReturn

import pytest

PLUGIN = "subreaper-of-tests"
PR_SET_PDEATHSIG, PR_SET_CHILD_SUBREAPER = 1, 36
ENDS = (signal.SIGTERM, signal.SIGHUP)
WATCHED = (signal.SIGCHLD, signal.SIGINT, *ENDS)
LOOK_AGAIN_S = 0.05


def leave_nothing_behind(config: pytest.Config) -> None:
    """The tests go on below two processes more, once.

    A worker of pytest-xdist has threads, which no fork takes along, and is below them already.
    """
    if hasattr(config, "workerinput") or config.pluginmanager.has_plugin(PLUGIN):
        return
    config.pluginmanager.register(sys.modules[__name__], PLUGIN)
    go_below()


def go_below() -> None:
    """Go on as a grandchild of this process, which waits, ends what is left, and ends alike."""
    for when_killed in (signal.SIGTERM, signal.SIGKILL):
        parent = os.getpid()
        sys.stdout.flush()
        sys.stderr.flush()
        if child := os.fork():
            _stand_above(child)
        ctypes.CDLL(None).prctl(PR_SET_PDEATHSIG, when_killed, 0, 0, 0)
        if os.getppid() != parent:  # it ended before we could ask for that
            os._exit(1)


def _stand_above(child: int) -> NoReturn:
    signal.pthread_sigmask(signal.SIG_BLOCK, WATCHED)
    ctypes.CDLL(None).prctl(PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0)
    status = _status_of(child)
    end_descendants()
    _end_like(status)


def _status_of(child: int) -> int:
    """As os.waitpid() tells it, when it has ended; or the signal by which we are to end."""
    while (status := _reaped(child)) is None:
        told = signal.sigwaitinfo(WATCHED)
        if told.si_signo in ENDS:
            return told.si_signo
        if told.si_signo == signal.SIGINT and told.si_pid:  # a terminal's Ctrl-C went to all of us
            os.kill(child, signal.SIGINT)
    return status


def _reaped(child: int) -> int | None:
    """Take the end of each that has ended; the child's own, where it is among them."""
    with suppress(ChildProcessError):
        while (ended := os.waitpid(-1, os.WNOHANG))[0]:
            if ended[0] == child:
                return ended[1]
    return None


def end_descendants() -> None:
    """Kill what is below this process, until nothing is that may be killed."""
    while any([_killed(pid) for pid in descendants(os.getpid())]):
        signal.sigtimedwait({signal.SIGCHLD}, LOOK_AGAIN_S)
        _reaped(os.getpid())


def _killed(pid: int) -> bool:
    with suppress(OSError):  # it has just ended, or it is another user's
        os.kill(pid, signal.SIGKILL)
        return True
    return False


def descendants(ancestor: int) -> set[int]:
    """Every process below one, as long as it lives."""
    parents = dict(filter(None, map(_parent_of, Path("/proc").glob("[0-9]*"))))
    found, fresh = set[int](), {ancestor}
    while fresh := {pid for pid, parent in parents.items() if parent in fresh}:
        found |= fresh
    return found


def _parent_of(process: Path) -> tuple[int, int] | None:
    try:
        state, parent = (process / "stat").read_text("utf-8").rpartition(")")[2].split()[:2]
    except OSError:
        return None
    return None if state == "Z" else (int(process.name), int(parent))


def _end_like(status: int) -> NoReturn:
    """With its exit code, or by its signal."""
    if os.WIFSIGNALED(status):
        number = os.WTERMSIG(status)
        with suppress(OSError):  # SIGKILL has no handler
            signal.signal(number, signal.SIG_DFL)
        signal.pthread_sigmask(signal.SIG_UNBLOCK, {number})
        os.kill(os.getpid(), number)
    os._exit(os.waitstatus_to_exitcode(status) % 256)
