"""What a student types, in the false language: no plain English is left, and columns stay straight.

What does not fit a line of 80 columns is wrapped. In English each line fits, and the column of a
table begins at the same place in both.
"""

from __future__ import annotations

from collections.abc import Iterator
from datetime import datetime, timedelta, timezone
from pathlib import Path

import pytest
from false_screen import Type, left_plain, require_columns, require_no_english

from ros2_on_pip.label_column import (
    LabelledLine,
    columns_of,
    labelled,
    padded,
    side_by_side,
)
from ros2_on_pip.language import ENGLISH, FALSE
from roslings import course
from roslings.workspace.progress_file import (
    DrillProgress,
    LabProgress,
    QuizProgress,
    StudentProgress,
    as_json,
)
from roslings.workspace.student import start
from roslings_learn.drills import all_drills
from roslings_rover.remembered import remember_the_ball

NOW = datetime.now(timezone.utc).replace(microsecond=0)
LABS = course.all_labs()


# --- a learner on the way ------------------------------------------------------------------------


def nothing(workspace: Path) -> None:
    """A fresh clone."""


def at_the_ball(workspace: Path) -> None:
    """The first page is done."""
    remember_the_ball()


def begun(workspace: Path) -> None:
    """The first lab is put there."""
    start(LABS[0])


def tried(workspace: Path) -> None:
    """Labs were checked, a drill is mended, a quiz was answered, many days in a row."""
    start(LABS[1])
    passed = LabProgress(100.0, 100.0, 3, NOW, NOW, NOW)
    keep(
        workspace,
        StudentProgress(
            {LABS[0].name: passed, LABS[1].name: LabProgress(72.5, 40.0, 2, NOW, NOW)},
            {each.name: DrillProgress(1, NOW, NOW) for each in all_drills()},
            {LABS[0].outline.day: QuizProgress(9, 12, 9, 1, NOW)},
            [NOW.date() - timedelta(days=days) for days in range(12, -1, -1)],
        ),
    )


def all_done(workspace: Path) -> None:
    """Nothing is left."""
    passed = LabProgress(100.0, 100.0, 3, NOW, NOW, NOW)
    keep(workspace, StudentProgress({lab.name: passed for lab in LABS}))


def keep(workspace: Path, progress: StudentProgress) -> None:
    """As the workspace has it."""
    file = workspace / ".roslings" / "progress.json"
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(as_json(progress), "utf-8")


@pytest.fixture(params=[nothing, at_the_ball, begun, tried, all_done], ids=lambda f: f.__name__)
def at(request: pytest.FixtureRequest, typed: Type, tmp_path: Path) -> Iterator[str]:
    """A learner who is so far."""
    request.param(tmp_path / "ws")
    yield request.param.__name__


@pytest.mark.parametrize("words", [(), ("status",)], ids=["first-screen", "status"])
def test_where_a_learner_is(typed: Type, at: str, words: tuple[str, ...]) -> None:
    """`./roslings` and `status`, from the first day to the last."""
    require_no_english(typed(*words))
    require_columns(typed(*words, language=ENGLISH))


@pytest.mark.parametrize("language", [ENGLISH, FALSE])
def test_the_columns_of_status_are_straight(typed: Type, at: str, language: str) -> None:
    """A lab's name begins at one column, and what was reached in it at another."""
    lines = typed("status", language=language).splitlines()
    found = [
        (line, line.rindex(f" {lab.name} ") + 1)
        for lab in LABS
        for line in lines
        if f" {lab.name} " in line
    ]
    assert len(found) == len(LABS)
    assert len({columns_of(line[:name]) for line, name in found}) == 1
    behind = [line[line.index(" ", name) :] for line, name in found]
    reached = {len(line) - len(end.lstrip()) for (line, _), end in zip(found, behind, strict=True)}
    assert len(reached) == 1


def test_plain_english_on_a_screen_is_found(typed: Type) -> None:
    """Else the silence of the tests above would mean nothing."""
    screen = typed().replace("./roslings watch", "./roslings watch    the first drills")
    assert [line.partition(" in ")[0] for line in left_plain(screen)] == [
        "'the'",
        "'first'",
        "'drills'",
    ]


# --- a column of labels --------------------------------------------------------------------------


def test_a_long_label_moves_its_whole_column() -> None:
    """And a text that has no room goes on beside it; what is typed is never broken."""
    told = [
        LabelledLine("Next", "what comes then", "./roslings check topics"),
        LabelledLine("Weiter und weiter", "this goes on for longer than the line has room for"),
    ]
    assert list(labelled(told, at_least=6, width=48)) == [
        "Next              ./roslings check topics",
        "                      what comes then",
        "Weiter und weiter this goes on for longer than",
        "                  the line has room for",
    ]
    assert list(labelled(told[:1], at_least=6, width=48)) == [
        "Next  ./roslings check topics    what comes then"
    ]


def test_letters_of_two_columns_are_measured() -> None:
    """Chinese ones are as wide as two; an accent that stands behind its letter takes none."""
    assert [columns_of(text) for text in ("Next", "下一步", "e\u0301a")] == [4, 6, 2]
    assert padded("下一步", 8) == "下一步  "
    assert list(labelled([LabelledLine("下一步", "go"), LabelledLine("Read", "on")])) == [
        "下一步 go",
        "Read   on",
    ]


def test_parts_stand_beside_each_other_while_there_is_room() -> None:
    """And below each other where there is none."""
    assert side_by_side(["one", "two", "three"], "  ", width=9) == "one  two\nthree"
