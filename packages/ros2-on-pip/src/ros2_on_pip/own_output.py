"""Standard output holds what a command prints, and nothing that a library below Python writes.

Fast DDS writes its complaints to the same place, and a script that reads our lines would trip.
"""

from __future__ import annotations

import os
import sys


def keep() -> None:
    """Our own words go on to where they went; what else is written there goes to stderr."""
    sys.stdout.flush()
    ours = os.dup(sys.stdout.fileno())
    os.dup2(sys.stderr.fileno(), sys.stdout.fileno())
    kept = os.fdopen(ours, "w", 1, encoding=sys.stdout.encoding, errors=sys.stdout.errors)
    sys.stdout = kept
