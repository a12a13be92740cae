"""What a lesson promises is compared word by word: one changed word in any of it is found.

nbval compares what the one execution of each lesson printed with what the lesson holds, and with
copies of it in which one word after the other is changed.
"""

from __future__ import annotations

import copy
import re
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

from lesson_runs import lessons, walked
from roslings_learn.lessons.rules import Lesson
from roslings_learn.lessons.rules.form import COMPARED, LEAST_COMPARED

if TYPE_CHECKING:  # nbval loads for seconds; only who runs these tests pays for it
    from lessons_as_tests import LessonCell

WORD = re.compile(r"\w+")
OTHER = "changed"
each_lesson = pytest.mark.parametrize(
    "lesson",
    [
        pytest.param(lesson, id=lesson.day.id, marks=pytest.mark.xdist_group(lesson.day.id))
        for lesson in lessons()
    ],
)


@pytest.fixture(autouse=True)
def _as_typed(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """nbval's options as `--nbval-lax` sets them: the plugin is loaded where lessons are run."""
    for name, value in {"nbval_lax": True, "nbdime": False, "nbval_sanitize_with": None}.items():
        monkeypatch.setattr(request.config.option, name, value, raising=False)


def compared(lesson: Lesson, parent: pytest.Session) -> list[LessonCell]:
    """The cells whose outputs a lesson promises, as nbval reads them."""
    from lessons_as_tests import LessonFile

    file = LessonFile.from_parent(parent, path=lesson.path)
    file.setup_sanitize_files()
    return [cell for cell in file.cells if COMPARED in cell.tags]


def changed_by_a_word(outputs: list[Any]) -> Iterator[tuple[str, list[Any]]]:
    """The outputs with one word changed, for each word in them."""
    for place, output in enumerate(outputs):
        for key in [key for key in ("text", "ename", "evalue") if key in output]:
            for word in WORD.finditer(output[key]):
                other = copy.deepcopy(outputs)
                text = output[key]
                other[place][key] = text[: word.start()] + OTHER + text[word.end() :]
                yield f"{word.group()!r} in {text!r}", other


def unnoticed(cell: LessonCell, now: list[Any]) -> list[str]:
    """The words of a cell's saved outputs that may change without being found."""
    changes = list(changed_by_a_word(cell.cell.outputs))
    assert changes, f"{cell.cell.id} promises no word"
    return [what for what, other in changes if cell.compare_outputs(now, other)]


@each_lesson
def test_a_lesson_promises_enough(lesson: Lesson, request: pytest.FixtureRequest) -> None:
    """Each word of it is compared, where the same is printed again."""
    cells = compared(lesson, request.session)
    assert len(cells) >= LEAST_COMPARED
    for cell in cells:
        same = copy.deepcopy(cell.cell.outputs)
        assert cell.compare_outputs(same, cell.cell.outputs)
        assert unnoticed(cell, same) == []


@pytest.mark.slow
@each_lesson
def test_a_changed_word_is_found_when_the_lesson_runs(
    lesson: Lesson, shared_folder: Path, request: pytest.FixtureRequest
) -> None:
    """All tests of a lesson share the execution that it is compared with."""
    import nbformat

    book = nbformat.reads(walked(shared_folder, lesson).executed, as_version=4)
    now = {cell.id: cell.outputs for cell in book.cells if cell.cell_type == "code"}
    for cell in compared(lesson, request.session):
        assert cell.compare_outputs(now[cell.cell.id], cell.cell.outputs), cell.cell.id
        assert unnoticed(cell, now[cell.cell.id]) == []


LEFT_OUT = {
    "[INFO] [1795728756.393125389] [talker]: one": "[INFO] [1795728999.000000001] [talker]: one",
    "accepted with ID: 5a1f7170b6394968a461d27397d64c79": "accepted with ID: "
    "9b997c55134648358b59e871793f2881",
    "port /tmp/rover-p5vnj_4j/ttyROVER": "port /tmp/rover-9798qmky/ttyROVER",
    "in /tmp/tmprysi27c2/ws.": "in /tmp/tmpta5e9rla/ws.",
    "process started with pid [31366]": "process started with pid [412]",
    "<Node object at 0x7f3a2b1c>": "<Node object at 0x7f3a00ff>",
    "in domain 41, at port 11852": "in domain 7, at port 11818",
    "waiting for service to become available...\nresponse:": "response:",
}
KEPT = {
    "[INFO] [1795728756.393125389] [talker]: one": "[WARN] [1795728756.393125389] [talker]: one",
    "port /tmp/rover-p5vnj_4j/ttyROVER": "port /tmp/lidar-p5vnj_4j/ttyROVER",
    "level: 30.0": "level: 40.0",
    "in domain 41, at port 11852": "in domain 41, at door 11852",
}


def sanitized(text: str) -> str:
    """As nbval compares it."""
    from nbval.plugin import get_sanitize_patterns

    from lessons_as_tests import SANITIZER

    for pattern, other in get_sanitize_patterns(SANITIZER.read_text("utf-8")):
        text = re.sub(pattern, other, text)
    return text


def test_times_ids_and_places_are_not_compared() -> None:
    """They are others at each run; what stands beside them is compared."""
    assert [pair for pair in LEFT_OUT.items() if len(set(map(sanitized, pair))) != 1] == []
    assert [pair for pair in KEPT.items() if len(set(map(sanitized, pair))) != 2] == []
