"""How long packages on the way are graded, over their solution; prints, and asserts nothing.

    .venv/bin/python tests/bench/half_done.py [LAB ...]      the starter and each state; of all labs

From command to verdict, by the command that a student types.
"""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "labs"))

from half_done import states

from roslings.course import Lab, all_labs, root

MOST = 1.5
"""Over the solution: more is marked."""


def graded(lab: Lab, package: Path) -> tuple[float, str]:
    """Seconds and verdict."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "verdict.json"
        words = [str(root() / "roslings"), "check", lab.name, str(package)]
        began_s = time.monotonic()
        said = subprocess.run([*words, "--json", str(file)], capture_output=True, check=False)
        took_s = time.monotonic() - began_s
        if not file.exists():
            sys.exit(said.stderr.decode())
        verdict = json.loads(file.read_text("utf-8"))
    return took_s, f"{verdict['outcome']} {verdict['score']:g}"


def packages(lab: Lab, folder: Path) -> Iterator[tuple[str, Path]]:
    """The starter, and what it becomes."""
    yield f"{lab.name}-0", lab.starter
    for state in states(lab):
        yield state.name, state.make(folder / state.name / lab.card.package)


def main(names: list[str]) -> None:
    """Print a line for each."""
    for lab in all_labs():
        if names and lab.name not in names:
            continue
        graded(lab, lab.solution)  # whatever is made at the first use is made now
        whole_s, said = graded(lab, lab.solution)
        print(f"{lab.name + ' solution':24} {whole_s:6.2f} s         {said}", flush=True)
        with tempfile.TemporaryDirectory() as folder:
            for name, package in packages(lab, Path(folder)):
                took_s, said = graded(lab, package)
                mark = " <" if took_s > MOST * whole_s else ""
                print(
                    f"{name:24} {took_s:6.2f} s {took_s / whole_s:5.2f}  {said}{mark}", flush=True
                )


if __name__ == "__main__":
    main(sys.argv[1:])
