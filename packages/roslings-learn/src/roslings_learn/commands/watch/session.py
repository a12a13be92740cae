"""One lab or one drill that is watched: what is the same for both."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from roslings.typed import program
from roslings.way import bar
from roslings.workspace import progress
from roslings.workspace.errors import CannotRead, ChangedMeanwhile
from roslings_launcher.cli import explain
from roslings_learn.commands.watch.editing import edit
from roslings_learn.commands.watch.keyboard import Keyboard

KEYS = "h hint   e edit   r run again   l lesson   g graph   n next   q quit"
MOST_HINTS = 3
CLEAR = "\x1b[2J\x1b[H"


def tell(error: Exception) -> None:
    """What cannot be checked now may be right at the next save. Raises what nobody expects."""
    if isinstance(error, FileNotFoundError | IsADirectoryError | NotADirectoryError):
        error = ChangedMeanwhile(Path(error.filename or "A file"))
    if isinstance(error, PermissionError) and error.filename:
        error = CannotRead(Path(error.filename))
    explain(error)


@dataclass
class Session(ABC):
    """Checks at each save, and follows the keys in between."""

    keys: Keyboard
    folder: Path
    """What is watched."""
    day: str
    hints: int = field(default=0, init=False)
    """How many were asked for since the last check."""
    over: bool = field(default=False, init=False)
    goes_on: bool = field(default=False, init=False)
    """Whether the next one of the way comes after it."""

    @abstractmethod
    def run(self) -> bool:
        """Until somebody ends it; whether the next one is wanted."""

    @abstractmethod
    def show_hint(self, step: int) -> None:
        """Step 1 to 3 of the hint for what the last check found."""

    @abstractmethod
    def show_graph(self) -> None:
        """What the last check saw."""

    @abstractmethod
    def is_done(self) -> bool:
        """All passes."""

    @property
    def title(self) -> str:
        """What is worked on, in one line; empty where the session says it itself."""
        return ""

    @property
    def code(self) -> Path:
        """What an editor opens."""
        return self.folder

    def turns(self) -> Iterator[frozenset[Path]]:
        """What was saved, each time that a check is due: at once, at a save, and at the key r."""
        from roslings.workspace.watch import changes

        # Begun first: a save during a check is not missed.
        saves = changes(self.folder, lambda: self.over, begin=True, wake=self.keys.is_pressed)
        for number, saved in enumerate(saves):
            key = self.keys.take()
            if number and not saved and key != "r":
                self.follow(key)
                continue
            self.hints = 0
            self._head(saved, number > 0)
            yield saved

    def _head(self, saved: frozenset[Path], again: bool) -> None:
        """On a terminal each verdict stands on a screen of its own; the last one stays at first."""
        if self.keys.keys:
            print(CLEAR if again else "")
            print("\n".join(filter(None, [bar(progress.status()), self.title])))
        if saved:
            there = frozenset(path for path in saved if path.exists())
            word = "Saved" if there else "Gone"
            print(f"\n{word}: {self._names(there or saved)}", flush=True)

    def _names(self, paths: frozenset[Path]) -> str:
        inside = (path for path in paths if path != self.folder.resolve())
        names = sorted(str(path.relative_to(self.folder.resolve())) for path in inside)
        return ", ".join(names[:3]) or f"the folder {self.folder.name}"

    def say_that_it_waits(self) -> None:
        """What can be done now."""
        if self.keys.keys:
            print(f"\nSave a file to check again.\n{KEYS}", flush=True)
        else:
            print("\nWatching. Save a file to check again; Ctrl-C ends it.", flush=True)

    # --- the keys -------------------------------------------------------------------------

    def follow(self, key: str) -> None:
        """What a key asks for; one without a meaning is told."""
        asked = {
            "h": self._hint, "e": self._edit, "l": self._lesson, "g": self.show_graph,
            "n": self._next, "q": self._quit,
        }  # fmt: skip
        if key:
            asked.get(key, self._help)()

    def _help(self) -> None:
        print(f"\n{KEYS}", flush=True)

    def _hint(self) -> None:
        """Each press tells a little more."""
        self.hints = min(self.hints + 1, MOST_HINTS)
        self.show_hint(self.hints)

    def _edit(self) -> None:
        if self.keys.keys:
            with self.keys.keys.lent():
                edit(self.code)

    def _lesson(self) -> None:
        number = int(self.day[:2])
        print(f"\nIn another terminal: {program()} lab {number}    (days/{self.day})", flush=True)

    def _next(self) -> None:
        """Only who is done goes on; the others are told how to leave."""
        if self.is_done():
            self.go_on()
        else:
            print("\nThis one is not done yet. To leave it: q", flush=True)

    def go_on(self) -> None:
        """The next one of the way."""
        self.goes_on = self.over = True

    def _quit(self) -> None:
        self.over = True
