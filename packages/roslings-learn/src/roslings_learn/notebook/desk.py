"""The desk from a cell, in the ROS domain of this notebook."""

from __future__ import annotations

import html
import os
import sys
from collections.abc import Iterable
from contextlib import ExitStack

from roslings_learn.notebook.errors import NotebookTrouble
from roslings_learn.notebook.picture import in_a_notebook
from roslings_learn.notebook.place import on_the_site, settle_in
from roslings_learn.notebook.programs import NotebookProgram
from roslings_learn.of_window import OF_SERVER
from roslings_learn.start import START

OPEN, OPENS_WITHIN_S = "The desk is open.", 60.0
HIGH_PX = 620
FRAME = '<iframe src="{src}" title="{title}" width="100%" height="{high}"></iframe>'

_running = ExitStack()
"""The desk that this kernel has started: it ends when another one is, or with the kernel."""


class NoSuchTab(NotebookTrouble):
    """The desk has no tab of this name."""

    def __init__(self, name: str, there: Iterable[str]) -> None:
        super().__init__(f"The desk has no tab '{name}'. It has: {', '.join(there)}")


def desk(tab: str = "rover") -> None:
    """Open the desk: it sees the nodes of this notebook, also those that a cell starts later.

    In the window of `./roslings lab` it stands below the cell; elsewhere, in a browser's tab.
    Raises NoSuchTab, and ProgramEnded where the desk says why it does not open.
    """
    from roslings_desk.tab import tabs

    if tab not in (there := tabs()):
        raise NoSuchTab(tab, there)
    domain = settle_in()
    if on_the_site() or not in_a_notebook():
        print(f"The desk shows the nodes of ROS domain {domain}. In a terminal: ./roslings desk")
    elif server := os.environ.get(OF_SERVER):
        _show(f"{server}roslings/desk/{domain}/{tab}", f"The desk, tab {tab}, ROS domain {domain}")
    else:
        _open_in_browser(tab)


def _show(address: str, title: str) -> None:
    from IPython.display import display

    words = {"src": html.escape(address), "title": html.escape(title), "high": HIGH_PX}
    display({"text/html": FRAME.format(**words), "text/plain": title}, raw=True)


def _open_in_browser(tab: str) -> None:
    _running.close()
    program = _running.enter_context(NotebookProgram(f"'{sys.executable}' '{START}' desk {tab}"))
    program.says(OPEN, timeout_s=OPENS_WITHIN_S)
    program.says("Ctrl-C")
    print(*program.lines[:2], sep="\n")
