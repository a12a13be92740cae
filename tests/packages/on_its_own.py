"""A package's tests, in an environment that has what it says that it needs and no other of ours.

A file for each package, so that the gate chooses among them by what each of them reads
(`tests/needed/choice.py`): the package, those below it, and its tests.
"""

from __future__ import annotations

import subprocess
import sys

from sources import ROOT


def passes_alone(name: str) -> None:
    """As `./roslings test NAME` does it: all pass, and there are some."""
    command = [sys.executable, str(ROOT / "tests/alone.py"), name, "-q", "--no-header"]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout[-10_000:] + done.stderr[-2_000:]
    assert " passed" in done.stdout.splitlines()[-1]
