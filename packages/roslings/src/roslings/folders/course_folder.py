"""Where the course lies, and where this engine lies."""

from __future__ import annotations

import os
from pathlib import Path


def root() -> Path:
    """The course's folder: the clone this engine lies in, or `ROSLINGS_COURSE`."""
    return Path(os.environ.get("ROSLINGS_COURSE") or engine_root()).absolute()


def engine_root() -> Path:
    """The folder that this engine lies in: a clone, unless it came by pip."""
    return Path(__file__).parents[5]
