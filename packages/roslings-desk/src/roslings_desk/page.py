"""The page around a tab: its head, the way to the other tabs, and the tab's own part."""

from __future__ import annotations

import asyncio
from collections.abc import Callable, Sequence
from pathlib import Path

from nicegui import ui

from ros2_on_pip.graph.drawing import STYLE as GRAPH_STYLE
from roslings_desk.bag_bar import BagBar
from roslings_desk.bag_player import BagPlayer
from roslings_desk.controls import Notice, PageText, button, part, problem_of, told
from roslings_desk.hub import Hub
from roslings_desk.saving import HERE, LAST_S, save
from roslings_desk.tab import OpenTab, Tab
from roslings_rover.palette import variables

STYLE = Path(__file__).with_name("style.css")


def build(
    hub: Hub,
    name: str,
    tabs: dict[str, Callable[[], Tab]],
    bag: BagPlayer | None = None,
    shown: Sequence[str] = (),
) -> None:
    """The page of the tab `name`. What the tab opened ends when the browser is gone.

    With a `bag` its line stands above each tab. `shown` is what the tab shows at once.
    """
    tab = tabs[name]()
    ui.page_title(f"{tab.title} - roslings desk")
    ui.add_css(variables() + STYLE.read_text("utf-8") + GRAPH_STYLE)
    with part("header"):
        PageText("h1", "roslings desk")
        _ways(name, tabs)
        where = f"bag {bag.path.name}" if bag else f"ROS domain {hub.desk_node.domain}"
        PageText("p", where, "domain")
        _show_saving(hub)
    if bag:
        BagBar(bag)
    with part("div", "tab"):
        PageText("h2", tab.title)
        _open(OpenTab(hub, shown), tab)


def build_for_phone(hub: Hub, tab: Tab) -> None:
    """The page for a telephone: one tab, no way to another."""
    ui.page_title(f"{tab.title} - roslings desk")
    ui.add_css(variables() + STYLE.read_text("utf-8"))
    with part("header"):
        PageText("h1", "roslings desk")
        PageText("p", f"ROS domain {hub.desk_node.domain}", "domain")
    with part("div", "tab for-phone"):
        PageText("h2", tab.title)
        _open(OpenTab(hub), tab)


def _ways(here: str, tabs: dict[str, Callable[[], Tab]]) -> None:
    with part("nav", aria_label="Tabs"):
        for name in tabs:
            current = "page" if name == here else None
            PageText("a", name.capitalize(), href=f"./{name}", aria_current=current)


def _show_saving(hub: Hub) -> None:
    """A button that saves what open tabs have heard, in the folder where the desk was started."""

    async def save_heard() -> None:
        said.say("")
        said.say((await asyncio.to_thread(save, hub.heard, HERE)).words)

    trouble = Notice()
    button(f"Save the last {LAST_S:g} s", told(trouble, save_heard))
    said = PageText("p", "", "spoken", aria_live="polite")


def _open(open_tab: OpenTab, tab: Tab) -> None:
    notice = Notice()
    client = ui.context.client
    client.on_delete(open_tab.close)

    def act() -> None:
        notice.say(problem_of(tab.refresh))

    if problem := problem_of(lambda: tab.show(open_tab)):
        notice.say(problem)
    else:
        ui.timer(tab.every_s, act)
