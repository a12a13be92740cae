"""Evidence of earlier schemas, and the words that it was judged with when it was recorded.

    .venv/bin/python packages/roslings/tests/evidence/judged_words.py

writes `words.json.xz` of each lab anew.

`schema1/LAB/` holds evidence of the lab's solution, as `check --evidence` wrote it; more evidence,
of wrong packages, lies in `kills` beside this file. Write the words anew only where a text or a
rule of judging is meant to change, and look at what changed.
"""

from __future__ import annotations

import json
import lzma
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from roslings.course import lab
from roslings.evidence import Evidence, read_json
from roslings.judge import judge
from roslings.verdict import CheckResult

sys.path.insert(0, str(Path(__file__).resolve().parents[4] / "tests"))

from kills_of_old import read_kills

HERE = Path(__file__).parent
LABS = tuple(sorted(folder.name for folder in (HERE / "schema1").iterdir()))
TOLD = {"id", "outcome", "points", "expected", "measured", "why", "hint", "mend", "fault", "log"}
"""What judging says of a check. Titles and the three hints are the course's texts."""

Words = dict[str, list[dict[str, Any]]]
"""Name of a package to what is said of each of its checks."""


def recorded(name: str) -> Words:
    """The words of the labs' packages when they were recorded."""
    words: Words = json.loads(
        lzma.decompress((HERE / "schema1" / name / "words.json.xz").read_bytes())
    )
    return words


def judged(name: str) -> Words:
    """The words of the same packages today."""
    return {
        package: [_told(check) for check in judge(lab(name), evidence).checks]
        for package, evidence in evidence_of(name)
    }


def evidence_of(name: str) -> Iterator[tuple[str, Evidence]]:
    """The evidence of a lab's solution, where it is kept, and that of its kills."""
    packed = HERE / "schema1" / name / "solution.json.xz"
    if packed.is_file():
        yield "solution", read_json(lzma.decompress(packed.read_bytes()))
    for kill, evidence in read_kills(name):
        yield kill.package, evidence


def _told(check: CheckResult) -> dict[str, Any]:
    return check.model_dump(mode="json", include=TOLD, exclude_defaults=True)


if __name__ == "__main__":
    for each in LABS:
        content = json.dumps(judged(each), indent=0, sort_keys=True).encode()
        (HERE / "schema1" / each / "words.json.xz").write_bytes(lzma.compress(content, preset=9))
        print(each)
