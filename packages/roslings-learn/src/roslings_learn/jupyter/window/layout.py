"""A day as a workspace of JupyterLab: what stands where when the page opens for the first time.

From then on it is the student's: JupyterLab keeps how they have arranged it, and opens it so again.
One in which nothing is open any more is laid out anew.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from jupyterlab_server.workspaces_handler import WorkspacesManager

from roslings.workspace.progress import LabStatus, status
from roslings_learn.jupyter.copies import LABS, LESSON, TASK, Copies
from roslings_learn.lessons import Day

TERMINAL = re.compile(r"\bTerminals? ((?:\d(?:, | and )?)+)")
"""As lessons and tasks name them: `Terminal 2`, `Terminals 1, 2 and 3`."""
OPEN_THE_FILE = re.compile(r"Open\s+the\s+file\s+`~/([^`]+)`")
"""What a page says where its day has no lab."""
TODO = "TODO"
LAYOUT = "layout-restorer:data"
VIEWS = "roslings-view"
"""The tabs of our own, in `labextension`."""
ROVER = f"{VIEWS}:rover"
OPENED = "roslings-window:file"
"""Which file the page has opened by itself."""
HALF = (0.5, 0.5)
Area = dict[str, Any]


@dataclass(frozen=True)
class DayWindow:
    """What the window of a day holds. Paths are JupyterLab's: with slashes, below its root."""

    name: str
    """Of the workspace: the day's id."""
    pages: tuple[str, ...]
    """The lesson, then what else is read."""
    terminals: int
    file: str
    """What is edited; empty where it is not there yet."""


def day_window(day: Day, copies: Copies) -> DayWindow:
    """What this day's window is to hold. Raises CannotRead of the workspace."""
    labs = _labs_of(day.id, copies.workspace)
    tasks = [copies.folder / LABS / each.lab.name / TASK for each in labs]
    pages = [copies.folder / day.id / LESSON, *(tasks or _beside(day, copies))]
    file = file_to_edit(day.id, copies)
    return DayWindow(
        day.id,
        tuple(copies.path_of(page) for page in pages if page.is_file()),
        terminals_named(_texts(day, copies, labs)),
        copies.path_of(file) if file else "",
    )


def terminals_named(texts: Iterable[str]) -> int:
    """The largest number of a terminal that they name; one at least."""
    numbers = [
        int(each)
        for text in texts
        for found in TERMINAL.findall(text)
        for each in re.findall(r"\d", found)
    ]
    return max(numbers, default=1)


def file_to_edit(day_id: str, copies: Copies) -> Path | None:
    """The file of the student's package with most of the starter's TODOs; None before it is there.

    On a day without a lab, the file that a page of the day says to open.
    """
    labs = _labs_of(day_id, copies.workspace)
    if not labs:
        return _named_by_a_page(copies.course / "days" / day_id)
    at = next((each for each in labs if not each.progress.done), labs[-1])
    if at.package is None:
        return None
    return next(filter(Path.is_file, (at.package / each for each in _most_to_do(at))), None)


def _labs_of(day_id: str, workspace: Path) -> list[LabStatus]:
    return [each for each in status(workspace) if each.lab.outline.day == day_id]


def _most_to_do(at: LabStatus) -> list[Path]:
    """The starter's files in Python, the one with most TODOs first, below the package."""
    files = sorted(at.lab.starter.rglob("*.py"))
    files.sort(key=lambda file: -file.read_text("utf-8", "replace").count(TODO))
    return [file.relative_to(at.lab.starter) for file in files[:1]]


def _named_by_a_page(day: Path) -> Path | None:
    texts = (page.read_text("utf-8") for page in sorted(day.glob("*.md")))
    named = (found[1] for text in texts if (found := OPEN_THE_FILE.search(text)))
    return next(filter(Path.is_file, (Path.home() / each for each in named)), None)


def _beside(day: Day, copies: Copies) -> list[Path]:
    own = copies.folder / day.id
    return [own / page.name for page in sorted(copies.lesson_of(day).parent.glob("*.md"))]


def _texts(day: Day, copies: Copies, labs: Sequence[LabStatus]) -> Iterable[str]:
    lesson = copies.lesson_of(day)
    files = [lesson, *lesson.parent.glob("*.md"), *(each.lab.task for each in labs)]
    return (file.read_text("utf-8") for file in files if file.is_file())


# --- as JupyterLab keeps it --------------------------------------------------------------------


def lay_out(window: DayWindow, folder: Path) -> None:
    """Write the workspace into JupyterLab's `folder` of them, unless the student has one.

    Raises OSError.
    """
    manager = WorkspacesManager(str(folder))
    if _shows_something(manager, window.name):
        return
    content = {"data": workspace(window), "metadata": {"id": window.name}}
    manager.save(window.name, json.dumps(content))


def _shows_something(manager: WorkspacesManager, name: str) -> bool:
    """A workspace that is damaged shows nothing either."""
    try:
        kept: Area = manager.load(name)
        return _has_tabs(kept["data"][LAYOUT]["main"]["dock"])
    except (KeyError, TypeError, ValueError, AttributeError):
        return False


def _has_tabs(area: Area | None) -> bool:
    if not area:
        return False
    return bool(area.get("widgets")) or any(map(_has_tabs, area.get("children", ())))


def workspace(window: DayWindow) -> dict[str, Any]:
    """What JupyterLab restores: each tab by its name, and where they stand."""
    restored: dict[str, Any] = dict([*map(_page, window.pages), *_terminals(window)])
    restored[ROVER] = _data(name="rover")
    reading = [_page(each)[0] for each in window.pages]
    doing = [ROVER]
    if window.file:
        restored[editor := f"editor:{window.file}"] = _data(path=window.file, factory="Editor")
        restored[OPENED] = window.file
        doing.insert(0, editor)
    typing = [name for name, _ in _terminals(window)]
    right = _split("vertical", _tabs(doing), _tabs(typing))
    return {
        LAYOUT: {
            "main": {"dock": _split("horizontal", _tabs(reading), right), "current": reading[0]},
            "left": {"collapsed": True, "visible": True},
            "right": {"collapsed": True, "visible": True},
            "relativeSizes": [0, 1, 0],
        },
        **restored,
    }


def _page(path: str) -> tuple[str, Area]:
    if path.endswith(".ipynb"):
        return f"notebook:{path}", _data(path=path, factory="Notebook")
    return f"markdownviewer-widget:{path}", _data(path=path, factory="Markdown Preview")


def _terminals(window: DayWindow) -> list[tuple[str, Area]]:
    names = [str(number) for number in range(1, window.terminals + 1)]
    return [(f"terminal:{name}", _data(name=name)) for name in names]


def _data(**words: str) -> Area:
    return {"data": words}


def _tabs(names: Sequence[str]) -> Area:
    return {"type": "tab-area", "currentIndex": 0, "widgets": list(names)}


def _split(orientation: str, *areas: Area) -> Area:
    return {
        "type": "split-area",
        "orientation": orientation,
        "sizes": list(HALF),
        "children": list(areas),
    }
