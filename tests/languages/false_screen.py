"""A student's terminal of 80 columns in the false language, and what may stand on it."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache

from plain_english import plain, words_of
from ros2_on_pip.label_column import columns_of
from roslings import course
from roslings.commands.way import FIRST_DAY, FIRST_PAGE
from roslings_learn.drills import all_drills

COLUMNS = 80
Type = Callable[..., str]
"""Types words behind `./roslings` in a language, and gives what stands on the screen then."""


@cache
def names() -> frozenset[str]:
    """Of days, labs and drills: the same in each language."""
    labs = {
        word
        for lab in course.all_labs()
        for name in (lab.name, lab.outline.day)
        for word in words_of(name)
    }
    drills = {each.name for each in all_drills()}
    return frozenset(labs | drills | words_of(FIRST_DAY))


def left_plain(screen: str, known: frozenset[str] = frozenset()) -> list[str]:
    """The plain words of a screen, each with its line."""
    lines = screen.replace(FIRST_PAGE, "").splitlines()
    return plain([(line, "terminal") for line in lines], names() | known)


def require_no_english(screen: str, known: frozenset[str] = frozenset()) -> None:
    """No plain word, no line that is too long, and something that was translated."""
    assert not left_plain(screen, known), "\n".join(left_plain(screen, known))
    require_columns(screen)
    assert not screen.isascii()


def require_columns(screen: str) -> None:
    """No line is wider than a terminal."""
    wide = [line for line in screen.splitlines() if columns_of(line) > COLUMNS]
    assert not wide, "\n".join(wide)
