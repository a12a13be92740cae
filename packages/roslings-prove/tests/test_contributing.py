"""CONTRIBUTING's walk "Add a check", done as it is written: two files make a check."""

from __future__ import annotations

import re
import shutil
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import yaml

from roslings.course import Lab, lab, root
from until_told import checked

pytestmark = pytest.mark.slow

TEXT = (root() / "CONTRIBUTING.md").read_text("utf-8")
WALK = TEXT[TEXT.index("## Add a check") : TEXT.index("## Add a lab")]
NAME = "listener_quiet"


def block(language: str, holding: str) -> str:
    """The walk's block of code that holds a word, without its indentation."""
    blocks = re.findall(rf"^( *)```{language}\n(.*?)^ *```", WALK, re.DOTALL | re.MULTILINE)
    (found,) = [(indent, text) for indent, text in blocks if holding in text]
    indent, text = found
    return "".join(line.removeprefix(indent) for line in text.splitlines(keepends=True))


@pytest.fixture
def changed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Lab:
    """The lab of the walk in a course of its own, with the card and the grader changed."""
    course = tmp_path / "course"
    shutil.copytree(root() / "labs" / "topics", course / "labs" / "topics")
    (course / "graders").mkdir()
    shutil.copy(root() / "graders" / "grade_topics.py", course / "graders")
    monkeypatch.setenv("ROSLINGS_COURSE", str(course))
    made = lab("topics")
    give_points(made.folder / "card.yaml")
    with made.grader.open("a", encoding="utf-8") as grader:
        grader.write("\n\n" + block("python", NAME))
    return lab("topics")


def give_points(card: Path) -> None:
    """As the walk says: from one check to the other; its comment tells what was there."""
    lines = block("yaml", f"{NAME}: ")
    ((check, _, was),) = re.findall(r"(\w+): (\d+) +# was (\d+)", lines)
    text = card.read_text("utf-8")
    assert re.search(rf"  {check}: {was}\b", text), "the card has other points by now"
    card.write_text(re.sub(rf"  {check}: {was}\b.*\n", lines, text), "utf-8")


@pytest.fixture
def verdict(changed: Lab, tmp_path: Path) -> Callable[..., dict[str, Any]]:
    """What `./roslings check topics PACKAGE` says by the changed lab; check to result."""

    def of(package: str) -> dict[str, Any]:
        said = checked("topics", package, folder=tmp_path).verdict
        return {each["id"]: each for each in said["checks"]}

    return of


def test_the_two_files_make_a_check(verdict: Callable[..., dict[str, Any]]) -> None:
    """The solution gets its points, which were another check's."""
    checks = verdict(str(root() / "labs" / "topics" / "solution" / "chatter"))
    assert {check["outcome"] for check in checks.values()} == {"pass"}
    assert sum(check["points"] for check in checks.values()) == 100
    assert checks[NAME]["points"] == 2


@pytest.mark.slow
def test_its_mutant_is_caught(
    changed: Lab, verdict: Callable[..., dict[str, Any]], tmp_path: Path
) -> None:
    """It fails in the checks that the walk names: its own, and no other of the walk's."""
    text = block("yaml", "what:")
    (changed.folder / "mutants" / "second_voice.yaml").write_text(text, "utf-8")
    (mutant,) = [each for each in changed.mutants() if each.name == "second_voice"]
    package = mutant.make(changed.solution, tmp_path / "made" / "chatter").parent
    failed = {name for name, each in verdict(str(package)).items() if each["outcome"] == "fail"}
    assert failed == set(yaml.safe_load(text)["fails"])
