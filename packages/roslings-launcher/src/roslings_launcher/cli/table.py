"""All commands: each package of the course brings a table of its own.

A package has a module `command_names` with `COMMANDS`. Each line says who types a command
(`learners`, `teachers`; empty: it is not listed), its name, what it is about, and where it stands.
That is `MODULE`, or `MODULE:FUNCTION` where a function reads the words itself. In a course's folder
the tables are found by their files, and no package is imported: they are there before anything is
installed. Elsewhere they are the entry points `roslings.command` of what is installed.

A MODULE has `add_options(parser)`, which says what the command takes, and `run(options)`. Where it
has `leave(status)`, too, that ends the process.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from pathlib import Path
from runpy import run_path
from typing import Any

from roslings_launcher.sources import source_folders

LEARNERS, TEACHERS = "learners", "teachers"
TABLE = "command_names"
GROUP = "roslings.command"
ORDER = (
    "doctor",
    "lab",
    "site",
    "drill",
    "quiz",
    "start",
    "check",
    "watch",
    "explain",
    "status",
    "diff",
    "pack",
    "my-rover",
    "rover",
    "desk",
    "board",
    "camera",
    "graph",
    "break",
    "ros2",
    "ready",
    "grade",
    "regrade",
    "override",
    "forget",
    "overview",
    "export",
    "cluster",
    "new-lab",
    "prove",
    "release",
    "serve",
    "test",
    "wheels",
)
"""As `--help` lists them; what stands in no place here comes last."""
FIRST_WORD = ""
"""The name of what runs without a word."""


@dataclass(frozen=True)
class CommandEntry:
    """One command of the table."""

    typed_by: str
    name: str
    about: str
    stands_in: str

    @property
    def reads_its_words(self) -> bool:
        """Its function takes the words as they were typed."""
        return ":" in self.stands_in

    def load(self) -> Any:
        """The module, or the function that takes the words."""
        module, _, function = self.stands_in.partition(":")
        found = import_module(module)
        return getattr(found, function) if function else found


@cache
def commands() -> dict[str, CommandEntry]:
    """By name, in the order of the list."""
    found = {row[1]: CommandEntry(*row) for table in _tables() for row in table}
    return {name: found[name] for name in sorted(found, key=_place)}


def listed(typed_by: str) -> list[CommandEntry]:
    """Those that `--help` tells of."""
    return [command for command in commands().values() if command.typed_by == typed_by]


def _place(name: str) -> tuple[int, str]:
    return ORDER.index(name) if name in ORDER else len(ORDER), name


def _tables() -> Iterator[tuple[tuple[str, str, str, str], ...]]:
    folders = source_folders(Path(__file__).parents[5])
    files = [file for folder in folders for file in folder.glob(f"*/{TABLE}.py")]
    if not files:  # by pip: the packages lie side by side
        from importlib.metadata import entry_points  # 10 ms, which nothing else here needs

        yield from (point.load() for point in entry_points(group=GROUP))
    for file in files:
        yield run_path(str(file))["COMMANDS"]
