"""The same verdict as JUnit, Gradescope's and check50's files."""

from __future__ import annotations

import json
from pathlib import Path
from xml.etree.ElementTree import fromstring

import pytest
import written_verdicts

from roslings.report.check50 import write_check50
from roslings.report.gradescope import write_gradescope
from roslings.report.junit import write_junit
from roslings.report.refusal import Refusal
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
    assert [case.get("name") for case in suite.findall("testcase")] == [
        check.id for check in verdict.checks
    ]


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


@pytest.mark.parametrize("wall", ["namespaces", "user", "none"])
def test_every_shape_names_the_wall(wall: str, tmp_path: Path) -> None:
    """And says of the second one what it does not stop."""
    verdict = written_verdicts.full_score()
    environment = verdict.environment.model_copy(update={"wall": wall})
    verdict = verdict.model_copy(update={"environment": environment})
    write_gradescope(verdict, tmp_path / "results.json")
    write_check50(verdict, tmp_path / "check50.json")
    write_junit(verdict, tmp_path / "it.xml")
    told = json.loads((tmp_path / "results.json").read_text("utf-8"))
    check50 = json.loads((tmp_path / "check50.json").read_text("utf-8"))["environment"]
    suite = fromstring((tmp_path / "it.xml").read_bytes())
    named = {each.get("name"): each.get("value") for each in suite.iter("property")}
    assert {told["extra_data"]["wall"], check50["wall"], named["wall"]} == {wall}
    for words in (told["output"], check50["about"], str(named["wall_about"])):
        assert ("does not stop the network" in words) is (wall == "user")


@pytest.mark.parametrize("is_students", [True, False])
def test_a_refusal_is_told_in_every_shape(is_students: bool, tmp_path: Path) -> None:
    """A zero where the student can mend it; where not, no score at all."""
    refusal = Refusal("topics", "It is empty\x1b[2J.", "Put it there.", is_students)
    write_gradescope(refusal, tmp_path / "results.json")
    write_check50(refusal, tmp_path / "check50.json")
    write_junit(refusal, tmp_path / "it.xml")
    told = json.loads((tmp_path / "results.json").read_text("utf-8"))
    assert told.get("score") == (0.0 if is_students else None)
    assert ("no fault of yours" in told["output"]) is not is_students
    named = json.loads((tmp_path / "check50.json").read_text("utf-8"))["error"]
    suite = fromstring((tmp_path / "it.xml").read_bytes())
    case = suite.find("testcase/failure" if is_students else "testcase/error")
    assert case is not None
    for text in (told["output"], named["value"], str(case.text)):
        assert "It is empty\\x1b[2J.\nPut it there." in text


def test_hidden_checks_are_hidden(tmp_path: Path) -> None:
    """Gradescope knows the word; the others do not name them."""
    checks = written_verdicts.three_faults().checks
    seen, hidden = checks[0], checks[1].model_copy(update={"hidden": True})
    verdict = written_verdicts.three_faults().model_copy(update={"checks": (seen, hidden)})
    write_gradescope(verdict, tmp_path / "results.json")
    write_check50(verdict, tmp_path / "check50.json")
    write_junit(verdict, tmp_path / "it.xml")
    tests = json.loads((tmp_path / "results.json").read_text("utf-8"))["tests"]
    assert [test["visibility"] for test in tests] == ["visible", "hidden"]
    for name in ("check50.json", "it.xml"):
        text = (tmp_path / name).read_text("utf-8")
        assert seen.id in text
        assert hidden.id not in text
        assert hidden.title not in text
