"""Each kind of mistake that an author makes in a grader, by `check` and by `prove`, for real."""

from __future__ import annotations

import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import pytest

from ros2_on_pip.errors import FAILED, INCONCLUSIVE
from roslings.course import Lab
from roslings_class.result import GradingResult
from roslings_prove.new_lab import new_lab
from roslings_prove.prove import AS_ABOVE, Solution, proof_of


@dataclass(frozen=True)
class Kind:
    """A mistake, and what Python says of it."""

    old: str
    new: str
    said: str
    seen_in_files: bool = True
    """`prove` need not grade anything to find it."""


WATCH = "scene.watch(ALIVE)"
QUIET = "telling.topic(ALIVE).must(have_rate(ALIVE))"
KINDS = {
    "an unknown name in an experiment": Kind(
        WATCH, "scene.watch(ALIFE)", "NameError: name 'ALIFE' is not defined"
    ),
    "an unknown action in an experiment": Kind(
        WATCH,
        "scene.wach(ALIVE)",
        "AttributeError: 'Scene' object has no attribute 'wach'",
        seen_in_files=False,
    ),
    "a wrong thing for an action": Kind(
        "scene.run(ALARM)",
        'scene.run("alarm")',
        "AttributeError: 'str' object has no attribute 'executable'",
        seen_in_files=False,
    ),
    "an unknown name in a check": Kind(
        QUIET,
        "telling.topic(ALIFE).must(have_rate(ALIVE))",
        "NameError: name 'ALIFE' is not defined",
    ),
    "an unknown view in a check": Kind(
        QUIET,
        "telling.topc(ALIVE).must(have_rate(ALIVE))",
        "AttributeError: 'ExperimentView' object has no attribute 'topc'",
        seen_in_files=False,
    ),
    "a misspelt demand": Kind(
        "import count_up, have_rate",
        "import count_up, hav_rate",
        "ImportError: cannot import name 'hav_rate'",
    ),
    "a wrong import": Kind(
        "from roslings.course import lab",
        "from roslings.corse import lab",
        "ModuleNotFoundError: No module named 'roslings.corse'",
    ),
    "no Python": Kind("def test_ends(", "def test_ends((", "SyntaxError: "),
}


def test_what_the_grader_did_is_told_once(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """It is wrong, and not open: to prove it again would tell the same."""
    monkeypatch.setenv("ROSLINGS_COURSE", str(tmp_path))
    package = Solution(new_lab("range-alarm", "alarm", "03-topics"))
    result = GradingResult(
        submission=package.name,
        digest="",
        attempt=1,
        state="broken",
        broken_by_grader=True,
        reason="The grader has a mistake: graders/grade_range_alarm.py:46\nNameError",
    )
    first = proof_of(package, result)
    assert not first.holds and not first.is_open
    assert "grade_range_alarm.py:46\n       NameError" in first.line
    assert proof_of(package, result, {result.grader_broke}).problem == AS_ABOVE
    busy = result.model_copy(update={"broken_by_grader": False})
    assert proof_of(package, busy, {""}).is_open


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS.values(), ids=KINDS)
def test_a_mistake_in_a_grader_is_told_with_its_line(
    kind: Kind, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """File, line, Python's words, and the next step: of each kind, by both commands."""
    monkeypatch.setenv("ROSLINGS_COURSE", str(tmp_path))
    lab = new_lab("range-alarm", "alarm", "03-topics")
    line = spoil(lab, kind)
    checked = run("check", lab.name, "--solution", cwd=tmp_path)
    assert checked.returncode == INCONCLUSIVE, checked.stdout + checked.stderr
    insist(checked.stdout + checked.stderr, kind, line)
    proven = prove(lab, tmp_path, in_files=kind.seen_in_files)
    assert proven.returncode == FAILED, proven.stdout + proven.stderr
    insist(proven.stdout, kind, line)
    assert ("Nothing was graded." in proven.stdout) is kind.seen_in_files
    assert "prove it again" not in proven.stdout


def spoil(lab: Lab, kind: Kind) -> int:
    """Make the mistake; returns the line of it."""
    text = lab.grader.read_text("utf-8")
    assert text.count(kind.old) == 1
    lab.grader.write_text(text.replace(kind.old, kind.new), "utf-8")
    return text[: text.index(kind.old)].count("\n") + 1


def prove(lab: Lab, folder: Path, *, in_files: bool) -> subprocess.CompletedProcess[str]:
    """What the files tell; else solution, starter and one mutant are graded, the others left."""
    words = ("prove", lab.name, "--packages")
    if in_files:
        return run(*words, cwd=folder)
    for mutant in (lab.folder / "mutants").glob("*.yaml"):
        if mutant.stem != "rate_2_hz":
            mutant.unlink()
    return run(*words, "--anyway", cwd=folder)


def run(*words: str, cwd: Path) -> subprocess.CompletedProcess[str]:
    """The command, as an author types it; that nobody can tell is what it is to say."""
    command = [sys.executable, "-m", "roslings", *words]
    return subprocess.run(command, capture_output=True, text=True, check=False, cwd=cwd)


def insist(said: str, kind: Kind, line: int) -> None:
    """All of it is there, whatever lines a terminal makes of it."""
    words = " ".join(said.replace("│", " ").split())
    assert f"graders/grade_range_alarm.py:{line}" in words, said
    assert kind.said in words, said
    assert "mends this line" in words or "Mend this first" in words, said
    assert "The measurement broke off" not in words
