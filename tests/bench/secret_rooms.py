"""How the solution of the lab wander does in secret rooms; prints, and asserts nothing.

    .venv/bin/python tests/bench/secret_rooms.py each [N]    N gradings, each with its own secret
    .venv/bin/python tests/bench/secret_rooms.py same [N]    N gradings with one secret

A line tells each grading's seconds, its verdict, and how many of its rooms were believed in
lockstep; the last one tells how many rooms in all, and how many gradings said the same.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

from roslings.capabilities.rooms.record import RoomDriveSeen, RoomsSeen
from roslings.capabilities.rooms.seeds import SECRET
from roslings.course import root
from roslings.report.evidence_file import read_evidence
from roslings.report.json_file import read_json
from roslings.verdict import Verdict

LAB = "wander"
SECRETS: dict[str, Callable[[int], str]] = {"each": str, "same": lambda _: "one for all"}


@dataclass(frozen=True)
class GradingOfRooms:
    """One grading of the solution."""

    seconds: float
    verdict: Verdict
    drives: tuple[RoomDriveSeen, ...]

    @property
    def in_lockstep(self) -> int:
        """So many rooms were believed at once."""
        return sum(drive.clock == "lockstep" for drive in self.drives)

    @property
    def said(self) -> str:
        """The verdict, and what failed in it."""
        failed = (each.id for each in self.verdict.checks if each.outcome != "pass")
        score = self.verdict.score
        return " ".join(("not told" if score is None else f"{score:g}", *failed))


def graded(secret: str) -> GradingOfRooms:
    """By the command that an instructor's grading runs, with the rooms of this secret."""
    with tempfile.TemporaryDirectory() as folder:
        verdict, evidence = Path(folder) / "verdict.json", Path(folder) / "evidence"
        words = [root() / "roslings", "check", LAB, "--solution"]
        words += ["--json", verdict, "--evidence", evidence]
        began_s = time.monotonic()
        variables = {**os.environ, SECRET: secret}
        subprocess.run(words, env=variables, capture_output=True, check=False)
        took_s = time.monotonic() - began_s
        return GradingOfRooms(took_s, read_json(verdict), tuple(drives_in(evidence)))


def drives_in(evidence: Path) -> Iterator[RoomDriveSeen]:
    """All that were judged."""
    for seen in read_evidence(evidence, LAB).runs:
        yield from seen.part(RoomsSeen).drives


def main(which: str, count: int) -> None:
    """A line for each, and one for all."""
    gradings = []
    for number in range(count):
        gradings.append(each := graded(SECRETS[which](number)))
        rooms = f"{each.in_lockstep} of {len(each.drives)} rooms in lockstep"
        print(f"{each.seconds:6.1f} s  {each.said:24} {rooms}", flush=True)
    most = Counter(each.said for each in gradings).most_common(1)[0][1]
    believed = sum(each.in_lockstep for each in gradings)
    rooms_in_all = sum(len(each.drives) for each in gradings)
    print(f"{believed} of {rooms_in_all} rooms in lockstep; the same verdict in {most} of {count}")


if __name__ == "__main__":
    which, *more = sys.argv[1:] or ["each"]
    main(which, int(more[0]) if more else 10)
