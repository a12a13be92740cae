"""Prints what the script `./roslings` adds to a command. Asserts nothing.

./roslings check topics --solution    # so that the environment stands
python3 tests/bench/startup.py [RUNS]
"""

from __future__ import annotations

import os
import statistics
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PYTHON = str(ROOT / ".venv/bin/python")


def main() -> int:
    """Three ways to the same word, side by side."""
    if not Path(PYTHON).exists():
        print("There is no environment yet. Next: ./roslings check topics --solution")
        return 2
    runs = int(sys.argv[1]) if len(sys.argv) > 1 else 30
    once = {**os.environ, "_ROS_WHEELS_BOOTSTRAP_COMPLETE": "1"}
    twice = {k: v for k, v in os.environ.items() if k != "_ROS_WHEELS_BOOTSTRAP_COMPLETE"}
    start = [PYTHON, str(ROOT / "src/roslings/bootstrap/start.py"), "--version"]
    script_ms = median_ms([str(ROOT / "roslings"), "--version"], twice, runs)
    started_once_ms = median_ms(start, once, runs)
    started_twice_ms = median_ms(start, twice, runs)
    print(f"./roslings --version                {script_ms:6.1f} ms (median of {runs})")
    print(f"Python alone, started once          {started_once_ms:6.1f} ms")
    print(f"Python alone, as the wheels start it{started_twice_ms:6.1f} ms")
    print(f"the script adds                     {script_ms - started_once_ms:6.1f} ms")
    print(f"and against the wheels' own start   {script_ms - started_twice_ms:6.1f} ms")
    return 0


def median_ms(command: list[str], environment: dict[str, str], runs: int) -> float:
    """Wall time of a command."""
    return statistics.median(once_ms(command, environment) for _ in range(runs))


def once_ms(command: list[str], environment: dict[str, str]) -> float:
    """Wall time of one run."""
    started_s = time.perf_counter()
    subprocess.run(command, env=environment, stdout=subprocess.DEVNULL, check=True)
    return (time.perf_counter() - started_s) * 1000


if __name__ == "__main__":
    sys.exit(main())
