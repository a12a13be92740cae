"""Prints what the short commands take, and what the script `./roslings` adds. Asserts nothing.

./roslings check topics --solution    # so that the environment stands
python3 tests/bench/startup.py [RUNS]

Each command is measured in turn with Python alone (`python -c pass`) and with `--help`: a busy
computer makes all of them slow, and the ratios stay.
"""

from __future__ import annotations

import os
import resource
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PYTHON = str(ROOT / ".venv/bin/python")
SCRIPT = str(ROOT / "roslings")
START = [
    PYTHON,
    str(ROOT / "packages/roslings-launcher/src/roslings_launcher/start.py"),
    "--version",
]
COMMANDS = {
    "python -c pass": [PYTHON, "-c", "pass"],
    "start.py --version": START,
    "--version": [SCRIPT, "--version"],
    "--help": [SCRIPT, "--help"],
    "./roslings": [SCRIPT],
    "status": [SCRIPT, "status"],
    "start, begun already": [SCRIPT, "start", "topics"],
    "diff": [SCRIPT, "diff", "topics"],
    "check --hint": [SCRIPT, "check", "topics", "--hint"],
}
"""The last ones in a workspace in which the starter was checked once."""


def main() -> int:
    """A line a command: wall and CPU, and both over Python alone and over `--help`."""
    if not Path(PYTHON).exists():
        print("There is no environment yet. Next: ./roslings check topics --solution")
        return 2
    runs = int(sys.argv[1]) if len(sys.argv) > 1 else 30
    with tempfile.TemporaryDirectory() as workspace:
        environment = {**os.environ, "ROSLINGS_WS": workspace}
        environment.pop("_ROS_WHEELS_BOOTSTRAP_COMPLETE", None)
        for words in (["start", "topics"], ["check", "topics"]):
            subprocess.run(
                [SCRIPT, *words], env=environment, stdout=subprocess.DEVNULL, check=False
            )
        show({name: [] for name in COMMANDS}, environment, runs)
    return 0


def show(
    taken: dict[str, list[tuple[float, float]]], environment: dict[str, str], runs: int
) -> None:
    """Run all in turn, so often, and print the medians."""
    for _ in range(runs):
        for name, command in COMMANDS.items():
            taken[name].append(once_ms(command, environment))
    medians = {
        name: tuple(map(statistics.median, zip(*all_, strict=True))) for name, all_ in taken.items()
    }
    (bare, bare_cpu), (asked, asked_cpu) = medians["python -c pass"], medians["--help"]
    print(f"{'':22}{'ms':>7}{'CPU ms':>8}{'/ pass':>8}{'/ help':>8}{'CPU / pass':>12}{'/ help':>8}")
    for name, (wall, cpu) in medians.items():
        print(
            f"{name:22}{wall:7.0f}{cpu:8.0f}{wall / bare:8.1f}{wall / asked:8.1f}"
            f"{cpu / bare_cpu:12.1f}{cpu / asked_cpu:8.1f}"
        )
    adds = medians["--version"][0] - medians["start.py --version"][0]
    print(f"the script adds {adds:.1f} ms (median of {runs} each)")


def once_ms(command: list[str], environment: dict[str, str]) -> tuple[float, float]:
    """Wall and CPU time of one run."""
    before, began_s = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    quiet = subprocess.DEVNULL
    subprocess.run(command, env=environment, stdout=quiet, stderr=quiet, check=False)
    wall_s = time.perf_counter() - began_s
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu_s = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return wall_s * 1000, cpu_s * 1000


if __name__ == "__main__":
    sys.exit(main())
