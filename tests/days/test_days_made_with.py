"""The course is made with six given packages: each is asked for, pinned, and used."""

from __future__ import annotations

import re
from dataclasses import dataclass

import pytest

from roslings.course import root


@dataclass(frozen=True)
class Given:
    """One of the six: the group of pyproject.toml that asks for it, and where it is used."""

    name: str
    group: str
    file: str
    use: str
    """A line of this file has this pattern."""


LEARN = "packages/roslings-learn/src/roslings_learn"
ENGINE = "packages/roslings/src/roslings"
SIX = (
    Given("jupyterlab", "lab", f"{LEARN}/jupyter/server.py", r'if place.hub else "jupyterlab"'),
    Given("nbval", "test", "tests/lessons_as_tests.py", r"^class LessonFile\(IPyNbFile\):"),
    Given("nbval", "test", ".ci/run", r"\./roslings test days --nbval-lax"),
    Given("ros-jazzy-rclpy", "ros", f"{LEARN}/notebook/session.py", r"^ +rclpy\.init\($"),
    Given("ros-jazzy-rclpy", "ros", "days/02-nodes/lesson.ipynb", r"from rclpy\.node import Node"),
    Given(
        "ros-jazzy-common-interfaces",
        "ros",
        "days/03-topics/lesson.ipynb",
        r"from sensor_msgs\.msg import FluidPressure",
    ),
    Given("pytest", "check", f"{ENGINE}/judge/judge.py", r"pytest\.main\("),
    Given("matplotlib", "graph", f"{ENGINE}/report/graph_sheet.py", r"^from matplotlib\.figure"),
)


def group_of(name: str) -> str:
    """The lines of a group of pyproject.toml."""
    text = (root() / "pyproject.toml").read_text("utf-8")
    found = re.search(rf"^{name} = \[\n(.*?)^\]", text, re.MULTILINE | re.DOTALL)
    assert found, f"pyproject.toml has no group {name}"
    return found[1]


def test_six_are_given() -> None:
    """No more, no fewer."""
    assert len({given.name for given in SIX}) == 6


@pytest.mark.parametrize("given", SIX, ids=lambda given: f"{given.name} in {given.file}")
def test_a_given_package_is_asked_for_pinned_and_used(given: Given) -> None:
    """In its group, in constraints.txt, and where the course is made with it."""
    asked = rf'^    "{given.name}(?![\w-])[^"]*"'
    assert re.search(asked, group_of(given.group), re.MULTILINE)
    pins = (root() / "constraints.txt").read_text("utf-8")
    assert re.search(rf"^{given.name}==", pins, re.MULTILINE)
    text = (root() / given.file).read_text("utf-8")
    assert re.search(given.use, text, re.MULTILINE), f"{given.file} no longer uses {given.name}"


@pytest.mark.parametrize("page", ["README.md", "CONTRIBUTING.md"])
def test_the_pages_say_how_the_lessons_are_run(page: str) -> None:
    """One command for all of them."""
    assert "./roslings test days --nbval-lax" in (root() / page).read_text("utf-8")
