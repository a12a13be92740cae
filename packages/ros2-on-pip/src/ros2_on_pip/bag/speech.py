"""The lines that rosbag2 writes: with a level, a time and a speaker."""

from __future__ import annotations

import sys
import time


def tell(who: str, text: str, level: str = "INFO") -> None:
    """One line in the form of ROS's log."""
    seconds, rest = divmod(time.time_ns(), 10**9)
    print(f"[{level}] [{seconds}.{rest:09d}] [{who}]: {text}", file=sys.stderr, flush=True)
