"""Prints the doctor's figures: time of the whole run and of each check, and what it covers.

    python tests/bench/doctor.py [PYTHON_WITH_ROS]

The first figure is a fresh process with a bare Python (`-S`) and a copy of the course that has no
environment, so no ROS; the second, with the Python that is given, or this one, on this course.
It asserts nothing. Measure on an idle machine.
"""

from __future__ import annotations

import json
import os
import shutil
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2] / "packages/ros-doctor/src"
RUNS = 7
ROWS = 30


def run(python: str, *flags: str, **env: str) -> tuple[float, str]:
    """Return the seconds that one whole run takes, and what it printed."""
    start = time.monotonic()
    done = subprocess.run(
        [python, *flags, "-m", "ros_doctor", "--json"],
        env={"PATH": os.environ["PATH"], "HOME": "/nonexistent", **env},
        cwd=os.sep,
        capture_output=True,
        text=True,
        check=False,
    )
    return time.monotonic() - start, done.stdout


def show(name: str, source: Path, python: str, *flags: str) -> str:
    """Print the median of some runs; return the last output."""
    path = f"{Path(python).parent}{os.pathsep}{os.environ['PATH']}"
    runs = [run(python, *flags, PATH=path, PYTHONPATH=str(source)) for _ in range(RUNS)]
    times = sorted(seconds for seconds, _ in runs)
    median = statistics.median(times)
    print(f"{name:<24}{median:6.2f} s   ({times[0]:.2f} to {times[-1]:.2f}, {RUNS} runs)")
    return runs[-1][1]


def show_checks(output: str) -> None:
    """Print the time of each check, slowest first, and the sum of the quick ones."""
    checks = sorted(json.loads(output)["checks"], key=lambda one: -one["seconds"])
    print("\nSeconds a check, slowest first:")
    for check in checks[:12]:
        print(f"  {check['id']:<20}{check['seconds']:8.4f}   {check['status']}")
    rest = sum(check["seconds"] for check in checks[12:])
    print(f"  {len(checks) - 12} others together{rest:7.4f}")


def show_cover() -> None:
    """Print how many of the known troubles of beginners have a check."""
    sys.path.insert(0, str(SOURCE))
    from ros_doctor.registry import all_checks

    checks = all_checks()
    rows = {row for check in checks for row in check.rows}
    print(f"\n{len(checks)} checks cover {len(rows)} of {ROWS} rows of beginners' troubles.")


def main() -> None:
    """Print all figures."""
    with_ros = sys.argv[1] if len(sys.argv) > 1 else sys.executable
    bare = getattr(sys, "_base_executable", sys.executable)
    with tempfile.TemporaryDirectory() as folder:
        copy = Path(folder) / "src"
        shutil.copytree(SOURCE, copy)
        show("bare Python, no ROS", copy, bare, "-S")
    output = show("with this environment", SOURCE, with_ros)
    status = {check["id"]: check["status"] for check in json.loads(output)["checks"]}
    print(f"  there, talk was {status['talk']} and qos {status['qos']}")
    show_checks(output)
    show_cover()


if __name__ == "__main__":
    main()
