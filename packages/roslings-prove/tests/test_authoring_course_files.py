"""What `release` and `export` take along, and that they say what they leave out."""

from __future__ import annotations

import os
import subprocess
from pathlib import Path

import pytest

from roslings import course
from roslings_class.course_files import CannotCollect, course_files
from roslings_class.export import export
from roslings_class.release import NO_SITE, release
from roslings_launcher.cli import main
from roslings_prove.new_lab import new_lab

GIT = ("-c", "user.name=a", "-c", "user.email=a@example.org", "-c", "commit.gpgsign=false")


def git(folder: Path, *words: str) -> None:
    """One command of git, that ends well."""
    subprocess.run(["git", *GIT, *words], cwd=folder, check=True, capture_output=True)


@pytest.fixture
def clone(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A course of somebody else's: a lab that is committed, one that is not, and private things."""
    folder = tmp_path / "course"
    folder.mkdir()
    monkeypatch.setenv("ROSLINGS_COURSE", str(folder))
    git(folder, "init", "--quiet")
    new_lab("old", "lamp")
    (folder / ".gitignore").write_text("secret.csv\n")
    git(folder, "add", ".")
    git(folder, "commit", "--quiet", "--message", "old")
    new_lab("new", "siren")
    (folder / "graders/hidden_new.py").write_text("POINTS = {}\n")
    (folder / "grades").mkdir()
    (folder / "grades/ann.csv").write_text("ann,100\n")
    (folder / "secret.csv").write_text("bo,0\n")
    return folder


def test_release_and_export_see_the_same_labs(
    clone: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """One that is not committed too, and both say so; what is private stays where it is."""
    for name, command in (("r", ["release"]), ("e", ["export", "gradescope", "new"])):
        assert main([*command, "--to", str(tmp_path / name)]) == 0
        told = capsys.readouterr().out
        assert "Not committed yet, and in it as it is now: graders/grade_new.py, labs/new" in told
        assert "Not committed, and not in it: graders/hidden_new.py, grades/ann.csv." in told
        assert "git add" in told
        made = {path.name for path in (tmp_path / name).rglob("*") if path.is_file()}
        assert "grade_new.py" in made
        assert not made & {"ann.csv", "secret.csv", "hidden_new.py"}
    assert (tmp_path / "r/labs/new/card.yaml").is_file()
    assert not (tmp_path / "r/labs/new/solution").exists()


def test_what_is_committed_needs_no_word(clone: Path, tmp_path: Path) -> None:
    """Nothing is told of a lab that git keeps, nor of a clean folder but that no site is built."""
    assert not [
        line
        for line in export("gradescope", course.lab("old"), tmp_path / "e")
        if "Not committed yet" in line
    ]
    git(clone, "add", ".")
    assert release(tmp_path / "r").remarks == [NO_SITE]


@pytest.mark.parametrize("kept", [True, False], ids=["a clone", "no clone"])
def test_an_engine_elsewhere_comes_along(kept: bool, clone: Path, tmp_path: Path) -> None:
    """A course without one of its own is whole in its edition."""
    if not kept:
        (clone / ".git").rename(tmp_path / "git")
    release(tmp_path / "r")
    for name in (
        "roslings",
        "pyproject.toml",
        "constraints.txt",
        "packages/roslings/src/roslings/commands/check.py",
    ):
        assert (tmp_path / "r" / name).is_file(), name
    assert os.access(tmp_path / "r/roslings", os.X_OK)


def test_a_clone_that_git_does_not_read_is_refused(clone: Path) -> None:
    """Rather than all of the folder, with what is private."""
    (clone / ".git/HEAD").write_text("nothing\n")
    with pytest.raises(CannotCollect, match="git does not say"):
        course_files()
