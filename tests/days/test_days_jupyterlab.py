"""Once in real JupyterLab: open, run all, see the picture, answer the quiz."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from jupyterlab import Lab, served
from tiny_course import CELLS, DAY, Cell, with_cell, write_course

from lesson_runs import lessons, names
from lessons_as_tests import surroundings
from roslings.course import root
from roslings_learn.lessons.rules import Lesson
from skips import needs

pytestmark = [
    pytest.mark.slow,
    needs("Chromium"),
]
WRITTEN = list(lessons())
LIVE = """from roslings_learn.notebook import quiz, session, show_graph
from rclpy.node import Node
from std_msgs.msg import String


class Lamp(Node):
    def __init__(self):
        super().__init__("lamp")
        self.create_publisher(String, "light", 10)


with session() as ros:
    ros.start(Lamp)
    show_graph()"""


def tiny_and_live() -> tuple[Cell, ...]:
    """The tiny lesson with a real node in its first cell."""
    return with_cell("first", text=LIVE)


def test_a_student_opens_a_day_runs_all_and_answers(browser: Any, tmp_path: Path) -> None:
    """Pictures have their words, asserts are a line, the quiz explains, the lesson stays."""
    lesson = write_course(tmp_path / "course", tiny_and_live())
    before = lesson.read_bytes()
    with served("1", surroundings(tmp_path, tmp_path / "course"), tmp_path) as address:
        lab = Lab(browser, address)
        lab.wait_for_kernel()
        assert lab.page.locator(".jp-MarkdownOutput img[src*='lamp']").count() == 1
        lab.run_all()
        assert "/lamp publishes on /light" in str(
            lab.page.locator(".jp-OutputArea-output img").first.get_attribute("alt")
        )
        assert "Not yet: Still 2 Hz." in lab.outputs()
        own = tmp_path / "ws" / "notebooks" / DAY / "lesson.ipynb"
        assert lab.failed(own) == [cell.id for cell in CELLS if "raises-exception" in cell.tags]
        lab.page.get_by_label("It shines.").check()
        lab.page.get_by_role("button", name="Check answer 1").click()
        lab.page.get_by_text("Yes, that is its work.").wait_for()
        assert lab.page.locator("text=Would you like to").count() == 0  # no news
        lab.page.close()
    assert lesson.read_bytes() == before


@pytest.mark.parametrize("lesson", WRITTEN, ids=names(WRITTEN))
def test_each_lesson_runs_in_jupyterlab(browser: Any, lesson: Lesson, tmp_path: Path) -> None:
    """Errors only where a tag announces them."""
    with served(str(lesson.day.number), surroundings(tmp_path, root()), tmp_path) as address:
        lab = Lab(browser, address)
        lab.wait_for_kernel()
        lab.run_all()
        own = tmp_path / "ws" / "notebooks" / lesson.day.id / "lesson.ipynb"
        tagged = [cell.id for cell in lesson.cells if "raises-exception" in cell.tags]
        assert lab.failed(own) == tagged
        assert lab.alts() and all(len(alt) > 10 for alt in lab.alts())
        lab.page.close()
