"""Frames: the tree on /tf and /tf_static as it is now, who says each step, what does not fit."""

from __future__ import annotations

import os
import time
from collections.abc import Sequence
from functools import partial

from ros2_on_pip.interfaces import UnknownInterface, class_of
from roslings_desk.controls import Notice, PageText, StatusLine, button, part
from roslings_desk.frames_now import TF_MESSAGE, FrameRow, FramesLook, FramesNow
from roslings_desk.hub import SharedSubscription
from roslings_desk.tab import OpenTab
from roslings_rover.rover.frames import TF, TF_STATIC

COLUMNS = ("Frame", "Rate and age", "x, y, z in m", "Yaw in degrees", "Said by")
MOST_ROWS = 100
DEEPEST = 12
NOTHING = "No node says frames now: nobody publishes /tf or /tf_static. The rover does."
AWAITED = "Nothing has come yet."
OF_ROS = "The type of /tf is missing. Type once: sudo apt install ros-jazzy-tf2-msgs"
OF_COURSE = "The type of /tf is missing. Type once: ./roslings ready rover --tf"


class FramesTab:
    """Listens to /tf and /tf_static as long as somebody publishes there."""

    title, every_s = "Frames", 0.5

    def __init__(self) -> None:
        self._now = FramesNow()
        self._heard: dict[str, SharedSubscription] = {}
        self._read_to: dict[str, int] = {}
        self._rows: list[FrameRow] = []
        self._lines: list[list[PageText]] = []
        self._drawn: list[tuple[str, int]] = []

    def show(self, open_tab: OpenTab) -> None:
        """What does not fit, and the tree."""
        self._open = open_tab
        self._is_readable = _is_readable()
        with part("div", "row"):
            button("Say the tree", self._say)
        self._spoken = StatusLine()
        self._count = PageText("p", "", "count")
        self._trouble = Notice()
        frame = part("div", "scroll", role="region", tabindex=0, aria_label="The tree of frames")
        with frame, part("table", "frames"):
            with part("thead"), part("tr"):
                for each in COLUMNS:
                    PageText("th", each, scope="col")
            self._body = part("tbody")

    def refresh(self) -> None:
        """Take in what has come, and say how all frames are now."""
        if not self._is_readable:
            self._count.say(OF_ROS if os.environ.get("ROS_DISTRO") else OF_COURSE)
            return
        self._follow()
        for topic, heard in self._heard.items():
            self._take(topic, heard)
        now_s = time.monotonic()
        self._now.forget(now_s)
        look = FramesLook(self._now, self._said_by(), now_s, self._clock_ns)
        self._rows = list(look.rows())
        self._trouble.say("\n".join(look.faults()))
        self._count.say(_counted(self._rows, bool(self._heard)))
        self._draw(self._rows[:MOST_ROWS])

    @property
    def _clock_ns(self) -> int:
        return int(self._open.hub.desk_node.node.get_clock().now().nanoseconds)

    def _follow(self) -> None:
        """Listen to what is published, and to nothing else: a tab makes no topic appear."""
        there = {seen.name for seen in self._open.hub.topics() if seen.publishers}
        for topic in (TF, TF_STATIC):
            if topic in there and topic not in self._heard:
                self._heard[topic] = self._open.hear(topic, TF_MESSAGE)
                self._read_to[topic] = 0
            elif topic not in there and topic in self._heard:
                self._open.leave(self._heard.pop(topic))

    def _take(self, topic: str, heard: SharedSubscription) -> None:
        for message in heard.after(self._read_to[topic]):
            self._read_to[topic] = message.number
            self._now.take(heard.read(message), message.came_s, topic == TF_STATIC)

    def _said_by(self) -> dict[str, Sequence[str]]:
        return {topic: self._nodes_on(topic) for topic in (TF, TF_STATIC)}

    def _nodes_on(self, topic: str) -> list[str]:
        found = self._open.hub.desk_node.publishers(topic)
        return sorted({f"{each.node_namespace.rstrip('/')}/{each.node_name}" for each in found})

    def _say(self) -> None:
        self._spoken.say(" ".join(map(_sentence, self._rows)) or NOTHING)

    def _draw(self, rows: list[FrameRow]) -> None:
        """Texts change where they stand; only another tree is made anew."""
        tree = [(row.name, row.depth) for row in rows]
        if tree != self._drawn:
            self._drawn = tree
            self._body.clear()
            with self._body:
                self._lines = [_made(row) for row in rows]
        for row, cells in zip(rows, self._lines, strict=True):
            for cell, words in zip(cells, _cells(row), strict=True):
                cell.say(words)


def _is_readable() -> bool:
    try:
        class_of(TF_MESSAGE, "msg")
    except UnknownInterface:
        return False
    return True


def _made(row: FrameRow) -> list[PageText]:
    """A frame stands further to the right than the one above it."""
    with part("tr"):
        name = PageText("th", row.name, "frame", scope="row")
        name.style(f"padding-left: {0.6 + 1.4 * min(row.depth, DEEPEST):.1f}rem")
        return [*map(partial(PageText, "td"), _cells(row))]


def _cells(row: FrameRow) -> tuple[str, ...]:
    return (row.age or "root", row.translation, row.yaw, row.said_by)


def _counted(rows: list[FrameRow], heard: bool) -> str:
    if not rows:
        return AWAITED if heard else NOTHING
    more = f", {MOST_ROWS} of them shown" if len(rows) > MOST_ROWS else ""
    return f"{len(rows)} frames{more}"


def _sentence(row: FrameRow) -> str:
    if not row.age:
        return f"{row.name} is a root."
    return f"{row.name}: {row.age}, at {row.translation} m, yaw {row.yaw} degrees."
