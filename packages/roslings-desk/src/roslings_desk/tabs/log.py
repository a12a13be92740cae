"""Log: what nodes say on /rosout, the newest first, by level, node and text."""

from __future__ import annotations

from datetime import datetime
from typing import Any

from roslings_desk.controls import PageText, SelectField, TextField, button, part
from roslings_desk.tab import OpenTab

ROSOUT = "/rosout"
LEVELS = {"DEBUG": 10, "INFO": 20, "WARN": 30, "ERROR": 40, "FATAL": 50}
"""As rcl_interfaces/msg/Log counts them."""
KEPT, MOST_ROWS, LONGEST_TEXT = 2_000, 200, 500
COLUMNS = ("Time", "Level", "Node", "Text")


class LogTab:
    """Lines of all nodes, since this page was opened; of some nodes also those before."""

    title, every_s = "Log", 0.25

    def __init__(self) -> None:
        self._lines: dict[tuple[Any, ...], Any] = {}
        self._heard_to = 0
        self._missed = 0
        self._paused = False
        self._drawn: object = None

    def show(self, open_tab: OpenTab) -> None:
        """Filters, and the table."""
        self._hub = open_tab.hub
        self._heard = open_tab.hear(ROSOUT, "rcl_interfaces/msg/Log")
        with part("div", "row"):
            self._level = SelectField("Least level", LEVELS, "INFO")
            self._node = TextField("Node", type="search")
            self._text = TextField("Text", type="search")
            self._pause = button("Pause", self._turn, aria_pressed="false")
        self._count = PageText("p", "", "count", role="status")
        frame = part("div", "scroll", role="region", tabindex=0, aria_label="Lines of the log")
        with frame, part("table"):
            with part("thead"), part("tr"):
                for each in COLUMNS:
                    PageText("th", each, scope="col")
            self._body = part("tbody")

    def _turn(self) -> None:
        self._paused = not self._paused
        self._pause.props["aria-pressed"] = str(self._paused).lower()
        self._pause.update()

    def refresh(self) -> None:
        """Take in what has come, and draw it where the table is another one then."""
        self._hub.topics()  # a first node may have come, which has kept its lines for us
        for message in self._heard.after(self._heard_to):
            self._missed += message.number - self._heard_to - 1
            self._heard_to = message.number
            self._keep(self._heard.read(message))
        asked = (self._heard_to, self._level.value, self._node.value, self._text.value)
        if not self._paused and asked != self._drawn:
            self._drawn = asked
            self._draw([line for line in reversed(self._lines.values()) if self._is_wanted(line)])

    def _keep(self, line: Any) -> None:
        """What a node kept for late listeners may come twice."""
        self._lines[line.stamp.sec, line.stamp.nanosec, line.name, line.msg] = line
        if len(self._lines) > KEPT:
            del self._lines[next(iter(self._lines))]

    def _is_wanted(self, line: Any) -> bool:
        return (
            line.level >= LEVELS.get(self._level.value, 0)
            and self._node.value.lower() in line.name.lower()
            and self._text.value.lower() in line.msg.lower()
        )

    def _draw(self, wanted: list[Any]) -> None:
        missed = f"; {self._missed} came too fast and are not here" if self._missed else ""
        self._count.say(f"{len(wanted)} of {len(self._lines)} lines{missed}")
        self._body.clear()
        with self._body:
            for line in wanted[:MOST_ROWS]:
                with part("tr"):
                    for words in _cells(line):
                        PageText("td", words)


def _cells(line: Any) -> tuple[str, ...]:
    at = datetime.fromtimestamp(line.stamp.sec + line.stamp.nanosec / 1e9)
    level = next((word for word, number in LEVELS.items() if number == line.level), line.level)
    text = line.msg if len(line.msg) <= LONGEST_TEXT else f"{line.msg[:LONGEST_TEXT]}..."
    return (f"{at:%H:%M:%S.%f}"[:-3], str(level), line.name, text)
