"""Two workers of a Dask cluster on this machine beside one process; prints, and asserts nothing.

    .venv/bin/python tests/bench/cluster.py [LAB] [COUNT]

The same submissions are graded by `grade --jobs 1`, by `grade --jobs 2`, and by
`grade --dask ADDRESS` with two workers of one thread each.
"""

from __future__ import annotations

import sys
import tempfile
import time
from contextlib import redirect_stderr, redirect_stdout
from io import StringIO
from pathlib import Path

from batch import hand_in
from distributed import LocalCluster

from roslings import course
from roslings_class.command import GradeOptions, grade

WORKERS = 2


def main(words: list[str]) -> None:
    """Print a line for each way."""
    lab = course.lab(words[0] if words else "topics")
    count = int(words[1]) if len(words) > 1 else 10
    with tempfile.TemporaryDirectory() as name:
        place = Path(name)
        handed_in = hand_in(lab, count, place / "in")
        for jobs in (1, WORKERS):
            choices = GradeOptions(lab.name, handed_in, place / f"jobs-{jobs}", jobs=jobs)
            show(f"--jobs {jobs}", choices, count)
        with LocalCluster(
            n_workers=WORKERS, threads_per_worker=1, host="127.0.0.1", dashboard_address=None
        ) as cluster:
            address = cluster.scheduler_address
            choices = GradeOptions(lab.name, handed_in, place / "dask", dask=address)
            show(f"--dask, {WORKERS} workers", choices, count)


def show(way: str, choices: GradeOptions, count: int) -> None:
    """Grade, and print how long it took."""
    began_s = time.monotonic()
    with redirect_stdout(StringIO()), redirect_stderr(StringIO()):
        unclear = grade(choices).unclear
    seconds = time.monotonic() - began_s
    print(f"{way:18} {seconds:6.1f} s  {60 * count / seconds:5.1f} a minute, {unclear} unclear")


if __name__ == "__main__":  # a worker imports this file too
    main(sys.argv[1:])
