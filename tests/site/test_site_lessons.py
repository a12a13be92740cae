"""Words, quizzes and path of days: what is right in the course, and what is told of what is not."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from roslings.course import root
from roslings_learn.lessons import BadLessons, DocumentProblem, read_lessons

LESSONS = read_lessons(root())
TERMS = LESSONS.glossary.by_id.values()
HAVE_SENSES = (
    "workspace",
    "action",
    "node",
    "service",
    "feedback",
    "goal",
    "topic",
    "package",
    "message",
)
CATEGORIES = {
    "Core concepts",
    "Communication",
    "Tools",
    "Control and planning",
    "Hardware",
    "Manipulation and tasks",
    "Build and packages",
    "Computers and data",
}


def sentences(text: str) -> list[str]:
    """The sentences of a text, without the addresses of its links."""
    return re.split(r"(?<=[.?])\s+", re.sub(r"\]\(#[^)]*\)", "]", text))


def test_there_are_a_hundred_words_in_eight_categories() -> None:
    """One file a category."""
    assert len(TERMS) >= 100
    assert {each.category for each in LESSONS.glossary.categories} == CATEGORIES


@pytest.mark.parametrize("word", HAVE_SENSES)
def test_words_with_several_meanings_have_several_entries(word: str) -> None:
    """Each says which it is."""
    senses = LESSONS.glossary.senses_of[word]
    assert len(senses) >= 2
    assert all(term.sense for term in senses)


def test_a_definition_is_one_sentence() -> None:
    """It is what a popover shows."""
    assert [term.id for term in TERMS if len(sentences(term.definition)) != 1] == []
    assert [term.id for term in TERMS if not term.definition.endswith(".")] == []


def test_sentences_are_short() -> None:
    """14 words on average, none above 25."""
    all_of_them = [
        one for term in TERMS for text in (term.definition, term.note) for one in sentences(text)
    ]
    assert [one for one in all_of_them if len(one.split()) > 25] == []
    assert sum(len(one.split()) for one in all_of_them) / len(all_of_them) <= 14


def test_each_day_teaches_words() -> None:
    """No day of the path is without."""
    assert all(len(LESSONS.words_of(day)) >= 3 for day in LESSONS.days)


def test_a_word_with_several_senses_is_not_guessed() -> None:
    """The mistake of this project's seed: a folder's name opened the reach of an arm."""
    glossary = LESSONS.glossary
    assert glossary.meant("workspace", frozenset()) is None
    assert glossary.meant("workspace", frozenset({"workspace", "workspace-arm"})) is None
    chosen = glossary.meant("Workspace", frozenset({"workspace-arm"}))
    assert chosen is not None
    assert chosen.id == "workspace-arm"


# --- bad files ---------------------------------------------------------------------------------

QUIZ = "days/01-install/quiz.yaml"
WORDS = "glossary/tools.yaml"


def spoil(course: Path, name: str, find: str, replace: str) -> int:
    """Replace a text in a file; returns the line where it stands."""
    path = course / name
    text = path.read_text("utf-8")
    assert find in text
    path.write_text(text.replace(find, replace, 1), "utf-8")
    return text[: text.index(find)].count("\n") + 1


def only_problem(course: Path, name: str) -> DocumentProblem:
    """The one thing that is told."""
    with pytest.raises(BadLessons) as told:
        read_lessons(course)
    (problem,) = told.value.problems
    assert problem.path == course / name
    return problem


BAD = {
    "no right answer": (QUIZ, "        right: true\n", "", "no right answer", "right: true", -6),
    "two right answers": (
        QUIZ,
        "        why: Each terminal has variables of its own.",
        "        why: Each.\n        right: true",
        "several right answers",
        "kind: several",
        None,
    ),
    "doubled question": (
        QUIZ,
        "install-what-first",
        "install-which-are-true",
        "there twice",
        "another id",
        0,
    ),
    "unknown term in a quiz": (
        QUIZ,
        "#word-package",
        "#word-pakage",
        "'pakage'",
        "'package'",
        0,
    ),
    "no explanation": (
        QUIZ,
        "        why: It runs on one.\n",
        "",
        "'why' is missing",
        "why: ...",
        -1,
    ),
    "unknown kind": (QUIZ, "kind: several", "kind: some", "a kind", "order", None),
    "no kind": (QUIZ, "    kind: several\n", "", "needs a kind", "kind: one", None),
    "unknown key": (QUIZ, "    ask: Bring", "    aks: Bring", "ask", "", None),
    "doubled choice": (QUIZ, "text: All of it", "text: Nothing", "there twice", "Change", None),
    "not YAML": (QUIZ, "    kind: one", "    kind: 'one", "not YAML", "line", 0),
    "doubled key": (QUIZ, "    kind: one", "    kind: one\n    kind: one", "twice", "Delete", 1),
    "unknown see": (WORDS, "see: [terminal, ssh]", "see: [terminal, shh]", "'shh'", "'ssh'", 0),
    "unknown day": (
        WORDS,
        "    day: 3\n",
        "    day: 99\n",
        "no day 99",
        f"1 to {len(LESSONS.days)}",
        0,
    ),
    "no definition": (
        WORDS,
        "    definition: tmux is a program that shows several terminals in one window"
        " and keeps them alive.\n",
        "",
        "'definition' is missing",
        "definition: ...",
        None,
    ),
    "doubled term": (WORDS, "- id: tmux", "- id: terminal", "'terminal' is there twice", "id", 0),
    "a sense is missing": (WORDS, "    sense: of Linux\n", "", "several senses", "sense: ", None),
    "unknown sense": ("days/path.yaml", "senses: [node, ", "senses: [nod, ", "'nod'", "'node'", 0),
}


@pytest.mark.parametrize("case", BAD)
def test_a_mistake_is_told_with_file_line_and_mend(case: str, course: Path) -> None:
    """Every way in which an author slips."""
    name, find, replace, what, mend, off = BAD[case]
    line = spoil(course, name, find, replace)
    with pytest.raises(BadLessons) as told:
        read_lessons(course)
    problem = next(each for each in told.value.problems if what in each.what)
    assert problem.path == course / name
    assert mend in problem.mend
    assert problem.mend
    assert abs(problem.line - line) <= 8
    if off is not None:
        assert problem.line == line + off


def test_a_quiz_of_an_unknown_day(course: Path) -> None:
    """The path of days names all of them."""
    (course / "days" / "01-install").rename(course / "days" / "01-instal")
    told = [each for each in caught(course) if "'01-instal'" in each.what]
    assert {each.path.name for each in told} == {"quiz.yaml", "lesson.ipynb"}
    assert all("'01-install'" in each.mend for each in told)


def caught(course: Path) -> tuple[DocumentProblem, ...]:
    """All that is told."""
    with pytest.raises(BadLessons) as told:
        read_lessons(course)
    return told.value.problems


def test_all_mistakes_are_told_at_once(course: Path) -> None:
    """Not one a build."""
    spoil(course, QUIZ, "#word-package", "#word-pakage")
    spoil(course, "days/03-topics/quiz.yaml", "again: install-one-terminal", "again: no-such")
    assert {each.path.parent.name for each in caught(course)} == {"01-install", "03-topics"}


def test_a_question_is_asked_again_only_after_its_day(course: Path) -> None:
    """A later day may repeat an earlier one, not the other way round."""
    spoil(course, QUIZ, "questions:\n", "questions:\n  - again: topics-who-hears\n")
    assert "No earlier day" in only_problem(course, QUIZ).what


@pytest.mark.parametrize("content", [b"", b"\xff\xfe", b"questions: []\n", b"- 1\n"])
def test_strange_files_are_told_too(content: bytes, course: Path) -> None:
    """Empty, not text, of another form."""
    (course / QUIZ).write_bytes(content)
    problems = [each for each in caught(course) if each.path == course / QUIZ]
    assert problems
    assert all(each.mend for each in problems)
