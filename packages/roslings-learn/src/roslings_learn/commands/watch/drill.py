"""A drill that is watched: when it is mended, the next one comes by itself."""

from __future__ import annotations

import time
from dataclasses import dataclass, field
from pathlib import Path

from ros2_on_pip.language import Text, said
from ros2_on_pip.typed_paths import shown
from roslings.commands.invocation import program
from roslings_learn.commands.watch.keyboard import Keyboard
from roslings_learn.commands.watch.session import KeyAction, Ours, WatchSession, say, tell
from roslings_learn.drills import Drill, all_drills, drill, telling
from roslings_learn.drills.command import checked
from roslings_learn.drills.judging import DrillVerdict
from roslings_learn.drills.student import begin_again, is_changed, start, statuses

SKIP, RESET = Text("watch.key.skip", "skip"), Text("watch.key.reset", "reset")
NOTHING_TO_RESET = Text("watch.nothing_to_reset", "Your file is the starter, as it was.")


def begun(name: str, keys: Keyboard) -> DrillSession:
    """The starter is put there for who has none. Raises DiskFull, CannotWriteFolder."""
    one = drill(name)
    file, _ = start(one)
    return DrillSession(keys, file.parent, one.day, one, file)


@dataclass
class DrillSession(WatchSession):
    """One file that is run at each save."""

    drill: Drill
    file: Path
    verdict: DrillVerdict | None = field(default=None, init=False)
    _resets: bool = field(default=False, init=False)
    """Whether one more press puts the starter back."""

    def run(self) -> bool:
        """The task and the first thing that is wrong; then a verdict at each save of this file."""
        from roslings_learn.drills.running import load

        for number, _ in enumerate(self.turns()):
            if number == 0:
                self._show_task()
                load(self.drill)  # while the task is read
            self._resets = False
            self._check()
            if self.is_done():
                self._tell_of_ours()
                return True
            self.say_that_it_waits()
        return self.goes_on

    def counts(self, saved: frozenset[Path]) -> bool:
        """Other drills lie in the same folder."""
        return bool(saved & {self.file.resolve(), self.folder.resolve()})

    def _show_task(self) -> None:
        names = [each.name for each in all_drills()]
        page = telling.page()
        place = (names.index(self.drill.name) + 1, len(names))
        telling.put_task(
            page, self.drill, self.file, place, telling.WayToGoOn(program(), watched=True)
        )
        page.print()
        print(flush=True)

    def _check(self) -> None:
        page = telling.page()
        try:
            with self.checking():
                self.verdict = checked(self.drill, self.file, time.monotonic())
            way = telling.WayToGoOn(program(), watched=True)
            telling.put_verdict(page, self.drill, self.verdict, self.file, way)
            page.print()
        except Exception as error:
            self.verdict = None
            tell(error)

    def _tell_of_ours(self) -> None:
        """The students' edition has no solutions: then there is nothing to compare with."""
        self.solved = None
        if self.drill.has_solution:
            self.solved = Ours(self.drill.name, self._show_ours)
            if self.keys.keys:
                beside = "{key} shows our {drill} beside yours."
                told = said("watch.beside", beside, key="c", drill=self.drill.name)
                print(f"\n{told}", flush=True)

    def _show_ours(self) -> None:
        page = telling.page()
        page.blank()
        telling.put_beside(page, self.drill, self.file)
        page.print()

    def show_hint(self, step: int) -> None:
        """The card's."""
        page = telling.page()
        page.blank()
        telling.put_hint(page, self.drill, step, program(), watched=bool(self.keys.keys))
        page.print()

    def show_all(self) -> None:
        """The drills of this day, and how many of the others are done."""
        page = telling.page()
        page.blank()
        telling.put_day(page, statuses(), self.drill, program())
        page.print()

    def offers(self) -> list[KeyAction]:
        """A drill can be passed over, and begun again."""
        changed = is_changed(self.drill)
        return [
            KeyAction("s", SKIP, self._skip, not self.is_done()),
            KeyAction("x", RESET, self._reset, changed, NOTHING_TO_RESET),
        ]

    def _skip(self) -> None:
        left_out = "{drill} is left out. It comes again at the next {command}."
        command = f"{program()} watch"
        say(said("watch.left_out", left_out, drill=self.drill.name, command=command))
        self.go_on()

    def _reset(self) -> None:
        """The first press tells what the second does; what is put back is a save."""
        if not self._resets:
            self._resets = True
            twice = "{key}: press {key} once more, and the starter comes back. Your file is kept."
            say(said("watch.reset_twice", twice, key="x"))
            return
        self._resets = False
        back, kept = "The starter is back. Yours is kept: {file}", shown(begin_again(self.drill))
        say(said("watch.reset_done", back, file=kept))

    def is_done(self) -> bool:
        """It is mended."""
        return self.verdict is not None and self.verdict.outcome == "pass"

    @property
    def lesson(self) -> str:
        """The card's paragraph."""
        return self.drill.card.lesson

    @property
    def code(self) -> Path:
        """The one file."""
        return self.file
