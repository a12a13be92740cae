"""Prints how a world in lockstep with nodes does: the same commands, and how long a tick takes.

    python tests/bench/lockstep.py same [RUNS]     of RUNS drives, how many said the same
    python tests/bench/lockstep.py steps [ROUNDS]  wall time a tick, and of a room of 60 s
    python tests/bench/lockstep.py busy [RUNS]     `same`, beside four processes that only compute

A drive is of 10 robot seconds with /clock in steps of 50 ms, and a scan at every tick. "same"
counts the drives whose commands are those of most of them, tick by tick. A "late" tick is one
whose node had no processor, or computed, for more than the budget's half second. It asserts
nothing.
"""

from __future__ import annotations

import platform
import statistics
import subprocess
import sys
from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "packages/roslings/tests/lockstep"))

from lockstep_drives import CREWS, TIMER, driven

from roslings.lockstep import LockstepDrive

RUNS, ROUNDS, BUSY = 20, 5, 4
ROOM_S = 60.0
COMPUTES = "while True: pass"


@contextmanager
def busy(count: int) -> Iterator[None]:
    """So many processes that only compute."""
    words = [sys.executable, "-c", COMPUTES]
    others = [subprocess.Popen(words) for _ in range(count)]
    try:
        yield
    finally:
        for other in others:
            other.kill()
            other.wait()


def print_same(runs: int) -> None:
    """A line for each crew."""
    for name, crew in CREWS.items():
        drives = [driven(crew, scan_every_ticks=1) for _ in range(runs)]
        print(f"{name:6} {alike(drives)}, {of_ticks(drives)}", flush=True)


def alike(drives: Sequence[LockstepDrive]) -> str:
    """How many did as most did; and why others ended."""
    most = Counter(drive.commands for drive in drives).most_common(1)[0][1]
    broken = {f"; {drive.end}: {drive.why}" for drive in drives if drive.end != "done"}
    return f"the same in {most} of {len(drives)}{''.join(sorted(broken))}"


def of_ticks(drives: Sequence[LockstepDrive]) -> str:
    """The middle, the slowest, and how many ticks were late."""
    each_ms = sorted(1e3 * drive.tick_s for drive in drives)
    late = sum(tick.late for drive in drives for tick in drive.ticks)
    return f"{statistics.median(each_ms):.1f} ms a tick (to {each_ms[-1]:.1f}), {late} ticks late"


def print_steps(rounds: int) -> None:
    """A tick of each crew, and a whole room with one node as the rover's scanner turns."""
    for name, crew in CREWS.items():
        drives = [driven(crew, scan_every_ticks=1) for _ in range(rounds)]
        print(f"{name:6} {of_ticks(drives)}; {len(crew.nodes)} nodes", flush=True)
    rooms = [driven(TIMER, length_s=ROOM_S) for _ in range(rounds)]
    middle_s = statistics.median(room.wall_s for room in rooms)
    print(f"a room of {ROOM_S:g} s: {middle_s:.1f} s of wall time, {of_ticks(rooms)}")


def main(what: str, count: int) -> None:
    """One of the three."""
    print(f"Python {platform.python_version()}, {platform.system()} {platform.release()}")
    if what == "steps":
        print_steps(count or ROUNDS)
        return
    with busy(BUSY if what == "busy" else 0):
        print_same(count or RUNS)


if __name__ == "__main__":
    given = sys.argv[1:]
    if not given or given[0] not in ("same", "steps", "busy"):
        sys.exit(__doc__)
    main(given[0], int(given[1]) if given[1:] else 0)
