"""A drill that is watched: when it is mended, the next one comes by itself."""

from __future__ import annotations

import time
from dataclasses import dataclass, field
from pathlib import Path

from roslings.typed import program
from roslings_learn.commands.watch.keyboard import Keyboard
from roslings_learn.commands.watch.session import Session, tell
from roslings_learn.drills import Drill, all_drills, drill, telling
from roslings_learn.drills.command import checked
from roslings_learn.drills.judging import DrillVerdict
from roslings_learn.drills.student import start


def begun(name: str, keys: Keyboard) -> DrillSession:
    """The starter is put there for who has none. Raises DiskFull, CannotWrite."""
    one = drill(name)
    file, _ = start(one)
    return DrillSession(keys, file.parent, one.day, one, file)


@dataclass
class DrillSession(Session):
    """One file that is run at each save."""

    drill: Drill
    file: Path
    verdict: DrillVerdict | None = field(default=None, init=False)

    def run(self) -> bool:
        """The task and the first thing that is wrong; then a verdict at each save of this file."""
        from roslings_learn.drills.running import load

        load(self.drill)
        for number, saved in enumerate(self.turns()):
            if number == 0:
                self._show_task()
            if saved and not saved & {self.file.resolve(), self.folder.resolve()}:
                self.say_that_it_waits()
                continue
            self._check()
            if self.is_done():
                return True
            self.say_that_it_waits()
        return self.goes_on

    def _show_task(self) -> None:
        names = [each.name for each in all_drills()]
        page = telling.page()
        place = (names.index(self.drill.name) + 1, len(names))
        telling.put_task(page, self.drill, self.file, place, telling.Way(program(), watched=True))
        page.print()
        print(flush=True)

    def _check(self) -> None:
        page = telling.page()
        try:
            self.verdict = checked(self.drill, self.file, time.monotonic())
            way = telling.Way(program(), watched=True)
            telling.put_verdict(page, self.drill, self.verdict, self.file, way)
            page.print()
        except Exception as error:
            self.verdict = None
            tell(error)

    def show_hint(self, step: int) -> None:
        """The card's."""
        page = telling.page()
        telling.put_hint(page, self.drill, step, program())
        page.print()

    def show_graph(self) -> None:
        """A drill's run is over at once: who wants to look, lets it run."""
        print(f"\nRun it in another terminal, and look: {program()} graph", flush=True)

    def is_done(self) -> bool:
        """It is mended."""
        return self.verdict is not None and self.verdict.outcome == "pass"

    @property
    def code(self) -> Path:
        """The one file."""
        return self.file
