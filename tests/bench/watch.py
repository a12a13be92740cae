"""Prints the time from a save until `./roslings watch` shows the next drill; asserts nothing.

    .venv/bin/python tests/bench/watch.py [DAY]

A student's terminal of 80 columns, the real command, an empty home. Each drill's file is replaced
by its solution, and the clock runs until the screen names the next one. Beside it, in turn, what a
bare node takes from its start until it is ready: nothing that runs a node can be quicker.
"""

from __future__ import annotations

import shutil
import statistics
import sys
import tempfile
import time
from collections.abc import Iterator
from datetime import datetime, timezone
from pathlib import Path

from drills import bare_s, percentile
from roslings.course import all_labs, root
from roslings.workspace.progress_file import DrillProgress, LabProgress, StudentProgress, as_json
from roslings_learn.drills import Drill, all_drills

sys.path.append(str(root() / "tests" / "cli"))
from watch_terminal import Watched, watching


def main() -> None:
    """Print a line for each drill, and one for all."""
    days = sorted({one.day for one in all_drills()})
    if len(sys.argv) > 1:
        days = [day for day in days if int(day[:2]) == int(sys.argv[1])]
    found = [each for day in days for each in _day_s(day)]
    floor_s = statistics.median(floor_s for _, floor_s in found)
    print(f"\na node alone: {floor_s:.2f} s from start to ready (median)")
    _print("from save to next drill", [save_s for save_s, _ in found])
    _print("over a node alone", [save_s - floor_s for save_s, floor_s in found])


def _print(told: str, values: list[float]) -> None:
    p50_s, p95_s = percentile(values, 0.5), percentile(values, 0.95)
    print(f"{told}: {len(values)} drills, p50 {p50_s:.2f} s, p95 {p95_s:.2f} s,", end=" ")
    print(f"longest {max(values):.2f} s")


def _day_s(day: str) -> list[tuple[float, float]]:
    """The drills of a day, by a student who has done all that comes before."""
    with tempfile.TemporaryDirectory() as folder:
        home = Path(folder)
        _write_off_before(day, home / "roslings_ws" / ".roslings" / "progress.json")
        with watching(home) as watch:
            found = [*_times_s(watch, [one for one in all_drills() if one.day == day], home)]
            watch.press("q")
    return found


def _write_off_before(day: str, file: Path) -> None:
    now = datetime.now(timezone.utc)
    lab = LabProgress(100.0, 100.0, 1, now, now, now)
    done = StudentProgress(
        {each.name: lab for each in all_labs() if each.outline.day < day},
        {each.name: DrillProgress(1, now, now) for each in all_drills() if each.day < day},
    )
    file.parent.mkdir(parents=True)
    file.write_text(as_json(done), "utf-8")


def _times_s(watch: Watched, wanted: list[Drill], home: Path) -> Iterator[tuple[float, float]]:
    """Of each drill: until the next one is shown, and what a bare node takes just before."""
    for one in wanted:
        watch.shows(rf"(?s)\n\S+ {one.name} .*q quit")
        floor_s = bare_s()
        part = home / "typed"
        shutil.copyfile(one.solution, part)
        saved_s = time.monotonic()
        part.replace(home / "roslings_ws" / "drills" / one.day / one.file_name)
        watch.shows(rf"{one.name} +it does all that is asked(?s:.*)\n(Drill \d+ of |Day \d\d-)")
        after_s = time.monotonic() - saved_s
        print(f"{one.name:24} {after_s:.2f} s; a node alone {floor_s:.2f} s", flush=True)
        yield after_s, floor_s


if __name__ == "__main__":
    main()
