"""Where the seconds of a grading go: stretches of time, and what each moment belongs to.

Whoever does a part notes it; the judge sums them up.
"""

from __future__ import annotations

import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from itertools import pairwise
from os import sysconf
from pathlib import Path

from roslings.evidence import GradingSpan, Part

FIRST: tuple[Part, ...] = ("building", "watching", "starting", "ending", "reading", "judging")
"""Where several parts go on at once, the moment belongs to the first of these."""

NS_PER_S = 10**9


@contextmanager
def noted(timeline: list[GradingSpan], part: Part, of: str = "") -> Iterator[None]:
    """Write down how long the block took, also where it ends in an error."""
    began_ns = time.monotonic_ns()
    try:
        yield
    finally:
        timeline.append(
            GradingSpan(part=part, of=of, began_ns=began_ns, ended_ns=time.monotonic_ns())
        )


def shares_s(
    timeline: Sequence[GradingSpan], began_ns: int, ended_ns: int
) -> dict[Part | None, float]:
    """Seconds of each part between two moments; None: of no part. They add up to the whole."""
    edges = {edge for span in timeline for edge in (span.began_ns, span.ended_ns)}
    inside = sorted({began_ns, ended_ns, *(e for e in edges if began_ns < e < ended_ns)})
    shares: dict[Part | None, float] = dict.fromkeys((*FIRST, None), 0.0)
    for from_ns, to_ns in pairwise(inside):
        shares[_part_at(timeline, from_ns)] += (to_ns - from_ns) / NS_PER_S
    return shares


def _part_at(timeline: Sequence[GradingSpan], moment_ns: int) -> Part | None:
    now = {span.part for span in timeline if span.began_ns <= moment_ns < span.ended_ns}
    return next((part for part in FIRST if part in now), None)


def process_began_ns() -> int:
    """When this process was started, on the monotonic clock; the shell that became it included.

    From the 22nd field of /proc/self/stat, to a hundredth of a second: proc_pid_stat(5).
    """
    after_name = Path("/proc/self/stat").read_text("utf-8").rpartition(")")[2].split()
    since_boot_s = int(after_name[19]) / sysconf("SC_CLK_TCK")
    age_s = time.clock_gettime(time.CLOCK_BOOTTIME) - since_boot_s
    return time.monotonic_ns() - round(age_s * NS_PER_S)
