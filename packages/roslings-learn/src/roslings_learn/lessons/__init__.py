"""What the lessons say besides their notebooks: the path of days, the words, the quizzes.

Reads `days/path.yaml`, `glossary/*.yaml` and `days/*/quiz.yaml`, and checks them against each
other. A mistake is told with file, line and mend; all mistakes are told at once.
"""

from roslings_learn.lessons.document import BadLessons, DocumentProblem
from roslings_learn.lessons.glossary import Category, Glossary, Term
from roslings_learn.lessons.lessons import Lessons, read_glossary
from roslings_learn.lessons.path import Day
from roslings_learn.lessons.quiz import (
    CommonMistake,
    One,
    OrderQuestion,
    Prints,
    Question,
    Quiz,
    QuizChoice,
    Several,
)
from roslings_learn.lessons.translated import read_lessons

__all__ = [
    "BadLessons",
    "Category",
    "CommonMistake",
    "Day",
    "DocumentProblem",
    "Glossary",
    "Lessons",
    "One",
    "OrderQuestion",
    "Prints",
    "Question",
    "Quiz",
    "QuizChoice",
    "Several",
    "Term",
    "read_glossary",
    "read_lessons",
]
