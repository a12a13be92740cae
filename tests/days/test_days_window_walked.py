"""Days in one window of a real browser: the first page, day 3 and day 5, and no `source` typed."""

from __future__ import annotations

import re
from collections.abc import Callable
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest
from student import save_as
from terminals import Terminal, until
from test_first_page import Reader, changes, follow_the_page
from window import Window, WindowStudent, day_window, without_source

from roslings.course import Lab, lab
from skips import needs

pytestmark = [
    pytest.mark.slow,
    needs("Chromium", "environment made by ./roslings"),
]
MOVED = re.compile(r"x (-?\d+\.\d\d) m")


@dataclass
class WindowReader(Reader):
    """Who follows the first page in the window: the file is edited in its editor."""

    window: Window | None = None

    def __post_init__(self) -> None:
        self.blocks = [each for each in map(without_source, self.blocks) if each.lines]

    def edits_the_file(self) -> None:
        """Make the page's next change."""
        self.made.append(self.edits.pop(0))
        self._types(self.made[-1].made_in)

    def takes_the_edit_back(self) -> None:
        """Put the letter back."""
        self._types(self.made.pop().undone.made_in)

    def _types(self, changed: Callable[[str], str]) -> None:
        assert self.window
        file = self.home / changes()[0].file
        self.window.has_tabs(file.name)
        self.window.writes(file.name, changed(file.read_text("utf-8")), file)


def on_the_map(window: Window) -> float:
    """The x that the tab Rover shows, in metres."""
    found = MOVED.search(window.inside("Rover").locator("p.value").inner_text())
    return float(found[1]) if found else 0.0


def test_the_first_page_in_one_window(browser: Any, tmp_path: Path) -> None:
    """Three terminals, an editor that opens by itself, and the rover on the map beside them."""
    with day_window(browser, 1, tmp_path) as window:
        window.has_tabs("lesson.ipynb", "first-15-minutes.md", "Rover", "Terminal 1", "Terminal 3")
        reader = WindowReader(tmp_path, window.terminal, window=window)
        follow_the_page(reader)
        assert on_the_map(window) > 1.0
        window.reads("Check", "100")


def write(student: WindowStudent, of: Lab) -> None:
    """What somebody writes who does it right: one file in the editor, the others beside it."""
    own = student.home / "roslings_ws" / "src" / of.outline.package
    (edited,) = [name for name in student.window.tabs() if name.endswith(".py")]
    (file,) = own.rglob(edited)
    (right,) = of.solution.rglob(edited)
    student.window.writes(edited, right.read_text("utf-8"), file)
    save_as(of.solution, own)


def follower(window: Window, home: Path, of: Lab) -> WindowStudent:
    """Who follows the lab's task."""
    return WindowStudent(home, 0, ExitStack(), of.task.read_text("utf-8"), window=window)


def is_checked(student: WindowStudent, of: Lab) -> None:
    """The last step of a task, in terminal 1, and its page beside."""
    terminal = student.terminal(1)
    terminal.type("cd -")
    terminal.is_free()
    terminal.type(f"./roslings check {of.name}")
    terminal.tells("100 of 100")
    terminal.is_free()
    student.window.reads("Check", "100")


def test_day_three_in_one_window(browser: Any, tmp_path: Path) -> None:
    """A talker and a listener: built in one terminal, and found at once in the two others."""
    of = lab("topics")
    with day_window(browser, 3, tmp_path) as window:
        window.has_tabs(
            "lesson.ipynb", "task.md", "Rover", "Terminal 1", "Terminal 2", "Terminal 3"
        )
        student = follower(window, tmp_path, of)
        for number in (1, 2, 3):
            student.terminal(number)  # all stand at their prompts before anything is built
        student.types()[0].is_free()
        window.has_tabs("talker.py")
        write(student, of)
        builder, _ = student.types()
        builder.shows("1 package finished")
        talker, _ = student.types()
        talker.shows("Publishing: 'Hello robotics 1'")
        listener, _ = student.types()
        listener.shows("I heard: 'Hello robotics")
        window.comes_to_front("Rover")
        window.inside("Rover").get_by_role("link", name="Graph").click()
        window.reads("Rover", "/listener")
        student.ends(2)
        student.ends(3)
        is_checked(student, of)
        is_checked_by_a_cell(window, of)


def is_checked_by_a_cell(window: Window, of: Lab) -> None:
    """The lesson's own cell does it, too: another page comes in the place of the last one."""
    frame = window.page.locator("iframe[title='Check']")
    before = frame.get_attribute("src")
    window.comes_to_front("lesson.ipynb")
    for text in ("from roslings_learn.notebook import check", f'check("{of.name}")'):
        window.page.locator(".jp-CodeCell", has_text=text).first.click()
        window.front = ""
        window.page.keyboard.press("Control+Enter")
    until(lambda: frame.get_attribute("src") != before, lambda: str(before), window.rest)
    window.reads("Check", "100")


def finds(terminal: Terminal, command: str, name: str) -> None:
    """Ask again until it is there, as somebody does who was quicker than a server."""

    def is_there() -> bool:
        terminal.type(command)
        terminal.is_free()
        return name in terminal.heard().partition("\n")[2]

    until(is_there, lambda: f"{name} is never there", terminal.rest)


def test_day_five_in_one_window(browser: Any, tmp_path: Path) -> None:
    """Rover, server and goals in three terminals; the map beside them shows where it drives."""
    of = lab("actions")
    with day_window(browser, 5, tmp_path) as window:
        window.has_tabs("lesson.ipynb", "task.md", "Rover", *(f"Terminal {n}" for n in range(1, 5)))
        student = follower(window, tmp_path, of)
        for number in (1, 2, 3, 4):
            student.terminal(number)
        student.types()[0].is_free()
        window.has_tabs("drive_server.py")
        write(student, of)
        shown, _ = student.types()
        shown.shows("tolerance")
        student.types()[0].shows("1 package finished")
        student.types()
        window.reads("Rover", "x 0.00 m, y 0.00 m")
        student.types()
        finds(student.terminal(4), "ros2 action list", "/drive_to")
        goal, said = student.types()
        assert "/drive_to [rover_interfaces/action/DriveTo]" in said
        goal.shows("distance")
        until(lambda: on_the_map(window) > 0.2, lambda: "it does not drive", window.rest)
        goal.press_ctrl_c()
        goal.is_free()
        refused, said = student.types()
        refused.shows("rejected")
        assert "rejected" in said
        refused.is_free()
        client, _ = student.types()
        client.shows(r"The rover is there after \d")
        student.ends(3)
        alone, said = student.types()
        assert "No server for /drive_to" in said
        alone.shows(r"\n\r*1\r?\n")
        student.ends(2)
        is_checked(student, of)
