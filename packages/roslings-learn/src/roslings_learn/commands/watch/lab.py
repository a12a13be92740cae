"""A lab that is watched."""

from __future__ import annotations

import argparse
import time
from contextlib import closing
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING

from ros2_on_pip.language import Text, said
from ros2_on_pip.typed_paths import from_here
from roslings.commands.invocation import program
from roslings.commands.showing import replace_kept, show
from roslings.course import Lab
from roslings.course.titles import lab_title
from roslings.workspace import progress
from roslings.workspace.errors import NotThere
from roslings.workspace.student import package_of, start
from roslings_learn.commands.watch.keyboard import Keyboard
from roslings_learn.commands.watch.session import KeyAction, Ours, WatchSession, say, tell

if TYPE_CHECKING:
    from roslings.evidence import GraphSeen
    from roslings.grading.checking import Ready
    from roslings.grading.saving import Graded

GRAPH = Text("watch.key.graph", "graph")
NO_NODE = Text("watch.no_node", "No node has run yet.")


def begun(lab: Lab, options: argparse.Namespace, keys: Keyboard) -> LabSession:
    """The starter is put there for who has none."""
    options.lab = lab.name
    if options.path is None and _package_there(lab) is None:
        text, package = "The starter of {lab!r} is in {package}.", from_here(start(lab).package)
        print(said("watch.started", text, lab=lab.name, package=package))
    return LabSession(keys, package_of(lab, options.path), lab.outline.day, lab, options)


def _package_there(lab: Lab) -> Path | None:
    return next((each.package for each in progress.status() if each.lab.name == lab.name), None)


@dataclass
class LabSession(WatchSession):
    """A package that is built and graded at each save."""

    lab: Lab
    options: argparse.Namespace
    graded: Graded | None = field(default=None, init=False)

    def run(self) -> bool:
        """With all loaded that is the same for each check."""
        from roslings.grading.checking import ready_again_and_again

        with closing(ready_again_and_again(self.lab)) as each_ready:
            ready = next(each_ready)
            for _ in self.turns():
                self._check(ready)
                ready = next(each_ready)  # only the save is waited for
                if self.is_done() and self.keys.keys:
                    self._tell_of_ours()
                    pack = f"{program()} pack {self.lab.name}"
                    say(said("watch.hand_in", "Done. To hand it in: {command}", command=pack))
                self.say_that_it_waits()
        return self.goes_on

    def _check(self, ready: Ready) -> None:
        """What is wrong with the package now may be right at the next save."""
        try:
            self._insist_on_folder()
            package = package_of(self.lab, self.options.path)
            with self.checking():
                self.graded = ready.grade(package, time.monotonic_ns())
            verdict = self.graded.verdict
            show(verdict, self.options, replace_kept(self.lab, verdict, package))
        except Exception as error:
            self.graded = None
            tell(error)

    def _insist_on_folder(self) -> None:
        """What is watched is there: a package that lies elsewhere now is followed by nobody."""
        if not self.folder.exists():
            raise NotThere(self.folder, f"{program()} start {self.lab.name}")

    def show_hint(self, step: int) -> None:
        """For the first check that failed."""
        if self.graded is None:
            say(said("watch.no_verdict", "There is no verdict to give a hint for."))
        else:
            show(self.graded.verdict, argparse.Namespace(**{**vars(self.options), "hint": step}))

    def offers(self) -> list[KeyAction]:
        """What the last check saw."""
        return [
            KeyAction("g", GRAPH, self._show_graph, bool(self._graph), NO_NODE),
        ]

    def _show_graph(self) -> None:
        from ros2_on_pip.graph.words import graph_text

        if self._graph:
            print(f"\n{graph_text(self._graph)}", flush=True)

    @property
    def _graph(self) -> GraphSeen | None:
        """As the last check saw it, when most nodes of the lab ran at once."""
        experiments = self.graded.evidence.experiments.values() if self.graded else ()
        names = {node.node for node in self.lab.card.nodes}
        graphs = (seen.graph for seen in experiments if seen.graph.nodes)
        return max(graphs, key=lambda graph: len(names & {*graph.nodes}), default=None)

    def show_all(self) -> None:
        """All labs, and how far each is."""
        from roslings.commands.status import lines

        print("", *lines(), sep="\n", flush=True)

    def _tell_of_ours(self) -> None:
        """The students' edition has no solutions: then there is nothing to compare with."""
        if self.lab.solution.is_dir():
            self.solved = Ours(self.lab.name, self._show_ours)

    def _show_ours(self) -> None:
        """File by file."""
        from roslings_learn.drills.beside import package_lines

        for line in package_lines(package_of(self.lab, self.options.path), self.lab.solution):
            print(line)
        print(flush=True)

    @property
    def lesson(self) -> str:
        """Where the lesson tells of the first check that failed."""
        checks = self.graded.verdict.checks if self.graded else ()
        told = (each.lesson for each in checks if each.outcome == "fail" and each.lesson)
        return next(told, f"days/{self.day}")

    def is_done(self) -> bool:
        """The last check passed."""
        return self.graded is not None and self.graded.verdict.outcome == "pass"

    @property
    def title(self) -> str:
        """The day and what it is about."""
        day = self.lab.outline.day
        return said("watch.day", "Day {day}: {title}", day=day, title=lab_title(self.lab))
