"""Run as root, or as somebody else, where every user can read the Python that runs these tests."""

from __future__ import annotations

import subprocess
import sys
from functools import cache
from pathlib import Path

AS_ORDINARY = Path(__file__).parents[1] / "rogues" / "as_ordinary.py"


def shown(*command: str) -> list[str]:
    """The command as root, in a view of the disk where nobody's home hides Python."""
    show = ["unshare", "--mount", sys.executable, "-I", "-S", str(AS_ORDINARY), "0"]
    return [*show, sys.prefix, sys.base_prefix, "--", *command]


@cache
def why_not() -> str:
    """Why there can be no user of its own here, even so; empty where there can."""
    source = (
        "from roslings.arena.users import lack_of_users as l; x = l(); print(x.reason if x else '')"
    )
    command = shown(sys.executable, "-c", source)
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    return done.stdout.strip() or done.stderr.strip()
