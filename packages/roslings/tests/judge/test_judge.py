"""Judging is pure: the same evidence, the same verdict; another card, another verdict."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
from real_run import evidence_of_solution

from roslings import course
from roslings.course import Lab, lab
from roslings.evidence import Evidence
from roslings.judge import BadGrader, judge
from roslings.verdict import Verdict


@pytest.fixture(scope="module")
def evidence(tmp_path_factory: pytest.TempPathFactory) -> Evidence:
    """What was seen of a real run of the solution."""
    return evidence_of_solution("topics", tmp_path_factory.mktemp("evidence"))


@pytest.fixture
def other_course(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A copy of the course that a test may change."""
    for folder in ("labs", "graders"):
        shutil.copytree(course.root() / folder, tmp_path / folder)
    monkeypatch.setenv("ROSLINGS_COURSE", str(tmp_path))
    return tmp_path


def change(file: Path, find: str, replace: str) -> Lab:
    """Change one place of the copied course; returns its lab."""
    text = file.read_text("utf-8")
    assert text.count(find) == 1
    file.write_text(text.replace(find, replace), "utf-8")
    return lab("topics")


def outcomes(verdict: Verdict) -> dict[str, str]:
    """Check to outcome, of those that did not pass."""
    return {check.id: check.outcome for check in verdict.checks if check.outcome != "pass"}


def test_evidence_that_was_saved_is_judged_alike(evidence: Evidence, tmp_path: Path) -> None:
    """Written, read back, judged again: nothing differs."""
    file = tmp_path / "evidence.json"
    file.write_text(evidence.model_dump_json(by_alias=True), "utf-8")
    again = Evidence.model_validate_json(file.read_text("utf-8"))
    assert judge(lab("topics"), again) == judge(lab("topics"), evidence)
    assert judge(lab("topics"), evidence).score == 100


def test_a_changed_limit_changes_that_check_alone(evidence: Evidence, other_course: Path) -> None:
    """An instructor asks for 4 Hz: the same evidence now fails the rate."""
    topics = change(other_course / "labs/topics/card.yaml", "hz: 2.0", "hz: 4.0")
    verdict = judge(topics, evidence)
    assert outcomes(verdict) == {"rate": "fail"}
    rate = next(check for check in verdict.checks if check.id == "rate")
    assert rate.fault == "TooSlow"
    assert "4 messages a second" in rate.title


@pytest.mark.parametrize(("fault", "outcome"), [("TooSlow", "skip"), ("TooFast", "fail")])
def test_one_mistake_costs_one_check(
    evidence: Evidence, other_course: Path, fault: str, outcome: str
) -> None:
    """The same mistake spoils a later check too: that one is skipped, and says what to mend."""
    card, grader = other_course / "labs/topics/card.yaml", other_course / "graders/grade_topics.py"
    change(card, "hz: 2.0", "hz: 4.0")
    change(card, 'text: "Hello', 'text: "Other')
    ends = '@check(needs=["talker_type"])\ndef test_text('
    rate = f'@check(needs=["talker_type"], explained_by={{"rate": "{fault}"}})\ndef test_text('
    verdict = judge(change(grader, ends, rate), evidence)
    text = next(check for check in verdict.checks if check.id == "text")
    assert outcomes(verdict)["rate"] == "fail"
    assert text.outcome == outcome
    assert ("first mend: " in (text.why or "")) is (outcome == "skip")


@pytest.mark.parametrize(
    ("share", "points"), [(0.0, 0), (0.5, 3), (0.59, 4), (0.99, 6), (1.0, 6), (1.5, 6), (-1.0, 0)]
)
def test_a_fault_may_leave_a_share_of_the_points(
    evidence: Evidence, other_course: Path, share: float, points: float
) -> None:
    """Whole points, never all of them, and never less than none. The check fails all the same."""
    find = "    talking.topic(CHATTER).must(count_up)"
    raises = f"""
    from roslings.judge.faults.base import Unmet
    fault = Unmet("it counts", "up to a point")
    fault.earned = {share}
    raise fault"""
    (failed,) = judge(
        change(other_course / "graders/grade_topics.py", find, raises), evidence
    ).failed()
    assert (failed.id, failed.points, failed.max_points) == ("counting", points, 7)


def test_nothing_seen_is_not_failed(evidence: Evidence) -> None:
    """Without experiments there is nothing to judge about the nodes, and nobody says why."""
    empty = evidence.model_copy(update={"experiments": {}})
    verdict = judge(lab("topics"), empty)
    assert set(outcomes(verdict).values()) == {"skip", "inconclusive"}
    assert verdict.score is None


@pytest.mark.parametrize(("hz", "outcome"), [("2.0", "inconclusive"), ("4.0", "skip")])
def test_who_had_nothing_to_look_at_is_told_by_another_check_or_cannot_tell(
    evidence: Evidence, other_course: Path, hz: str, outcome: str
) -> None:
    """Nothing fails, and a check saw nothing: this computer was too busy, the student is right."""
    change(other_course / "labs/topics/card.yaml", "hz: 2.0", f"hz: {hz}")
    topics = change(
        other_course / "graders/grade_topics.py",
        "    talking.topic(CHATTER).must(count_up)",
        "    from roslings.judge.faults.reasons import NothingSeen\n\n"
        '    raise NothingSeen("messages")',
    )
    verdict = judge(topics, evidence)
    assert outcomes(verdict)["counting"] == outcome
    assert (verdict.score is None) is (outcome == "inconclusive")
    why = next(check.why for check in verdict.checks if check.id == "counting") or ""
    assert why.endswith("; check again") is (outcome == "inconclusive")


def test_a_mistake_of_the_grader_costs_the_student_nothing(
    evidence: Evidence, other_course: Path
) -> None:
    """An error in a check is inconclusive: no score, and who to tell."""
    topics = change(
        other_course / "graders/grade_topics.py",
        "    talking.topic(CHATTER).must(count_up)",
        "    talking.topic(CHATTER).no_such_thing()",
    )
    verdict = judge(topics, evidence)
    assert outcomes(verdict) == {"counting": "inconclusive"}
    assert verdict.score is None


def test_a_computer_that_stood_still_costs_the_student_nothing(
    evidence: Evidence, other_course: Path
) -> None:
    """A time limit that is missed while the observer itself was not run: no verdict, the reason."""
    quick = "hz: 4000.0"  # in simulated time the node ran at many times two a second
    topics = change(other_course / "labs/topics/card.yaml", "hz: 2.0", quick)
    stalled = evidence.model_copy(deep=True)
    stalled.experiments["talking"].clock = "wall"
    stalled.experiments["talking"].stall_s = 3.0
    verdict = judge(topics, stalled)
    assert outcomes(verdict) == {"rate": "inconclusive"}
    assert verdict.outcome == "inconclusive"
    assert "3.0 s" in next(str(c.why) for c in verdict.checks if c.id == "rate")


PUBLISHED = "talking.published_by(TALKER)"
BARE: dict[str, tuple[str, str]] = {
    "a message": (f"assert {PUBLISHED} == [], 'it publishes too'", "it publishes too"),
    "one with what was seen": (
        f"assert {PUBLISHED} == [], f'it publishes on {{{PUBLISHED}}}'",
        "it publishes on ['/chatter']",
    ),
    "one of two lines": (
        "assert not CHATTER, 'it is there,\\nand was seen'",
        "it is there, and was seen",
    ),
    "none": (f"assert {PUBLISHED} == []", "it is not so"),
    "one that is raised": ("raise AssertionError('it is not even')", "it is not even"),
    "none that is raised": ("raise AssertionError", "it is not so"),
}


@pytest.mark.parametrize(("line", "measured"), BARE.values(), ids=BARE)
def test_the_message_of_a_bare_assert_is_what_was_measured(
    evidence: Evidence, other_course: Path, line: str, measured: str
) -> None:
    """The student reads it as in CONTRIBUTING, and beside it the check's own line."""
    find = "    talking.topic(CHATTER).must(count_up)"
    topics = change(other_course / "graders/grade_topics.py", find, f"    {line}")
    (failed,) = judge(topics, evidence).failed()
    assert (failed.id, failed.measured) == ("counting", measured)
    assert failed.expected == failed.title


@pytest.mark.parametrize(
    ("find", "replace"),
    [("def test_figure", "def test_picture"), ("import lab\n", "import no_such_word\n")],
    ids=["a check without points", "a file that cannot be read"],
)
def test_a_grader_that_does_not_fit_its_card_is_refused(
    evidence: Evidence, other_course: Path, find: str, replace: str
) -> None:
    """The course is at fault, and says where."""
    topics = change(other_course / "graders/grade_topics.py", find, replace)
    with pytest.raises((BadGrader, ImportError)):
        judge(topics, evidence)
