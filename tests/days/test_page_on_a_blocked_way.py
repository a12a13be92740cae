"""The page of day 5 on a way that is blocked: each command typed, beside the real rover."""

from __future__ import annotations

import re
import subprocess
import sys
from collections.abc import Iterator
from contextlib import ExitStack
from pathlib import Path
from typing import Any

import pytest
from student import BLOCK, Student, placed, save_as
from terminals import until

from ros2_on_pip.domain_lease import leased_domain
from roslings.capabilities.actions.contract import ActionWords
from roslings.course import lab, root
from roslings_rover.models.world import Box, default_world
from skips import needs

LAB = lab("actions")
PAGE = (root() / "days/05-actions/blocked-way.md").read_text("utf-8")
POINT = re.compile(r"\{x: (\S+), y: (\S+), tolerance")
DISTANCE = re.compile(r"^distance: (\S+)$", re.M)
STANDS = 20
"""As many feedbacks without a change: two seconds."""


def number(pattern: str) -> list[float]:
    """What the page says in these words."""
    (found,) = re.findall(pattern, " ".join(PAGE.split()))
    return [float(each) for each in ([found] if isinstance(found, str) else found)]


def is_stuck() -> Any:
    """The page's function, and its numbers."""
    (code,) = re.findall(r"^```python\n(.*?)^```$", PAGE, re.M | re.S)
    names: dict[str, Any] = {}
    exec(code, names)
    return names


def test_the_box_stands_where_the_page_says() -> None:
    """On the floor that every rover has; the goal is behind it, and the detour is free."""
    west, east, south, north = number(r"from (\S+) to (\S+) m in x, and from (\S+) to (\S+) m in y")
    assert Box(west, south, east, north) in default_world().obstacles
    (blocked, around, again) = [(float(x), float(y)) for x, y in POINT.findall(PAGE)]
    assert blocked == again and blocked[1] > north
    drawing = (root() / "days/05-actions/pictures/blocked-way.svg").read_text("utf-8")
    for x, y in (blocked, around):
        assert f"({x}, {y})" in PAGE and f"({x}, {y})" in drawing


def test_each_command_names_its_terminal() -> None:
    """So each of them is typed below."""
    assert len(placed(PAGE)) == len(BLOCK.findall(PAGE)) == 4


@pytest.mark.parametrize(
    ("distances", "stuck"),
    [
        ([], False),
        ([2.13] * 49, False),  # not five seconds yet
        ([2.13] * 50, True),
        ([5.0 - 0.05 * n for n in range(50)], False),  # half a metre a second
        ([5.0 - 0.05 * n for n in range(50)] + [2.5] * 50, True),
        ([2.5 + 0.001 * (n % 2) for n in range(60)], True),  # it trembles
        ([2.0 + 0.05 * n for n in range(50)], True),  # it goes away
    ],
)
def test_the_function_of_the_page_tells_who_is_stuck(distances: list[float], stuck: bool) -> None:
    """Not who drives, and not who has just begun."""
    assert is_stuck()["is_stuck"](distances) is stuck


def test_its_seconds_are_those_of_the_lab() -> None:
    """At the card's rate of feedback."""
    (performs,) = LAB.card.nodes[0].of(ActionWords).performs
    assert performs.feedback is not None
    assert is_stuck()["PATIENCE"] == 5 * performs.feedback.hz


@pytest.fixture
def student(tmp_path: Path) -> Iterator[Student]:
    """With the lab done and built."""
    workspace = tmp_path / "roslings_ws"
    save_as(LAB.solution, workspace / "src" / LAB.card.package)
    colcon = Path(sys.executable).with_name("colcon")
    subprocess.run([colcon, "build"], cwd=workspace, check=True, capture_output=True)
    with leased_domain() as domain, ExitStack() as stack:
        yield Student(tmp_path, domain, stack, PAGE)


@pytest.mark.slow
@needs("colcon")
def test_the_page_on_a_blocked_way_goes_as_it_tells(student: Student) -> None:
    """The rover stands, its feedback says so, and two goals lead around the box."""
    rover, _ = student.types()
    rover.shows(r"/odom")
    server, _ = student.types()
    client, _ = student.types()
    client.shows("Goal accepted")

    def stands() -> bool:
        last = DISTANCE.findall(client.heard().replace("\r", ""))[-STANDS:]
        return len(last) == STANDS and max(map(float, last)) - min(map(float, last)) < 0.002

    until(stands, lambda: f"it drives on:\n{client}")
    (told_m,) = number(r"about (\S+) m\.")
    assert float(DISTANCE.findall(client.heard().replace("\r", ""))[-1]) == pytest.approx(
        told_m, abs=0.1
    )
    rover.shows(student.promised("The rover touches something."))
    assert re.search(student.promised("Goal canceled."), student.ends(3))

    ended = student.promised("Goal finished with status: SUCCEEDED")
    client, first = student.types()
    assert re.search(ended, first)
    client.shows(ended)
    assert "Traceback" not in server.heard() + student.ends(2)
    student.ends(1)
    assert student.left == []
