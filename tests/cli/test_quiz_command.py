"""`./roslings quiz`: questions in the terminal, a reason after each answer, a score at the end."""

from __future__ import annotations

import os
import pty
import subprocess
import sys
from collections.abc import Callable, Iterable
from pathlib import Path

import pytest

from roslings import course
from roslings.workspace.progress import read_progress, record_quiz
from roslings.workspace.progress_file import DamagedProgress, StudentProgress, as_json, progress_in
from roslings_launcher.cli import main
from roslings_learn.commands.quiz import QuizRound, ask_all
from roslings_learn.jupyter.errors import NoSuchDay
from roslings_learn.lessons import One, OrderQuestion, Prints, Question, Quiz, Several, read_lessons
from roslings_learn.lessons.answering import NotAnAnswer, how_to_answer, judged, right_answer
from roslings_learn.lessons.quiz_text import as_text

LESSONS = read_lessons(course.root())
QUESTIONS = {each.id: each for quiz in LESSONS.quizzes for each in quiz.questions}
LAMP = QUESTIONS["install-source-terminal"]


def letters_of(question: Question) -> str:
    """The right answer, as it is typed."""
    if isinstance(question, Prints):
        return question.prints
    if isinstance(question, OrderQuestion):
        return "".join("abcdefgh"[question.shown.index(n)] for n in range(len(question.steps)))
    return "".join("abcdefgh"[n] for n, choice in enumerate(question.choices) if choice.right)


def wrong_of(question: Question) -> str:
    """A wrong one."""
    if isinstance(question, Prints):
        return question.prints + " no"
    return letters_of(question)[::-1] if isinstance(question, OrderQuestion) else _other(question)


def _other(question: One | Several) -> str:
    wrong = [n for n, choice in enumerate(question.choices) if not choice.right]
    return "abcdefgh"[wrong[0]] if wrong else "a"


def typing(lines: Iterable[str]) -> Callable[[str], str]:
    """Somebody who types these lines, and then Ctrl-D."""
    left = iter(lines)

    def read(_: str) -> str:
        try:
            return next(left)
        except StopIteration:
            raise EOFError from None

    return read


@pytest.mark.parametrize("question", QUESTIONS.values(), ids=lambda each: each.id)
def test_the_right_letters_are_right(question: Question) -> None:
    """Of every question of the course; the wrong ones are told without giving the answer."""
    found = judged(question, letters_of(question))
    assert found.right and all(found.said)
    wrong = judged(question, wrong_of(question))
    if not (isinstance(question, Several) and all(each.right for each in question.choices)):
        assert not wrong.right and wrong.said
    assert how_to_answer(question) and all(right_answer(question))


@pytest.mark.parametrize("typed", ["", "  ", "z", "ab", "aa", "1", "nothing"])
def test_what_is_no_answer_is_told(typed: str) -> None:
    """And does not count as a try."""
    with pytest.raises(NotAnAnswer, match="One letter, a to d"):
        judged(LAMP, typed)


@pytest.mark.parametrize("typed", ["A", " a ", "a)", "a."])
def test_letters_are_read_kindly(typed: str) -> None:
    """Capitals, blanks, brackets."""
    assert judged(LAMP, typed) == judged(LAMP, "a")


def test_an_order_wants_every_letter() -> None:
    """And each once."""
    question = next(each for each in QUESTIONS.values() if isinstance(each, OrderQuestion))
    for typed in ("a", letters_of(question)[:-1], letters_of(question) + "a"):
        with pytest.raises(NotAnAnswer):
            judged(question, typed)
    first, second, *rest = letters_of(question)
    said = judged(question, "".join([first, *rest, second])).said
    assert said == ("The first 1 is right.",) or len(rest) == 0


def round_of(
    quiz: Quiz, wrong_first: int, capsys: pytest.CaptureFixture[str]
) -> tuple[QuizRound, str]:
    """Everything answered; the first ones wrong at first."""
    lines = list[str]()
    for number, question in enumerate(quiz.questions):
        lines += [wrong_of(question)] * (number < wrong_first) + [letters_of(question)]
        lines += [""] * (number < len(quiz.questions) - 1)
    found = ask_all(quiz, typing(lines))
    return found, capsys.readouterr().out


def test_only_the_first_try_counts(capsys: pytest.CaptureFixture[str]) -> None:
    """The reason comes after each; the screen is 80 columns wide."""
    quiz = next(quiz for quiz in LESSONS.quizzes if quiz.day == "01-install")
    found, said = round_of(quiz, 2, capsys)
    assert found == QuizRound(len(quiz.questions), len(quiz.questions) - 2, whole=True)
    assert said.count("Not yet.") == 2 and said.count("Right.") == len(quiz.questions)
    assert max(map(len, said.splitlines())) <= 80


def test_after_two_tries_the_answer_is_told(capsys: pytest.CaptureFixture[str]) -> None:
    """With its reason; then it goes on."""
    quiz = Quiz("01-install", (LAMP,))
    assert ask_all(quiz, typing([wrong_of(LAMP), wrong_of(LAMP)])) == QuizRound(1, 0, whole=True)
    assert "This is right:" in capsys.readouterr().out


@pytest.mark.parametrize("typed", [["q"], [], ["?", "q"]])
def test_it_can_be_ended(typed: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    """By q and by Ctrl-D; nothing was asked to its end."""
    assert ask_all(Quiz("01-install", (LAMP,)), typing(typed)) == QuizRound(0, 0)


# --- what is kept ------------------------------------------------------------------------------


def test_the_best_round_is_kept(tmp_path: Path) -> None:
    """By its part of the questions: a quiz may have more of them next year."""
    for right, of, best in ((6, 10, (6, 10)), (4, 10, (6, 10)), (8, 12, (8, 12)), (7, 12, (8, 12))):
        found = record_quiz("05-actions", right, of, tmp_path)
        assert (found.best, found.of) == best and found.last == right
    kept = read_progress(tmp_path)
    assert kept.quizzes["05-actions"].rounds == 4 and len(kept.days) == 1
    assert progress_in(as_json(kept).encode()) == kept


@pytest.mark.parametrize(
    "entry", ['{"best": 11, "of": 10}', '{"best": -1}', '{"of": true}', "3", '{"last_at": "x"}']
)
def test_a_score_that_cannot_be_is_damage(entry: str) -> None:
    """The file is then set aside."""
    with pytest.raises(DamagedProgress):
        progress_in(f'{{"schema": 1, "quizzes": {{"05-actions": {entry}}}}}'.encode())
    assert progress_in(b'{"schema": 1, "labs": {}}') == StudentProgress()


# --- as it is typed ----------------------------------------------------------------------------


@pytest.mark.parametrize("word", ["5", "05", "05-actions", "actions"])
def test_in_a_pipe_it_is_printed(
    word: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """By number, folder or name of the day."""
    assert main(["quiz", word]) == 0
    quiz = LESSONS.quiz("05-actions")
    assert quiz and capsys.readouterr().out.rstrip() == as_text(quiz)


@pytest.mark.parametrize("word", ["0", "33", "action", "five"])
def test_a_day_that_is_none_is_told(word: str, capsys: pytest.CaptureFixture[str]) -> None:
    """With all that are there."""
    assert main(["quiz", word]) == 2
    said = capsys.readouterr().err
    assert word in said and "05-actions" in said
    assert isinstance(NoSuchDay(word, LESSONS.days), Exception)


@pytest.mark.slow
def test_a_round_on_a_terminal_stands_in_status(tmp_path: Path) -> None:
    """The command itself, on a terminal; `status` then has the score."""
    quiz = LESSONS.quiz("01-install")
    assert quiz
    lines = "".join(f"{letters_of(each)}\n\n" for each in quiz.questions).removesuffix("\n")
    own = {**os.environ, "ROSLINGS_WS": str(tmp_path), "COLUMNS": "80"}
    screen, end = pty.openpty()
    asking = subprocess.Popen(
        [sys.executable, "-m", "roslings", "quiz", "1"],
        cwd=course.root(),
        env=own,
        stdin=end,
        stdout=end,
        stderr=end,
        start_new_session=True,
    )
    os.close(end)
    os.write(screen, lines.encode())
    said = _until_it_ends(screen)
    assert asking.wait() == 0
    count = len(quiz.questions)
    assert f"{count} of {count} right at the first try" in said
    told = subprocess.run(
        [sys.executable, "-m", "roslings", "status"],
        cwd=course.root(),
        env=own,
        capture_output=True,
        text=True,
        check=True,
    ).stdout
    assert f" {count}/{count} " in next(line for line in told.splitlines() if "01-install" in line)


def _until_it_ends(screen: int) -> str:
    said = b""
    try:
        while part := os.read(screen, 65536):
            said += part
    except OSError:  # the other end is closed
        pass
    finally:
        os.close(screen)
    return said.decode("utf-8", "replace")
