"""The picture of the desk: all its tabs are on it, and each shows what a real node said."""

from __future__ import annotations

import io
import re
from pathlib import Path
from typing import Any

import png
import pytest
from desk_picture import PICTURE, SHOWN, alt, drawn

from roslings.course import root
from roslings_desk.tab import BUILT_IN

FEWEST_COLOURS = 20
"""A page that shows nothing has fewer."""


def size(picture: bytes) -> tuple[int, int]:
    """Width and height in pixels."""
    wide, high, *_ = png.Reader(io.BytesIO(picture)).read()
    return wide, high


def colours(picture: bytes) -> set[tuple[int, ...]]:
    """All that are in it."""
    *_, rows, _ = png.Reader(io.BytesIO(picture)).asRGB8()
    return {tuple(row[at : at + 3]) for row in rows for at in range(0, len(row), 3)}


def test_each_tab_is_on_it() -> None:
    """In their order; a new one is missed here."""
    assert list(SHOWN) == list(BUILT_IN)


@pytest.mark.parametrize("page", ["README.md", "packages/roslings-desk/README.md"])
def test_a_page_shows_it_and_says_it_in_words(page: str) -> None:
    """For who does not see it."""
    file = root() / page
    ((words, picture),) = re.findall(r"!\[([^]]*)\]\(([^)]*desk\.png)\)", file.read_text("utf-8"))
    assert words == alt()
    assert (file.parent / picture).resolve() == PICTURE


@pytest.mark.slow
def test_it_looks_so_today(browser: Any, tmp_path: Path) -> None:
    """Each tab waits for what a node says, so none is empty; the sheet is as large as the kept."""
    pictures, sheet = drawn(browser, tmp_path)
    assert [title.lower() for title, _ in pictures] == list(BUILT_IN)
    assert all(len(colours(picture)) > FEWEST_COLOURS for _, picture in pictures)
    assert size(sheet) == size(PICTURE.read_bytes())
