"""A sandbox for strangers' code, made by bubblewrap: what may be seen is listed, nothing is hidden.

Inside are the system's programs, Python with its packages, and the one submission. What stands in
for packages of ROS that are not installed is there, too. No home, no course, no grader and no other
submission is inside. Of the network only the loopback of the arena exists.
"""

from __future__ import annotations

import os
import stat
import sys
from collections.abc import Iterator, Mapping, Sequence
from compileall import compile_file
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from functools import cache
from hashlib import sha256
from importlib.util import cache_from_source
from pathlib import Path
from threading import Lock

import ros2_on_pip
from ros2_on_pip.profiles import QUICK_DISCOVERY
from roslings.arena import cgroup, kernel
from roslings.arena.bounds import MB, Bounds
from roslings.arena.environment import HERE, LOSSY_LINK, PACED, base_environment

SETPRIV = "/usr/bin/setpriv"
"""Of util-linux."""
USER = "1000"
"""The same for everybody, as in arena/etc."""

SYSTEM = ("/bin", "/sbin", "/lib", "/lib32", "/lib64", "/libx32")
"""Beside /usr; most systems have them as symbolic links into it."""
SETTINGS = ("ld.so.cache", "ld.so.conf", "ld.so.conf.d", "alternatives", "localtime", "fonts")
OWN_SETTINGS = {name: HERE / "etc" / name for name in ("passwd", "group")}
GUARDIAN = tuple(HERE / name for name in ("guardian.py", "kernel.py", "refusals.py"))
ROS2 = Path(ros2_on_pip.__file__).parent
STAND_INS = tuple(ROS2 / name for name in ("__init__.py", "rosbag2", "stand_ins"))
"""Packages of ROS that no wheel brings, and what they stand on."""
KERNEL_SETTINGS = (
    "sys",
    "irq",
    "bus",
    "acpi",
    "fs",
    "scsi",
    "tty",
    "pressure",
    "sysrq-trigger",
    "mtrr",
)
"""Of /proc; what is written there holds for the whole machine."""
COVERED = (
    "keys",
    "key-users",
    "kcore",
    "kmsg",
    "kpagecgroup",
    "kpagecount",
    "kpageflags",
    "pagetypeinfo",
    "sched_debug",
    "slabinfo",
    "timer_list",
    "vmallocinfo",
)
"""Of /proc; keys of whoever runs the command, and what only root reads."""
PROC = Path("/proc")
SHARED_MEMORY_BYTES = 64 * MB
_showing = Lock()
"""Experiments run side by side, and are shown the same."""
LISTS_OF_FOLDERS = ("AMENT_PREFIX_PATH", "LD_LIBRARY_PATH", "PYTHONPATH")


@dataclass(frozen=True)
class Sandbox:
    """What one process, and all that it starts, may see, write and take."""

    program: Path
    """bubblewrap itself."""
    trees: tuple[cgroup.CgroupTree, ...] = ()
    shown: tuple[Path, ...] = ()
    written: tuple[tuple[Path, Path], ...] = ()
    """Folders that it may write: where each lies, and where the process sees it."""
    home: Path | None = None
    """A folder of its own, empty at first and gone at its end."""
    other: int | None = None
    """The leased user who its processes are outside, where root grades; None: who grades."""
    view: Path | None = None
    """A folder of that user's, in which it is shown what lies where only root may go."""
    terminals: bool = False
    """Whether it sees our pseudo-terminals, of which one may be a board's port. Only for a process
    that Isolation.command() has put into a room: that one's /dev/pts holds nobody else's."""
    bounds: Bounds = field(default_factory=Bounds)

    def showing(self, *paths: Path) -> Sandbox:
        """The same, with more to be seen."""
        return replace(self, shown=(*self.shown, *paths))

    def writing(self, lies: Path, seen: Path) -> Sandbox:
        """The same, with a folder that may be written."""
        return replace(self, written=(*self.written, (lies, seen)))

    @property
    def watch(self) -> dict[str, int]:
        """What the guardian watches: who meets these bounds is ended, all of it."""
        return {**self.bounds.watch, "files": self.bounds.files}

    def held_by(self, other: int, view: Path) -> Sandbox:
        """The same, whose processes are another user outside."""
        return replace(self, other=other, view=view)

    @contextmanager
    def around(
        self, inner: Sequence[str], tells: int | None = None
    ) -> Iterator[tuple[list[str], cgroup.Group]]:
        """The command that runs `inner` inside, and the group that counts what it takes.

        Into the descriptor `tells` bubblewrap writes, as JSON, which process that is.
        Raises OSError where what is to be seen cannot be shown.
        """
        with cgroup.group(self.trees, self.bounds) as group:
            with _showing:
                for path, place in self.to_be_shown():
                    if not place.exists():
                        kernel.show(str(path), str(place), self._is_written(path))
            yield group.command(self.command(inner, tells)), group

    def command(self, inner: Sequence[str], tells: int | None = None) -> list[str]:
        """bubblewrap's; the other user, where there is one, starts it."""
        info = [] if tells is None else ["--info-fd", str(tells)]
        return [*self._as_other(), *self._walls(), *info, *self._view(), "--", *inner]

    def _as_other(self) -> list[str]:
        if self.other is None:
            return []
        who = str(self.other)
        return [SETPRIV, "--reuid", who, "--regid", who, "--clear-groups", "--no-new-privs", "--"]

    def to_be_shown(self) -> Iterator[tuple[Path, Path]]:
        """What lies where the other user may not go, and where it is shown instead."""
        sources = [
            *_system(),
            *self.shown,
            *OWN_SETTINGS.values(),
            *(lies for lies, _ in self.written),
        ]
        for path in sources:
            if (place := self._seen_at(path)) != path:
                yield path, place

    def _is_written(self, path: Path) -> bool:
        return any(path == lies for lies, _ in self.written)

    def _seen_at(self, path: Path) -> Path:
        """Where bubblewrap finds it: the folder that is there now, if there was another before."""
        if self.view is None or is_open_to_all(path):
            return path
        found = path.stat()
        return self.view / sha256(f"{path} {found.st_dev} {found.st_ino}".encode()).hexdigest()

    def _walls(self) -> list[str]:
        return [
            str(self.program),
            "--unshare-user",
            "--uid",
            USER,
            "--gid",
            USER,
            "--unshare-pid",
            "--unshare-ipc",
            "--unshare-uts",
            "--unshare-cgroup-try",
            "--hostname",
            "roslings",
            "--cap-drop",
            "ALL",
            "--new-session",
            "--die-with-parent",
            "--as-pid-1",
        ]

    def _view(self) -> Iterator[str]:
        """The mounts, in their order: what comes later lies over what comes earlier."""
        yield from ("--proc", "/proc", *_settings_and_keys(), "--dev", "/dev")
        if self.terminals:
            yield from ("--dev-bind", "/dev/pts", "/dev/pts")
        yield from _empty(Path("/dev/shm"), SHARED_MEMORY_BYTES)
        yield from _empty(Path("/tmp"), self.bounds.home_bytes)
        for path in [*_system(), *self.shown]:
            yield from ("--ro-bind", str(self._seen_at(path)), str(path))
        for name, file in OWN_SETTINGS.items():
            yield from ("--ro-bind", str(self._seen_at(file)), f"/etc/{name}")
        for link, target in _links():
            yield from ("--symlink", target, link)
        for lies, seen in self.written:
            yield from ("--bind", str(self._seen_at(lies)), str(seen))
        if self.home:
            yield from _empty(self.home, self.bounds.home_bytes)
        yield from ("--remount-ro", "/dev", "--remount-ro", "/")


def _settings_and_keys() -> Iterator[str]:
    """The kernel's settings are the whole machine's, and can be read; what is root's is empty.

    Where root grades, the kernel takes the process for root as soon as it opens one of them. The
    kernel does not ask for its rights, of which it has none (sysctl_perm), only for its user.
    `bubblewrap` leaves these folders open, for the folders themselves nobody can write. A kernel
    may be built without.
    """
    for name in KERNEL_SETTINGS:
        yield from ("--ro-bind-try", str(PROC / name), str(PROC / name))
    for path in (PROC / name for name in COVERED):
        if path.exists():
            yield from ("--ro-bind", os.devnull, str(path))


def is_open_to_all(path: Path) -> bool:
    """Every user may go there; what lies below is asked by nobody here."""
    try:
        return all(folder.stat().st_mode & stat.S_IXOTH for folder in path.parents)
    except OSError:
        return False


def _empty(place: Path, most_bytes: int) -> Iterator[str]:
    yield from ("--size", str(most_bytes), "--tmpfs", str(place))


def _system() -> Iterator[Path]:
    yield Path("/usr")
    yield from _once_for_all()
    yield from installations(base_environment(Path("/tmp")))


@cache
def _once_for_all() -> tuple[Path, ...]:
    """What every process may see of the system, and what a guardian needs of the engine."""
    folders = [Path(name) for name in SYSTEM if not Path(name).is_symlink()]
    settings = [Path("/etc", name) for name in SETTINGS]
    guardian = [*GUARDIAN, *map(compiled, GUARDIAN)]
    shown = [*folders, *settings, QUICK_DISCOVERY, PACED, LOSSY_LINK, *guardian, *STAND_INS]
    return tuple(filter(Path.exists, shown))


def compiled(module: Path) -> Path:
    """Where Python keeps the module compiled, which no guardian could write; made where it lacks.

    An installation that nobody may write goes without.
    """
    compile_file(module, quiet=2)
    return Path(cache_from_source(str(module)))


@cache
def _links() -> list[tuple[str, str]]:
    return [(name, str(Path(name).readlink())) for name in SYSTEM if Path(name).is_symlink()]


def installations(environment: Mapping[str, str]) -> tuple[Path, ...]:
    """Where Python, its packages and ROS lie, as far as that is not within /usr.

    Each is a whole prefix, or a folder that a variable of `environment` names: ours, never one
    that a build has made.
    """
    return _outermost(tuple(environment.get(name, "") for name in LISTS_OF_FOLDERS))


@cache
def _outermost(lists: tuple[str, ...]) -> tuple[Path, ...]:
    """The prefixes, and those of the listed folders that lie in no other."""
    folders = [Path(part) for each in lists for part in each.split(os.pathsep) if part]
    python = [
        Path(sys.base_prefix),
        Path(sys.prefix),
        Path(os.path.realpath(sys.executable)).parent,
    ]
    found: list[Path] = []
    for path in [*python, *folders]:
        inside = any(path.is_relative_to(other) for other in (Path("/usr"), *found))
        if path.is_absolute() and path.is_dir() and not inside:
            found.append(path)
    return tuple(found)
