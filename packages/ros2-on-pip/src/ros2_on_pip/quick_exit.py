"""The end of a command that has closed and said all: the process ends at once.

Python would first tidy ROS's libraries away, object by object: 0.12 s, a quarter of `topic list`.
"""

from __future__ import annotations

import os
import sys
from typing import NoReturn


def leave(status: int) -> NoReturn:
    """End this process with `status`; what was printed is out before."""
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(status)
