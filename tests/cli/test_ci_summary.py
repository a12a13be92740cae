"""The end of `.ci/run`: what was not graded, what failed and what cost most is told."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

from roslings.course import all_labs, root

SUMMARY = root() / ".ci/summary.py"
MUTANTS = [f"{lab.name}-{each.name}" for lab in all_labs() for each in lab.mutants()]
VERDICTS = "tests/labs/test_verdicts.py::test_a_mutant_fails_where_it_says"
ROGUES = "tests/rogues/test_rogues.py::test_a_rogue_is_contained"


def summary(folder: Path, outcomes: dict[str, str], stages: str) -> tuple[int, str]:
    """Status and words, for a run with these tests and stages."""
    (folder / "stages").write_text(stages, "utf-8")
    costs = (
        {"test": name, "outcome": outcome, "wall_s": number, "cpu_s": number / 2}
        for number, (name, outcome) in enumerate(outcomes.items())
    )
    (folder / "costs").write_text("".join(f"{json.dumps(cost)}\n" for cost in costs), "utf-8")
    words = [sys.executable, str(SUMMARY), str(folder / "stages"), str(folder / "costs")]
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    assert "Traceback" not in done.stderr, done.stderr
    return done.returncode, done.stdout


def test_what_was_not_graded_is_named(tmp_path: Path) -> None:
    """Each mutant and each rogue that lies in the course counts; one of them is missing."""
    outcomes = {f"{VERDICTS}[{name}]": "passed" for name in MUTANTS[1:]}
    outcomes[f"{ROGUES}[ordinary-reads-run]"] = "failed"
    outcomes[f"{ROGUES}[ordinary-reads-build]"] = "skipped"
    status, words = summary(tmp_path, outcomes, "12.5 20.0 0 The tests\n")
    assert status == 1
    assert f"Mutants: {len(MUTANTS) - 1} of {len(MUTANTS)} graded, 0 wrong" in words
    assert f"MISSING 1: {MUTANTS[0]}\n" in words
    assert "Rogues as ordinary: 1 of" in words and ", 1 wrong\n  1 skipped" in words
    assert "writes-import" in words and "zip_bomb" in words
    assert "reads-run" in words.partition("Rogues as root")[2]
    assert "MISSING" in words and words.endswith("FAILED\n")


def test_all_that_there_is_is_well(tmp_path: Path) -> None:
    """What a run with no test misses is all that has to be graded."""
    _, words = summary(tmp_path, {}, "1.0 1.0 0 One\n")
    mutants, ordinary, as_root = (
        line.partition(": ")[2].split(", ") for line in words.splitlines() if "MISSING" in line
    )
    assert sorted(mutants) == sorted(MUTANTS) and set(as_root) < set(ordinary)
    names = [*(f"{VERDICTS}[{name}]" for name in mutants),
             *(f"{ROGUES}[ordinary-{name}]" for name in ordinary),
             *(f"{ROGUES}[root-{name}]" for name in as_root)]  # fmt: skip
    status, words = summary(tmp_path, dict.fromkeys(names, "passed"), "1.0 1.0 0 One\n")
    assert (status, "MISSING" in words) == (0, False), words


def test_a_stage_that_failed_fails_all(tmp_path: Path) -> None:
    """It is marked, and the slowest tests and the sum stand above it."""
    names = {f"tests/test_it.py::test_{number}": "passed" for number in range(30)}
    status, words = summary(tmp_path, names, "1.5 2.0 0 One\n10.0 4.0 1 The other one\n")
    assert status == 1
    assert "       10       4  The other one  FAILED\n" in words
    assert "       12       6  all\n" in words
    assert "test_29\n" in words and "test_10\n" in words and "test_9\n" not in words
