"""What prints without end is a failed check, with the lines that were counted, in every lab."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from roslings.course import all_labs, lab
from roslings.evidence import Evidence, LogLine, ProcessSeen, read_json
from roslings.judge import NothingToJudge, judge
from roslings.judge.faults import Inconclusive
from roslings.judge.views import ExperimentView
from roslings.verdict import CheckResult
from roslings_learn.drills.judging import judged
from roslings_learn.drills.steps import Step
from roslings_prove.proofs.kept import kept_here

LABS = [each.name for each in all_labs() if each.name != "example"]
LINES, MEGABYTES = 412_345, 2.5
NS = 10**9


def flooding(evidence: Evidence, executable: str) -> Evidence:
    """The same, but that this program prints in a loop, wherever it runs, and was ended for it."""
    told = evidence.model_copy(deep=True)
    runs = told.experiments.values()
    for process in (each for run in runs for each in run.processes.values()):
        if process.executable == executable:
            _flood(process)
    return told


def _flood(process: ProcessSeen) -> None:
    process.bounds_met, process.status, process.ended_by_itself = ["output"], -9, True
    process.asked_to_end_ns = process.ending = None
    process.ended_ns = process.started_ns + 4 * NS
    process.output_lines, process.output_bytes = LINES, round(MEGABYTES * 1e6)
    process.output_dropped_bytes = process.output_bytes - 500_000
    process.lines = [LogLine(arrival_ns=0, text="again", source="terminal") for _ in range(11_000)]


def programs() -> Iterator[tuple[str, str, Evidence]]:
    """Each program of each lab, launch files too: lab, program, evidence of a good package."""
    for name in LABS:
        seen = good(name)
        ran = {
            each.executable for run in seen.experiments.values() for each in run.processes.values()
        }
        yield from ((name, each, seen) for each in sorted(ran))


def good(name: str) -> Evidence:
    """Of the solution, as it is kept."""
    content = kept_here().archives(lab(name)).evidence("solution")
    assert content
    return read_json(content)


def told(checks: tuple[CheckResult, ...]) -> list[CheckResult]:
    """The checks that tell of what it printed."""
    return [check for check in checks if check.fault == "PrintsWithoutEnd"]


def test_it_is_one_failed_check_in_every_lab() -> None:
    """Of each program; the others wait for that one, and none says that nobody knows."""
    for name, executable, evidence in programs():
        checks = judge(lab(name), flooding(evidence, executable)).checks
        assert len(told(checks)) == 1, (name, executable, [(c.id, c.outcome) for c in checks])
        (check,) = told(checks)
        assert check.measured is not None
        assert f"it wrote {LINES:,} lines ({MEGABYTES} MB) in 4.0 s" in check.measured
        unclear = [each.id for each in checks if each.outcome == "inconclusive"]
        assert not unclear, (name, executable, unclear)
        assert len(check.log) < 10, "one line is as the other"


@pytest.mark.parametrize(
    "error", [None, Inconclusive("too much"), NothingToJudge("no line"), KeyError()]
)
def test_a_drill_tells_it_before_all_else(error: Exception | None) -> None:
    """Whatever the demand says of the rest."""

    def demand(_: object) -> None:
        if error:
            raise error

    _, executable, evidence = next(programs())
    runs = flooding(evidence, executable).experiments.values()
    view = ExperimentView(next(run for run in runs if run.prints_without_end))
    verdict = judged("loop", [Step("runs", "It runs.", demand)], view)
    assert verdict.outcome == "fail"
    assert verdict.first
    assert verdict.first.fault == "PrintsWithoutEnd"
    assert f"{LINES:,} lines" in verdict.headline
