"""How large the evidence of each lab's solution is, and what it costs to write and to read it.

    .venv/bin/python tests/bench/evidence.py                 the kept evidence in its tests
    .venv/bin/python tests/bench/evidence.py kept/evidence.json ...   evidence of `check --evidence`

Lists of objects, packed by zlib as gradebooks once were, beside columns, packed by xz as they are.
Sizes do not depend on the machine; times are CPU milliseconds, the least of several tries: compare
them within one row.
"""

from __future__ import annotations

import lzma
import sys
import time
import zlib
from collections.abc import Callable, Iterator
from pathlib import Path

from roslings.evidence import Evidence, evidence_json, read_json, thin_json
from roslings_class.grading import QUICKLY, THOROUGHLY, packed
from roslings_prove.anonymous import for_judging, without_machine

KEPT = Path(__file__).parents[2] / "packages/roslings/tests/evidence/schema1"
TRIES = 9
COLUMNS = (
    "lab",
    "JSON, kB: lists",
    "columns",
    "packed, kB: lists, zlib",
    "columns, xz",
    "kept with the course",
    "write + pack, ms: lists",
    "columns",
    "unpack + read, ms: lists",
    "columns",
)


def given(arguments: list[str]) -> Iterator[tuple[str, Evidence]]:
    """Lab and evidence."""
    if not arguments:
        for file in sorted(KEPT.glob("*/solution.json.xz")):
            yield file.parent.name, read_json(lzma.decompress(file.read_bytes()))
    for argument in arguments:
        evidence = read_json(Path(argument).read_bytes())
        yield evidence.lab, evidence


def cpu_ms(act: Callable[[], object]) -> float:
    """The least that it took."""
    took = []
    for _ in range(TRIES):
        began_s = time.process_time()
        act()
        took.append(time.process_time() - began_s)
    return min(took) * 1000


def row(lab: str, evidence: Evidence) -> str:
    """One row of the table."""
    lists, columns = evidence_json(evidence), thin_json(evidence)
    old, new = zlib.compress(lists, 6), packed(evidence)
    kept = packed(for_judging(without_machine(evidence)), THOROUGHLY)
    times = (
        cpu_ms(lambda: zlib.compress(evidence_json(evidence), 6)),
        cpu_ms(lambda: lzma.compress(thin_json(evidence), preset=QUICKLY)),
        cpu_ms(lambda: read_json(zlib.decompress(old))),
        cpu_ms(lambda: read_json(lzma.decompress(new))),
    )
    sizes = (f"{len(each) / 1e3:.1f}" for each in (lists, columns, old, new, kept))
    return f"| {' | '.join((lab, *sizes, *(f'{ms:.1f}' for ms in times)))} |"


if __name__ == "__main__":
    print(f"| {' | '.join(COLUMNS)} |\n|{' --- |' * len(COLUMNS)}")
    for name, each in given(sys.argv[1:]):
        print(row(name, each), flush=True)
