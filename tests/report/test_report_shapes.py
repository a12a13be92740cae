"""The same verdict as JUnit, Gradescope's and check50's files."""

from __future__ import annotations

import json
from pathlib import Path
from xml.etree.ElementTree import fromstring

import pytest
import written_verdicts

from roslings.report import write_check50, write_gradescope, write_junit
from roslings.verdict import Verdict

WRITTEN = {
    "full": written_verdicts.full_score(),
    "three": written_verdicts.three_faults(),
    "open": written_verdicts.inconclusive(),
    "crashed": written_verdicts.crashed(),
}
each_verdict = pytest.mark.parametrize("verdict", WRITTEN.values(), ids=WRITTEN.keys())


@each_verdict
def test_junit_counts_as_the_verdict_does(verdict: Verdict, tmp_path: Path) -> None:
    """Failures are failures, an open check is an error, a skipped one is skipped."""
    write_junit(verdict, tmp_path / "it.xml")
    suite = fromstring((tmp_path / "it.xml").read_text("utf-8"))
    outcomes = [check.outcome for check in verdict.checks]
    counts = {word: suite.get(word) for word in ("tests", "failures", "errors", "skipped")}
    assert counts == {
        "tests": str(len(outcomes)),
        "failures": str(outcomes.count("fail")),
        "errors": str(outcomes.count("inconclusive")),
        "skipped": str(outcomes.count("skip")),
    }
    assert len(suite.findall("testcase/failure")) == outcomes.count("fail")
    assert [case.get("name") for case in suite] == [check.id for check in verdict.checks]


def test_what_a_node_writes_breaks_no_file(tmp_path: Path) -> None:
    """Control characters, halves of characters and mark-up."""
    nasty = "a\x00b\x1b[2J</failure>\ud800\ufffe&"
    failing = written_verdicts.failing("rate", expected=nasty, measured=nasty, why=nasty, hint="h")
    verdict = written_verdicts.verdict(failing)
    write_junit(verdict, tmp_path / "it.xml")
    write_gradescope(verdict, tmp_path / "results.json")
    write_check50(verdict, tmp_path / "check50.json")
    told = fromstring((tmp_path / "it.xml").read_bytes()).find("testcase/failure")
    assert told is not None
    assert "</failure>" in str(told.text)
    assert "\\x1b" in str(told.text)
    assert json.loads((tmp_path / "results.json").read_text("utf-8"))["score"] < 100
    assert json.loads((tmp_path / "check50.json").read_text("utf-8"))["results"]


@each_verdict
def test_gradescope_gets_the_points(verdict: Verdict, tmp_path: Path) -> None:
    """All of them, or none where nobody could tell: never a zero."""
    write_gradescope(verdict, tmp_path / "results.json")
    told = json.loads((tmp_path / "results.json").read_text("utf-8"))
    if verdict.outcome == "inconclusive":
        assert "score" not in told
        assert not any("score" in test for test in told["tests"])
        assert "no grade" in told["output"]
    else:
        assert told["score"] == verdict.score
        assert [t["score"] for t in told["tests"]] == [c.points for c in verdict.checks]
    failed = [t["number"] for t in told["tests"] if t.get("status") == "failed"]
    assert failed == [check.id for check in verdict.failed()]


@each_verdict
def test_check50_tells_pass_fail_and_neither(verdict: Verdict, tmp_path: Path) -> None:
    """A cause wherever it did not pass."""
    write_check50(verdict, tmp_path / "check50.json")
    results = json.loads((tmp_path / "check50.json").read_text("utf-8"))["results"]
    passed = {"pass": True, "fail": False, "skip": None, "inconclusive": None}
    assert [r["passed"] for r in results] == [passed[c.outcome] for c in verdict.checks]
    assert all(bool(r["cause"]) is (r["passed"] is not True) for r in results)
