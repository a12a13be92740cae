"""What the window of a day holds, and what the server is told; nothing is started."""

from __future__ import annotations

import json
import re
import subprocess
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from tiny_course import DAY, write_course

from roslings.course import all_labs, root
from roslings_learn.jupyter import server
from roslings_learn.jupyter.copies import Copies
from roslings_learn.jupyter.server import LABEXTENSIONS, JupyterOptions, command
from roslings_learn.jupyter.window.layout import (
    DayWindow,
    day_window,
    lay_out,
    terminals_named,
    workspace,
)
from roslings_learn.lessons import Day, read_lessons
from roslings_learn.of_window import OF_WINDOW, wanted_or_next

NAMES = DayWindow("05-actions", ("ws/lesson.ipynb", "ws/task.md"), 2, "ws/server.py")


@pytest.fixture
def copies(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Copies:
    """Of the real course, in a home that is empty."""
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.delenv("ROSLINGS_WS", raising=False)
    return Copies(root(), tmp_path / "roslings_ws", read_lessons(root()).glossary)


def days() -> tuple[Day, ...]:
    """All of them."""
    return read_lessons(root()).days


def tabs_in(area: dict[str, Any]) -> list[str]:
    """The names of all tabs below."""
    inside = [name for child in area.get("children", ()) for name in tabs_in(child)]
    return [*area.get("widgets", ()), *inside]


def test_each_day_has_what_its_tasks_name(copies: Copies) -> None:
    """The lesson first, each task of the day, and as many terminals as are named."""
    copies.copy_all(days())
    of_days = {day.id: day_window(day, copies) for day in days()}
    assert {window.terminals for window in of_days.values()} <= {1, 2, 3, 4}
    assert (of_days["03-topics"].terminals, of_days["05-actions"].terminals) == (3, 4)
    for day in days():
        tasks = [each.name for each in all_labs() if each.outline.day == day.id]
        lesson, *others = of_days[day.id].pages
        assert lesson == f"roslings_ws/notebooks/{day.id}/lesson.ipynb"
        assert not tasks or [Path(each).parent.name for each in others] == tasks
        assert of_days[day.id].file == ""
    assert of_days["01-install"].pages[1].endswith("01-install/first-15-minutes.md")


def test_the_editor_opens_what_has_most_to_do(copies: Copies) -> None:
    """Of the student's own package; on day 1, the file that the page names."""
    starter = root() / "labs/actions/starter/drive_to"
    own = copies.workspace / "src" / "drive_to"
    own.parent.mkdir(parents=True)
    subprocess.run(["cp", "-r", starter, own], check=True)
    of_days = {day.id: day for day in days()}
    found = day_window(of_days["05-actions"], copies).file
    assert found == "roslings_ws/src/drive_to/drive_to/drive_server.py"
    program = copies.root / "first_program/beacon/beacon.py"
    program.parent.mkdir(parents=True)
    program.touch()
    assert day_window(of_days["01-install"], copies).file == "first_program/beacon/beacon.py"


@pytest.mark.parametrize(
    ("text", "count"),
    [
        ("nothing", 1),
        ("Terminal 2, in any folder:", 2),
        ("Terminals 1, 2 and 3, in the roslings folder:", 3),
        ("Terminals 1 to 4", 1),
        ("the terminal 9", 1),
    ],
)
def test_terminals_are_counted_as_they_are_named(text: str, count: int) -> None:
    """The largest number of all."""
    assert terminals_named([text]) == count


def test_what_a_student_has_arranged_stays(tmp_path: Path) -> None:
    """And what is empty, or damaged, is laid out anew."""
    lay_out(NAMES, tmp_path)
    (file,) = tmp_path.iterdir()
    kept = json.loads(file.read_text("utf-8"))
    dock = kept["data"]["layout-restorer:data"]["main"]["dock"]
    assert set(tabs_in(dock)) == {
        "notebook:ws/lesson.ipynb",
        "markdownviewer-widget:ws/task.md",
        "editor:ws/server.py",
        "roslings-view:rover",
        "terminal:1",
        "terminal:2",
    }
    assert set(tabs_in(dock)) <= set(kept["data"])
    dock["sizes"] = [0.9, 0.1]
    file.write_text(json.dumps(kept))
    lay_out(NAMES, tmp_path)
    assert json.loads(file.read_text("utf-8")) == kept
    dock["children"] = []
    for empty in (json.dumps(kept), '{"data": {}, "metadata": {"id": "x"}}', "[]", "{"):
        file.write_text(empty)
        lay_out(NAMES, tmp_path)
        assert json.loads(file.read_text("utf-8"))["data"] == workspace(NAMES)


def test_a_workspace_outside_of_the_home_is_shown_too(tmp_path: Path) -> None:
    """As in a container, where it is a volume: what both lie in is JupyterLab's root."""
    write_course(tmp_path / "course")
    lessons = read_lessons(tmp_path / "course")
    copies = Copies(tmp_path / "course", Path("/volume"), lessons.glossary)
    assert copies.root == Path("/")
    assert copies.path_of(copies.folder / DAY) == f"volume/notebooks/{DAY}"
    page = JupyterOptions(copies, DAY).page
    assert page == f"/lab/workspaces/{DAY}/tree/volume/notebooks/{DAY}/lesson.ipynb"


def test_a_browser_of_another_system_is_led_by_the_address(
    copies: Copies, monkeypatch: pytest.MonkeyPatch
) -> None:
    """On WSL and in a Codespace; its own page alone may speak to it from there."""
    for name in ("WSL_DISTRO_NAME", "CODESPACE_NAME"):
        monkeypatch.delenv(name, raising=False)
    by_address = "--ServerApp.use_redirect_file=False"
    assert by_address not in command(JupyterOptions(copies, None), Path("share"))
    monkeypatch.setenv("WSL_DISTRO_NAME", "Ubuntu")
    assert by_address in command(JupyterOptions(copies, None), Path("share"))
    monkeypatch.setenv("CODESPACE_NAME", "odd.name-1")
    words = command(JupyterOptions(copies, None), Path("share"))
    (pattern,) = [word for word in words if "allow_origin_pat" in word]
    pattern = pattern.partition("=")[2]
    assert re.fullmatch(pattern, "https://odd.name-1-8888.app.github.dev")
    for other in (
        "https://oddxname-1-8888.app.github.dev",
        "https://odd.name-1-8888.evil.dev",
        "http://odd.name-1-8888.app.github.dev",
    ):
        assert not re.fullmatch(pattern, other)


def test_without_bash_a_terminal_is_what_jupyter_takes(
    copies: Copies, monkeypatch: pytest.MonkeyPatch
) -> None:
    """And the page opens all the same."""
    monkeypatch.setattr(server.shutil, "which", lambda name: None)
    assert not [
        word for word in command(JupyterOptions(copies, None), Path("share")) if "terminado" in word
    ]


def test_the_page_has_its_part_of_the_window() -> None:
    """JupyterLab finds it by its package.json, and its script is there."""
    (folder,) = LABEXTENSIONS.iterdir()
    about = json.loads((folder / "package.json").read_text("utf-8"))
    assert about["name"] == folder.name
    assert (folder / about["jupyterlab"]["_build"]["load"]).is_file()


def test_one_notebook_of_a_window_is_in_its_domain(monkeypatch: pytest.MonkeyPatch) -> None:
    """The window holds it against other windows; a second notebook gets another one.

    Which domain is free, the machine says: other tests lease some beside.
    """
    free, window = wanted_or_next(97)
    with window:
        other, held = wanted_or_next(free)
        with held:
            assert other != free
        monkeypatch.setenv(OF_WINDOW, str(free))
        first, seat = wanted_or_next(free)
        with seat:
            second, held = wanted_or_next(free)
            with held:
                assert (first, second != free) == (free, True)
        again, seat = wanted_or_next(free)
        with seat:
            assert again == free


def test_the_hub_opens_the_same_window(copies: Copies) -> None:
    """JupyterHub's server of one user is told the same."""
    alone = command(JupyterOptions(copies, "05-actions"), Path("share"))
    by_hub = command(replace(JupyterOptions(copies, "05-actions"), hub=True), Path("share"))
    of_window = [word for word in alone if "window" in word or "workspaces" in word]
    assert len(of_window) >= 5
    assert {word.replace("LabApp.def", "ServerApp.def") for word in of_window} <= set(by_hub)
