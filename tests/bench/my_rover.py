"""My rover of all its parts: until it is ready, and what it takes while it drives.

    .venv/bin/python tests/bench/my_rover.py [ROUNDS]

The parts are the labs' solutions, built before. Prints the seconds from Enter to a map, of all
parts and of the voice alone; then processors and memory of all its processes, for 20 s.
"""

from __future__ import annotations

import os
import re
import shutil
import signal
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from ros2_on_pip.domain_lease import leased_domain
from roslings.course import lab
from roslings_my_rover.parts import PARTS, VOICE, RoverPart

WATCHED_S = 20.0
READY = "The rover is ready"
TICKS_A_SECOND = os.sysconf("SC_CLK_TCK")


def put(workspace: Path, parts: tuple[RoverPart, ...]) -> None:
    """The solutions of these labs as a student's packages."""
    shutil.rmtree(workspace / "src", ignore_errors=True)
    for part in parts:
        own = lab(part.lab)
        shutil.copytree(own.solution, workspace / "src" / own.outline.package)


@contextmanager
def running(workspace: Path) -> Iterator[tuple[subprocess.Popen[str], float]]:
    """The rover, and the seconds until it was ready."""
    with leased_domain() as domain:
        began_s = time.monotonic()
        process = subprocess.Popen(
            [sys.executable, "-m", "roslings", "my-rover", "--view", "lines"],
            env={
                **os.environ,
                "ROS_DOMAIN_ID": str(domain),
                "ROSLINGS_WS": str(workspace),
                "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
            },
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            text=True,
            start_new_session=True,
        )
        assert process.stdout
        for line in process.stdout:
            if line.startswith(READY):
                break
        try:
            yield process, time.monotonic() - began_s
        finally:
            process.send_signal(signal.SIGINT)
            process.communicate()


def family(pid: int) -> list[int]:
    """It and all that descend from it."""
    found = [pid]
    for each in found:
        for task in Path(f"/proc/{each}/task").glob("*/children"):
            found += map(int, task.read_text().split())
    return found


def cpu_s(pids: list[int]) -> float:
    """Seconds of a processor that these have used."""
    stats = (Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split() for pid in pids)
    return sum(int(stat[11]) + int(stat[12]) for stat in stats) / TICKS_A_SECOND


def pss_mb(pids: list[int]) -> float:
    """What they hold, each shared page once."""
    texts = (Path(f"/proc/{pid}/smaps_rollup").read_text() for pid in pids)
    return sum(int(re.findall(r"^Pss: +(\d+)", text, re.M)[0]) for text in texts) / 1024


def main(rounds: int) -> None:
    """Print the figures."""
    with tempfile.TemporaryDirectory() as folder:
        workspace = Path(folder)
        for name, parts in (("all parts", PARTS), ("the voice alone", (VOICE,))):
            put(workspace, parts)
            with running(workspace):
                pass  # built from now on
            ready_s = []
            for _ in range(rounds):
                with running(workspace) as (process, seconds):
                    ready_s.append(seconds)
                    if parts == PARTS and len(ready_s) == rounds:
                        watch(process.pid)
            print(
                f"{name}: ready in {statistics.median(ready_s):.1f} s, median of {rounds}"
                f" ({min(ready_s):.1f} to {max(ready_s):.1f})"
            )


def watch(pid: int) -> None:
    """The processors and the memory of a rover that has been running for a moment."""
    time.sleep(3.0)
    pids = family(pid)
    before_s, began_s = cpu_s(pids), time.monotonic()
    time.sleep(WATCHED_S)
    share = (cpu_s(pids) - before_s) / (time.monotonic() - began_s)
    print(f"{len(pids)} processes: {share:.2f} of one core, {pss_mb(pids):.0f} MB")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 5)
