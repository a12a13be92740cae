"""What is typed around a check, in the false language: `start`, `diff`, `pack`, a hint."""

from __future__ import annotations

import argparse
from pathlib import Path

import pytest
from false_screen import Type, left_plain, require_columns, require_no_english

from plain_english import words_of
from ros2_on_pip.language import ENGLISH, FALSE, speaking, template
from roslings import course
from roslings.commands.holding import told_of_no_wall
from roslings.commands.showing import kept
from roslings.evidence import BuildSeen, Evidence, LogLine, ProcessSeen, SoakSeen
from roslings.grading import handing_in
from roslings.judge.plugin import hint_id
from roslings.report.json_file import write_json
from roslings.verdict import CheckResult, Environment, Timings, Verdict
from roslings.workspace.own_card import NotAStudentName, take_name, told_of

LABS = course.all_labs()
LAB = LABS[0]
PLACES = frozenset({"ws", "tmp", "src", LAB.outline.package})


def test_a_lab_is_started_compared_and_packed(typed: Type, tmp_path: Path) -> None:
    """Put there, looked at, made a file of, and of that another one."""
    with speaking(FALSE):
        card = words_of((LAB.folder / "card.yaml").read_text("utf-8"))
    zipped = str(tmp_path / "lab.zip")
    for words in (
        ("start", LAB.name),
        ("diff", LAB.name),
        ("pack", LAB.name, "--out", zipped, "--soak", "0"),
        ("pack", LAB.name, "--out", zipped, "--soak", "0"),
    ):
        require_no_english(typed(*words), PLACES | card)


def test_in_english_they_fit_a_terminal(typed: Type, tmp_path: Path) -> None:
    """A path stays in one piece where it fits a line."""
    for words in (("start", LAB.name), ("diff", LAB.name), ("pack", LAB.name, "--soak", "0")):
        if words[0] == "pack":
            words = (*words, "--out", str(tmp_path / "lab.zip"))
        require_columns(typed(*words, language=ENGLISH))


def test_a_hint_for_the_last_check(typed: Type, tmp_path: Path) -> None:
    """Each step of each check, from a verdict that was kept in the false language."""
    typed("start", LAB.name)
    for name in LAB.hints:
        with speaking(FALSE):
            kept(LAB).parent.mkdir(parents=True, exist_ok=True)
            write_json(verdict(name), kept(LAB))
        for step in "123":
            said = typed("check", LAB.name, "--hint", step)
            whole = " ".join(line for line in said.splitlines() if not line.startswith("      "))
            known = words_of((LAB.folder / "card.yaml").read_text("utf-8"))
            assert not left_plain(whole, PLACES | known | words_of(name))


def verdict(name: str) -> Verdict:
    """In which one check failed."""
    steps = enumerate(LAB.hints[name].steps, 1)
    hints = tuple(template(hint_id(LAB.name, name, n), step) for n, step in steps)
    failed = CheckResult(id=name, title="", outcome="fail", points=0, max_points=100, hints=hints)
    environment = Environment(
        roslings="", ros_distro="", rmw="", python="", platform="", isolation="", clock="", seed=0
    )
    return Verdict(
        lab=LAB.name,
        package=LAB.outline.package,
        outcome="fail",
        score=0.0,
        checks=(failed,),
        seconds=Timings(),
        environment=environment,
    )


def process(**seen: object) -> ProcessSeen:
    """A node of the lab."""
    fields = {"executable": "talker", "started_ns": 0, "ended_ns": 30_000_000_000, **seen}
    return ProcessSeen.model_validate(fields)


@pytest.mark.parametrize("built", [False, True], ids=["not-built", "built"])
def test_nodes_that_are_left_running(built: bool) -> None:
    """What `pack` says of each that stays, that ends, and that is not there."""
    line = LogLine(arrival_ns=0, text="'too late'", source="terminal")
    processes = {
        "stays": process(asked_to_end_ns=29_000_000_000, status=0),
        "ends": process(ended_by_itself=True, status=1, lines=[line]),
        "missing": process(),
    }
    build = BuildSeen(
        succeeded=True, recognised_as=None, seconds=1.0, executables=["stays", "ends"]
    )
    seen = Evidence.model_construct(
        build=build if built else None, soak=SoakSeen(for_s=30.0, processes=processes)
    )
    with speaking(FALSE):
        said = "\n".join(handing_in._told(LAB, seen))
    assert not left_plain(said, frozenset({"talker", "missing", "roslings"}))
    assert len(said.splitlines()) == (5 if built else 1)


def test_a_card_of_ones_own(typed: Type) -> None:
    """Whose it is, what is one's own in it; a lab that has one card; a name that is none."""
    known = frozenset({"Ada"})
    with speaking(FALSE):
        with pytest.raises(NotAStudentName) as refused:
            take_name("---")
        assert not left_plain(str(refused.value), frozenset({"for"}))
        take_name("Ada")
        for lab in LABS:
            first = next(told_of(lab.name))
            assert not left_plain(first, known | words_of(lab.name))


def test_a_package_that_nothing_holds(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    """Its reason is one of the machine's."""
    monkeypatch.setenv("ROSLINGS_WS", str(tmp_path / "ws"))
    wall = argparse.Namespace(sandbox=False, lack=None, because="")
    monkeypatch.setattr("roslings.arena.choose_isolation", lambda: wall)
    options = argparse.Namespace(solution=False, trust=False)
    with speaking(FALSE):
        assert not left_plain(told_of_no_wall(tmp_path, options), frozenset({"as", "stranger"}))
