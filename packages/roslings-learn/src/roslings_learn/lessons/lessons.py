"""Reads all files of the lessons, and checks that what they say of each other is true."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path as File

from roslings_learn.lessons.document import BadLessons, Document, DocumentProblem, nearest, read
from roslings_learn.lessons.glossary import LINK, Category, Glossary, Term
from roslings_learn.lessons.path import Day, Path
from roslings_learn.lessons.quiz import Again, Question, Quiz, QuizFile

Located = tuple[Document[Category], int, Term]


@dataclass(frozen=True)
class Lessons:
    """The path of days, the words, and the quizzes that are written."""

    days: tuple[Day, ...]
    glossary: Glossary
    quizzes: tuple[Quiz, ...]

    def day(self, number: int) -> Day:
        """The day with this number. Raises KeyError."""
        for day in self.days:
            if day.number == number:
                return day
        raise KeyError(number)

    def quiz(self, day: str) -> Quiz | None:
        """The quiz of a day, where it is written."""
        return next((quiz for quiz in self.quizzes if quiz.day == day), None)

    def words_of(self, day: Day) -> tuple[Term, ...]:
        """The terms that a day teaches."""
        return tuple(term for term in self.glossary.by_id.values() if term.day == day.number)


def read_lessons(root: File) -> Lessons:
    """Read the lessons of the course in `root`.

    Raises BadLessons with every mistake, each with file, line and mend.
    """
    problems: list[DocumentProblem] = []
    days = _days(root / "days" / "path.yaml", problems)
    glossary = _glossary(root, days, problems)
    quizzes = _quizzes(root, days, glossary, problems)
    problems += _strange_folders(root / "days", days)
    problems += _unknown_senses(root / "days" / "path.yaml", days, glossary)
    if problems:
        raise BadLessons(problems)
    return Lessons(days, glossary, quizzes)


def read_glossary(root: File) -> Glossary:
    """Read the words alone. Raises BadLessons."""
    problems: list[DocumentProblem] = []
    glossary = _glossary(root, _days(root / "days" / "path.yaml", problems), problems)
    if problems:
        raise BadLessons(problems)
    return glossary


def _days(path: File, problems: list[DocumentProblem]) -> tuple[Day, ...]:
    try:
        document = read(path, Path)
    except BadLessons as error:
        problems += error.problems
        return ()
    days = document.content.days
    for index, day in enumerate(days):
        if day.number in {other.number for other in days[:index]}:
            mend = "Give each day a number of its own."
            what = f"There are two days {day.number}."
            problems.append(document.problem(what, mend, "days", index))
    return days


def _strange_folders(folder: File, days: tuple[Day, ...]) -> Iterator[DocumentProblem]:
    known = [day.id for day in days]
    for quiz in sorted(folder.glob("*/*")):
        day = quiz.parent.name
        if known and quiz.name in ("quiz.yaml", "lesson.ipynb") and day not in known:
            mend = nearest(day, known, "day") + " Days are named in days/path.yaml."
            yield DocumentProblem(quiz, 1, f"There is no day '{day}'.", mend)


def _unknown_senses(
    path: File, days: tuple[Day, ...], glossary: Glossary
) -> Iterator[DocumentProblem]:
    document = read(path, Path) if days and glossary.by_id else None
    for index, day in enumerate(days):
        for place, sense in enumerate(day.senses):
            if document and sense not in glossary.by_id:
                yield _unknown_term(document, sense, glossary, "days", index, "senses", place)


# --- the words ---------------------------------------------------------------------------------


def _glossary(root: File, days: tuple[Day, ...], problems: list[DocumentProblem]) -> Glossary:
    documents: list[Document[Category]] = []
    for path in sorted((root / "glossary").glob("*.yaml")):
        try:
            documents.append(read(path, Category))
        except BadLessons as error:
            problems += error.problems
    glossary = Glossary(tuple(document.content for document in documents))
    if not problems:  # else half of the ids would be unknown
        problems += _cross_checked(documents, glossary, days)
    return glossary


def _cross_checked(
    documents: list[Document[Category]], glossary: Glossary, days: tuple[Day, ...]
) -> Iterator[DocumentProblem]:
    located = [
        (document, index, term)
        for document in documents
        for index, term in enumerate(document.content.terms)
    ]
    yield from _doubled_terms(located)
    for each in located:
        yield from _unknown_in(each, glossary, {day.number for day in days})
    for document in documents:
        for index, sense in enumerate(document.content.senses):
            if sense not in glossary.by_id:
                yield _unknown_term(document, sense, glossary, "senses", index)


def _doubled_terms(located: list[Located]) -> Iterator[DocumentProblem]:
    ids: dict[str, str] = {}
    titles: dict[str, str] = {}
    for document, index, term in located:
        here = f"{document.path.name}:{document.line('terms', index)}"
        for seen, key, kind in ((ids, term.id, "id"), (titles, term.title.lower(), "name")):
            if key in seen:
                what = f"The {kind} '{key}' is there twice, first in {seen[key]}."
                mend = "Choose another id." if kind == "id" else "Give each a 'sense'."
                yield document.problem(what, mend, "terms", index)
            seen.setdefault(key, here)


def _unknown_in(located: Located, glossary: Glossary, days: set[int]) -> Iterator[DocumentProblem]:
    document, index, term = located
    for place, other in enumerate(term.see):
        if other not in glossary.by_id:
            yield _unknown_term(document, other, glossary, "terms", index, "see", place)
    for field in ("definition", "note", "example"):
        for _, other in LINK.findall(getattr(term, field)):
            if other not in glossary.by_id:
                yield _unknown_link(document, other, glossary)
    if term.day is not None and term.day not in days:
        mend = f"Use a day from {min(days)} to {max(days)}, or delete the line."
        yield document.problem(f"There is no day {term.day}.", mend, "terms", index, "day")
    if len(glossary.senses_of.get(term.name.lower(), ())) > 1 and not term.sense:
        what = f"'{term.name}' has several senses, and '{term.id}' does not say which it is."
        yield document.problem(what, "Add a line 'sense: ...'.", "terms", index)


def _unknown_term(
    document: Document[Category] | Document[QuizFile] | Document[Path],
    wanted: str,
    glossary: Glossary,
    *place: int | str,
) -> DocumentProblem:
    mend = nearest(wanted, list(glossary.by_id), "term")
    return document.problem(f"There is no term '{wanted}'.", mend, *place)


def _unknown_link(
    document: Document[Category] | Document[QuizFile], wanted: str, glossary: Glossary
) -> DocumentProblem:
    mend = nearest(wanted, list(glossary.by_id), "term")
    line = document.line_with(f"#word-{wanted})")
    return DocumentProblem(document.path, line, f"There is no term '{wanted}'.", mend)


# --- the quizzes -------------------------------------------------------------------------------


def _quizzes(
    root: File, days: tuple[Day, ...], glossary: Glossary, problems: list[DocumentProblem]
) -> tuple[Quiz, ...]:
    known: dict[str, Question] = {}
    documents: list[tuple[Day, Document[QuizFile]]] = []
    for day in sorted(days, key=lambda day: day.number):
        path = root / "days" / day.id / "quiz.yaml"
        try:
            documents += [(day, read(path, QuizFile))] if path.is_file() else []
        except BadLessons as error:
            problems += error.problems
    if problems:  # else the questions of a file that cannot be read would be unknown
        return ()
    for _, document in documents:
        problems += _unknown_in_quiz(document, glossary)
    return tuple(
        Quiz(day.id, _questions(document, day, known, problems)) for day, document in documents
    )


def _questions(
    document: Document[QuizFile],
    day: Day,
    known: dict[str, Question],
    problems: list[DocumentProblem],
) -> tuple[Question, ...]:
    """The questions of a day; `known` has those of the days before it, and gets its own."""
    earlier = dict(known)
    asked = dict[str, Question]()
    for index, entry in enumerate(document.content.questions):
        key = entry.again if isinstance(entry, Again) else entry.id
        wrong = _wrong_id(entry, key, asked, earlier)
        if wrong:
            problems.append(document.problem(*wrong, "questions", index))
        elif isinstance(entry, Again):
            asked[key] = earlier[key]
        else:
            asked[key] = known[key] = entry.asked_on(day.id)
    return tuple(asked.values())


def _wrong_id(
    entry: Question | Again, key: str, asked: dict[str, Question], earlier: dict[str, Question]
) -> tuple[str, str] | None:
    """What is wrong with a question's id, and the mend."""
    if isinstance(entry, Again) and key not in earlier:
        mend = nearest(key, list(earlier), "question of an earlier day")
        return f"No earlier day has the question '{key}'.", mend
    if key in asked or (key in earlier and not isinstance(entry, Again)):
        mend = "Choose another id, or write '- again: ID' for a question of an earlier day."
        return f"The id '{key}' is there twice.", mend
    return None


def _unknown_in_quiz(document: Document[QuizFile], glossary: Glossary) -> Iterator[DocumentProblem]:
    for entry in document.content.questions:
        texts = () if isinstance(entry, Again) else entry.texts()
        for text in texts:
            for _, wanted in LINK.findall(text):
                if wanted not in glossary.by_id:
                    yield _unknown_link(document, wanted, glossary)
