"""`./roslings watch`: a verdict at each save, and one key for what a learner wants next."""

from __future__ import annotations

import argparse
import os
from contextlib import suppress

from ros2_on_pip.errors import OK
from roslings import course
from roslings.commands.options import path_option
from roslings.way import drill_before, drills_there
from roslings.workspace import progress
from roslings_learn.commands.watch.keyboard import Keyboard, keyboard
from roslings_learn.commands.watch.session import Session


def add_options(word: argparse.ArgumentParser) -> None:
    """What it takes."""
    word.add_argument("lab", metavar="LAB|DRILL", nargs="?", help="default: today's")
    path_option(word)
    word.add_argument(
        "--plain", action="store_true", help="no keys, no new screen: lines only, as for a pipe"
    )
    word.set_defaults(
        solution=False, json=None, html=None, evidence=None, only=None, seed=None, hint=None,
        clock="auto", port=None, hidden=None, trust=False, as_stranger=False, timings=False,
        all=False, soak=None,
    )  # fmt: skip


def run(options: argparse.Namespace) -> int:
    """Check now, and again at every save, until Ctrl-C or `q`."""
    if options.plain:
        os.environ["TERM"] = "dumb"  # to who draws: lines only, no colours, nothing that moves
    name = options.lab or next_name()
    with suppress(KeyboardInterrupt), keyboard(options.plain) as keys:
        while name and _session(name, options, keys).run():
            options.path, name = None, next_name()
    return OK


def next_name() -> str | None:
    """The drill or the lab that comes next on the way; None, and a word, when all is done."""
    at = progress.today().at
    if at is None:
        print("All labs are done. Well done!")
        return None
    return drill_before(at.lab) or at.lab.name


def _session(name: str, options: argparse.Namespace, keys: Keyboard) -> Session:
    """Of a drill, where one is called so; else of a lab. Raises CourseError."""
    if name in {drill for _, drill in drills_there()} and options.path is None:
        from roslings_learn.commands.watch.drill import begun as drill_begun

        return drill_begun(name, keys)
    from roslings_learn.commands.watch.lab import begun as lab_begun

    return lab_begun(course.lab(name), options, keys)
