"""The place of hidden checks does not stand in the list of processes."""

from __future__ import annotations

import subprocess
import sys

import pytest

ASKS = """
import sys
from pathlib import Path
import roslings_launcher.cli as cli
def command(options):
    print(Path("/proc/self/cmdline").read_bytes().replace(b"\\0", b" ").decode())
    print(options.hidden.name, sys.argv[-1])
    return 0
cli.run = lambda _, options: command(options)
sys.exit(cli.main(sys.argv[1:]))
"""


@pytest.mark.parametrize("words", [["--hidden", "/exam/se cret.py"], ["--hidden=/exam/se cret.py"]])
def test_hidden_checks_are_not_listed(words: list[str]) -> None:
    """The command knows its words; whoever lists processes sees all but this one."""
    asks = [sys.executable, "-c", ASKS, "check", "topics", *words, "--all"]
    done = subprocess.run(asks, capture_output=True, text=True, check=True)
    *listed, known = done.stdout.splitlines()
    assert not [line for line in listed if "se cret" in line]
    assert "check topics" in listed[-1] and listed[-1].rstrip().endswith("--all")
    assert known == "se cret.py --all"
