"""The window's own parts in a real browser: the desk, what is kept, and who may come in."""

from __future__ import annotations

import json
import re
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import httpx
import pytest
from jupyterlab import serving
from terminals import until
from tiny_course import DAY, with_cell, write_course
from websockets.exceptions import InvalidStatus
from websockets.sync.client import connect
from window import Window, day_window

from lessons_as_tests import surroundings
from roslings_learn.jupyter.copies import Copies
from roslings_learn.jupyter.server import (
    JupyterOptions,
    command,
    environment,
    workspaces,
    write_kernel,
)
from roslings_learn.jupyter.window.layout import LAYOUT, ROVER, lay_out
from roslings_learn.jupyter.window.layout import day_window as planned
from roslings_learn.lessons import read_lessons
from skips import needs

pytestmark = [
    pytest.mark.slow,
    needs("Chromium", "environment made by ./roslings"),
]
LAMP = """from roslings_learn.notebook import desk, session

ros = session().__enter__()
lamp = ros.node("lamp")
print(ros.names())
desk("graph")"""
LAUNCHER = "Launcher"
NO_ROVER = "No node publishes /odom"
BELOW = "/user/ann/"
SOCKET = "roslings/desk/here/_nicegui_ws/socket.io/?EIO=4&transport=websocket"


def run_first_cell(window: Window) -> None:
    """Click into it, and press the keys."""
    window.page.locator(".jp-Notebook .jp-CodeCell").first.click()
    window.front = ""
    window.page.keyboard.press("Control+Enter")


def test_a_notebook_its_desk_and_the_terminals_are_in_one_domain(
    browser: Any, tmp_path: Path
) -> None:
    """A node of a cell is seen by the desk below the cell, by the tab Rover, and in a terminal."""
    write_course(tmp_path / "course", with_cell("first", text=LAMP))
    with day_window(browser, 1, tmp_path, ROSLINGS_COURSE=str(tmp_path / "course")) as window:
        window.has_tabs("lesson.ipynb", "Rover", "Terminal 1")
        window.reads("Rover", NO_ROVER)
        run_first_cell(window)
        below = window.page.frame_locator(".jp-OutputArea-output iframe")
        body = below.locator("body")
        until(lambda: "/lamp" in body.inner_text(), body.inner_text, window.rest)
        window.inside("Rover").get_by_role("link", name="Graph").click()
        window.reads("Rover", "/lamp")
        terminal = window.terminal(1)
        terminal.type("ros2 node list")
        terminal.shows(r"/lamp\r?\n")


def test_a_tab_that_was_closed_comes_back_by_closing_all(browser: Any, tmp_path: Path) -> None:
    """The page is kept as the student leaves it; where nothing is left, it is laid out anew."""
    write_course(tmp_path / "course")
    variables = {"ROSLINGS_COURSE": str(tmp_path / "course")}
    with day_window(browser, 1, tmp_path, **variables) as window:
        window.has_tabs("Rover", "Terminal 1")
        close(window, "Rover")
        kept(tmp_path, lambda tabs: tabs and ROVER not in tabs, window)
    with day_window(browser, 1, tmp_path, **variables) as window:
        window.has_tabs("lesson.ipynb", "Terminal 1")
        assert "Rover" not in window.tabs()
        until(lambda: closed_one(window), lambda: f"left: {window.tabs()}", window.rest)
        kept(tmp_path, lambda tabs: not tabs, window)
    with day_window(browser, 1, tmp_path, **variables) as window:
        window.has_tabs("lesson.ipynb", "Rover", "Terminal 1")


def closed_one(window: Window) -> bool:
    """Close the first tab, if there is one; whether none is left but what opens by itself then."""
    if (discard := window.page.get_by_role("button", name="Discard")).is_visible():
        discard.click()  # a lesson that is not saved asks
    elif left := [name for name in window.tabs() if name != LAUNCHER]:
        close(window, left[0])
    else:
        return True
    return False


def close(window: Window, name: str) -> None:
    """By the sign on its tab."""
    window.comes_to_front(name)
    tab = window.page.locator("#jp-main-dock-panel").get_by_role("tab", name=name, exact=True)
    tab.locator(".lm-TabBar-tabCloseIcon").click()
    window.front = ""


def kept(home: Path, is_so: Callable[[list[str]], Any], window: Window) -> None:
    """Wait until JupyterLab has kept tabs of which this holds."""

    def holds() -> Any:
        return (tabs := kept_tabs(home)) is not None and is_so(tabs)

    until(holds, lambda: str(kept_tabs(home)), window.rest)


def kept_tabs(home: Path) -> list[str] | None:
    """The tabs that open at the next start; None while JupyterLab writes them."""
    (file,) = workspaces(home / "roslings_ws").iterdir()
    try:
        layout = json.loads(file.read_text("utf-8"))["data"][LAYOUT]
    except json.JSONDecodeError:
        return None
    return list(widgets(layout["main"]["dock"] or {}))


def widgets(area: dict[str, Any]) -> Iterator[str]:
    """Those of an area, and of the areas in it."""
    yield from area.get("widgets", ())
    for each in area.get("children", ()):
        yield from widgets(each)


# --- behind a path, and who may come in --------------------------------------------------------


@dataclass(frozen=True)
class Served:
    """A server below a path, as JupyterHub's are."""

    address: str

    @property
    def base(self) -> str:
        """With the path, and a slash."""
        return re.match(rf"http://[^/]+{BELOW}", self.address)[0]  # type: ignore[index]

    def client(self) -> httpx.Client:
        """A browser that came in by the address: a page for strangers has no such cookie."""
        found = httpx.Client(follow_redirects=True, trust_env=False, timeout=120)
        came = found.get(self.address)
        assert came.status_code == 200
        assert any(name.startswith("username-") for name in found.cookies), came.text[:2000]
        return found

    def knocked(self, origin: str, cookies: str) -> int:
        """What the desk's websocket is answered; 101 lets it in."""
        address = self.base.replace("http", "ws", 1) + SOCKET
        try:
            with connect(
                address,
                additional_headers={"Cookie": cookies},
                origin=origin,  # type: ignore[arg-type]
                proxy=None,
            ):
                return 101
        except InvalidStatus as refused:
            return int(refused.response.status_code)


@pytest.fixture
def below_a_path(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Served]:
    """The window of the tiny course, in a Codespace of this name."""
    write_course(tmp_path / "course")
    lessons = read_lessons(tmp_path / "course")
    variables = surroundings(tmp_path, tmp_path / "course")
    monkeypatch.setenv("CODESPACE_NAME", "odd")
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.setenv("ROSLINGS_COURSE", str(tmp_path / "course"))
    copies = Copies(tmp_path / "course", tmp_path / "ws", lessons.glossary)
    copies.copy_all(lessons.days)
    lay_out(planned(lessons.days[0], copies), workspaces(copies.workspace))
    share = write_kernel(Path(sys.prefix), copies.workspace)
    words = command(JupyterOptions(copies, DAY, browser=False), share)
    seen = {**environment(share), **variables, "HOME": str(tmp_path)}
    (tmp_path / ".bashrc").write_text("PS1='ready> '\n")
    with serving([*words, f"--ServerApp.base_url={BELOW}"], seen, tmp_path) as address:
        yield Served(address)


def test_behind_a_path_all_of_it_is_there(browser: Any, below_a_path: Served) -> None:
    """Terminal and desk, as behind JupyterHub; the browser asks no other host and no other port."""
    window = Window(browser, "about:blank")
    asked: list[str] = []
    window.page.on("request", lambda request: asked.append(request.url))
    window.page.goto(below_a_path.address)
    window.is_ready()
    window.has_tabs("lesson.ipynb", "Rover", "Terminal 1")
    window.reads("Rover", NO_ROVER)
    window.terminal(1)
    strange = {url for url in asked if not url.startswith((below_a_path.base, "data:", "blob:"))}
    assert not strange
    window.page.close()


def test_the_desk_is_behind_the_login(below_a_path: Served) -> None:
    """Nobody sees it, or moves a robot by it, who could not open the notebook."""
    page = f"{below_a_path.base}roslings/desk/here/rover"
    stranger = httpx.get(page, trust_env=False)
    assert stranger.status_code in (302, 403) and "desk" not in stranger.text
    assert below_a_path.knocked(below_a_path.base.rstrip("/"), "") == 403
    inside = below_a_path.client()
    assert "roslings desk" in inside.get(page).text
    assert "_nicegui" in inside.get(page).text and "roslings-desk-" not in str(inside.cookies)


def test_a_foreign_page_is_refused(below_a_path: Served) -> None:
    """By its Origin, though its browser has the cookie; that of the Codespace is not foreign."""
    cookies = "; ".join(f"{name}={value}" for name, value in below_a_path.client().cookies.items())
    own = re.match("http://[^/]+", below_a_path.base)[0]  # type: ignore[index]
    assert below_a_path.knocked(own, cookies) == 101
    assert below_a_path.knocked("https://odd-8888.app.github.dev", cookies) == 101
    for origin in ("https://evil.example", "https://evil-8888.app.github.dev", "null"):
        assert below_a_path.knocked(origin, cookies) == 403, origin


def test_what_is_not_there_says_so(below_a_path: Served) -> None:
    """No page of a check, no such day, no such domain."""
    inside = below_a_path.client()
    none = inside.get(f"{below_a_path.base}roslings/check")
    assert none.status_code == 404 and "./roslings check LAB" in none.text
    news = inside.get(f"{below_a_path.base}roslings/news/{DAY}")
    assert news.json() == {"file": "", "checked": ""}
    wrong = inside.get(f"{below_a_path.base}roslings/desk/999/rover")
    assert wrong.status_code == 502 and "must be a whole number from 0 to 101" in wrong.text
    assert "Traceback" not in wrong.text
