"""Each day that has a lab ends with what the lab's part does on the robot, as its task types it."""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from roslings.course import root

DAYS = sorted(path.parent for path in root().glob("days/*/lesson.ipynb"))[1:]


def texts(day: Path) -> list[str]:
    """Of its lesson's cells."""
    cells = json.loads((day / "lesson.ipynb").read_text("utf-8"))["cells"]
    return ["".join(cell["source"]) for cell in cells]


def wins(text: str) -> set[str]:
    """The commands that start the student's own rover."""
    return set(re.findall(r"\./roslings my-rover[^`\n]*", text))


@pytest.mark.parametrize("day", DAYS, ids=lambda day: day.name)
def test_a_day_ends_on_the_robot(day: Path) -> None:
    """Students of the lesson alone see it, too; and by a command that its task explains."""
    last = next(text for text in texts(day) if text.startswith("## The check"))
    labs = re.findall(r"labs/([a-z-]+)/task\.md", "".join(texts(day)))
    tasks = [(root() / "labs" / lab / "task.md").read_text("utf-8") for lab in labs]
    assert len(wins(last)) == 1
    assert wins(last) <= set().union(*map(wins, tasks))
