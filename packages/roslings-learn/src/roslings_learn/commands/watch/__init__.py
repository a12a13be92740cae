"""`./roslings watch`: a verdict at each save, and one key for what a learner wants next."""

from __future__ import annotations

import argparse
import os
from contextlib import suppress
from difflib import get_close_matches

from ros2_on_pip.errors import OK
from ros2_on_pip.language import said
from roslings import course
from roslings.commands.options import path_option
from roslings.commands.way import ALL_DONE, drills_left, drills_there
from roslings.workspace import progress
from roslings_learn.commands.watch.keyboard import Keyboard, keyboard
from roslings_learn.commands.watch.session import WatchSession
from roslings_learn.drills import NoSuchDrill


def add_options(word: argparse.ArgumentParser) -> None:
    """What it takes."""
    word.add_argument("lab", metavar="LAB|DRILL", nargs="?", help="default: today's")
    path_option(word)
    word.add_argument(
        "--plain", action="store_true", help="no keys, no new screen: lines only, as for a pipe"
    )
    word.set_defaults(
        solution=False,
        json=None,
        html=None,
        evidence=None,
        only=None,
        seed=None,
        hint=None,
        clock="auto",
        port=None,
        hidden=None,
        trust=False,
        as_stranger=False,
        timings=False,
        all=False,
        soak=None,
    )


def run(options: argparse.Namespace) -> int:
    """Check now, and again at every save, until Ctrl-C or `q`."""
    if options.plain:
        os.environ["TERM"] = "dumb"  # to who draws: lines only, no colours, nothing that moves
    with suppress(KeyboardInterrupt), keyboard(options.plain) as keys:
        _one_after_the_other(options, keys)
    return OK


def _one_after_the_other(options: argparse.Namespace, keys: Keyboard) -> None:
    """Each that is done, or passed over, makes place for the next one."""
    name, solved, passed_over = options.lab or next_name(), None, frozenset[str]()
    while name:
        session = _session(name, options, keys)
        session.solved = solved
        if not session.run():
            return
        if not session.is_done():
            passed_over |= {name}
        options.path, solved = None, session.solved
        name = neighbour(name, passed_over) or next_name(passed_over)


def neighbour(name: str, passed_over: frozenset[str]) -> str | None:
    """The drill of the same day that comes after this drill, and is not done."""
    there = drills_there()
    at = next((n for n, (_, drill) in enumerate(there) if drill == name), None)
    if at is None:
        return None
    day, left = there[at][0], {drill for _, drill in drills_left()} - passed_over
    return next((drill for of, drill in there[at + 1 :] if of == day and drill in left), None)


def next_name(passed_over: frozenset[str] = frozenset()) -> str | None:
    """The drill or the lab that comes next on the way; None, and a word, when all is done."""
    at = progress.today().at
    if at is None:
        print(ALL_DONE)
        return None
    up_to_here = (drill for day, drill in drills_left() if day <= at.lab.outline.day)
    return next((drill for drill in up_to_here if drill not in passed_over), at.lab.name)


def _session(name: str, options: argparse.Namespace, keys: Keyboard) -> WatchSession:
    """Of a drill, where one is called so; else of a lab. Raises CourseError."""
    if name in {drill for _, drill in drills_there()} and options.path is None:
        from roslings_learn.commands.watch.drill import begun as drill_begun

        return drill_begun(name, keys)
    from roslings.workspace.own_card import own_lab
    from roslings_learn.commands.watch.lab import begun as lab_begun

    _insist_on_a_name(name)
    return lab_begun(own_lab(name), options, keys)


def _insist_on_a_name(name: str) -> None:
    """A slip in the name of a drill is no slip in that of a lab. Raises NoSuchDrill."""
    drills = [drill for _, drill in drills_there()]
    labs = [lab.name for lab in course.all_labs()]
    near = get_close_matches(name, [*labs, *drills], n=1)
    if name not in labs and near and near[0] in drills:
        text = "There is no lab and no drill {name!r}. Did you mean {near!r}?"
        raise NoSuchDrill(said("watch.no_such", text, name=name, near=near[0]))
