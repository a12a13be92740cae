"""The same command in two clones, in turns: what a change costs; prints, and asserts nothing.

    .venv/bin/python tests/bench/two_clones.py [--fresh] BEFORE AFTER ROUNDS WORD...

BEFORE and AFTER are folders of clones whose environments hold the same packages: what is installed
beside costs time, too. WORD... is what follows `./roslings`; `{new}` in it is a folder that is new
in each round. Which one begins changes from round to round, so that both meet the same machine.
With `--fresh` each run is in a clone of the clone, with an empty HOME: all is installed anew.

    .venv/bin/python tests/bench/two_clones.py OLD NEW 9 check topics --solution
    .venv/bin/python tests/bench/two_clones.py OLD NEW 4 grade topics HAND_INS --out {new} --jobs 1
"""

from __future__ import annotations

import argparse
import os
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Sequence
from pathlib import Path


def took(clone: Path, words: Sequence[str], *, fresh: bool) -> tuple[float, float]:
    """Seconds of the clock, and of the processors, of one run; it must succeed."""
    with tempfile.TemporaryDirectory() as new:
        place, home = (cloned(clone, new), f"{new}/home") if fresh else (clone, os.environ["HOME"])
        command = ["./roslings", *(word.replace("{new}", f"{new}/new") for word in words)]
        environment = {**os.environ, "HOME": home}
        before, began_s = os.times(), time.monotonic()
        subprocess.run(
            command,
            cwd=place,
            env=environment,
            check=True,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL if fresh else None,
        )
        passed_s, after = time.monotonic() - began_s, os.times()
    children = (after.children_user, after.children_system)
    return passed_s, sum(children) - before.children_user - before.children_system


def cloned(clone: Path, folder: str) -> Path:
    """A clone of a clone, without its environment; an empty home lies beside it."""
    place = Path(folder, "clone")
    subprocess.run(["git", "clone", "-q", clone, place], check=True)
    Path(folder, "home").mkdir()
    return place


def main(clones: Sequence[Path], rounds: int, words: Sequence[str], *, fresh: bool) -> None:
    """Print a row for each clone: medians, the range, and the ratio to the first one."""
    runs: dict[Path, list[tuple[float, float]]] = {clone: [] for clone in clones}
    for number in range(rounds):
        for clone in clones if number % 2 else reversed(clones):
            runs[clone].append(took(clone, words, fresh=fresh))
    print("| clone | s | from | to | of the first | CPU s | of the first |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    first_s, first_cpu_s = map(statistics.median, zip(*runs[clones[0]], strict=True))
    for clone, told in runs.items():
        all_s, all_cpu_s = zip(*told, strict=True)
        at_s, cpu_s = statistics.median(all_s), statistics.median(all_cpu_s)
        print(
            f"| {clone.name} | {at_s:.2f} | {min(all_s):.2f} | {max(all_s):.2f} "
            f"| {at_s / first_s:.2f} | {cpu_s:.2f} | {cpu_s / first_cpu_s:.2f} |"
        )


def options_in(words: Sequence[str]) -> argparse.Namespace:
    """Two clones, how often, and what is typed."""
    reader = argparse.ArgumentParser(description=__doc__, usage=(__doc__ or "").splitlines()[2])
    reader.add_argument("--fresh", action="store_true")
    reader.add_argument("clones", nargs=2, type=Path)
    reader.add_argument("rounds", type=int)
    reader.add_argument("words", nargs=argparse.REMAINDER)
    return reader.parse_args(words)


if __name__ == "__main__":
    options = options_in(sys.argv[1:])
    main(options.clones, options.rounds, options.words, fresh=options.fresh)
