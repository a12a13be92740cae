"""A quiz below a cell: every field has a label, every answer its reason; and as plain text."""

from __future__ import annotations

import re
from collections import Counter
from pathlib import Path
from string import ascii_lowercase
from typing import Any

import pytest
from tiny_course import DAY, write_course

from roslings.course import root
from roslings_learn.lessons import One, OrderQuestion, Quiz, Several, read_lessons
from roslings_learn.lessons.quiz import mixed
from roslings_learn.lessons.quiz_text import as_text, without_links
from roslings_learn.notebook import quiz as ask
from roslings_learn.notebook.quiz_widgets import drawn


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
    options = dict(asked.fields[0].options)
    asked.fields[0].value = options["It sings."]
    assert "Not yet." in asked.check() and "a bell does that" in asked.check()
    asked.fields[0].value = options["It shines."]
    assert "Right." in asked.check() and "<code>its</code>" in asked.check()


def test_several_choices(quiz: Quiz) -> None:
    """Too few, one too many, and all that are right."""
    asked = Asked(quiz, 2)
    by_text = {field.description: field for field in asked.fields}
    bulb, switch, wheels = (by_text[text] for text in ("A bulb", "A switch", "Wheels"))
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
    assert ") right: Yes" in answers and "It prints 2" in answers
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


# --- the order of the choices -----------------------------------------------------------------

QUIZZES = read_lessons(root()).quizzes
ASKED = {each.id: (quiz.day, each) for quiz in QUIZZES[::-1] for each in quiz.questions}
ONE = [(day, each) for day, each in ASKED.values() if isinstance(each, One)]
"""Every question with one right choice, each once, and the day that asks it first."""


def place_of_right(question: One) -> int:
    """Where the right choice is shown."""
    return [choice.right for choice in question.choices].index(True)


def test_the_right_choice_is_everywhere_about_as_often() -> None:
    """Who always takes the first, or the last, knows nothing and gets no more than chance."""
    for count, fewest in ((3, 15), (4, 40)):
        places = Counter(place_of_right(each) for _, each in ONE if len(each.choices) == count)
        even = sum(places.values()) / count
        assert sum(places.values()) >= fewest
        assert all(0.6 * even <= places[place] <= 1.4 * even for place in range(count)), places


@pytest.mark.parametrize("day", [quiz.day for quiz in QUIZZES])
def test_no_day_has_its_right_choices_at_one_place(day: str) -> None:
    """Not even two of three."""
    places = Counter(place_of_right(each) for of, each in ONE if of == day)
    assert max(places.values()) / sum(places.values()) < 2 / 3, places


def test_the_order_follows_from_the_id_alone() -> None:
    """In each Python, and for who asks again on a later day."""
    assert mixed("topics-who-hears", 4) == [2, 3, 0, 1]
    assert mixed("a", 2) != mixed("b", 2) or mixed("a", 3) != mixed("b", 3)
    for quiz in QUIZZES:
        for each in quiz.questions:
            assert each.model_copy() == ASKED[each.id][1]


@pytest.mark.parametrize("number", range(len(QUIZZES)))
def test_the_notebook_shows_what_is_read(number: int) -> None:
    """As widgets and as text, of each real question; the steps of an order, too, never right."""
    quiz = QUIZZES[number]
    printed = [" ".join(part.split()) for part in as_text(quiz).split("Answers")[0].split("\n\n")]
    whole = " ".join(printed)
    boxes = drawn(quiz).children
    for each, box in zip(quiz.questions, boxes, strict=True):
        _, *fields, _, _ = box.children
        if isinstance(each, One | Several):
            texts = [without_links(choice.text) for choice in each.choices]
            lettered = zip(ascii_lowercase, texts, strict=False)
            assert " ".join(f"{a}) {' '.join(text.split())}" for a, text in lettered) in whole
            shown = (
                [o[0] for o in fields[0].options]
                if isinstance(each, One)
                else [field.description for field in fields]
            )
            assert shown == [text.replace("`", "") for text in texts]
        elif isinstance(each, OrderQuestion):
            texts = [without_links(each.steps[place].text) for place in each.shown]
            assert list(fields[0].options)[1:] == [text.replace("`", "") for text in texts]
            assert each.shown != sorted(each.shown)


PLACES = re.compile(r"\bof (the )?(above|below|these)\b|\bthe choices? (above|below)\b", re.I)


def test_no_choice_speaks_of_the_places_of_others() -> None:
    """They are mixed."""
    chosen = [each for _, each in ASKED.values() if isinstance(each, One | Several)]
    assert [c.text for each in chosen for c in each.choices if PLACES.search(c.text)] == []
