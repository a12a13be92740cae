"""Run a piece of Python in a process that has fewer rights or less room than the tests have."""

from __future__ import annotations

import os
import subprocess
import sys
import textwrap
from collections.abc import Callable
from pathlib import Path

PR_CAPBSET_DROP = 24
CAP_DAC_OVERRIDE, CAP_DAC_READ_SEARCH = 1, 2
WITHOUT_RIGHTS = f"""
import ctypes, os, sys
if os.geteuid() == 0:  # root may read and write everything, unless it gives these two away
    for capability in ({CAP_DAC_OVERRIDE}, {CAP_DAC_READ_SEARCH}):
        if ctypes.CDLL(None, use_errno=True).prctl({PR_CAPBSET_DROP}, capability, 0, 0, 0):
            sys.exit("cannot give rights away")
os.execv(sys.executable, [sys.executable, "-c", *sys.argv[1:]])
"""
Run = Callable[..., str]


def python(command: list[str], source: str, *arguments: Path) -> str:
    """Run a piece of Python behind `command`; what it prints."""
    paths = os.pathsep.join(path for path in sys.path if path)
    done = subprocess.run(
        [*command, textwrap.dedent(source), *map(str, arguments)],
        env={**os.environ, "PYTHONPATH": paths},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout.strip()
