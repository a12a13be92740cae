"""The instructor's page names what a hand-in did that is not ordinary."""

from __future__ import annotations

from pathlib import Path

import pytest

from roslings.course import lab
from roslings.evidence import (
    BuildSeen,
    Evidence,
    ExperimentSeen,
    ProcessSeen,
)
from roslings_class.class_page import write_class_page
from roslings_class.grades import Class, StudentGrade
from roslings_class.result import GradingResult
from roslings_class.unusual import BOUNDS, unusual


def evidence_of(*processes: ProcessSeen, build: BuildSeen | None = None) -> Evidence:
    """Of one experiment for each process."""
    seen = {
        str(number): ExperimentSeen(name=str(number), clock="wall", processes={"it": each})
        for number, each in enumerate(processes)
    }
    return Evidence.model_construct(build=build, experiments=seen, attempts=[])


def process(**words: object) -> ProcessSeen:
    """The talker's."""
    return ProcessSeen.model_validate({"executable": "talker", "started_ns": 0, **words})


def test_an_ordinary_one_is_not_named() -> None:
    """Nor a build that failed by itself."""
    failed = BuildSeen(
        succeeded=False, recognised_as=None, seconds=1, output=["SyntaxError: invalid syntax"]
    )
    assert unusual(evidence_of(process(), build=failed)) == ()


@pytest.mark.parametrize("bound", BOUNDS)
def test_each_bound_is_named(bound: str) -> None:
    """In words, with the number of runs."""
    met = process(bounds_met=[bound])
    assert unusual(evidence_of(met, met)) == (f"talker {BOUNDS[bound]} (2 times)",)


def test_what_was_left_and_a_build_without_end_are_named() -> None:
    """With their numbers."""
    build = BuildSeen(
        succeeded=False,
        recognised_as=None,
        seconds=45,
        output=["x", "The build did not end within 45 s."],
    )
    assert unusual(evidence_of(process(left_behind=3), build=build)) == (
        "The build did not end within 45 s.",
        "talker ended, and left 3 processes running",
    )


def test_refused_calls_a_full_disk_and_busy_threads_are_named() -> None:
    """Of a run and of a build alike, with their numbers."""
    taken = {"filled_its_disk": True, "refused_calls": {"unshare": 2, "keyctl": 1}, "most_busy": 50}
    build = BuildSeen(succeeded=True, recognised_as=None, seconds=1, **taken)
    assert unusual(evidence_of(process(**taken), build=build)) == tuple(
        f"{name} {words}"
        for name in ("The build", "talker")
        for words in (
            "filled the disk that a sandbox has",
            "made calls that no lab needs, and they were refused: keyctl (1), unshare (2)",
            "kept up to 50 threads busy at once, so it was put behind all others",
        )
    )


def test_the_class_page_names_who_did_it(tmp_path: Path) -> None:
    """And says that it may be a mistake; where nobody did such a thing, it says nothing."""
    ordinary = result("honest")
    bomb = result("bomb", unusual=("talker wanted <b>more</b>",))
    broke = result("endless", state="broken", reason="The grading did not end within 900 s.")
    page = page_of([ordinary, bomb, broke], tmp_path)
    section = page.partition("What was not ordinary")[2].partition("</section>")[0]
    assert "talker wanted &lt;b&gt;more&lt;/b&gt;" in section
    assert "did not end within 900 s" in section
    assert "bomb" in section and "honest" not in section
    assert "A mistake can do this" in section
    assert "What was not ordinary" not in page_of([ordinary], tmp_path)


def result(name: str, **words: object) -> GradingResult:
    """Of one submission."""
    begin = {"submission": name, "digest": name, "attempt": 1, "state": "graded"}
    return GradingResult.model_validate({**begin, **words})


def page_of(results: list[GradingResult], tmp_path: Path) -> str:
    """The class's page."""
    grades = [StudentGrade(student=None, result=each) for each in results]
    write_class_page(lab("topics"), Class(grades), (), tmp_path / "class.html")
    return (tmp_path / "class.html").read_text("utf-8")
