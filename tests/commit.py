"""Which commit is tested: where there is no time for all, each begins with others."""

from __future__ import annotations

import subprocess
from pathlib import Path


def newest_commit() -> str:
    """What git calls it; nothing where there is no git."""
    words = ["git", "-C", str(Path(__file__).parent), "rev-parse", "HEAD"]
    return subprocess.run(words, capture_output=True, text=True, check=False).stdout.strip()
