"""What the lessons say besides their notebooks: the path of days, the words, the quizzes.

Reads `days/path.yaml`, `glossary/*.yaml` and `days/*/quiz.yaml`, and checks them against each
other. A mistake is told with file, line and mend; all mistakes are told at once.
"""

from roslings_learn.lessons.document import BadLessons, Problem
from roslings_learn.lessons.glossary import Category, Glossary, Term
from roslings_learn.lessons.lessons import Lessons, read_glossary, read_lessons
from roslings_learn.lessons.path import Day
from roslings_learn.lessons.quiz import Choice, Mistake, One, Order, Prints, Question, Quiz, Several

__all__ = [
    "BadLessons",
    "Category",
    "Choice",
    "Day",
    "Glossary",
    "Lessons",
    "Mistake",
    "One",
    "Order",
    "Prints",
    "Problem",
    "Question",
    "Quiz",
    "Several",
    "Term",
    "read_glossary",
    "read_lessons",
]
