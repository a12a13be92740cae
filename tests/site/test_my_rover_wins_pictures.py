"""What each day adds to the rover, in a picture: its page shows it, and a real run looks so."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree

import pytest
from my_rover_wins_pictures import (
    COLUMNS,
    WINS,
    Win,
    drawn,
    kinds_of,
    plain,
    seen,
    shots_of,
    words_of,
)

from roslings.course import lab, root
from roslings_my_rover.parts import PARTS

PAGE = root() / "site/pages/reference/my-rover.md"
SVG = "{http://www.w3.org/2000/svg}"
AT_EACH_LANDING = (2, 8)
each_win = pytest.mark.parametrize("win", WINS, ids=lambda win: win.lab)


def picture(win: Win) -> str:
    """As it lies in the lab."""
    return win.file.read_text("utf-8")


def test_each_day_of_the_rover_has_one() -> None:
    """From day 2 on, the black box too; day 3's chatter is no part."""
    assert [win.day for win in WINS] == list(range(2, 13))
    assert {win.lab for win in WINS} == {part.lab for part in PARTS} | {"black-box"}


@each_win
def test_task_and_page_show_it_with_words(win: Win) -> None:
    """With the sentence that the picture itself holds; both have the same picture."""
    ending = lab(win.lab).task.read_text("utf-8").rpartition("## On your rover")[2]
    assert f"![{win.alt}](pictures/{win.file.name})" in ending
    assert f"![{win.alt}](pictures/{win.copy.name})" in PAGE.read_text("utf-8")
    assert win.copy.read_text("utf-8") == picture(win)
    assert ElementTree.fromstring(picture(win)).findtext(f"{SVG}title") == win.alt


@each_win
def test_it_is_drawn_from_a_screen(win: Win) -> None:
    """By its program, and by nobody's hand; small, and of 80 columns."""
    svg = picture(win)
    shots = shots_of(svg)
    assert drawn(win.alt, shots) == svg
    assert shots[0].typed == win.typed
    assert max(len(plain(line)) for shot in shots for line in shot.lines) <= COLUMNS
    assert len(svg) < 20_000 and "<script" not in svg and "href" not in svg


@each_win
def test_it_shows_what_its_words_say(win: Win) -> None:
    """What is quoted behind a colon stands on the screen."""
    said = " ".join(plain(line) for shot in shots_of(picture(win)) for line in shot.lines)
    told = [each.strip(". ") for each in win.alt.split(": ")[1:]]
    assert [each for each in told if each.split(". ")[0] not in said] == []


def test_the_program_of_day_9_tells_what_the_rover_went() -> None:
    """In its picture, too."""
    win = next(each for each in WINS if each.lab == "black-box")
    rover, program = shots_of(picture(win))
    (went,) = [plain(line).split()[2] for line in rover.lines if "It went" in plain(line)]
    (told,) = [plain(line).split()[1] for line in program.lines if "distance:" in plain(line)]
    assert abs(float(went) - float(told)) <= 0.1


@pytest.mark.slow
@pytest.mark.parametrize(
    "win",
    [
        pytest.param(win, id=win.lab, marks=[] if win.day in AT_EACH_LANDING else pytest.mark.twice)
        for win in WINS
    ],
)
def test_a_run_of_today_looks_so(win: Win, tmp_path: Path) -> None:
    """The same words, but for the numbers, and the same things on the map."""
    shots = seen(win, tmp_path)
    assert words_of(shots) == words_of(shots_of(picture(win)))
    assert kinds_of(shots) == kinds_of(shots_of(picture(win)))
