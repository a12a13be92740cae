"""A text in quotes is told by single and by double ones: sources print either."""

from __future__ import annotations

import pytest

from roslings.course import lab
from roslings.evidence import ExperimentSeen, LogLine, ProcessSeen
from roslings.judge.demands import log_each, spellings
from roslings.judge.faults import LoggedAgain, NotLogged
from roslings.judge.views import ProcessView

STATUS = lab("nodes").card.nodes[0]


def writes(*texts: str) -> ProcessView:
    """A process that wrote these lines."""
    lines = [LogLine(arrival_ns=0, text=text, source="terminal") for text in texts]
    process = ProcessSeen(executable="it", started_ns=0, lines=lines)
    return ProcessView(process, ExperimentSeen(name="x", clock="wall"))


@pytest.mark.parametrize("line", ["Publishing: 'OK 1'", 'Publishing: "OK 1"'])
def test_both_quotes_are_right(line: str) -> None:
    """The card names one of them; both say the same."""
    writes(line).must(log_each(STATUS, ["OK 1"]))


@pytest.mark.parametrize("line", ["Publishing: OK 1", "Publishing: 'OK 1\"", 'Sent: "OK 1"'])
def test_other_words_are_wrong(line: str) -> None:
    """No quotes, two kinds at once, another word."""
    with pytest.raises(NotLogged):
        writes(line).must(log_each(STATUS, ["OK 1"]))


def test_a_line_without_quotes_has_one_spelling() -> None:
    """Nothing else is let through."""
    assert spellings("Distance: {text} mm", "5") == ("Distance: 5 mm",)


def test_a_line_may_be_printed_and_logged_but_neither_twice() -> None:
    """Some do both; who does one of them twice says that two things happened."""
    printed, logged = "Publishing: 'OK 1'", "[INFO] [1.0] [it]: Publishing: 'OK 1'"
    writes(printed, logged).must(log_each(STATUS, ["OK 1"]))
    for twice in ((printed, printed), (logged, logged)):
        with pytest.raises(LoggedAgain, match="2 times"):
            writes(*twice).must(log_each(STATUS, ["OK 1"]))
