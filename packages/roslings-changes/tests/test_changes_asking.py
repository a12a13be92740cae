"""The questions in a terminal: what is shown, what may be typed, how it ends."""

from __future__ import annotations

from collections.abc import Callable, Iterator

import pytest
from test_changes_questions import verdict

from roslings_changes.asking import ExplainRound, answered, ask_all, listed, question_lines
from roslings_changes.candidates import CodeChange
from roslings_changes.questions import Question

BEFORE = "class A:\n    def b(self):\n        self.create_timer(0.5, self.c)\n"
CHANGE = CodeChange("number", "chatter/talker.py", 3, BEFORE, BEFORE.replace("0.5", "0.75"))


def question(*failed: str) -> Question:
    """One that these checks answer."""
    found = verdict(*failed)
    return Question(CHANGE, found.failed()[0], found.checks)


def typing(*lines: str) -> Callable[[str], str]:
    """A student who types these, and then Ctrl-D."""
    left: Iterator[str] = iter(lines)

    def read(text: str) -> str:
        for line in left:
            return line
        raise EOFError

    return read


def test_a_change_is_shown_with_file_and_line_and_moved_to_the_left() -> None:
    """As a difference is written."""
    assert question_lines(2, question("rate")) == [
        "2 of 3   chatter/talker.py, line 3",
        "",
        "    - self.create_timer(0.5, self.c)",
        "    + self.create_timer(0.75, self.c)",
        "",
    ]


def test_the_checks_fit_on_a_screen() -> None:
    """Each in one line, with its number and name."""
    lines = listed(question("rate").checks)
    assert lines[1].split()[:2] == ["2", "rate"] and max(map(len, lines)) < 80


@pytest.mark.parametrize("typed", ["rate", "2", " 2 "])
def test_a_check_is_named_by_number_or_name(typed: str) -> None:
    """Right is the first one that fails."""
    said: list[str] = []
    found = ask_all([question("rate", "ends")], typing(typed, "it is slower"), said.append)
    assert found == ExplainRound(asked=1, right=1)
    assert said[-1].startswith("Right. The first check that fails is rate: About rate.")


def test_another_one_is_told_and_counted() -> None:
    """With what the grader says."""
    said: list[str] = []
    found = ask_all([question("text"), question("rate")], typing("ends", "", "2", ""), said.append)
    assert found == ExplainRound(asked=2, right=1)
    assert "Not ends. The first check that fails is text" in said[1]


def test_what_is_no_check_is_asked_again() -> None:
    """With what may be typed."""
    said: list[str] = []
    ask_all([question("text")], typing("0", "5", "speed", "3", "so"), said.append)
    assert said[1:4] == ["Type a number from 1 to 4, or a name as it stands there."] * 3
    assert said[4].startswith("Right.")


@pytest.mark.parametrize("lines", [[], ["q"], ["rate"]])
def test_q_and_ctrl_d_end_it_and_nothing_more_is_graded(lines: list[str]) -> None:
    """Questions are made one by one."""
    made = iter([question("rate"), question("text")])
    assert ask_all(made, typing(*lines), lambda _: None).asked == 0
    assert len(list(made)) == 1


def test_without_an_answer_the_grader_alone_speaks() -> None:
    """For those who ask others."""
    assert answered(question("rate"))[0] == "The first check that fails is rate: About rate."
