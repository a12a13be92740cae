"""The window of a day as a student has it: `./roslings lab DAY` in a real browser.

Terminals are typed into by the browser's keyboard, and read by what their websockets bring. All of
it is a `Terminal` as every other page of a day is followed by.
"""

from __future__ import annotations

import json
import re
from collections import defaultdict
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

from jupyterlab import served
from student import Commands, Student
from terminals import LOOK_EVERY_S, PATIENCE_S, Terminal, surroundings, until

from lessons_as_tests import free_domain
from roslings.course import root
from skips import imported

SOCKET = re.compile(r"/terminals/websocket/(\w+)")
SIZE = {"width": 1920, "height": 1080}
NO_WEBGL = """const asked = HTMLCanvasElement.prototype.getContext;
HTMLCanvasElement.prototype.getContext = function (kind, ...words) {
  return kind.startsWith("webgl") ? null : asked.call(this, kind, ...words);
};"""
"""Without a graphics card that takes half a processor; terminals can be drawn without."""
SOURCE = re.compile(r"(source|\.) ")
CLICKS_WITHIN_MS = 2_000
"""Then somebody looks again; what never comes is waited for as long as all else."""


class Window:
    """One page of the browser, and what its terminals have said."""

    def __init__(self, browser: Any, address: str) -> None:
        self.said: defaultdict[str, bytearray] = defaultdict(bytearray)
        self.front = ""
        """The tab that was clicked last: it has the keyboard."""
        self.page = browser.new_page(viewport=SIZE)
        self.page.set_default_timeout(PATIENCE_S * 1000)
        self.page.add_init_script(NO_WEBGL)
        self.page.on("websocket", self._listen)
        self.page.goto(address)

    def _listen(self, socket: Any) -> None:
        if found := SOCKET.search(socket.url):
            socket.on("framereceived", lambda frame: self._hear(found[1], frame))

    def _hear(self, name: str, frame: Any) -> None:
        kind, *content = json.loads(frame)
        if kind == "stdout":
            self.said[name] += content[0].encode()

    def rest(self) -> None:
        """Let the browser go on."""
        self.page.wait_for_timeout(LOOK_EVERY_S * 1000)

    def is_ready(self) -> None:
        """Wait until the lesson is open, and has a kernel: it takes the keyboard when it comes."""
        self.page.locator("text=| Idle").first.wait_for()

    def terminal(self, number: int) -> WindowTerminal:
        """The terminal of this number; its tab comes to the front."""
        found = WindowTerminal(self, str(number))
        found.is_free()
        return found

    def tabs(self) -> list[str]:
        """The names of all tabs of the main area."""
        labels = self.page.locator("#jp-main-dock-panel .lm-TabBar-tabLabel").all_text_contents()
        return [str(each) for each in labels]

    def has_tabs(self, *names: str) -> None:
        """Wait until all of these are there."""
        until(lambda: set(names) <= set(self.tabs()), lambda: f"{names}: {self.tabs()}", self.rest)

    def inside(self, title: str) -> Any:
        """What stands in a tab of ours."""
        return self.page.frame_locator(f"iframe[title='{title}']")

    def reads(self, title: str, words: str) -> None:
        """Wait until these words stand in a tab of ours, which comes to the front."""
        self.comes_to_front(title)
        body = self.inside(title).locator("body")
        until(lambda: words in body.inner_text(), body.inner_text, self.rest)

    def comes_to_front(self, name: str) -> None:
        """Click on a tab, where it is not the last one that was clicked."""
        if name != self.front:
            main = self.page.locator("#jp-main-dock-panel")
            main.get_by_role("tab", name=name, exact=True).click()
            self.front = name

    def writes(self, name: str, text: str, file: Path) -> None:
        """Put this text into the editor of the file, and save it."""
        self.comes_to_front(name)
        self._clicks_into_the_editor(name)
        self.page.keyboard.press("Control+a")
        self.page.keyboard.insert_text(text)
        self.page.keyboard.press("Control+s")
        until(lambda: file.read_text("utf-8") == text, lambda: file.read_text("utf-8"), self.rest)

    def _clicks_into_the_editor(self, name: str) -> None:
        """The page of a check that has just ended may come before it: then its tab once more."""
        editor = self.page.locator(".jp-FileEditor:visible .cm-content")

        def clicked() -> bool:
            try:
                editor.click(timeout=CLICKS_WITHIN_MS)
            except imported("playwright.sync_api").TimeoutError:
                self.front = ""
                self.comes_to_front(name)
                return False
            return True

        until(clicked, lambda: f"no editor of {name}: {self.tabs()}", self.rest)


class WindowTerminal(Terminal):
    """A terminal of the page."""

    def __init__(self, window: Window, name: str) -> None:
        self._window, self._name = window, name
        self._mark, self._typed = 0, ""

    @property
    def _said(self) -> bytearray:  # type: ignore[override] # the page hears it
        return self._window.said[self._name]

    def type(self, line: str) -> None:
        """As a person does: click on the tab, type, Enter."""
        self._mark, self._typed = len(self._said), line
        self.press(f"{line}\n")

    def press(self, keys: str) -> None:
        """Keys, as the browser's keyboard has them."""
        self._window.comes_to_front(f"Terminal {self._name}")
        keyboard = self._window.page.keyboard
        for key in re.findall(r"\x1b\[[A-D]|\n|[^\x1b\n]+", keys):
            if key in KEYS:
                keyboard.press(KEYS[key])
            else:
                keyboard.type(key)

    def press_ctrl_c(self) -> None:
        """Interrupt what runs in the foreground."""
        self._window.comes_to_front(f"Terminal {self._name}")
        self._window.page.keyboard.press("Control+c")

    def rest(self) -> None:
        """The browser goes on."""
        self._window.rest()


KEYS = {
    "\x1b[A": "ArrowUp",
    "\x1b[B": "ArrowDown",
    "\x1b[C": "ArrowRight",
    "\x1b[D": "ArrowLeft",
    "\n": "Enter",
}


@contextmanager
def day_window(browser: Any, day: int, home: Path, **variables: str) -> Iterator[Window]:
    """The day in the browser, for a student with this home."""
    seen = {**surroundings(home, free_domain()), **variables}
    (home / ".bashrc").write_text(f"PS1='{seen['PS1']}'\n")  # Debian's own would overwrite it
    with served(str(day), seen, root(), [root() / "roslings"]) as address:
        window = Window(browser, address)
        try:
            window.is_ready()
            yield window
        finally:
            window.page.close()


def without_source(block: Commands) -> Commands:
    """The block, and nothing that only makes a terminal ready."""
    return replace(block, lines=tuple(line for line in block.lines if not SOURCE.match(line)))


@dataclass
class WindowStudent(Student):
    """Who follows a text in the window, and never types `source`."""

    window: Window = field(kw_only=True)

    def __post_init__(self) -> None:
        super().__post_init__()
        self.left = [each for each in map(without_source, self.left) if each.lines]

    def terminal(self, number: int) -> Terminal:
        """It is there already."""
        if number not in self.terminals:
            self.terminals[number] = self.window.terminal(number)
        return self.terminals[number]
