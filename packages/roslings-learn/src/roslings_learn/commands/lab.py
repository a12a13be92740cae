"""`./roslings lab`: open the day in one window of JupyterLab."""

from __future__ import annotations

import argparse
from dataclasses import replace

from roslings import course
from roslings.workspace.errors import writing
from roslings.workspace.student import workspace_root


def add_options(word: argparse.ArgumentParser) -> None:
    """What it takes."""
    word.add_argument(
        "day", metavar="DAY", nargs="?", help="for example: 3, or 03-topics (default: today's)"
    )
    word.add_argument("--no-browser", action="store_true", help="print the address, open nothing")
    word.add_argument("--port", metavar="N", type=int, help="default: 8888, or the next free one")
    word.add_argument(
        "--ip",
        metavar="ADDRESS",
        help="who may open it; 0.0.0.0 in a container (default: this computer)",
    )
    word.add_argument(
        "--hub", action="store_true", help="as the server of one user: JupyterHub starts it so"
    )


def run(options: argparse.Namespace) -> int:
    """Open the day's window in JupyterLab, until Ctrl-C: lesson, terminals, editor, rover."""
    from roslings_learn.jupyter.choosing import place_for
    from roslings_learn.jupyter.copies import Copies
    from roslings_learn.jupyter.server import open_lab, workspaces
    from roslings_learn.jupyter.window.layout import day_window, lay_out
    from roslings_learn.lessons import read_lessons

    lessons = read_lessons(course.root())
    days = lessons.days
    copies = Copies(course.root(), workspace_root(), lessons.glossary)
    place = place_for(options.day, days, copies, options.port, not options.no_browser)
    place = replace(place, ip=options.ip, hub=options.hub)
    for told in copies.copy_all(days):
        print(told)
    for day in (day for day in days if day.id == place.day):
        with writing(copies.folder):
            lay_out(day_window(day, copies), workspaces(copies.workspace))
    return open_lab(place)
