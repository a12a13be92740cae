"""`test`: what follows it is for pytest."""

from __future__ import annotations

import subprocess
import sys


def test_options_reach_pytest() -> None:
    """Also those that come first, as in `./roslings test -m slow`."""
    words = ["test", "-m", "slow", "--collect-only", "-q", "-n", "0", "tests/experiment"]
    command = [sys.executable, "-m", "roslings", *words]
    ran = subprocess.run(command, capture_output=True, text=True, check=False)
    assert ran.returncode == 0, ran.stderr
    assert "test_clocks.py::test_tricky_nodes" in ran.stdout
    assert "test_what_follows_the_clock" not in ran.stdout


def test_its_help_is_ours() -> None:
    """And says so."""
    command = [sys.executable, "-m", "roslings", "test", "--help"]
    ran = subprocess.run(command, capture_output=True, text=True, check=False)
    assert "options for pytest" in ran.stdout
