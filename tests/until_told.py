"""A live verdict is asked for again while nobody can tell, and never because it is wrong.

A busy machine may keep a verdict back, and says so: that is what a student is told to do then, and
what `prove` and `grade` do by themselves. Every test that holds one to a score asks here.
"""

from __future__ import annotations

import json
import shutil
import subprocess
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, TypeVar

from ros2_on_pip.errors import INCONCLUSIVE

MOST_TRIES = 3
OPEN = "Not everything could be told"
"""On the screen of a verdict that is none."""
Told = TypeVar("Told")


def until_told(ask: Callable[[], Told], is_open: Callable[[Told], bool]) -> Told:
    """The first answer that is one; the last of `MOST_TRIES` where none is."""
    for _ in range(MOST_TRIES):
        told = ask()
        if not is_open(told):
            break
    return told


def is_open(ran: subprocess.CompletedProcess[str]) -> bool:
    """By its exit code it could not tell."""
    return ran.returncode == INCONCLUSIVE


def run_until_told(
    words: Sequence[str | Path], kept: Path | None = None, **how: Any
) -> subprocess.CompletedProcess[str]:
    """Any command that ends with the exit codes of `check`; `how` is subprocess.run()'s.

    `kept` is the folder that it makes, and refuses to make twice.
    """
    captured = {"capture_output": True, "text": True, "check": False, **how}

    def ask() -> subprocess.CompletedProcess[str]:
        if kept:
            shutil.rmtree(kept, ignore_errors=True)
        return subprocess.run([*map(str, words)], **captured)

    return until_told(ask, is_open)


@dataclass(frozen=True)
class Checked:
    """What came of `check`."""

    ran: subprocess.CompletedProcess[str]
    verdict: dict[str, Any]

    @property
    def status(self) -> int:
        """Its exit code."""
        return self.ran.returncode

    def outcomes(self, outcome: str) -> list[str]:
        """The checks that came to it."""
        return [each["id"] for each in self.verdict["checks"] if each["outcome"] == outcome]


ROSLINGS = ("-m", "roslings")
"""What Python runs as `./roslings`."""


def checked(
    lab: str,
    *words: str | Path,
    folder: Path,
    roslings: Sequence[str | Path] = ROSLINGS,
    **how: Any,
) -> Checked:
    """`./roslings check LAB WORDS` in a folder, which gets the verdict's file."""
    file = folder / "verdict.json"
    command = [sys.executable, *roslings, "check", lab, *words, "--json", file]
    ran = run_until_told(command, **{"cwd": folder, **how})
    assert file.is_file(), ran.stderr
    return Checked(ran, json.loads(file.read_text("utf-8")))
