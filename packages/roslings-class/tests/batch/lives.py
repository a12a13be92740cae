"""What processes of a worker pool do in these tests: answer, hang, break off."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import time

from roslings.report.whole_file import write_whole
from roslings_class.grading import main as grading
from roslings_class.result import GradingOrder, GradingResult


def by_name(order: GradingOrder) -> None:
    """The submission's name says what to do."""
    verb = order.submission.partition("-")[0]
    {
        "refuse": refuse,
        "hang": hang,
        "raise": fail,
        "vanish": vanish,
        "grade": grading,
        "busy": busy,
    }[verb](order)


def refuse(order: GradingOrder) -> None:
    """Answer at once."""
    _answer(order, "refused")


def busy(order: GradingOrder) -> None:
    """Unclear at the first try; the second is clear, and notes who works beside it."""
    rooms = len(list(order.room.parent.iterdir()))
    _answer(order, "broken" if order.attempt == 1 else "refused", f"{rooms} at work")


def hang(order: GradingOrder) -> None:
    """Start a process, ignore SIGTERM and never end."""
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    child = subprocess.Popen([sys.executable, "-c", "import time; time.sleep(600)"])
    (order.path.parent / "hangs").write_text(f"{os.getpid()} {child.pid}")
    time.sleep(600)


def fail(order: GradingOrder) -> None:
    """Break off with a traceback."""
    raise OSError("the disk is on fire")


def vanish(order: GradingOrder) -> None:
    """Killed from outside."""
    os.kill(os.getpid(), signal.SIGKILL)


def _answer(order: GradingOrder, state: str, reason: str = "because") -> None:
    result = GradingResult.model_validate(
        {
            "submission": order.submission,
            "digest": order.digest,
            "attempt": order.attempt,
            "state": state,
            "reason": reason,
        }
    )
    write_whole(order.answer, result.model_dump_json().encode())
