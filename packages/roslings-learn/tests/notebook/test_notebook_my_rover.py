"""A student's own rover below a cell: its map, its parts in words, and nothing left afterwards."""

from __future__ import annotations

import re
import shutil
import subprocess
from collections.abc import Iterator
from pathlib import Path

import pytest
from kernels import Kernel, Ran, kernel
from test_notebook_cells import alt_of, content_of

from roslings.course import lab, root
from roslings_rover.models.rooms import room_of

pytestmark = pytest.mark.slow
PAGE = (root() / "site/pages/reference/my-rover.md").read_text("utf-8")
CELLS = re.findall(r"^```python\n(.*?)^```", PAGE, re.M | re.S)


@pytest.fixture(scope="module")
def cells(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Kernel]:
    """A kernel of a student who has the labs of the days 2 and 3."""
    folder = tmp_path_factory.mktemp("notebook")
    for name in ("nodes", "distance-sensor"):
        own = lab(name)
        shutil.copytree(own.solution, folder / "ws" / "src" / own.outline.package)
    with kernel(folder) as opened:
        yield opened


def drawn(ran: Ran) -> tuple[str, bytes]:
    """The words and the picture of the one map."""
    assert ran.error == "", ran
    (shown,) = ran.shown
    return alt_of(shown), content_of(shown)


def left_behind() -> str:
    """Programs of parts that still run."""
    done = subprocess.run(["ps", "-ww", "-eo", "args"], capture_output=True, text=True, check=True)
    own = [line for line in done.stdout.splitlines() if "/notebook" in line]
    return "\n".join(line for line in own if ".roslings/my_rover" in line)


def test_one_call_shows_the_own_rover(cells: Kernel) -> None:
    """It has driven, and its parts are told in words, for eyes and for ears."""
    ran = cells.run("show_my_rover()")
    words, picture = drawn(ran)
    assert re.search(r"^Your rover's map\. It is at x (0\.[1-9]|1\.)", words), words
    assert "Its parts: voice never checked, sonar never checked, no pace yet: day 4" in words
    assert "no pace yet: day 4, no pilot yet: day 5" in ran.text
    assert b"@keyframes drive" in picture
    assert left_behind() == ""


def test_the_pages_cells_run_as_they_stand_there(cells: Kernel) -> None:
    """The one call, and the rover that drives beside the lines of a cell."""
    assert len(CELLS) == 3
    for code in CELLS[:2]:
        words, _ = drawn(cells.run(code))
        assert "Your rover's map." in words and "voice" in words
    assert left_behind() == ""


def test_the_pages_rover_bumps_in_its_room(cells: Kernel) -> None:
    """Its map is that of the room; the bump is told in words and counted."""
    ran = cells.run(CELLS[2])
    words, picture = drawn(ran)
    assert re.search(r"^The rover's map\. It is at x .* It has bumped once\.$", words), words
    assert "bumps: 1" in ran.text
    obstacles = len(room_of(17).world.obstacles)
    assert picture.count(b'class="obstacle"') == obstacles and b">moves<" in picture


def test_the_parts_of_a_day_alone(cells: Kernel) -> None:
    """And its own words, once it has said some."""
    ran = cells.run("""
with session() as ros:
    rover = ros.my_rover(2)
    ros.until(lambda: rover.says, "its words", timeout_s=60)
    show_map(rover)
""")
    words, _ = drawn(ran)
    assert "Its parts: voice never checked." in words
    assert re.search(r'It says: "Robot status count: \d+"\.', words), words
    assert left_behind() == ""


def test_without_a_part_the_next_step_is_said(cells: Kernel, tmp_path: Path) -> None:
    """In a line, as it is in a terminal."""
    ran = cells.run(f"os.environ['ROSLINGS_WS'] = {str(tmp_path)!r}\nshow_my_rover()")
    assert ran.error == "NoPart" and "start nodes" in ran.told
    assert len(ran.told.splitlines()) <= 6 and "roslings_my_rover" not in ran.told
