"""A new lab works from the first minute, and `prove` tells when it does not any more."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import pytest

from roslings.course import Lab, lab, root
from roslings.workspace.inspect import inspect_package
from roslings_prove.consistency import files_fit
from roslings_prove.new_lab import CannotMake, new_lab
from roslings_prove.prove import gradings_fit, packages_of


@pytest.fixture
def made(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Lab:
    """A lab made in a course of its own."""
    monkeypatch.setenv("ROSLINGS_COURSE", str(tmp_path))
    return new_lab("line-follower", package="follower", day="09-lines")


def test_everything_has_the_new_names(made: Lab, tmp_path: Path) -> None:
    """No word of the example stays, neither in a text nor in a path."""
    files = [path for path in tmp_path.rglob("*") if path.is_file()]
    assert len(files) > 20
    for path in files:
        text = f"{path.relative_to(tmp_path)}\n{path.read_text('utf-8')}"
        assert "beacon" not in text.lower()
        assert "example" not in text.replace("example.com", "")
    assert (made.card.id, made.card.package, made.card.day) == (
        "line-follower",
        "follower",
        "09-lines",
    )


def test_its_parts_fit_each_other(made: Lab) -> None:
    """Task, hints, packages and mutants, as far as files tell."""
    assert [proof.line for proof in files_fit(made) if not proof.holds] == []
    for package in (made.solution, made.starter):
        seen = inspect_package(package, made.card)
        assert not [*seen.xml_problems, *seen.missing_files, *seen.syntax_errors]
    assert {check for mutant in made.mutants() for check in mutant.fails} == set(made.card.points)


def test_what_does_not_fit_is_told(made: Lab) -> None:
    """A check without hint, mutant and function, and a task that is older than the card."""
    card = made.folder / "card.yaml"
    text = card.read_text("utf-8").replace("  ends: 5", "  ends: 3\n  extra: 2")
    card.write_text(text.replace("hz: 1.0", "hz: 4.0"), "utf-8")
    wrong = "\n".join(proof.line for proof in files_fit(lab("line-follower")) if not proof.holds)
    assert wrong.count("WRONG") == 4
    assert wrong.count("extra") == 3
    assert "roslings.course.task line-follower" in wrong


@pytest.mark.parametrize(
    ("name", "package", "day"),
    [
        ("Line", None, None),
        ("a_b", None, None),
        ("../x", None, None),
        ("example", None, None),
        ("fine", "9x", None),
        ("fine", "a-b", None),
        ("fine", None, "monday"),
        ("", None, None),
    ],
)
def test_a_name_that_would_not_work_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str, package: str | None, day: str | None
) -> None:
    """And nothing is made."""
    monkeypatch.setenv("ROSLINGS_COURSE", str(tmp_path))
    with pytest.raises(CannotMake):
        new_lab(name, package, day)
    assert list(tmp_path.iterdir()) == []


def test_a_day_that_is_not_there_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """With the days that are; and nothing is made."""
    (tmp_path / "days/02-lines").mkdir(parents=True)
    monkeypatch.setenv("ROSLINGS_COURSE", str(tmp_path))
    with pytest.raises(CannotMake, match=r"Did you mean 02-lines\?\nThe days are: 02-lines\."):
        new_lab("fine", day="03-lines")
    assert [path.name for path in tmp_path.iterdir()] == ["days"]
    assert new_lab("fine").card.day == "02-lines"


def test_every_page_names_days_that_are_there() -> None:
    """In each command that takes one."""
    pages = [root() / "README.md", root() / "CONTRIBUTING.md", *root().glob("site/pages/**/*.md")]
    texts = "\n".join(page.read_text("utf-8") for page in pages)
    named = re.findall(r"new-lab [^`\n]*--day (\S+)", texts)
    assert named
    assert [day for day in named if not (root() / "days" / day).is_dir()] == []


def test_a_lab_is_never_overwritten(made: Lab) -> None:
    """Nor is a grader."""
    (made.folder / "card.yaml").write_text("mine", "utf-8")
    with pytest.raises(CannotMake, match="there already"):
        new_lab("line-follower")
    assert (made.folder / "card.yaml").read_text("utf-8") == "mine"


@pytest.mark.slow
def test_a_new_lab_is_proven_and_a_spoilt_one_is_not(made: Lab, tmp_path: Path) -> None:
    """For real, with the command."""
    command = [sys.executable, "-m", "roslings", "prove", "line-follower"]
    done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=tmp_path)
    assert done.returncode == 0, done.stdout
    assert "is proven" in done.stdout
    code = made.solution / "follower" / "follower.py"
    code.write_text(code.read_text("utf-8").replace("1.0,", "0.9,"), "utf-8")
    (made.folder / "mutants" / "rate_2_hz.yaml").unlink()
    command += ["--packages", "--anyway"]
    done = subprocess.run(command, capture_output=True, text=True, check=False, cwd=tmp_path)
    assert done.returncode == 1
    assert "WRONG  line-follower: the solution gets 100 of 100" in done.stdout


def test_a_refused_package_is_not_proven(made: Lab) -> None:
    """A solution that cannot even be read is wrong, not a crash."""
    (made.solution / "package.xml").unlink()
    (made.starter / "package.xml").unlink()
    for mutant in (made.folder / "mutants").iterdir():
        mutant.unlink()
    proofs = list(gradings_fit(packages_of(made), lambda standing: None, jobs=2))
    assert [proof.holds for proof in proofs] == [False, False]
    assert "package.xml" in proofs[0].problem
