"""Lessons in another language: the texts of the path, the words and the questions, by their ids.

What a student types or reads as code stays: the code of a question, what it prints, an example that
is a command.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path as File

from ros2_on_pip.language import ENGLISH, language, template
from roslings_learn.lessons import lessons as english
from roslings_learn.lessons.glossary import Category, Glossary, Term
from roslings_learn.lessons.lessons import Lessons
from roslings_learn.lessons.path import Day
from roslings_learn.lessons.quiz import (
    ChoiceQuestion,
    CommonMistake,
    OrderedStep,
    OrderQuestion,
    Prints,
    Question,
    QuizChoice,
)

Change = Callable[[str, str], str]
"""From a text's id and its English to what stands in its place."""
BETWEEN = ", "
"""Between the other spellings of a word."""
A_SENTENCE = re.compile(r"[A-Z0-9][^=_{}()/]*\.")
"""What an example looks like that is no code."""


def read_lessons(root: File) -> Lessons:
    """The lessons of the course in `root`, in the language that is asked for. Raises BadLessons."""
    return translated(english.read_lessons(root))


def translated(lessons: Lessons) -> Lessons:
    """The same in the language that is asked for."""
    return lessons if language() == ENGLISH else changed(lessons, template)


def texts_of(lessons: Lessons) -> Iterator[tuple[str, str]]:
    """The id and the English of each text. Lessons are in English as they are read."""
    found: dict[str, str] = {}

    def keep(name: str, text: str) -> str:
        found[name] = text
        return text

    changed(lessons, keep)
    yield from found.items()


def changed(lessons: Lessons, change: Change) -> Lessons:
    """The same lessons, with other texts."""
    quizzes = tuple(
        replace(quiz, questions=tuple(_question(each, change) for each in quiz.questions))
        for quiz in lessons.quizzes
    )
    categories = tuple(_category(each, change) for each in lessons.glossary.categories)
    days = tuple(_day(each, change) for each in lessons.days)
    return Lessons(days, Glossary(categories), quizzes)


def _day(day: Day, change: Change) -> Day:
    name = f"days.{day.id}"
    title, can = change(f"{name}.title", day.title), change(f"{name}.can", day.can)
    return day.model_copy(update={"title": title, "can": can})


# --- the words ---------------------------------------------------------------------------------


def _category(category: Category, change: Change) -> Category:
    """Its own name stays English: a page calls its filter by it."""
    return category.model_copy(
        update={"terms": tuple(_term(each, change) for each in category.terms)}
    )


def _term(term: Term, change: Change) -> Term:
    name = f"glossary.{term.id}"
    fields = ["name", "sense", "definition", "note"]
    fields += ["example"] if A_SENTENCE.fullmatch(term.example) else []
    texts = {field: getattr(term, field) for field in fields if getattr(term, field)}
    found: dict[str, object] = {
        field: change(f"{name}.{field}", text) for field, text in texts.items()
    }
    also = change(f"{name}.also", BETWEEN.join(term.also)) if term.link else ""
    found["also"] = tuple(filter(None, also.split(BETWEEN))) if term.link else term.also
    return term.model_copy(update=found)


# --- the questions -----------------------------------------------------------------------------


def _question(question: Question, change: Change) -> Question:
    name = f"quizzes.{question.id}"
    found: dict[str, object] = {"ask": change(f"{name}.ask", question.ask)}
    if isinstance(question, ChoiceQuestion):
        found["choices"] = tuple(
            _answer(each, f"{name}.{number}", change)
            for number, each in enumerate(question.choices, 1)
        )
    elif isinstance(question, OrderQuestion):
        found["steps"] = tuple(
            _answer(each, f"{name}.{number}", change)
            for number, each in enumerate(question.steps, 1)
        )
    else:
        found |= _printed(question, name, change)
    return question.model_copy(update=found)


def _answer(
    answer: QuizChoice | OrderedStep, name: str, change: Change
) -> QuizChoice | OrderedStep:
    text, why = change(f"{name}.text", answer.text), change(f"{name}.why", answer.why)
    return answer.model_copy(update={"text": text, "why": why})


def _printed(question: Prints, name: str, change: Change) -> dict[str, object]:
    """What was typed by mistake is code; why it is wrong is not."""
    mistakes = tuple(
        _mistake(each, f"{name}.mistakes.{number}", change)
        for number, each in enumerate(question.mistakes, 1)
    )
    return {"why": change(f"{name}.why", question.why), "mistakes": mistakes}


def _mistake(mistake: CommonMistake, name: str, change: Change) -> CommonMistake:
    return mistake.model_copy(update={"why": change(f"{name}.why", mistake.why)})
