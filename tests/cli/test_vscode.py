"""The tasks for VS Code: what they type exists, and the matcher finds the places in a verdict."""

from __future__ import annotations

import json
import re
import shlex
from typing import Any

import pytest

from roslings.course import all_labs, root
from roslings_launcher.cli import parser

TASKS: dict[str, Any] = json.loads((root() / ".vscode" / "tasks.json").read_text("utf-8"))


@pytest.mark.parametrize("task", TASKS["tasks"], ids=lambda task: task["label"])
def test_each_task_types_a_command_that_there_is(task: dict[str, Any]) -> None:
    """With a lab of the course in the place of the question."""
    program, *words = shlex.split(task["command"].replace("${input:lab}", "topics"))
    assert (root() / program).is_file()
    assert parser().parse_args(words).command


def test_the_question_knows_all_labs() -> None:
    """In the course's order."""
    (question,) = TASKS["inputs"]
    assert question["options"] == [lab.name for lab in all_labs()]
    assert question["default"] in question["options"]


@pytest.mark.parametrize(
    ("line", "place"),
    [
        ("  measured  package.xml:12: the tag <name> is not closed", ("package.xml", "12")),
        (
            "  expected  rclpy in package.xml, because rover_status/minimal_publisher.py:7",
            ("rover_status/minimal_publisher.py", "7"),
        ),
        ("Score     5 of 100. 16 checks: 1 passes, 2 fail, 13 are skipped.", None),
    ],
)
def test_the_matcher_finds_file_and_line(line: str, place: tuple[str, str] | None) -> None:
    """As they stand in a verdict; a line without a place is none."""
    (task,) = (task for task in TASKS["tasks"] if isinstance(task["problemMatcher"], dict))
    pattern = task["problemMatcher"]["pattern"]
    found = re.search(pattern["regexp"], line)
    assert (found and (found[pattern["file"]], found[pattern["line"]])) == place
