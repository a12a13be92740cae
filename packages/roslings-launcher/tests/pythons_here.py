"""The Pythons that this machine has."""

from __future__ import annotations

import subprocess
import sys

from skips import skip_without

BASE = getattr(sys, "_base_executable", "") or sys.executable


def find_python(minor: int) -> str:
    """The path of a Python 3.`minor` that runs; skips the test where there is none."""
    from roslings_launcher.seeds import other_pythons

    for python in [BASE, *other_pythons(f"python3.{minor}")]:
        ask = [python, "-c", f"import sys; sys.exit(sys.version_info[:2] != (3, {minor}))"]
        if subprocess.run(ask, capture_output=True, check=False).returncode == 0:
            return python
    skip_without(f"Python 3.{minor}")
    raise AssertionError(f"Python 3.{minor} runs here, and the bootstrap does not find it")
