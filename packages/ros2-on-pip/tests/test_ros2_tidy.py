"""What these tests start does not outlive them, however pytest ends."""

from __future__ import annotations

import os
import signal
import sys
from pathlib import Path

import pytest
from launch_shop import is_gone
from terminal import HERE, Shell, eventually

from sources import ROOT

pytestmark = pytest.mark.slow

SUITE = """
import os, sys, time
from pathlib import Path
from terminal import Running
node = Running([sys.executable, "-c", "import time; time.sleep(600)"], dict(os.environ), Path("/"))
print(node.process.pid, flush=True)
time.sleep(600)
"""


def test_what_a_suite_has_started_ends_with_it(empty: Shell, tmp_path: Path) -> None:
    """Terminated, as by a time limit, pytest runs no fixture to its end."""
    path = os.pathsep.join([empty.environment["PYTHONPATH"], str(HERE), str(ROOT / "tests")])
    with empty.program([sys.executable, "-c", SUITE], PYTHONPATH=path) as suite:
        suite.wait_for(r"^\d+$")
        node = int(suite.lines[-1])
        assert Path(f"/proc/{node}").exists()
        suite.process.send_signal(signal.SIGTERM)
        suite.wait()
        eventually(lambda: is_gone(node))
