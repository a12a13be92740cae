"""How much memory a grading takes: of the command and of its measuring process, not of the nodes.

    python peaks.py LAB PACKAGE

prints what came of it as JSON. It is a process of its own, so that its peak is that of one grading.
"""

from __future__ import annotations

import json
import subprocess
import sys
import threading
import time
from dataclasses import asdict, dataclass
from multiprocessing import active_children
from pathlib import Path

from roslings.course import lab
from roslings.experiment import MeasuringOptions, measuring_process
from roslings.judge import judge
from roslings.workspace.inspect import inspect_package

LOOK_EVERY_S = 0.01


@dataclass(frozen=True)
class Peaks:
    """One grading: the most memory that each of our processes held, and what was said."""

    command_bytes: int
    measuring_bytes: int
    outcome: str
    outcomes: dict[str, str]
    """Check to outcome."""
    why: dict[str, str]
    """Inconclusive check to its reason."""
    dropped: dict[str, int]
    """Kind to how much, in all experiments."""
    kept_bytes: int
    """Of the evidence, as JSON."""


def peak_bytes(process: int | str) -> int:
    """The most memory that a process has held so far (VmHWM); 0 when it is gone."""
    try:
        status = Path(f"/proc/{process}/status").read_text("ascii")
    except OSError:
        return 0
    lines = (line.split() for line in status.splitlines())
    return next((int(words[1]) * 1024 for words in lines if words[0] == "VmHWM:"), 0)


class Watched:
    """The memory of a process, looked at from now on until it is gone."""

    def __init__(self, process: int) -> None:
        self.peak = peak_bytes(process)
        threading.Thread(target=self._look, args=(process,), daemon=True).start()

    def _look(self, process: int) -> None:
        while now := peak_bytes(process):
            self.peak = max(self.peak, now)
            time.sleep(LOOK_EVERY_S)


def grade_here(name: str, package: Path) -> Peaks:
    """Measure and judge in this process."""
    from roslings.evidence import evidence_json

    one = lab(name)
    files = inspect_package(package, one.card)
    with measuring_process(one.name, MeasuringOptions(seed=1)) as begun:
        (process,) = active_children()
        measured = Watched(process.pid or 0)
        evidence = begun.measure(package, files, lambda step: None)
    verdict = judge(one, evidence)
    peak = peak_bytes("self")
    dropped: dict[str, int] = {}
    for each in (each for seen in evidence.experiments.values() for each in seen.dropped):
        dropped[each.kind] = dropped.get(each.kind, 0) + each.count
    return Peaks(
        command_bytes=peak,
        measuring_bytes=measured.peak,
        outcome=verdict.outcome,
        outcomes={check.id: check.outcome for check in verdict.checks},
        why={c.id: str(c.why) for c in verdict.checks if c.outcome == "inconclusive"},
        dropped=dropped,
        kept_bytes=len(evidence_json(evidence)),
    )


def grade(name: str, package: Path) -> Peaks:
    """Measure and judge in a fresh process."""
    command = [sys.executable, __file__, name, str(package)]
    told = subprocess.run(command, stdout=subprocess.PIPE, check=True)
    return Peaks(**json.loads(told.stdout))


if __name__ == "__main__":
    print(json.dumps(asdict(grade_here(sys.argv[1], Path(sys.argv[2])))))
