"""Whose cards a workspace has: said once, kept there, and asked by each command."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

import pytest

from roslings.course import lab
from roslings.course.variants import NoVariants, chosen
from roslings.workspace.own_card import NotAStudentName, own_lab, take_name, told_of, whose_cards


@pytest.fixture(autouse=True)
def course_of_everybody(monkeypatch: pytest.MonkeyPatch) -> None:
    """What a test chooses is forgotten after it."""
    monkeypatch.setenv("ROSLINGS_COURSE", "")


def test_without_a_name_everybody_has_the_same_card(workspace: Path) -> None:
    """And nothing is written."""
    assert whose_cards() == "" and list(told_of("topics")) == []
    assert own_lab("topics") == lab("topics")
    assert not workspace.exists()


def test_with_a_name_each_command_knows_the_own_card(workspace: Path) -> None:
    """It is made once; a second command finds it there, and so does a process that it starts."""
    take_name("s1001")
    want = chosen(lab("topics"), "s1001")
    assert next(told_of("topics")) == ("Your card of 'topics' is that of s1001. Its own words:")
    own = own_lab("topics")
    assert own.card.node("talker").publishes[0].rate.hz == want.words["rate"]  # type: ignore[union-attr]
    assert own.folder.is_relative_to(workspace / ".roslings")
    assert os.environ["ROSLINGS_COURSE"] == str(own.folder.parents[1])
    stamp = own.folder.stat().st_mtime_ns
    assert own_lab("topics").folder == own.folder  # a choice is made once
    os.environ["ROSLINGS_COURSE"] = ""
    assert own_lab("topics").folder.stat().st_mtime_ns == stamp


def test_another_name_takes_the_place_of_the_first(workspace: Path) -> None:
    """Only the last one's card stays."""
    take_name("s1001")
    first = own_lab("topics").folder
    os.environ["ROSLINGS_COURSE"] = ""
    take_name("s1002")
    second = own_lab("topics").folder
    assert first != second and not first.exists() and second.is_dir()
    assert len(list((workspace / ".roslings" / "variants").iterdir())) == 1


def test_a_lab_without_a_choice_is_everybodys(workspace: Path) -> None:
    """It is said, and whoever asks for a card by name is told."""
    take_name("s1001")
    assert own_lab("nodes") == lab("nodes")
    assert list(told_of("nodes")) == ["The lab 'nodes' has one card for everybody."]
    with pytest.raises(NoVariants, match=r"no labs/nodes/variants\.yaml"):
        own_lab("nodes", whose="s1001")


def test_for_somebody_else_is_for_one_command(workspace: Path) -> None:
    """An instructor looks at a hand-in; the workspace stays whose it is."""
    take_name("s1001")
    mine = own_lab("topics").folder
    os.environ["ROSLINGS_COURSE"] = ""
    assert own_lab("topics", whose="s1002").folder != mine
    assert mine.is_dir() and whose_cards() == "s1001"


def test_after_a_change_of_the_course_the_card_is_made_anew(
    workspace: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The old one would be another contract than that of who grades."""
    real = lab("topics")
    for folder in (real.folder, real.grader.parent):
        place = tmp_path / "course" / folder.relative_to(real.folder.parents[1])
        shutil.copytree(folder, place)
    monkeypatch.setenv("ROSLINGS_COURSE", str(tmp_path / "course"))
    take_name("s1001")
    before = own_lab("topics")
    card = tmp_path / "course/labs/topics/card.yaml"
    card.write_text(card.read_text("utf-8").replace("talker_runs: 4", "talker_runs: 4.0 # x"))
    monkeypatch.setenv("ROSLINGS_COURSE", str(tmp_path / "course"))
    assert own_lab("topics").folder != before.folder


@pytest.mark.parametrize("name", ["", "--", "...", "a\nb", "a" * 101, "\x1b[31m1"])
def test_nobody_is_called_so(workspace: Path, name: str) -> None:
    """The next step says what to give."""
    with pytest.raises(NotAStudentName, match="class list"):
        take_name(name)
    assert not (workspace / ".roslings").exists()


def test_a_name_is_no_path(workspace: Path) -> None:
    """Nothing outside of the workspace is made by it."""
    take_name("../../etc/s1001")
    assert own_lab("topics").folder.is_relative_to(workspace)
