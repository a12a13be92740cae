"""Control groups: the kernel's own account of a sandbox's processes and memory, and its bound.

Version 2 has one tree for all controllers, version 1 a tree for each: cgroups(7). A group can be
made by root nearly everywhere, and by others where the machine's owner has handed a part of the
tree to them. Where no group can be made, the sandbox is bounded by rlimits.
"""

from __future__ import annotations

import itertools
import os
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Literal

from roslings.arena.bounds import Bounds

Version = Literal[1, 2]
Bound = Literal["pids", "memory"]
BOUNDS: tuple[Bound, ...] = ("pids", "memory")
Controller = Literal["pids", "memory", "cpu"]
CONTROLLERS: tuple[Controller, ...] = ("pids", "memory", "cpu")
NEEDED = {"pids", "memory"}
WEIGHTS = {1: ("cpu.shares", 1024), 2: ("cpu.weight", 100)}
"""What one process weighs when the processors are shared out."""
PREFIX = "roslings-"
GONE_WITHIN_S = 5.0
_numbers = itertools.count()


@dataclass(frozen=True)
class CgroupTree:
    """A folder in which groups can be made, and what they control."""

    folder: Path
    controllers: tuple[Controller, ...]
    version: Version


@dataclass(frozen=True)
class Group:
    """One sandbox's part of each tree."""

    folders: tuple[Path, ...]

    def command(self, inner: Sequence[str]) -> list[str]:
        """The command that joins the group and then becomes `inner`."""
        if not self.folders:
            return list(inner)
        joins = " && ".join(f'echo $$ > "${n}"' for n in range(1, len(self.folders) + 1))
        script = f'{joins} && shift {len(self.folders)} && exec "$@"'
        places = [str(folder / "cgroup.procs") for folder in self.folders]
        return ["/bin/sh", "-c", script, "sh", *places, *inner]

    def reached(self) -> set[Bound]:
        """The bounds that somebody in the group has met so far."""
        return {name for folder in self.folders for name in BOUNDS if _met(folder, name)}


@contextmanager
def group(trees: Sequence[CgroupTree], bounds: Bounds) -> Iterator[Group]:
    """A group in each tree, gone with the block. Raises OSError where one cannot be made."""
    name = f"{PREFIX}{os.getpid()}-{_began(os.getpid())}-{next(_numbers)}"
    made: list[Path] = []
    try:
        for tree in trees:
            folder = tree.folder / name
            folder.mkdir()
            made.append(folder)
            for controller in tree.controllers:
                _bound(folder, tree.version, controller, bounds)
        yield Group(tuple(made))
    finally:
        for folder in made:
            _remove(folder)


def _bound(folder: Path, version: Version, controller: Controller, bounds: Bounds) -> None:
    if controller == "pids":
        _write(folder / "pids.max", bounds.tasks)
    elif controller == "cpu":
        name, one = WEIGHTS[version]
        _write(folder / name, one * bounds.weight)
    elif version == 1:
        _write(folder / "memory.limit_in_bytes", bounds.memory_bytes)
    else:
        _write(folder / "memory.max", bounds.memory_bytes)
        with suppress(FileNotFoundError):  # a kernel without swap
            _write(folder / "memory.swap.max", 0)


def _write(file: Path, value: int) -> None:
    with file.open("r+") as opened:  # never made: what is not there is not controlled
        opened.write(str(value))


def _met(folder: Path, bound: Bound) -> bool:
    """Whether the kernel refused a process, or ended one for want of memory."""
    if bound == "pids":
        return _number(folder / "pids.events", "max") > 0
    counts = (
        _number(folder / name, "oom_kill") for name in ("memory.events", "memory.oom_control")
    )
    return any(count > 0 for count in counts)


def _number(file: Path, key: str) -> int:
    try:
        lines = file.read_text("ascii").splitlines()
    except OSError:
        return 0
    return next((int(line.split()[1]) for line in lines if line.startswith(f"{key} ")), 0)


def _remove(folder: Path) -> None:
    """The kernel may need a moment until the last process is really gone."""
    until_s = time.monotonic() + GONE_WITHIN_S
    while True:
        try:
            folder.rmdir()
        except FileNotFoundError:
            return
        except OSError:
            if time.monotonic() > until_s:
                return  # the next sweep takes it
            time.sleep(0.005)
        else:
            return


def shares_processors(trees: Sequence[CgroupTree]) -> bool:
    """Whether a group of these is worth the same share, however many processes it has."""
    return any("cpu" in tree.controllers for tree in trees)


def trees() -> tuple[CgroupTree, ...]:
    """Where this process can make groups, for each controller at most one; old ones are swept."""
    found = [tree for tree in _all_trees() if os.access(tree.folder, os.W_OK)]
    for tree in found:
        _sweep(tree.folder)
    return tuple(found)


def _all_trees() -> Iterator[CgroupTree]:
    own = _own_groups()
    for mount in _mounts():
        names = [name for name in CONTROLLERS if name in mount.controllers]
        if mount.version == 2 and "" in own:
            yield from _beside(mount, own[""])
        elif names and names[0] in own:
            yield CgroupTree(mount.folder_of(own[names[0]]), tuple(names), 1)


def _beside(mount: Mount, own: str) -> Iterator[CgroupTree]:
    """In version 2 a group that has processes has no children: beside it, or further up.

    Source: Linux, Documentation/admin-guide/cgroup-v2.rst, "No Internal Process Constraint".
    """
    folder = mount.folder_of(own)
    for each in (folder, *folder.parents):
        handed_down = _words(each / "cgroup.subtree_control")
        if handed_down >= NEEDED and os.access(each, os.W_OK):
            yield CgroupTree(each, tuple(name for name in CONTROLLERS if name in handed_down), 2)
            return
        if each == mount.place:
            return


def _words(file: Path) -> set[str]:
    try:
        return set(file.read_text("ascii").split())
    except OSError:
        return set()


def _own_groups() -> dict[str, str]:
    """Controller to our own group; the one of version 2 under an empty name."""
    found = {}
    for line in Path("/proc/self/cgroup").read_text("utf-8").splitlines():
        _, names, path = line.split(":", 2)
        found.update(dict.fromkeys(names.split(","), path))
    return found


@dataclass(frozen=True)
class Mount:
    """One mounted tree."""

    root: str
    place: Path
    version: Version
    controllers: frozenset[str]
    """Of version 1, where each tree has its own."""

    def folder_of(self, group: str) -> Path:
        """Where a group of this tree lies."""
        return Path(os.path.normpath(self.place / os.path.relpath(group, self.root)))


def _mounts() -> Iterator[Mount]:
    """Every mounted tree of groups: proc_pid_mountinfo(5)."""
    for line in Path("/proc/self/mountinfo").read_text("utf-8").splitlines():
        before, _, after = line.partition(" - ")
        root, place = before.split()[3:5]
        kind, _, options = after.split(" ", 2)
        if kind in ("cgroup", "cgroup2"):
            version: Version = 1 if kind == "cgroup" else 2
            yield Mount(root, Path(place), version, frozenset(options.split(",")))


def _sweep(folder: Path) -> None:
    """Remove the groups of processes that were killed before they could."""
    for left in folder.glob(f"{PREFIX}*-*-*"):
        _, pid, began, _ = left.name.split("-")
        if _began(int(pid)) != began:
            with suppress(OSError):
                left.rmdir()


def _began(pid: int) -> str:
    """When a process began, in ticks: with its number, a name that is never used again."""
    try:
        words = Path(f"/proc/{pid}/stat").read_text("utf-8", "replace").rpartition(")")[2].split()
    except OSError:
        return ""
    return words[19]
