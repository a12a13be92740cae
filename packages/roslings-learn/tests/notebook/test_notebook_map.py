"""The map below a cell, in a browser: it drives once, and not for who asks for less motion."""

from __future__ import annotations

from typing import Any

import pytest

from roslings_learn.notebook.picture import NotebookPicture
from roslings_rover.models.differential_drive import Body, Pose
from roslings_rover.models.world import default_world
from roslings_rover.rover.moving_map import moving_map
from roslings_rover.rover.rover import RoverMoment

pytestmark = pytest.mark.slow

ALIKE = 10
TRIES = 5
"""A busy computer may look for the first time when the drive is over."""


def drive() -> NotebookPicture:
    """Five metres straight ahead in five seconds, as a cell shows them."""
    trail = [RoverMoment(0.05 * i, Pose(0.05 * i)) for i in range(101)]
    moving, still = (
        moving_map(default_world(), trail, Body().radius_m, moves=moves).encode()
        for moves in (True, False)
    )
    return NotebookPicture(moving, "image/svg+xml", "A drive", still=still)


def watched(browser: Any, motion: str) -> list[bytes]:
    """What a browser shows, until it has stood still for a while."""
    context = browser.new_context(reduced_motion=motion, viewport={"width": 620, "height": 600})
    page = context.new_page()
    page.set_content(drive().html())
    page.wait_for_function("document.images[0].complete")
    seen = [page.screenshot()]
    while len(seen) < ALIKE or len(set(seen[-ALIKE:])) > 1:
        page.wait_for_timeout(100)
        seen.append(page.screenshot())
    context.close()
    return seen


def pixels(screenshot: bytes) -> list[int]:
    """The values of all pixels in a row."""
    import png

    _, _, rows, _ = png.Reader(bytes=screenshot).read()
    return [value for row in rows for value in row]


def unlike(one: bytes, other: bytes) -> int:
    """How many values differ by more than the edge of a line does."""
    return sum(abs(a - b) > 64 for a, b in zip(pixels(one), pixels(other), strict=True))


def test_it_drives_and_then_stands_where_less_motion_shows_it_at_once(browser: Any) -> None:
    """More than one picture with motion, one without, and the end is the same."""
    watches = (watched(browser, "no-preference") for _ in range(TRIES))
    moving = next(seen for seen in watches if len(set(seen)) > 2)
    still = watched(browser, "reduce")
    assert len(set(still)) == 1
    assert unlike(moving[-1], still[0]) < 30 < unlike(moving[0], still[0])
