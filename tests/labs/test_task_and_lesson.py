"""A lab's task and its day's lesson tell the same numbers: terminals, times, TODOs, packages."""

from __future__ import annotations

import re
import sys
from pathlib import Path

import pytest

from roslings.course import Lab, all_labs, root

sys.path.append(str(root() / "tests" / "days"))
from student import lesson_of, text_of

NUMBERS = {
    "one": 1.0,
    "two": 2.0,
    "two and a half": 2.5,
    "three": 3.0,
    "four": 4.0,
    "five": 5.0,
}
NUMBER = r"(\d+|two and a half|one|two|three|four|five)"
TIME = re.compile(rf"\b{NUMBER} (minutes|hours?)\b", re.I)
WITHOUT_UNIT = re.compile(r"\b(\d+) for the lab `")
each_lab = pytest.mark.parametrize("each", all_labs(), ids=lambda each: each.name)


def value(told: str) -> float:
    """Of a number in digits or in words."""
    return NUMBERS[told.lower()] if told.lower() in NUMBERS else float(told)


def minutes_in(text: str) -> set[float]:
    """Each length of time that a text tells."""
    line = " ".join(text.split())
    found = {value(n) * (1 if unit == "minutes" else 60) for n, unit in TIME.findall(line)}
    return found | {float(minutes) for minutes in WITHOUT_UNIT.findall(line)}


def task_of(lab: Lab) -> str:
    """The whole task."""
    return lab.task.read_text("utf-8")


def lesson_text(lab: Lab) -> str:
    """The head of the day's lesson and what it says of the lab."""
    lesson = lesson_of(int(lab.outline.day[:2]))
    return text_of(lesson, ["", "The lab"])


@each_lab
def test_the_task_counts_its_terminals(each: Lab) -> None:
    """As many as it names."""
    task = task_of(each)
    (told,) = re.findall(rf"You use {NUMBER} terminals", task)
    lists = re.findall(r"[Tt]erminals? ((?:\d(?:, | and )?)+)", task)
    assert {int(number) for found in lists for number in re.findall(r"\d", found)} == set(
        range(1, int(value(told)) + 1)
    )


@each_lab
def test_the_lesson_counts_the_same_terminals(each: Lab) -> None:
    """Where it counts them."""
    (told,) = re.findall(rf"You use {NUMBER} terminals", task_of(each))
    counted = re.findall(rf"\b{NUMBER} terminals", lesson_text(each), re.I)
    assert {value(number) for number in counted} <= {value(told)}


@each_lab
def test_the_lesson_tells_the_same_time(each: Lab) -> None:
    """The task's is one of those that the lesson tells; the steps do not take longer."""
    task = task_of(each)
    head = task.partition("**Time:**")[2].partition("**You")[0]
    (whole,) = minutes_in(head)
    assert whole in minutes_in(lesson_text(each))
    steps = [int(minutes) for minutes in re.findall(r"^### .*\((\d+) minutes\)$", task, re.M)]
    assert sum(steps) <= whole + 10


@each_lab
def test_the_check_is_named_after_todos_that_there_are(each: Lab) -> None:
    """Within the task's text, after each group of them."""
    told = re.search(r"says\s+after\s+(TODO [\d, and\n]+|each of these files)", task_of(each))
    assert told
    named = {int(number) for number in re.findall(r"\d+", told[1])}
    assert named <= todos(each.starter)


def todos(folder: Path) -> set[int]:
    """The numbers of a starter's TODOs."""
    files = (file for file in folder.rglob("*") if file.suffix in (".py", ".xml", ".yaml"))
    text = "\n".join(file.read_text("utf-8") for file in files)
    return {int(number) for number in re.findall(r"TODO (\d+)", text)}


@each_lab
def test_a_count_of_packages_in_the_starter_is_that_of_the_solution(each: Lab) -> None:
    """Where TODO 1 says how many lines package.xml needs."""
    comment = re.findall(rf"TODO 1: name the {NUMBER} ROS packages", starter_xml(each))
    solution = (each.solution / "package.xml").read_text("utf-8")
    needed = solution.count("<exec_depend>") - solution.count("<exec_depend>ros2launch")
    assert [value(number) for number in comment] in ([], [needed])


def starter_xml(lab: Lab) -> str:
    """The starter's package.xml."""
    return (lab.starter / "package.xml").read_text("utf-8")
