"""How much memory our processes take, whatever a package does; prints, and asserts nothing.

    .venv/bin/python tests/bench/memory.py [ROGUE ...]

Of the gallery in tests/rogues, those that flood; each is graded by a process of its own, beside an
honest package. The student's nodes are not counted.
"""

from __future__ import annotations

import platform
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "rogues"))

from peaks import Peaks, grade
from rogue import LAB, Attempt, attempts

FLOODS = (
    "rosout_floods-node",
    "megabytes_on_four-node",
    "messages_64_kb-node",
    "messages_50_mb-node",
    "chatters_50_mb",
    "topics_300-node",
    "prints_100_mb-node",
    "graph_with_long_names-node",
    "nodes_200-node",
    "publishes_20_khz-node",
    "chatters_20_khz-node",
)
MB = 1e6


def show(name: str, peaks: Peaks) -> None:
    """One row of the table."""
    dropped = ", ".join(f"{count} {kind}" for kind, count in peaks.dropped.items()) or "-"
    print(
        f"| {name} | {peaks.measuring_bytes / MB:.0f} | {peaks.command_bytes / MB:.0f}"
        f" | {peaks.kept_bytes / MB:.1f} | {dropped} | {peaks.outcome} |",
        flush=True,
    )


def graded(attempt: Attempt) -> Peaks:
    """One rogue."""
    with tempfile.TemporaryDirectory() as folder:
        package = attempt.make(Path(folder) / LAB.card.package, {"mark": "rogue", "token": "rogue"})
        return grade(LAB.name, package)


def main(*names: str) -> None:
    """Print the table."""
    print(f"{platform.platform()}, Python {platform.python_version()}")
    print("| package | MB, measuring | MB, command | MB of evidence | dropped | verdict |")
    print("| --- | --- | --- | --- | --- | --- |")
    show("the solution", grade(LAB.name, LAB.solution))
    for attempt in attempts():
        if attempt.name in (names or FLOODS):
            show(attempt.rogue.name, graded(attempt))


if __name__ == "__main__":
    main(*sys.argv[1:])
