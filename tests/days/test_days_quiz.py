"""A quiz below a cell: every field has a label, every answer its reason; and as plain text."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from tiny_course import DAY, write_course

from roslings.lessons import Quiz, read_lessons
from roslings.notebook import quiz as ask
from roslings.notebook.quiz_text import as_text
from roslings.notebook.quiz_widgets import drawn


@pytest.fixture
def quiz(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Quiz:
    """The quiz of the tiny course, which is the course here."""
    write_course(tmp_path)
    monkeypatch.setenv("ROSLINGS_COURSE", str(tmp_path))
    found = read_lessons(tmp_path).quiz(DAY)
    assert found is not None
    return found


class Asked:
    """One question's widgets: heading, fields, button, what is said."""

    def __init__(self, quiz: Quiz, number: int) -> None:
        _, *self.fields, self.button, self.said = drawn(quiz).children[number - 1].children

    def check(self) -> str:
        """Press the button; what it then says."""
        self.button.click()
        return str(self.said.value)


def test_one_choice(quiz: Quiz) -> None:
    """Nothing chosen, a wrong one, the right one."""
    asked = Asked(quiz, 1)
    assert "Choose an answer first." in asked.check()
    asked.fields[0].value = 1
    assert "Not yet." in asked.check() and "a bell does that" in asked.check()
    asked.fields[0].value = 0
    assert "Right." in asked.check() and "<code>its</code>" in asked.check()


def test_several_choices(quiz: Quiz) -> None:
    """Too few, one too many, and all that are right."""
    asked = Asked(quiz, 2)
    bulb, switch, wheels = asked.fields
    bulb.value = True
    assert "not chosen yet" in asked.check()
    switch.value = wheels.value = True
    assert "Not yet." in asked.check() and "A car has them." in asked.check()
    wheels.value = False
    assert "Right." in asked.check()


def test_an_order(quiz: Quiz) -> None:
    """The steps come mixed; the first wrong place is told."""
    asked = Asked(quiz, 3)
    right = ["Plug it in", "Switch it on", "Look"]
    assert list(asked.fields[0].options)[1:] != right and "first." in asked.check()
    for field, step in zip(asked.fields, right[::-1], strict=True):
        field.value = step
    assert "Look again at this step. Plug it in" in asked.check()
    for field, step in zip(asked.fields, right, strict=True):
        field.value = step
    assert "Right." in asked.check()


def test_what_code_prints(quiz: Quiz) -> None:
    """A known mistake has its reason; spaces do not count."""
    asked = Asked(quiz, 4)
    asked.fields[0].value = "11"
    assert "numbers and not texts" in asked.check()
    asked.fields[0].value = "7"
    assert "once more" in asked.check()
    asked.fields[0].value = " 2 "
    assert "Right." in asked.check()


def test_every_field_has_a_label(quiz: Quiz) -> None:
    """For a screen reader, and for who speaks to the computer."""
    for number in range(1, 5):
        asked = Asked(quiz, number)
        assert asked.button.description == f"Check answer {number}"
        assert all(_label_of(field) for field in asked.fields), number


def _label_of(field: Any) -> bool:
    return bool(field.description or getattr(field, "options", ()))


def test_plain_text_holds_all_of_it(quiz: Quiz) -> None:
    """Questions first, answers after them, 80 columns, no marks of links."""
    text = as_text(quiz)
    questions, _, answers = text.partition("Answers")
    assert "What does a lamp do?" in questions and "right:" not in questions
    assert "a) right: Yes" in answers and "It prints 2" in answers
    assert max(map(len, text.splitlines())) <= 80 and "#word-" not in text


def test_asking_outside_of_a_notebook_prints(
    quiz: Quiz, capsys: pytest.CaptureFixture[str]
) -> None:
    """And where there is no quiz, it says which there are."""
    ask(quiz.day)
    ask("09-moon")
    said = capsys.readouterr().out
    assert "Quiz of 01-lamp: 4 questions." in said
    assert "There is no quiz for '09-moon'. There is: 01-lamp." in said


def test_a_broken_quiz_is_told(
    quiz: Quiz, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    """With file and line; the cell does not fail."""
    (tmp_path / "days" / DAY / "quiz.yaml").write_text("questions: []\n", "utf-8")
    ask(quiz.day)
    assert "quiz.yaml:1" in capsys.readouterr().out
