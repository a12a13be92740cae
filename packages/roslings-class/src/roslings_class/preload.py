"""Load once, before the first grading, what all gradings of a lab need."""

from __future__ import annotations

import gc
from functools import cache
from pathlib import Path

from roslings.experiment.preload import load_beforehand
from roslings.judge.preload import load_judge
from roslings_class.version import engine_version


@cache
def load_all(name: str, hidden: Path | None = None) -> None:
    """Load what measuring and judging need, so that every fork has it."""
    load_beforehand(name, hidden)
    load_judge(name, hidden)
    engine_version()
    gc.collect()
    gc.freeze()  # what is shared stays shared
