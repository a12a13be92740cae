"""`./roslings watch`: a verdict at each save, and one key for what a learner wants next."""

from __future__ import annotations

import argparse
import sys
import time
from collections.abc import Iterator
from contextlib import closing, contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

from roslings import course
from roslings.commands.editing import edit
from roslings.commands.showing import from_here, replace_kept, show
from roslings.commands.way import bar
from roslings.course import Lab
from roslings.exits import OK, explain
from roslings.keyboard import Keys, NoKeys, keys_of
from roslings.typed import program
from roslings.workspace import progress
from roslings.workspace.student import package_of, start

if TYPE_CHECKING:
    from roslings.checking import Ready
    from roslings.saving import Graded

KEYS = "h hint   e edit   r run again   l lesson   g graph   n next   q quit"
MOST_HINTS = 3
CLEAR = "\x1b[2J\x1b[H"


def watch(options: argparse.Namespace) -> int:
    """Check now, and again at every save, until Ctrl-C or `q`."""
    lab: Lab | None = course.lab(options.lab) if options.lab else _todays_lab()
    with suppress(KeyboardInterrupt), _keyboard(options) as keys:
        while lab:
            lab = _begun(lab, options, keys).run()
    return OK


def _todays_lab() -> Lab | None:
    """What is next, as `./roslings` says it."""
    at = progress.today().at
    if at is None:
        print("All labs are done. Well done!")
    return at.lab if at else None


def _begun(lab: Lab, options: argparse.Namespace, keys: Keyboard) -> Session:
    """The starter is put there for who has none."""
    options.lab = lab.name
    if options.path is None and _package_there(lab) is None:
        print(f"The starter of {lab.name!r} is in {from_here(start(lab).package)}.")
    return Session(lab, options, keys, package_of(lab, options.path))


def _package_there(lab: Lab) -> Path | None:
    return next((each.package for each in progress.status() if each.lab.name == lab.name), None)


# --- the keyboard ------------------------------------------------------------------------------


@dataclass
class Keyboard:
    """The keys of this terminal; none where there is no terminal, or where none are wanted."""

    keys: Keys | None = None
    _pressed: str = ""

    def is_pressed(self) -> bool:
        """Whether a key waits."""
        self._pressed = self._pressed or (self.keys.next(0.0) if self.keys else "")
        return bool(self._pressed)

    def take(self) -> str:
        """The key that waits; empty where none does."""
        key, self._pressed = self._pressed, ""
        return key


@contextmanager
def _keyboard(options: argparse.Namespace) -> Iterator[Keyboard]:
    """Without a terminal on both sides the lines come as they always did."""
    if options.plain or not sys.stdout.isatty():
        yield Keyboard()
        return
    try:
        with keys_of() as keys:
            yield Keyboard(keys)
    except NoKeys:
        yield Keyboard()


# --- one lab -----------------------------------------------------------------------------------


@dataclass
class Session:
    """One lab that is watched."""

    lab: Lab
    options: argparse.Namespace
    keys: Keyboard
    folder: Path
    graded: Graded | None = None
    hints: int = 0
    """How many were asked for since the last check."""
    after: Lab | None = None
    """The lab that comes next; None ends the command."""
    over: bool = field(default=False)

    def run(self) -> Lab | None:
        """Until somebody goes on; the lab to go on with, or None."""
        from roslings.checking import ready_again_and_again
        from roslings.workspace.watch import changes

        # Begun first: a save during a check is not missed.
        saves = changes(self.folder, lambda: self.over, begin=True, wake=self.keys.is_pressed)
        with closing(ready_again_and_again(self.lab)) as each_ready:
            ready = next(each_ready)
            for number, saved in enumerate(saves):
                key = self.keys.take()
                if number and not saved and key != "r":
                    self._follow(key)
                    continue
                self._check(ready, saved)
                ready = next(each_ready)  # only the save is waited for
                self._wait()
        return self.after

    def _check(self, ready: Ready, saved: frozenset[Path]) -> None:
        """What is wrong with the package now may be right at the next save."""
        self._head()
        if saved:
            print(f"\nSaved: {_names(saved, self.folder)}", flush=True)
        self.hints = 0
        try:
            package = package_of(self.lab, self.options.path)
            self.graded = ready.grade(package, time.monotonic_ns())
            verdict = self.graded.verdict
            show(verdict, self.options, replace_kept(self.lab, verdict))
        except Exception as error:
            explain(error)

    def _head(self) -> None:
        """On a terminal each verdict stands on a screen of its own."""
        if self.keys.keys:
            outline = self.lab.outline
            print(f"{CLEAR}{bar(progress.status())}\nDay {outline.day}: {outline.title}")

    def _wait(self) -> None:
        if not self.keys.keys:
            print("\nWatching. Save a file to check again; Ctrl-C ends it.", flush=True)
            return
        if self._is_done():
            print(f"\nDone. To hand it in: {program()} pack {self.lab.name}")
        print(f"\nSave a file to check again.\n{KEYS}", flush=True)

    # --- the keys -------------------------------------------------------------------------

    def _follow(self, key: str) -> None:
        """What a key asks for; one without a meaning is told."""
        asked = {
            "h": self._hint, "e": self._edit, "l": self._lesson, "g": self._graph,
            "n": self._next, "q": self._quit,
        }  # fmt: skip
        if key:
            asked.get(key, self._help)()

    def _help(self) -> None:
        print(f"\n{KEYS}", flush=True)

    def _hint(self) -> None:
        """Each press tells a little more."""
        if self.graded is None:
            return
        self.hints = min(self.hints + 1, MOST_HINTS)
        asked = argparse.Namespace(**{**vars(self.options), "hint": self.hints})
        show(self.graded.verdict, asked)

    def _edit(self) -> None:
        if self.keys.keys:
            with self.keys.keys.lent():
                edit(self.folder)

    def _lesson(self) -> None:
        day = self.lab.outline.day
        print(f"\nIn another terminal: {program()} lab {int(day[:2])}    (days/{day})", flush=True)

    def _graph(self) -> None:
        """As the last check saw it, when most nodes of the lab ran at once."""
        from roslings.report import graph_text

        experiments = self.graded.evidence.experiments.values() if self.graded else ()
        names = {node.node for node in self.lab.card.nodes}
        graphs = (seen.graph for seen in experiments if seen.graph.nodes)
        fullest = max(graphs, key=lambda graph: len(names & {*graph.nodes}), default=None)
        print(f"\n{graph_text(fullest)}" if fullest else "\nNo node has run yet.", flush=True)

    def _next(self) -> None:
        """Only who is done goes on; the others are told how far it is."""
        following = progress.today().at
        if not self._is_done() or following is None:
            print("\nThis lab is not done yet. To leave it: q" if following else "\nAll is done.",
                  flush=True)  # fmt: skip
            return
        self.after, self.over = following.lab, True

    def _quit(self) -> None:
        self.over = True

    def _is_done(self) -> bool:
        return self.graded is not None and self.graded.verdict.outcome == "pass"


def _names(saved: frozenset[Path], folder: Path) -> str:
    inside = (path for path in saved if path != folder.resolve())
    names = sorted(str(path.relative_to(folder.resolve())) for path in inside)
    return ", ".join(names[:3]) or "the package"
