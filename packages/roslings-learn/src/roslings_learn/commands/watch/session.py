"""One lab or one drill that is watched: what is the same for both."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Iterator
from contextlib import AbstractContextManager
from dataclasses import dataclass, field
from pathlib import Path

from ros2_on_pip.label_column import side_by_side, wrapped
from ros2_on_pip.language import Text, said
from roslings.commands.invocation import program
from roslings.commands.way import bar
from roslings.workspace import progress
from roslings.workspace.errors import CannotRead, ChangedMeanwhile
from roslings_launcher.cli import explain
from roslings_learn.commands.watch import editing
from roslings_learn.commands.watch.keyboard import QUIT, Keyboard

EDIT, RUN = "e", "r"
MOST_HINTS = 3
CLEAR = "\x1b[2J\x1b[H"
BETWEEN = "   "
KEYS = {
    "hint": Text("watch.key.hint", "hint"),
    "edit": Text("watch.key.edit", "edit"),
    "run": Text("watch.key.run", "run"),
    "lesson": Text("watch.key.lesson", "lesson"),
    "compare": Text("watch.key.compare", "compare"),
    "all": Text("watch.key.all", "all"),
    "next": Text("watch.key.next", "next"),
    "quit": Text("watch.key.quit", "quit"),
}
"""What keys are called in the line of keys."""
NOTHING_NOW = Text("watch.nothing_now", "There is nothing for it now.")
NO_HINT = Text("watch.no_hint", "All passes: there is nothing to hint at.")
NO_EDITOR = Text("watch.no_editor", "There is no editor that I know.")
NOT_COMPARED = Text("watch.not_compared", "Our solution is shown beside yours when yours passes.")
NOT_DONE = Text("watch.not_done", "This one is not done yet. To leave it: `q`")


def tell(error: Exception) -> None:
    """What cannot be checked now may be right at the next save. Raises what nobody expects."""
    if isinstance(error, FileNotFoundError | IsADirectoryError | NotADirectoryError):
        error = ChangedMeanwhile(Path(error.filename or said("watch.a_file", "A file")))
    if isinstance(error, PermissionError) and error.filename:
        error = CannotRead(Path(error.filename))
    explain(error)


def say(text: str) -> None:
    """After an empty line, in lines of 80 columns, at once."""
    print("", *wrapped(text), sep="\n", flush=True)


def _nothing() -> None:
    """A run is begun by who waits for it."""


@dataclass(frozen=True)
class KeyAction:
    """A key, what it is called in the line of keys, and what it does."""

    key: str
    word: Text
    does: Callable[[], None]
    now: bool = True
    """Whether it can do that now; one that cannot is not offered."""
    why_not: Text = NOTHING_NOW
    """Told to who presses it all the same."""


@dataclass(frozen=True)
class Ours:
    """A reference solution that may be looked at, since the student's own passes."""

    name: str
    show: Callable[[], None]


@dataclass
class WatchSession(ABC):
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
    solved: Ours | None = field(default=None, init=False)
    """Of what was done just before."""
    _known: frozenset[Path] = field(default_factory=frozenset, init=False)
    """The files that were there at the last look."""

    @abstractmethod
    def run(self) -> bool:
        """Until somebody ends it; whether the next one is wanted."""

    @abstractmethod
    def show_hint(self, step: int) -> None:
        """Step 1 to 3 of the hint for what the last check found."""

    @abstractmethod
    def show_all(self) -> None:
        """What there is besides this one, and what of it is done."""

    @abstractmethod
    def is_done(self) -> bool:
        """All passes."""

    @property
    def lesson(self) -> str:
        """Where the lesson tells of it: `days/DAY#heading`, or `days/DAY`."""
        return f"days/{self.day}"

    @property
    def title(self) -> str:
        """What is worked on, in one line; empty where the session says it itself."""
        return ""

    @property
    def code(self) -> Path:
        """What an editor opens."""
        return self.folder

    def counts(self, saved: frozenset[Path]) -> bool:
        """Whether a save of these files is one of what is checked."""
        return True

    # --- when a check is due --------------------------------------------------------------

    def turns(self) -> Iterator[frozenset[Path]]:
        """What was saved, each time that a check is due: at once, at a save, and at the key r."""
        from roslings.workspace.watch import changes

        # Begun first: a save during a check is not missed.
        saves = changes(self.folder, lambda: self.over, begin=True, wake=self.keys.is_pressed)
        for number, found in enumerate(saves):
            key = self.keys.take()
            saved = self._that_stay(found)
            if number and not saved and key != RUN:
                self.follow(key)
                continue
            self.hints = 0
            self._head(saved, number > 0)
            yield saved

    def _that_stay(self, found: frozenset[Path]) -> frozenset[Path]:
        """Without what an editor made and took away again, and what is not checked."""
        before, self._known = self._known, frozenset(self._files())
        kept = frozenset(path for path in found if path.exists() or path in before)
        kept |= found & {self.folder.resolve()}
        return kept if kept and self.counts(kept) else frozenset()

    def _files(self) -> Iterable[Path]:
        folder = self.folder.resolve()
        return folder.rglob("*") if folder.is_dir() else ()

    def checking(self) -> AbstractContextManager[None]:
        """Around a check: keys are heard meanwhile, and `q` ends it."""
        return self.keys.heard_meanwhile(self._meaning)

    def _meaning(self, key: str) -> str:
        """What is said of a key while a check runs."""
        if key == QUIT:
            return said("watch.quits", "{key}: quit. The check is ended.", key=key)
        if key == RUN:
            once_more = "{key}: one more run, as soon as this check is over."
            return said("watch.runs_again", once_more, key=key)
        word = next((each.word for each in self._all_offers() if each.key == key), None)
        if word is None:
            return self._no_meaning(key)
        return said(
            "watch.soon", "{key}: {word}, as soon as this check is over.", key=key, word=word
        )

    def _head(self, saved: frozenset[Path], again: bool) -> None:
        """On a terminal each verdict stands on a screen of its own; the last one stays at first."""
        if self.keys.keys:
            print(CLEAR if again else "")
            print("\n".join(filter(None, [bar(progress.status()), self.title])))
        if saved:
            there = frozenset(path for path in saved if path.exists())
            files = self._names(there or saved)
            now = said("watch.saved", "Saved: {files}", files=files)
            say(now if there else said("watch.gone", "Gone: {files}", files=files))

    def _names(self, paths: frozenset[Path]) -> str:
        inside = (path for path in paths if path != self.folder.resolve())
        names = sorted(str(path.relative_to(self.folder.resolve())) for path in inside)
        folder = said("watch.folder", "the folder {name}", name=self.folder.name)
        return ", ".join(names[:3]) or folder

    def say_that_it_waits(self) -> None:
        """What can be done now."""
        if self.keys.keys:
            save = said("watch.save", "Save a file to check again.")
            print(f"\n{save}\n{self._line_of_keys()}", flush=True)
        else:
            say(said("watch.waits", "Watching. Save a file to check again; Ctrl-C ends it."))

    # --- the keys -------------------------------------------------------------------------

    def offers(self) -> list[KeyAction]:
        """What else a key does here, in the order in which it is shown."""
        return []

    def _all_offers(self) -> list[KeyAction]:
        is_done = self.is_done()
        return [
            KeyAction("h", KEYS["hint"], self._hint, not is_done, NO_HINT),
            KeyAction(EDIT, KEYS["edit"], self._edit, editing.is_there(), NO_EDITOR),
            KeyAction(RUN, KEYS["run"], _nothing),
            KeyAction("l", KEYS["lesson"], self._lesson),
            *self.offers(),
            KeyAction("c", KEYS["compare"], self._compare, self.solved is not None, NOT_COMPARED),
            KeyAction("a", KEYS["all"], self.show_all),
            KeyAction("n", KEYS["next"], self.go_on, is_done, NOT_DONE),
            KeyAction(QUIT, KEYS["quit"], self._quit),
        ]

    def _line_of_keys(self) -> str:
        """The keys that do something now, in lines of 80 columns."""
        offers = (f"{one.key} {one.word}" for one in self._all_offers() if one.now)
        return side_by_side(offers, BETWEEN)

    def follow(self, key: str) -> None:
        """What a key asks for; one that can do nothing is answered, too."""
        if not key:
            return
        asked = next((each for each in self._all_offers() if each.key == key), None)
        if asked is None:
            print(f"\n{self._no_meaning(key)}\n{self._line_of_keys()}", flush=True)
        elif asked.now:
            asked.does()
            if not self.over and key not in (RUN, EDIT):
                print(f"\n{self._line_of_keys()}", flush=True)
        else:
            say(f"{key}: {asked.why_not}")

    @staticmethod
    def _no_meaning(key: str) -> str:
        if not key.isprintable():
            return said("watch.no_such_key", "This key: there is no such key here.")
        return said("watch.no_key", "{key}: there is no such key here.", key=key)

    def _hint(self) -> None:
        """Each press tells a little more."""
        self.hints = min(self.hints + 1, MOST_HINTS)
        self.show_hint(self.hints)

    def _edit(self) -> None:
        if self.keys.keys:
            with self.keys.keys.handed_over():
                editing.edit(self.code)

    def _lesson(self) -> None:
        from roslings_learn.commands.watch.reading import show

        show(self.lesson, program())

    def _compare(self) -> None:
        if self.solved:
            self.solved.show()

    def go_on(self) -> None:
        """The next one of the way."""
        self.goes_on = self.over = True

    def _quit(self) -> None:
        self.over = True
