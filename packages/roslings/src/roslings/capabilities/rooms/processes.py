"""Which processes a node is, as they are seen from outside of its walls.

A process in a sandbox has a number of its own there, and another one here. The world beside it
needs the one here. So each drive gives its nodes a mark on their command lines, which no other
drive has.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path

from roslings.lockstep.quiet import fields_of_stat

PROC = Path("/proc")
LONGEST_COMMAND = 65536
PARENT = 1
"""Of the fields behind a process's name in proc_pid_stat(5)."""


@dataclass(frozen=True)
class RunningProgram:
    """A process: who began it, and the words of its command."""

    parent: int
    words: tuple[str, ...]

    def has(self, mark: str) -> bool:
        """The mark stands in one of its words."""
        return any(mark in word for word in self.words)

    def is_of(self, package: str) -> bool:
        """It is an executable of a package, itself or behind its Python."""
        places = map(Path, self.words[:2])
        return any(place.parent.parts[-2:] == ("lib", package) for place in places)


def marked(mark: str, proc: Path = PROC) -> tuple[int, ...]:
    """The processes with this mark that no other one with it has begun; none where /proc hides."""
    programs = dict(_programs(proc))
    found = {pid: each for pid, each in programs.items() if each.has(mark)}
    return tuple(sorted(pid for pid, each in found.items() if each.parent not in found))


def executables_below(roots: tuple[int, ...], package: str, proc: Path = PROC) -> tuple[int, ...]:
    """Executables of a package that descend from these processes, the first one of each line."""
    programs = dict(_programs(proc))
    return tuple(sorted(_first_of(package, {*roots}, programs)))


def _first_of(package: str, roots: set[int], programs: Mapping[int, RunningProgram]) -> set[int]:
    found: set[int] = set()
    while roots:
        born = {pid for pid, each in programs.items() if each.parent in roots}
        ours = {pid for pid in born if programs[pid].is_of(package)}
        found |= ours
        roots = born - ours
    return found


def _programs(proc: Path) -> Iterator[tuple[int, RunningProgram]]:
    with suppress(OSError):
        for folder in proc.iterdir():
            if folder.name.isdigit():
                with suppress(OSError, IndexError, ValueError):
                    yield int(folder.name), _program(folder)


def _program(folder: Path) -> RunningProgram:
    """Raises OSError where it has ended."""
    with (folder / "cmdline").open("rb") as file:
        command = file.read(LONGEST_COMMAND).decode("utf-8", "replace")
    fields = fields_of_stat((folder / "stat").read_bytes())
    return RunningProgram(int(fields[PARENT]), tuple(command.split("\0")))
