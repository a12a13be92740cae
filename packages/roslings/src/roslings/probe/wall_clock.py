"""The wall clock beside the monotonic one: the middleware stamps by the first, we by the second."""

from __future__ import annotations

import time

PAIRS = 3


def to_wall_ns() -> int:
    """What a monotonic time lacks to be the wall clock's, now.

    Between a look at the one and a look at the other, a busy computer may keep this thread from
    running for milliseconds. So the closest of some pairs counts.
    """
    return min(_pair() for _ in range(PAIRS))[1]


def _pair() -> tuple[int, int]:
    """How far two looks at the monotonic clock are apart, and the wall clock less the first."""
    before_ns, wall_ns = time.monotonic_ns(), time.time_ns()
    return time.monotonic_ns() - before_ns, wall_ns - before_ns
