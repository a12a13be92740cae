"""What platforms show in the false language: files of a verdict, and what an instructor reads."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

import pytest
from false_screen import left_plain

from plain_english import plain, words_of
from ros2_on_pip.false_language import false
from ros2_on_pip.language import FALSE, speaking
from roslings import course
from roslings.report.check50 import check50_of
from roslings.report.check50 import refused as refused_by_check50
from roslings.report.classroom import classroom_of
from roslings.report.classroom import refused as refused_by_classroom
from roslings.report.gradescope import gradescope_of
from roslings.report.gradescope import refused as refused_by_gradescope
from roslings.report.junit import lines_of
from roslings.report.prairielearn import prairielearn_of
from roslings.report.prairielearn import refused as refused_by_prairielearn
from roslings.report.refusal import Refusal
from roslings.report.vpl import refused as refused_by_vpl
from roslings.report.vpl import vpl_of
from roslings.verdict import CheckOutcome, CheckResult, Environment, Timings, Verdict
from roslings_class.export import bundle
from roslings_class.export.errors import CannotExport
from roslings_class.export.systems import SYSTEMS, System

LAB = course.lab("nodes")
OUTCOMES: tuple[CheckOutcome, ...] = ("pass", "fail", "skip", "inconclusive")
READ = ("output", "message", "name", "description", "rationale", "help", "value", "format_errors")
"""Fields that people read."""
IDS = frozenset(OUTCOMES) | {"verdict", "submission"}


def verdict(score: float | None) -> Verdict:
    """One check of each outcome, in the false language; without a score it is inconclusive."""
    checks = tuple(
        CheckResult(
            id=outcome,
            title=false("It publishes."),
            outcome=outcome,
            points=1.0,
            max_points=2.0,
            expected=false("a rate") if outcome == "fail" else None,
            measured=false("another rate") if outcome == "fail" else None,
            why=false("Others count on it.") if outcome != "pass" else None,
            hint=false("Look at the timer.") if outcome == "fail" else None,
        )
        for outcome in OUTCOMES
    )
    environment = Environment(
        roslings="", ros_distro="", rmw="", python="", platform="", isolation="", clock="", seed=0
    )
    return Verdict(
        lab=LAB.name,
        package=LAB.outline.package,
        outcome="inconclusive" if score is None else "fail",
        score=score,
        checks=checks,
        advice=(false("Say what your package is for."),),
        seconds=Timings(),
        environment=environment,
    )


def read_in(value: object, field: str = "") -> list[str]:
    """What people read of a platform's file."""
    if isinstance(value, dict):
        return [text for name, each in value.items() for text in read_in(each, name)]
    if isinstance(value, list):
        return [text for each in value for text in read_in(each, field)]
    return [value] if isinstance(value, str) and (field in READ or not field) else []


Shape = Callable[[Verdict], object]
SHAPES: tuple[Shape, ...] = (
    gradescope_of,
    classroom_of,
    prairielearn_of,
    check50_of,
    lambda told: list(vpl_of(told)),
    lambda told: [line for check in told.checks for line in lines_of(check)],
)
REFUSED: tuple[Callable[[Refusal], object], ...] = (
    refused_by_gradescope,
    refused_by_classroom,
    refused_by_prairielearn,
    refused_by_check50,
    lambda told: list(refused_by_vpl(told)),
)


def left_in(file: object) -> list[str]:
    """Plain words in it; marks that VPL looks for are no words."""
    texts = [text.replace("Comment :=>>", "").replace("Grade :=>>", "") for text in read_in(file)]
    return plain([(text.replace("**", " "), "file") for text in texts], IDS)


@pytest.mark.parametrize("score", [50.0, None], ids=["scored", "inconclusive"])
@pytest.mark.parametrize("shape", SHAPES)
def test_a_verdict_as_a_platform_shows_it(shape: Shape, score: float | None) -> None:
    """Labels, outcomes, and why there is no grade."""
    with speaking(FALSE):
        file = shape(verdict(score))
    assert read_in(file) and not left_in(file), left_in(file)
    json.dumps(file)  # no text is left that only we can read


@pytest.mark.parametrize("mine", [True, False], ids=["students", "machines"])
@pytest.mark.parametrize("shape", REFUSED)
def test_where_there_is_no_verdict(shape: Callable[[Refusal], object], mine: bool) -> None:
    """Nobody waits for one."""
    refusal = Refusal(LAB.name, false("No package."), false("Submit one."), mine)
    with speaking(FALSE):
        file = shape(refusal)
    assert not left_in(file), left_in(file)
    json.dumps(file)


# --- for instructors -----------------------------------------------------------------------------


@pytest.mark.parametrize("system", SYSTEMS.values(), ids=lambda system: system.name)
def test_what_is_said_of_a_bundle(system: System, tmp_path: Path) -> None:
    """What goes where, the wall, and the page that tells each step."""
    known = words_of(
        f"{system.name} {LAB.name} {tmp_path} template grader course question protect github"
        " Gradescope GitHub Classroom PrairieLearn Moodle GitLab autograders vpl README"
    )
    with speaking(FALSE):
        told = "\n".join(bundle._told(system, LAB, tmp_path))
        bundle.write_own_files(system, LAB, tmp_path / "made")
    assert not left_plain(" ".join(told.split()), known)
    (readme,) = (tmp_path / "made").glob(bundle.README)
    assert not readme.read_text("utf-8").isascii()
    with speaking("en"):
        bundle.write_own_files(system, LAB, tmp_path / "english")
    assert (tmp_path / "english" / bundle.README).read_text("utf-8").isascii()


def test_why_nothing_is_exported(tmp_path: Path) -> None:
    """A platform that is not known, a folder that holds something."""
    (tmp_path / "file").touch()
    names = words_of(" ".join(SYSTEMS)) | words_of(str(tmp_path)) | {"DIR"}
    with speaking(FALSE):
        for name in ("gradescop", "gradescope"):
            with pytest.raises(CannotExport) as refused:
                bundle.export(name, LAB, tmp_path)
            assert not left_plain(str(refused.value), names | {"to"})
