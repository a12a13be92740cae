"""What the middleware is told while our own participant is made, and no node that we start."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from ros2_on_pip.profiles import QUICK_DISCOVERY

QUICK_LOOK = Path(__file__).with_name("quick_look.xml")
"""The names of nodes are asked for as soon as it is known whom to ask; by default 70 ms later."""

FILE = "FASTRTPS_DEFAULT_PROFILES_FILE"


@contextmanager
def quick_look() -> Iterator[None]:
    """Within the block, our own file is that for a look; another one, or none, stays as it is."""
    ours = os.environ.get(FILE) == str(QUICK_DISCOVERY)
    if ours:
        os.environ[FILE] = str(QUICK_LOOK)
    try:
        yield
    finally:
        if ours:
            os.environ[FILE] = str(QUICK_DISCOVERY)
