"""Many gradings of one package: are they equal, and what do they leave? Prints, asserts nothing.

.venv/bin/python tests/bench/repeat.py [LAB] [COUNT]
"""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
from collections import Counter
from collections.abc import Iterable
from pathlib import Path

Answer = tuple[tuple[str, str, float, str | None], ...]


def grade(lab: str, folder: Path) -> Answer:
    """Outcome, points and fault of every check, from the command that a student types."""
    file = folder / "verdict.json"
    words = [sys.executable, "-m", "roslings", "check", lab, "--solution", "--json", str(file)]
    environment = {**os.environ, "HOME": str(folder)}
    subprocess.run(words, env=environment, cwd=folder, capture_output=True, check=False)
    checks = json.loads(file.read_text("utf-8"))["checks"]
    return tuple((c["id"], c["outcome"], c["points"], c["fault"]) for c in checks)


def leftovers() -> dict[str, int]:
    """What a grading could leave: processes, shared memory, folders."""
    return {
        "processes": sum(1 for _ in processes()),
        "files in /dev/shm": len(list(Path("/dev/shm").glob("*fast*"))),
        "run folders": len(list(Path(tempfile.gettempdir()).glob(f"roslings-{os.getuid()}-*"))),
        "files in ~/.ros": len(list((Path.home() / ".ros").rglob("*"))),
    }


def processes() -> Iterable[str]:
    """Living processes of an arena."""
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit():
            try:
                line = (entry / "cmdline").read_bytes().replace(b"\0", b" ").decode()
            except OSError:
                continue
            if "import guardian" in line or "roslings.experiment.measuring" in line:
                yield line


def main(lab: str = "topics", count: str = "50") -> None:
    """Grade, count the different answers, and look at what is left."""
    before = leftovers()
    with tempfile.TemporaryDirectory() as folder:
        answers = Counter(grade(lab, Path(folder)) for _ in range(int(count)))
        in_home = [p for p in Path(folder).rglob("*") if p.name != "verdict.json"]
    print(f"{count} gradings of {lab}, {len(answers)} different answer(s): {[*answers.values()]}")
    for what, number in leftovers().items():
        print(f"{what}: {before[what]} before, {number} after")
    print(f"files left in the home: {len(in_home)}")


if __name__ == "__main__":
    main(*sys.argv[1:])
