"""`./roslings watch`: a verdict at each save, and one key for what a learner wants next."""

from __future__ import annotations

import argparse
import os
from contextlib import suppress

from roslings import course
from roslings.commands.watch.keyboard import Keyboard, keyboard
from roslings.commands.watch.session import Session
from roslings.commands.way import drill_before, drills_there
from roslings.errors import OK
from roslings.workspace import progress


def watch(options: argparse.Namespace) -> int:
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
        from roslings.commands.watch.drill import begun as drill_begun

        return drill_begun(name, keys)
    from roslings.commands.watch.lab import begun as lab_begun

    return lab_begun(course.lab(name), options, keys)
