"""Drills, quizzes and `watch` in the false language: no plain English is left on their screens."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path

import pytest
from false_screen import Type, left_plain, require_columns, require_no_english

from ros2_on_pip.false_language import false
from ros2_on_pip.language import ENGLISH, FALSE, speaking
from roslings import course
from roslings.report import often_said
from roslings_learn.commands import quiz as quizzes
from roslings_learn.commands.watch import editing, next_name, reading
from roslings_learn.commands.watch.drill import DrillSession, begun
from roslings_learn.commands.watch.keyboard import Keyboard
from roslings_learn.drills import Drill, all_drills, drill, telling
from roslings_learn.drills.faults import NeverSpins, NoAnswerYet, NotPrinted, ScriptMakesNoNode
from roslings_learn.drills.judging import DrillVerdict, failed
from roslings_learn.lessons import Prints, read_lessons

LAMP, CHILD = drill("no_spin"), drill("child")
LETTERS = frozenset({"a", "ac"})
"""They are typed."""
DAYS = sorted({each.day for each in all_drills()})
Say = Callable[[], None]


@pytest.fixture
def screen(typed: Type, capsys: pytest.CaptureFixture[str]) -> Callable[..., str]:
    """What a function prints, in a language."""

    def printed(say: Say, language: str = FALSE) -> str:
        capsys.readouterr()
        with speaking(language):
            say()
        return "".join(capsys.readouterr())

    return printed


# --- drills --------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    "words",
    [("drill",), ("drill", LAMP.name), ("drill", CHILD.name), ("drill", "--list")]
    + [("drill", LAMP.name, "--hint", step) for step in "123"],
    ids=" ".join,
)
def test_what_drill_shows(typed: Type, words: tuple[str, ...]) -> None:
    """The next one, a task, the hints, the list."""
    require_no_english(typed(*words), frozenset({"ws"}))
    require_columns(typed(*words, language=ENGLISH))


@pytest.mark.parametrize("words", [("no_spinn",), ("--day", "77")], ids=" ".join)
def test_a_drill_that_is_not_there(typed: Type, words: tuple[str, ...]) -> None:
    """What was meant, and where all are listed."""
    assert not left_plain(typed("drill", *words), frozenset({"roslings"}))


def verdicts() -> Iterable[tuple[Drill, DrillVerdict]]:
    """Of each kind, as a check makes them in the language that is asked for."""
    lamp, child = drill(LAMP.name), drill(CHILD.name)
    assert child.card.answer
    question = child.card.answer.question
    because = child.card.answer.because
    yield child, DrillVerdict(child.name, "pass", because=because, seconds=1.0)
    yield lamp, DrillVerdict(lamp.name, "pass", seconds=1.0)
    yield child, failed(child.name, "answer", "", NoAnswerYet(question))
    yield lamp, failed(lamp.name, "spins", "", NeverSpins("/lamp"))
    yield lamp, failed(lamp.name, "prints", "", NotPrinted("'on'", None))
    yield child, failed(child.name, "runs", "", ScriptMakesNoNode("your program", None, ""))


@pytest.mark.parametrize("watched", [False, True], ids=["typed", "watched"])
def test_the_verdict_on_a_drill(screen: Callable[..., str], watched: bool) -> None:
    """What is wrong, the mend, where hints are; and that all is well."""

    def say() -> None:
        page = telling.page()
        for one, verdict in verdicts():
            way = telling.WayToGoOn("./roslings", watched)
            telling.put_verdict(page, one, verdict, Path(f"/ws/{one.file_name}"), way)
        page.print()

    require_no_english(screen(say), frozenset({"ws"}))
    require_columns(screen(say, ENGLISH))


def test_labels_of_a_page_share_a_column(screen: Callable[..., str]) -> None:
    """However long they are in a language, all texts begin at one place, as in English."""

    def say() -> None:
        page = telling.page()
        page.labelled(often_said.EXPECTED, "123")
        page.command(often_said.NEXT, "123", "./roslings")
        page.labelled(often_said.MEASURED, "123 " * 40)
        page.print()

    for language, column in ((ENGLISH, 10), (FALSE, 12)):
        lines = screen(say, language).splitlines()
        assert {line.index("123") for line in lines} == {column}


# --- quizzes -------------------------------------------------------------------------------------


@pytest.mark.parametrize("day", DAYS)
def test_the_questions_of_a_day_in_a_pipe(typed: Type, day: str) -> None:
    """With their answers and reasons; what a program prints is code."""
    lessons = read_lessons(course.root())
    quiz = lessons.quiz(day)
    assert quiz
    known = LETTERS.union(*map(_code_of, quiz.questions))
    told = typed("quiz", day)
    require_columns(_without_code(told))
    assert not left_plain(_in_one_line(told), known)
    require_columns(_without_code(typed("quiz", day, language=ENGLISH)))


def _code_of(question: object) -> set[str]:
    """What stands as code in a question, or is what it prints."""
    text = f"{question.prints} {question.code}" if isinstance(question, Prints) else ""
    return set("".join(letter if letter.isalpha() else " " for letter in text).split())


def _in_one_line(screen: str) -> str:
    """So that code in a text is whole."""
    return " ".join(_without_code(screen).split())


def _without_code(screen: str) -> str:
    return "\n".join(line for line in screen.splitlines() if not line.startswith("       "))


def test_a_round_of_a_quiz(
    screen: Callable[..., str], monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """Every answer wrong, nothing, all of it; then once more, for a best score; then broken off."""
    said: list[str] = []
    with speaking(FALSE):
        install = read_lessons(course.root()).quiz("01-install")
    assert install

    def play(lines: Iterable[str]) -> Say:
        left = iter(lines)

        def read(text: str) -> str:
            said.append(text)
            try:
                return next(left)
            except StopIteration:
                raise EOFError from None

        def say() -> None:
            monkeypatch.setattr("builtins.input", read)
            quizzes._play(install)

        return say

    screens = [screen(play(_typed_lines())) for _ in range(2)]
    screens += [screen(play(["a", "q"])), screen(play([]))]
    known = LETTERS.union(*map(_code_of, install.questions))
    for each in (*screens, "\n".join(said)):
        require_columns(_without_code(each))
        assert not left_plain(_in_one_line(each), known)
    assert false("Your best") in _in_one_line(screens[1])


def _typed_lines() -> Iterable[str]:
    """No answer, wrong letters and many right ones, until a round is over."""
    for _ in range(200):
        yield from ("", "zz", "a", "b", "ab", "abc", "abcd", "dcba")


def test_a_day_that_has_no_quiz(typed: Type) -> None:
    """It names those that have one."""
    assert not left_plain(typed("quiz", "77"))


# --- watch ---------------------------------------------------------------------------------------


class Pressed(Keyboard):
    """A keyboard that is there."""

    def __init__(self) -> None:
        super().__init__(keys=object())  # type: ignore[arg-type]  # nobody presses any


@pytest.fixture
def session(typed: Type, monkeypatch: pytest.MonkeyPatch) -> DrillSession:
    """Of a drill that was saved once."""
    monkeypatch.setattr(editing, "is_there", lambda: False)
    return begun(LAMP.name, Pressed())


@pytest.mark.parametrize("key", ["h", "e", "r", "l", "s", "x", "c", "a", "n", "q", "z", "\x01"])
@pytest.mark.parametrize("done", [False, True], ids=["not-done", "done"])
def test_each_key_of_watch(
    screen: Callable[..., str], session: DrillSession, key: str, done: bool
) -> None:
    """What it shows, why it cannot, and what is said of it while a check runs."""
    session.verdict = DrillVerdict(LAMP.name, "pass") if done else None

    def say() -> None:
        session.say_that_it_waits()
        session.drill = drill(LAMP.name)  # its card in the language that is spoken
        if key != "l":  # the lesson itself is translated with its page
            session.follow(key)
            session.follow(key)
        print(session._meaning(key))

    require_no_english(screen(say), frozenset({"ws", *LETTERS}))
    require_columns(screen(say, ENGLISH))


def test_what_watch_says_by_itself(screen: Callable[..., str], session: DrillSession) -> None:
    """The head, what was saved or is gone, its own words where there are no keys."""

    def say() -> None:
        session.drill = drill(LAMP.name)
        session._head(frozenset({session.file.resolve()}), False)
        session._head(frozenset({session.folder.resolve() / "gone.py"}), False)
        session._head(frozenset({session.folder.resolve()}), False)
        session._show_task()
        session.keys = Keyboard()
        session.say_that_it_waits()
        editing.edit(session.file)
        reading.show("days/77-nothing", "./roslings")
        session.verdict, session.keys = DrillVerdict(LAMP.name, "pass"), Pressed()
        session._tell_of_ours()
        session._compare()
        next_name()

    monkey = pytest.MonkeyPatch()
    with monkey.context() as patch:
        patch.setattr(editing, "editor_for", lambda *_: None)
        told = screen(say)
        english = screen(say, ENGLISH)
    program = session.drill.solution.read_text("utf-8")
    shown = "\n".join(line for line in told.splitlines() if " | " not in line and " > " not in line)
    shown = "\n".join(line for line in shown.splitlines() if line[2:] not in program)
    require_no_english(shown, frozenset({"ws", *LETTERS}))
    require_columns(english)
