"""Which changes are asked about, and what is done to a package for it: nothing."""

from __future__ import annotations

import ast
import shutil
from collections.abc import Sequence
from pathlib import Path

import pytest

from roslings.course import Lab, lab
from roslings.verdict import CheckResult, Environment, Timings, Verdict
from roslings_changes.candidates import CodeChange, candidates
from roslings_changes.questions import MOST_GRADED, PLAIN, WANTED, drawn, graded, questions

CHECKS = ("builds", "rate", "text", "ends")
HERE = Environment(
    roslings="0",
    ros_distro="jazzy",
    rmw="",
    python="",
    platform="",
    isolation="domain",
    clock="sim",
    seed=1,
)


def verdict(*failed: str, inconclusive: Sequence[str] = ()) -> Verdict:
    """One in which these checks fail."""
    checks = tuple(
        CheckResult(
            id=name,
            title=f"About {name}.",
            points=0,
            max_points=25,
            outcome="fail"
            if name in failed
            else "inconclusive"
            if name in inconclusive
            else "pass",
        )
        for name in CHECKS
    )
    outcome = "inconclusive" if inconclusive else "fail" if failed else "pass"
    return Verdict(
        lab="topics",
        package="chatter",
        outcome=outcome,
        score=None if inconclusive else 0,
        checks=checks,
        seconds=Timings(),
        environment=HERE,
    )


@pytest.fixture
def topics() -> Lab:
    """The lab whose solution is asked about."""
    return lab("topics")


@pytest.fixture
def package(topics: Lab, tmp_path: Path) -> Path:
    """A copy of its solution."""
    return Path(shutil.copytree(topics.solution, tmp_path / "chatter"))


def content(folder: Path) -> dict[str, bytes]:
    """All files."""
    return {str(f.relative_to(folder)): f.read_bytes() for f in folder.rglob("*") if f.is_file()}


def test_each_is_another_line_and_read_on_one_screen(topics: Lab, package: Path) -> None:
    """And the program still compiles."""
    found = list(drawn(candidates(topics, package)))
    assert len(found) > 10 and {each.operator for each in found} <= PLAIN
    assert len({each.place for each in found}) == len(found)
    for each in found:
        ast.parse(each.after)
        assert each.changed.startswith("-")


def test_two_packages_get_other_questions(topics: Lab, package: Path, tmp_path: Path) -> None:
    """The same one the same, whatever its folder is called."""
    again = Path(shutil.copytree(package, tmp_path / "again"))
    node = again / "chatter/talker.py"
    first = [each.changed for each in drawn(candidates(topics, package))]
    assert [each.changed for each in drawn(candidates(topics, again))] == first
    node.write_text(f"{node.read_text('utf-8')}\n# my own\n", "utf-8")
    assert [each.changed for each in drawn(candidates(topics, again))] != first


def test_the_package_stays_and_the_copy_is_gone(topics: Lab, package: Path) -> None:
    """What is graded is a copy with the change alone."""
    before = content(package)
    change = candidates(topics, package)[0]
    seen: list[Path] = []

    def grade(copy: Path) -> Verdict:
        seen.append(copy)
        assert content(copy) == before | {change.file: change.after.encode()}
        return verdict()

    graded(package, change, grade)
    assert content(package) == before and not seen[0].exists()


def test_each_question_is_about_another_check(topics: Lab, package: Path) -> None:
    """What is not caught, and what could not be told, is no question."""
    given = [
        verdict(),
        verdict("rate", "ends"),
        verdict("rate"),
        verdict(inconclusive=["text"]),
        verdict("text"),
        verdict("builds"),
        verdict("ends"),
    ]
    verdicts = iter(given)
    found = list(questions(topics, package, lambda _: next(verdicts)))
    assert [each.failed.id for each in found] == ["rate", "text", "builds"]
    assert len(found) == WANTED and len(list(verdicts)) == 1


def test_where_nothing_is_caught_it_ends(topics: Lab, package: Path) -> None:
    """After so many gradings."""
    tried: list[Path] = []

    def grade(copy: Path) -> Verdict:
        tried.append(copy)
        return verdict()

    assert list(questions(topics, package, grade)) == []
    assert len(tried) == MOST_GRADED


def test_a_change_names_its_line() -> None:
    """The one that differs first."""
    change = CodeChange("number", "a/b.py", 2, "x = 1\ny = 2\n", "x = 1\ny = 3\n")
    assert change.changed == "-y = 2\n+y = 3" and change.place == ("a/b.py", 2)
