"""What a tab is: one file against this small interface. A student can write one, too.

    class Battery:
        title, every_s = "Battery", 0.5

        def show(self, open_tab: OpenTab) -> None:
            self.heard = open_tab.hear("/battery", "std_msgs/msg/Float32")
            self.value = PageText("p")

        def refresh(self) -> None:
            message = self.heard.newest()
            self.value.text = f"{message.data} V" if message else "nothing yet"

It is offered by a line `battery = my_package.battery:Battery` of the group `roslings.desk_tab` in
the entry points of an installed package. Its page is /battery.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import ExitStack
from functools import partial
from importlib import import_module
from importlib.metadata import EntryPoint, entry_points
from typing import Any, Protocol

from roslings_desk.hub import Hub, SharedSubscription

GROUP = "roslings.desk_tab"
BUILT_IN = {
    "rover": "roslings_desk.tabs.rover:RoverTab",
    "graph": "roslings_desk.tabs.graph:GraphTab",
    "topics": "roslings_desk.tabs.topics:TopicsTab",
    "frames": "roslings_desk.tabs.frames:FramesTab",
    "plot": "roslings_desk.tabs.plot:PlotTab",
    "services": "roslings_desk.tabs.services:ServicesTab",
    "actions": "roslings_desk.tabs.actions:ActionsTab",
    "parameters": "roslings_desk.tabs.parameters:ParametersTab",
    "image": "roslings_desk.tabs.image:ImageTab",
    "log": "roslings_desk.tabs.log:LogTab",
}
"""The name of the page, to its tab; in the order that they are shown."""


class OpenTab:
    """A tab that a page shows. What it listens to, and what it opened, ends when it is closed."""

    def __init__(self, hub: Hub, shown: Sequence[str] = ()) -> None:
        self.hub = hub
        self.shown = shown
        """What was typed behind the tab's name: `./roslings desk image /image`."""
        self.ends = ExitStack()
        """What is to be ended with the tab."""
        self._heard: list[SharedSubscription] = []
        self.ends.callback(self.leave_all)
        hub.closing.add(self.close)

    def hear(self, topic: str, type_name: str) -> SharedSubscription:
        """Listen to a topic as long as this tab is open. Raises UnknownInterface."""
        heard = self.hub.hear(topic, type_name)
        self._heard.append(heard)
        return heard

    def leave(self, heard: SharedSubscription) -> None:
        """This tab does not show it any more."""
        self._heard.remove(heard)
        self.hub.leave(heard)

    def close(self) -> None:
        """Nobody looks at it any more."""
        self.hub.closing.discard(self.close)
        self.ends.close()

    def leave_all(self) -> None:
        """It shows nothing any more."""
        for heard in list(self._heard):
            self.leave(heard)


class Tab(Protocol):
    """One page of the desk."""

    title: str
    every_s: float
    """So often it is drawn anew."""

    def show(self, open_tab: OpenTab) -> None:
        """Make what the page holds, and open what it needs."""

    def refresh(self) -> None:
        """Draw the newest. Raises CommandProblem, whose words then stand on the page."""


def tabs() -> dict[str, Callable[[], Tab]]:
    """The name of each tab's page, to what makes the tab: ours, then those of other packages."""
    found: dict[str, Callable[[], Tab]] = {name: _made(at) for name, at in BUILT_IN.items()}
    for point in entry_points(group=GROUP):
        found.setdefault(point.name, partial(_loaded, point))
    return found


def _loaded(point: EntryPoint) -> Tab:
    made: Tab = point.load()()
    return made


def _made(at: str) -> Callable[[], Tab]:
    module, _, name = at.partition(":")

    def make() -> Any:
        return getattr(import_module(module), name)()

    return make
