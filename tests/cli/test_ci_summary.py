"""The end of `.ci/run`: what was not graded, what failed and what cost most is told."""

from __future__ import annotations

import json
import subprocess
import sys
from contextlib import redirect_stdout
from functools import cache
from importlib.util import module_from_spec, spec_from_file_location
from io import StringIO
from pathlib import Path
from tempfile import TemporaryDirectory
from types import ModuleType

import pytest

from needed.left_out import KEPT as KEPT_BY_NEEDS
from needed.left_out import UNDRAWN
from roslings.course import all_labs, root
from roslings_prove.proofs.kept import kept_here

pytestmark = pytest.mark.slow

SUMMARY = root() / ".ci/summary.py"
MUTANTS = [f"{lab.name}-{each.name}" for lab in all_labs() for each in lab.mutants()]
KEPT_ONES = {
    f"{lab.name}-{name.removeprefix('mutant ')}"
    for lab in all_labs()
    for name in kept_here().lines(lab)
    if name.startswith("mutant ")
}
KEPT = (
    "packages/roslings-prove/tests/test_authoring_proofs.py::test_what_is_kept_shows_what_it_must"
)
FILES = ("stages", "costs", "due")
ROGUES = "tests/rogues/test_rogues.py::test_a_rogue_is_contained"


def summary(
    folder: Path, outcomes: dict[str, str], stages: str, due: dict[str, str] | None = None
) -> tuple[int, str]:
    """Status and words, for a run with these tests, stages and packages that were due.

    A mutant among the tests is one that was due. `skipped: NAME` is skipped for want of that.
    """
    due = {name: word for name, word in outcomes.items() if ": mutant " in name} | (due or {})
    outcomes = {name: word for name, word in outcomes.items() if name not in due}
    (folder / "due").write_text(
        "".join(
            f"{json.dumps({'package': name, 'why': 'a rule', 'outcome': word})}\n"
            for name, word in due.items()
        ),
        "utf-8",
    )
    (folder / "stages").write_text(stages, "utf-8")
    costs = (
        {"test": name, "wall_s": number, "cpu_s": number / 2, **came_of(outcome)}
        for number, (name, outcome) in enumerate(outcomes.items())
    )
    (folder / "costs").write_text("".join(f"{json.dumps(cost)}\n" for cost in costs), "utf-8")
    with redirect_stdout(StringIO()) as said:
        status = loaded().main(*(folder / name for name in FILES))
    return status, said.getvalue()


@cache
def loaded() -> ModuleType:
    """`.ci/summary.py`, which is no module of the engine."""
    spec = spec_from_file_location("summary", SUMMARY)
    assert spec and spec.loader
    module = sys.modules["summary"] = module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def came_of(outcome: str) -> dict[str, str]:
    """As `tests/costs.py` writes it; `skipped` alone is for want of time."""
    word, _, lack = outcome.partition(": ")
    return {"outcome": word, "lack": lack or ("time for slow tests" if word == "skipped" else "")}


def test_it_is_a_program_as_well(tmp_path: Path) -> None:
    """As `.ci/run` starts it: its status is that of the run."""
    status, words = summary(tmp_path, {}, "1.0 1.0 0 One\n")
    files = [str(tmp_path / name) for name in FILES]
    command = [sys.executable, str(SUMMARY), *files]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout) == (status, words), done.stderr


def test_what_was_not_graded_is_named(tmp_path: Path) -> None:
    """Each mutant and each rogue that lies in the course counts; one of them is missing."""
    outcomes = {package(name): "passed" for name in MUTANTS[1:]}
    outcomes[f"{ROGUES}[ordinary-reads-run]"] = "failed"
    outcomes[f"{ROGUES}[ordinary-reads-build]"] = "skipped"
    status, words = summary(tmp_path, outcomes, "12.5 20.0 0 The tests\n")
    assert status == 1
    assert f"Mutants: {len(MUTANTS) - 1} of {len(MUTANTS)} proven, 0 wrong" in words
    assert f"MISSING 1: {MUTANTS[0]}\n" in words
    assert "Rogues as ordinary: 1 of" in words and ", 1 wrong\n  1 skipped" in words
    assert "writes-import" in words and "zip_bomb" in words
    assert "reads-run" in words.partition("Rogues as root")[2]
    assert "MISSING" in words and last(words).startswith("FAILED: nothing asked for ")


def package(mutant: str) -> str:
    """What `prove` calls LAB-MUTANT."""
    lab = max((lab.name for lab in all_labs() if mutant.startswith(f"{lab.name}-")), key=len)
    return f"{lab}: mutant {mutant.removeprefix(f'{lab}-')}"


@cache
def all_of_them() -> dict[str, list[str]]:
    """The tests of all mutants and of all rogues: what a run with no test misses."""
    with TemporaryDirectory() as folder:
        _, words = summary(Path(folder), {}, "1.0 1.0 0 One\n")
    mutants, ordinary, as_root = (
        line.partition(": ")[2].split(", ") for line in words.splitlines() if "MISSING" in line
    )
    assert sorted(mutants) == sorted(MUTANTS) and set(as_root) < set(ordinary)
    rogues = [*(f"ordinary-{name}" for name in ordinary), *(f"root-{name}" for name in as_root)]
    return {
        "mutants": [package(name) for name in mutants],
        "rogues": [f"{ROGUES}[{name}]" for name in rogues],
    }


def last(words: str) -> str:
    """The line that is believed."""
    return words.splitlines()[-1]


def of_all(folder: Path, *, word: str = "skipped", **number: int) -> tuple[int, str]:
    """The end of a run in which so many of each kind were skipped, and all others passed."""
    outcomes: dict[str, str] = {}
    for kind, tests in all_of_them().items():
        left_out = "unclear" if kind == MUTANT else word
        outcomes |= dict.fromkeys(tests, "passed")
        outcomes |= dict.fromkeys(tests[: number.get(kind, 0)], left_out)
    return summary(folder, outcomes, "1.0 1.0 0 One\n")


def test_all_that_there_is_is_well(tmp_path: Path) -> None:
    """Nothing was skipped: only then all is well."""
    status, words = of_all(tmp_path)
    assert (status, "MISSING" in words, last(words)[:13]) == (0, False, "All is well: "), words


MUTANT = "mutants"


@pytest.mark.parametrize("kind", [MUTANT, "rogues"])
def test_what_was_skipped_is_not_called_well(kind: str, tmp_path: Path) -> None:
    """One is enough; the last line has its number."""
    status, words = of_all(tmp_path, **{kind: 1})
    assert (status, "All is well" in words) == (0, False)
    assert last(words).startswith("Passed, but NOT PROVEN: ")
    assert f" 1 of {len(all_of_them()['mutants'])} mutants" in last(words) or kind != MUTANT


def with_all(folder: Path, *others: str) -> tuple[int, str, int]:
    """Every mutant and rogue is proven, and `others` came of further tests; how many tests."""
    outcomes = {name: "passed" for names in all_of_them().values() for name in names}
    outcomes |= {f"tests/test_it.py::test_{n}": word for n, word in enumerate(others)}
    status, words = summary(folder, outcomes, "1 1 0 One\n")
    return status, last(words), sum(": mutant " not in name for name in outcomes)


def test_another_test_that_was_skipped_counts_too(tmp_path: Path) -> None:
    """It need not be a mutant or a rogue."""
    status, line, tests = with_all(tmp_path, "skipped")
    assert status == 0
    assert line == f"Passed, but NOT PROVEN: 1 of {tests} tests left out for want of time."


def test_what_the_machine_lacks_is_named_and_counted(tmp_path: Path) -> None:
    """Alone, and beside what there was no time for; the most first."""
    lacks = ("skipped: root", "skipped: /dev/net/tun", "skipped: /dev/net/tun")
    told = "roven, but for 3 of the machine: 2 no /dev/net/tun, 1 no root."
    status, line, _ = with_all(tmp_path, *lacks)
    assert (status, line) == (0, f"P{told}")
    status, line, tests = with_all(tmp_path, *lacks, "skipped")
    want = f"1 of {tests} tests left out for want of time; p{told}"
    assert (status, line) == (0, f"Passed, but NOT PROVEN: {want}")


def test_a_skip_without_a_known_reason_fails_the_run(tmp_path: Path) -> None:
    """No hook has named it: the file of costs was written without it."""
    status, line, _ = with_all(tmp_path, "skipped: bad weather")
    assert status == 1
    assert line == "FAILED: 1 tests were skipped for no reason that tests/machine.py names"


def test_a_run_in_which_all_was_skipped_fails_with_the_reason(tmp_path: Path) -> None:
    """Also where each single reason is a true one."""
    tests = {f"tests/test_it.py::test_{number}": "skipped: module rclpy" for number in range(4)}
    due = {package(name): "passed" for name in MUTANTS}
    status, words = summary(tmp_path, tests, "1 1 0 One\n", due)
    assert status == 1
    assert "all 4 tests were skipped: 4 no module rclpy" in last(words)


@pytest.mark.parametrize(("kind", "fewest"), [("mutants", 120), ("rogues", 30)])
def test_a_run_that_showed_too_little_fails(kind: str, fewest: int, tmp_path: Path) -> None:
    """All skipped, or all but a few: that is no proof, whatever the reason."""
    there = len(all_of_them()[kind])
    for skipped, wanted in ((there, 1), (there - fewest + 1, 1), (there - fewest, 0)):
        status, words = of_all(tmp_path, **{kind: skipped})
        assert status == wanted, words
        assert last(words).startswith("FAILED: " if wanted else "Passed, but NOT PROVEN: ")


def test_a_stage_that_failed_fails_all(tmp_path: Path) -> None:
    """It is marked, and the slowest tests and the sum stand above it."""
    names = {f"tests/test_it.py::test_{number}": "passed" for number in range(30)}
    status, words = summary(tmp_path, names, "1.5 2.0 0 One\n10.0 4.0 1 The other one\n")
    assert status == 1
    assert "       10       4  The other one  FAILED\n" in words
    assert "       12       6  all\n" in words
    assert "test_29\n" in words and "test_10\n" in words and "test_9\n" not in words


def test_a_mutant_whose_kept_evidence_was_judged_is_proven(tmp_path: Path) -> None:
    """All of a lab are, where the test of that lab passed; none where it was skipped."""
    kept = {f"{KEPT}[{lab.name}]": "passed" for lab in all_labs()}
    _, words = summary(tmp_path, kept, "1 1 0 One\n")
    assert f"Mutants: {len(KEPT_ONES)} of {len(MUTANTS)} proven, 0 wrong" in words
    assert "Mutants measured live at this landing: 0" in words
    skipped = {**kept, f"{KEPT}[topics]": "skipped"}
    of_topics = sum(name.startswith("topics-") for name in KEPT_ONES)
    _, words = summary(tmp_path, skipped, "1 1 0 One\n")
    assert f"Mutants: {len(KEPT_ONES) - of_topics} of {len(MUTANTS)} proven" in words


def test_what_was_measured_live_counts_before_what_is_kept(tmp_path: Path) -> None:
    """Wrong live, and right in evidence from another day: it is wrong."""
    kept = {f"{KEPT}[{lab.name}]": "passed" for lab in all_labs()}
    one = min(KEPT_ONES)
    _, words = summary(tmp_path, kept, "1 1 0 One\n", {package(one): "failed"})
    assert f"Mutants: {len(KEPT_ONES)} of {len(MUTANTS)} proven, 1 wrong" in words
    assert "Mutants measured live at this landing: 1" in words


def test_what_was_due_and_not_measured_fails_the_run(tmp_path: Path) -> None:
    """Whatever kind of package it is; how to measure it stands in the last line."""
    due = {"topics: solution": "passed", "topics: kill sign-talker.py:3-0": "unmeasured"}
    outcomes = {name: "passed" for names in all_of_them().values() for name in names}
    status, words = summary(tmp_path, outcomes, "1 1 0 One\n", due)
    total = len(MUTANTS) + len(due)
    wanted = f"FAILED: no time was left for 1 of {total} packages that were due;"
    assert status == 1 and last(words).startswith(wanted)
    assert last(words).endswith("./roslings prove --record --due measures and keeps them")


def test_what_was_due_and_is_wrong_is_named_in_the_last_line(tmp_path: Path) -> None:
    """A kill or a starter is no mutant: nothing else in the summary would tell of it."""
    due = {"topics: starter": "passed", "topics: kill sign-talker.py:3-0": "failed"}
    outcomes = {name: "passed" for names in all_of_them().values() for name in names}
    status, words = summary(tmp_path, outcomes, "1 1 0 One\n", due)
    wanted = "FAILED: these did not show what they must: topics: kill sign-talker.py:3-0"
    assert (status, last(words)) == (1, wanted)


def test_what_could_not_be_told_leaves_its_proof_as_old_as_it_was(tmp_path: Path) -> None:
    """Its kept evidence still counts; the last line has the number all the same."""
    outcomes = {name: "passed" for names in all_of_them().values() for name in names}
    outcomes |= {f"{KEPT}[{lab.name}]": "passed" for lab in all_labs()}
    outcomes[package(min(KEPT_ONES))] = "unclear"
    status, words = summary(tmp_path, outcomes, "1 1 0 One\n")
    assert f"Mutants: {len(MUTANTS)} of {len(MUTANTS)} proven, 0 wrong" in words
    wanted = f"1 of {len(MUTANTS)} packages that were due could not be told"
    assert (status, last(words)) == (0, f"Passed, but NOT PROVEN: {wanted}.")


# --- what was left out by what it needs ---------------------------------------------------------


def of_rogues(words: str) -> list[str]:
    """The lines about rogues as an ordinary user."""
    lines = words.partition("Rogues as ordinary: ")[2].partition("Rogues as root")[0]
    return [line.strip() for line in lines.splitlines()]


def number_as_ordinary() -> tuple[int, int]:
    """How many rogues are graded as an ordinary user, and how many tests all rogues are."""
    tests = all_of_them()["rogues"]
    return sum("[ordinary-" in test for test in tests), len(tests)


def test_rogues_that_are_kept_are_counted_apart_from_those_that_ran(tmp_path: Path) -> None:
    """None is missing, none was proven live, and the last line says that they ran before."""
    ordinary, all_of = number_as_ordinary()
    status, words = of_all(tmp_path, word=KEPT_BY_NEEDS, rogues=all_of - 1)
    assert (status, "MISSING" in words, "NOT PROVEN" in words) == (0, False, False)
    assert of_rogues(words) == [
        f"0 of {ordinary} proven, 0 wrong",
        f"{ordinary} kept by needs: proven before, with all that they need as it is.",
    ]
    before = f"{all_of - 1} tests were run before with all that they need as it is"
    assert f"\nLeft out: {before}.\n" in words
    assert last(words) == (
        f"All is well: every mutant and every rogue is proven, and no test was skipped; {before}."
    )


def test_rogues_on_which_no_lot_fell_are_not_called_proven(tmp_path: Path) -> None:
    """The core is another than when they passed: the lot is a rule, and no proof."""
    ordinary, _ = number_as_ordinary()
    status, words = of_all(tmp_path, word=UNDRAWN, rogues=ordinary)
    assert (status, "MISSING" in words, "All is well" in words) == (0, False, False)
    assert of_rogues(words)[1] == (
        f"{ordinary} not drawn: of what they need, only the core or a list of names is another."
    )
    assert last(words).startswith("Passed, but NOT PROVEN: 0 of ")
    assert f", {ordinary} of {ordinary} rogues as ordinary, 0 of " in last(words)
    assert f"{ordinary} tests not drawn: " in last(words)


def test_what_is_kept_stands_behind_what_the_machine_lacks(tmp_path: Path) -> None:
    """Both are said, and neither as the other; other tests than rogues count as well."""
    status, line, _ = with_all(tmp_path, KEPT_BY_NEEDS, "skipped: root", KEPT_BY_NEEDS)
    kept = "2 tests were run before with all that they need as it is"
    assert (status, line) == (0, f"Proven, but for 1 of the machine: 1 no root; {kept}.")
    status, line, tests = with_all(tmp_path, KEPT_BY_NEEDS, "skipped", KEPT_BY_NEEDS)
    late = f"1 of {tests} tests left out for want of time"
    assert (status, line) == (0, f"Passed, but NOT PROVEN: {late}; {kept}.")


def test_unsteady_ones_are_counted_and_fail_nothing(tmp_path: Path) -> None:
    """On a line of their own, before the last one."""
    status, words = of_all(tmp_path)
    assert (status, "Unsteady tests: 0 in this run, 0 of them new\n" in words) == (0, True)
    (tmp_path / "unsteady").write_text("tests/b.py::test_late[a b]\n", "utf-8")
    status, words = of_all(tmp_path)
    assert status == 0 and words.splitlines()[-2] == (
        "Unsteady tests: 1 in this run, 1 of them new: tests/b.py::test_late[a b]"
    )


def test_what_failed_is_named_at_the_end(tmp_path: Path) -> None:
    """Where a stage was broken off, nothing else names it. Unsteady ones are left out."""
    tests = {"tests/a.py::test_it": "failed", "tests/b.py::test_it": "failed"}
    (tmp_path / "unsteady").write_text("tests/b.py::test_it\n", "utf-8")
    _, words = summary(tmp_path, tests, "1 1 1 One\n")
    assert words.splitlines()[-2] == "FAILED tests/a.py::test_it"
    assert "FAILED tests/b.py" not in words
