"""What the short commands do not import: a line on the screen needs no model of evidence."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from ros2_on_pip.problem import CommandProblem
from roslings import course
from roslings.verdict import CheckResult, Environment, Timings, Verdict
from roslings.workspace.errors import CannotRead, NoWorkspace
from roslings_launcher.cli import MEANT, exit_code_of, main
from roslings_launcher.cli.table import commands

ENGINE = (
    "roslings.arena",
    "roslings_class",
    "roslings.evidence",
    "roslings.experiment",
    "roslings.judge",
    "roslings.probe",
    "roslings.grading.saving",
    "rclpy",
    "pytest",
    "numpy",
    "matplotlib",
)
"""What measures and judges."""
MODELS = ("pydantic", "rich", "roslings.course.card", "roslings.verdict", "roslings.report")
SEES = """
import atexit, json, sys
told = open(sys.argv.pop(1), "w")
atexit.register(lambda: json.dump(sorted(sys.modules), told))
from roslings_launcher.cli import main
sys.exit(main(sys.argv[1:]))
"""


@pytest.fixture
def workspace(tmp_path: Path) -> Path:
    """A student's workspace, with the verdict of an earlier check in it."""
    failed = CheckResult(
        id="rate",
        title="The rate",
        outcome="fail",
        points=0,
        max_points=100,
        hints=("Look at the timer.", "A period is 1 / rate.", "create_timer(0.5, ...)"),
    )
    environment = Environment(
        roslings="", ros_distro="", rmw="", python="", platform="", isolation="", clock="", seed=0
    )
    verdict = Verdict(
        lab="topics",
        package="chatter",
        outcome="fail",
        score=0.0,
        checks=(failed,),
        seconds=Timings(),
        environment=environment,
    )
    kept = tmp_path / "ws/.roslings"
    kept.mkdir(parents=True)
    (kept / "verdict-topics.json").write_text(verdict.model_dump_json(by_alias=True))
    (kept / "progress.json").write_text('{"schema": 1, "labs": {"topics": {"best": 40}}}')
    return tmp_path / "ws"


def imported_by(words: list[str], workspace: Path, code: int = 0) -> list[str]:
    """The modules that a command has imported at its end."""
    told = workspace.parent / "imported.json"
    done = subprocess.run(
        [sys.executable, "-c", SEES, told, *words],
        env={**os.environ, "ROSLINGS_WS": str(workspace), "PYTHONPATH": os.pathsep.join(sys.path)},
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == code, done.stderr
    assert done.stdout or done.stderr
    modules: list[str] = json.loads(told.read_text())
    return modules


def among(modules: list[str], rooms: tuple[str, ...]) -> list[str]:
    """Those of `modules` that are one of `rooms`, or lie in one."""
    return [
        name
        for name in modules
        if name.startswith(tuple(f"{room}." for room in rooms)) or name in rooms
    ]


@pytest.mark.parametrize("words", [[], ["status"], ["start", "topics"]], ids=" ".join)
def test_a_short_command_makes_no_models(words: list[str], workspace: Path) -> None:
    """It reads the outline of each card, and two numbers a lab."""
    modules = imported_by(words, workspace)
    assert among(modules, (*ENGINE, *MODELS)) == []
    assert "roslings.course.outline" in modules


@pytest.mark.parametrize("words", [[], ["status"], ["doctor", "--list"]], ids=" ".join)
def test_english_reads_no_language(words: list[str], workspace: Path) -> None:
    """It stands in the code: no file is read for it, and nothing that finds or reads files."""
    modules = imported_by(words, workspace)
    assert among(modules, ("yaml", "importlib.metadata", "ros2_on_pip.false_language")) == []


def test_neither_does_what_cannot_be_done(workspace: Path) -> None:
    """A lab that is begun already, and a name with a mistake in it, are answered as soon."""
    imported_by(["start", "topics"], workspace)
    for words in (["start", "topics"], ["start", "topcis"]):
        assert among(imported_by(words, workspace, 2), (*ENGINE, *MODELS)) == []


def test_what_was_changed_is_shown_without_models(workspace: Path) -> None:
    """`diff` compares files."""
    imported_by(["start", "topics"], workspace)
    modules = imported_by(["diff", "topics"], workspace)
    assert among(modules, (*ENGINE, "pydantic", "rich", "roslings.verdict")) == []


def test_a_hint_reads_the_verdict_and_nothing_else(workspace: Path) -> None:
    """The card, the grader and the evidence are not asked again."""
    modules = imported_by(["check", "topics", "--hint"], workspace, 1)
    assert among(modules, (*ENGINE, "roslings.course.card")) == []
    assert "roslings.verdict" in modules


def test_an_outline_says_what_its_card_says() -> None:
    """They are read in two ways."""
    for lab in course.all_labs():
        card = lab.card
        outline = (lab.outline.title, lab.outline.day, lab.outline.needs, lab.outline.package)
        assert outline == (card.title, card.day, card.needs, card.package)


@pytest.mark.parametrize(
    ("was", "now", "problem"),
    [
        ("title: A talker and a listener", "title: [1]", "title"),
        ("day: 03-topics", "day: third", "day"),
        ("package: chatter", "package: ../chatter", "package"),
        ("package: chatter", "packages: chatter", "package"),
    ],
)
def test_an_outline_that_cannot_be_read_is_told_by_the_card(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, was: str, now: str, problem: str
) -> None:
    """With file, line and word, as ever."""
    card = tmp_path / "labs/topics/card.yaml"
    card.parent.mkdir(parents=True)
    text = (course.lab("topics").folder / "card.yaml").read_text()
    assert was in text
    card.write_text(text.replace(was, now))
    monkeypatch.setenv("ROSLINGS_COURSE", str(tmp_path))
    with pytest.raises(course.CourseError, match=rf"card\.yaml:\d+: .*{problem}"):
        _ = course.lab("topics").outline


def test_the_narrower_error_decides() -> None:
    """The disk is the machine's fault, a missing workspace is not; a mistake of ours is neither."""
    assert exit_code_of(CannotRead(Path("x"))) == 3
    assert exit_code_of(NoWorkspace(Path("x"), "topics")) == 2
    assert exit_code_of(CommandProblem("no middleware")) == 2
    assert exit_code_of(KeyError("x")) is None


@pytest.mark.parametrize(
    ("typed", "told"),
    [
        ("chek", "there is no command 'chek'. Did you mean check?"),
        ("Check", "Did you mean check?"),
        ("qiuz", "Did you mean quiz?"),
        ("drils", "Did you mean drill?"),
        ("hint", "Did you mean check LAB --hint, or drill NAME --hint?"),
        ("submit", "Did you mean pack?"),
        ("reset", "Did you mean watch, and then the key x?"),
        ("xyz", "there is no command 'xyz'. All commands: ./roslings --help"),
    ],
)
def test_a_word_that_is_no_command(
    typed: str, told: str, capsys: pytest.CaptureFixture[str]
) -> None:
    """The nearest one is named, or where they are listed."""
    assert main([typed]) == 2
    assert told in capsys.readouterr().err


def test_each_word_that_is_meant_leads_to_a_command() -> None:
    """None of them is a command itself."""
    for word, meant in MEANT.items():
        assert word not in commands()
        assert meant.split(",")[0].split()[0] in {*commands(), "./roslings"}, meant


def test_the_help_has_two_lists(capsys: pytest.CaptureFixture[str]) -> None:
    """A learner finds the few that are for learners, on a screen of 80 columns."""
    with pytest.raises(SystemExit):
        main(["--help"])
    told = capsys.readouterr().out
    mine, others = told.split("for instructors and authors:")
    assert "  check " in mine and "  grade " in others
    assert max(map(len, told.splitlines())) <= 80
