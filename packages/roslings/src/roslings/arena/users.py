"""An unprivileged user of its own for each grading: the wall where root may make no namespaces.

The user has no name, no home and no group. It can read what everybody can, and write only into the
folders that it is given. All its processes are ended, and all its files removed, before its number
is leased again. Its network is the machine's: that this wall does not stop.
"""

from __future__ import annotations

import fcntl
import os
import pwd
import re
import shutil
import socket
import stat
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field, replace
from functools import cache
from pathlib import Path
from typing import IO

from ros2_on_pip.errors import INCONCLUSIVE, RoslingsError
from roslings.arena import cgroup, reach
from roslings.arena.bounds import Bounds
from roslings.arena.environment import HERE, base_environment

USERS = range(64200, 65000)
"""Below 65536, for containers have no more; and of nobody: 60000 to 64999 are given on demand
(Debian Policy 9.2.2). Whose turn was longest ago comes first: no class meets one of them twice."""
LEASES = Path("/run/roslings-users")
PREFIX = "roslings-user-"
VIEW = "view"
"""Of a sandbox's user: a folder in which it is shown what lies where only root may go."""
TRIED_WITHIN_S = 60
GONE_WITHIN_S = 10.0
BARE = (sys.executable, "-I", "-S")
END_ALL = "import os; os.kill(-1, 9)"
FORGET_KEYS = f"""
import sys
sys.path.insert(0, {str(HERE)!r})
import kernel
kernel.forget_keys()
"""
KEYS = {"shm": "-m", "msg": "-q", "sem": "-s"}
"""System V's shared memory, queues and semaphores: proc(5), and what ipcrm(1) calls them."""


@dataclass(frozen=True)
class Lack:
    """Why strangers' code cannot be held here, and what to do."""

    reason: str
    next_step: str


class NoFreeUser(RoslingsError):
    """Every user of the range is taken."""

    exit_status = INCONCLUSIVE

    def __init__(self) -> None:
        super().__init__("Too many gradings run on this machine at once. Wait for one to end.")


@dataclass(frozen=True)
class User:
    """Who runs a stranger's code in one grading, where it may write, and what it may take."""

    uid: int
    folder: Path
    """Root's own; in it lie the user's folders."""
    trees: tuple[cgroup.CgroupTree, ...] = ()
    bounds: Bounds = field(default_factory=Bounds)
    shown: tuple[Path, ...] = ()
    closed: tuple[str, ...] = ()
    """Of the places where every user may leave files: those that it cannot reach."""

    def showing(self, *paths: Path) -> User:
        """The same, with more to be read."""
        return replace(self, shown=(*self.shown, *paths))

    @property
    def reach(self) -> dict[str, object] | None:
        """What it may reach of the disk, in the words of kernel.confine(); None: all that is open.

        Neither the course nor another copy of it is among it, whoever may read those.
        """
        if not (rules := reach.rules(self.folder, self.shown, self.closed)):
            return None
        version = reach.landlock_version()
        scopes = reach.SCOPES if version >= reach.SCOPES_SINCE else 0
        return {"rules": rules, "rights": reach.everything(version), "scopes": scopes}

    @property
    def watch(self) -> dict[str, int]:
        """What the guardian watches; files it cannot count, for the disk is everybody's."""
        return self.bounds.watch

    @property
    def limits(self) -> dict[str, int]:
        """The kernel counts the processes of a user who is not root, and this one has no others."""
        return {**self.bounds.limits(), "RLIMIT_NPROC": self.bounds.tasks}

    @contextmanager
    def around(self, inner: Sequence[str]) -> Iterator[tuple[list[str], cgroup.Group]]:
        """The command that runs `inner`, and the group that counts what it takes."""
        with cgroup.group(self.trees, self.bounds) as group:
            yield group.command(inner), group


def give(folder: Path, uid: int) -> None:
    """A folder, and all that we put into it, belongs to the user from now on."""
    for at, folders, files in os.walk(folder):
        for name in (at, *(str(Path(at, each)) for each in (*folders, *files))):
            os.chown(name, uid, uid, follow_symlinks=False)
    folder.chmod(0o700)


def let_in(folder: Path, uid: int) -> None:
    """The user may enter a folder of ours, whose devices its group may use."""
    os.chown(folder, -1, uid)
    folder.chmod(0o710)


@contextmanager
def leased_user(in_sandboxes: bool = False) -> Iterator[User]:
    """A user whom nobody else is, until the block ends. Raises NoFreeUser, OSError.

    Whose processes all live `in_sandboxes` leaves no file outside, and no keys.
    """
    sweep = _leave_no_process if in_sandboxes else _leave_nothing
    with _lease() as uid:
        sweep(uid)
        _sweep_abandoned(sweep)
        folder = Path(tempfile.mkdtemp(prefix=f"{PREFIX}{uid}-"))
        try:
            folder.chmod(0o711)
            yield User(uid, folder, cgroup.trees())
        finally:
            sweep(uid)


@contextmanager
def _lease() -> Iterator[int]:
    """The lock is the kernel's: it ends with those who hold it, however they end."""
    LEASES.mkdir(mode=0o700, exist_ok=True)
    for uid in sorted(USERS, key=_leased_ns):
        if _is_somebody(uid):
            continue
        with (LEASES / str(uid)).open("w") as lock:
            if _taken(lock) and _ended(uid):  # a grading that was killed could not end it
                os.utime(lock.fileno())
                yield uid
                return
    raise NoFreeUser


def _sweep_abandoned(sweep: Callable[[int], None]) -> None:
    """What is left of users whose grading was killed: nobody holds their lease any more."""
    for folder in Path(tempfile.gettempdir()).glob(f"{PREFIX}*-*"):
        number = folder.name.removeprefix(PREFIX).partition("-")[0]
        if number.isdecimal() and int(number) in USERS:
            with (LEASES / number).open("a") as lock:
                if _taken(lock):
                    sweep(int(number))


def _leased_ns(uid: int) -> int:
    """When it was leased last; 0 where it never was."""
    with suppress(OSError):
        return (LEASES / str(uid)).stat().st_mtime_ns
    return 0


def _taken(lock: IO[str]) -> bool:
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        return False
    return True


def _is_somebody(uid: int) -> bool:
    try:
        pwd.getpwuid(uid)
    except KeyError:
        return False
    return True


# --- nothing stays -----------------------------------------------------------------------------


def _leave_no_process(uid: int) -> None:
    """Nor the folders of ours that were made for the user, which are empty here.

    In a grading's own mounts its view shows Python itself. So nothing but an empty folder is
    taken away: whoever comes here from inside removes nothing.
    """
    _ended(uid)
    for folder in Path(tempfile.gettempdir()).glob(f"{PREFIX}{uid}-*"):
        for each in (folder / VIEW, folder):
            with suppress(OSError):
                each.rmdir()


def _leave_nothing(uid: int) -> None:
    """End all that the user runs, and remove all that it left where everybody may."""
    _ended(uid)
    for folder in Path(tempfile.gettempdir()).glob(f"{PREFIX}{uid}-*"):
        _remove(folder)
    for place in reach.OPEN_TO_ALL:
        for path in _files_of(uid, place):
            _remove(path)
    for kind, option in KEYS.items():
        for number in _keys_of(kind, uid):
            subprocess.run(["ipcrm", option, number], check=False, capture_output=True)
    with suppress(OSError, subprocess.SubprocessError):
        _run_as(uid, [*BARE, "-c", FORGET_KEYS])


def _files_of(uid: int, place: str) -> Iterator[Path]:
    """All that the user left there, in folders of others too, whole folders as one."""
    try:
        entries = [*os.scandir(place)]
        may_write = os.stat(place).st_mode & stat.S_IWOTH  # noqa: PTH116
    except OSError:
        return
    for entry in entries:
        with suppress(OSError):
            folder = entry.is_dir(follow_symlinks=False)
            if not (folder or may_write):
                continue
            found = entry.stat(follow_symlinks=False)
            if found.st_uid == uid:
                yield Path(entry.path)
            elif folder and found.st_mode & stat.S_IXOTH:
                yield from _files_of(uid, entry.path)


def _ended(uid: int) -> bool:
    """End all that the user runs; whether nothing of it is left."""
    until_s = time.monotonic() + GONE_WITHIN_S
    while _runs(uid) and time.monotonic() < until_s:
        _run_as(uid, [*BARE, "-c", END_ALL])
    return not _runs(uid)


def _remove(path: Path) -> None:
    """Nothing where something is mounted below: to remove that would remove what it shows."""
    if is_mounted_below(path):
        return
    if path.is_dir() and not path.is_symlink():
        shutil.rmtree(path, ignore_errors=True)
    else:
        path.unlink(missing_ok=True)


def is_mounted_below(path: Path) -> bool:
    """Whether a mount of this process's lies there, or below; proc_pid_mountinfo(5)."""
    try:
        rows = Path("/proc/self/mountinfo").read_text("utf-8", "surrogateescape").splitlines()
    except OSError:
        return True
    resolved = path.resolve()
    return any(_unescaped(row.split()[4]).is_relative_to(resolved) for row in rows)


def _unescaped(mounted_at: str) -> Path:
    """The kernel writes a space, a tab, a line's end and a backslash as three octal digits."""
    return Path(re.sub(r"\\([0-7]{3})", lambda found: chr(int(found[1], 8)), mounted_at))


def _runs(uid: int) -> bool:
    """Whether a process of the user's is there, one that only waits to be collected excepted."""
    for name in filter(str.isdigit, os.listdir("/proc")):  # noqa: PTH208
        with suppress(OSError):
            words = Path("/proc", name, "status").read_text("utf-8", "replace")
            values = dict(line.split(":\t", 1) for line in words.splitlines() if ":\t" in line)
            if str(uid) in values["Uid"].split() and not values["State"].startswith("Z"):
                return True
    return False


def _keys_of(kind: str, uid: int) -> list[str]:
    """Numbers of what the user owns of one kind: sysvipc(7), proc_sysvipc(5)."""
    try:
        lines = Path("/proc/sysvipc", kind).read_text("ascii").splitlines()
    except OSError:
        return []
    head, *rows = ([*map(str.strip, line.split())] for line in lines)
    tables = (dict(zip(head, row, strict=False)) for row in rows)
    return [table[f"{kind}id"] for table in tables if str(uid) in (table["uid"], table["cuid"])]


# --- can it be had? ----------------------------------------------------------------------------


def _run_as(uid: int, command: Sequence[str]) -> subprocess.CompletedProcess[str]:
    """Raises OSError, subprocess.SubprocessError."""
    return subprocess.run(
        command,
        user=uid,
        group=uid,
        extra_groups=(),
        cwd="/",
        check=False,
        capture_output=True,
        text=True,
        env=base_environment(Path("/nonexistent")),
        timeout=TRIED_WITHIN_S,
    )


@cache
def lack_of_users() -> Lack | None:
    """Why strangers' code cannot be held by a user of its own here; None where it can."""
    if sys.platform != "linux" or os.geteuid() != 0:
        return Lack("only root can make one", "Run the command as root, in the platform's image.")
    for place in _needed():
        if lack := _lack_above(place) or _lack_within(place):
            return lack
    return _tried()


def _python() -> Path:
    return Path(os.path.realpath(sys.executable))


def _lack_above(place: Path) -> Lack | None:
    """On the way there: closed to others, or others may put something else in its place."""
    for folder in (place, *place.parents):
        mode = folder.stat().st_mode
        if not mode & stat.S_IXOTH:
            return _closed(folder)
        if mode & stat.S_IWOTH and not mode & stat.S_ISVTX:
            return _writable(folder)
    return None


def _lack_within(place: Path) -> Lack | None:
    """Python's own files, ROS's and ours."""
    for path, mode in _modes_within(place):
        if mode & stat.S_IWOTH:
            return _writable(path)
        if not mode & stat.S_IROTH:
            return _closed(path)
    return None


def _modes_within(place: Path) -> Iterator[tuple[Path, int]]:
    """Of all folders and files, not of links; of the system's own its distribution sees to it."""
    if place != Path("/usr"):
        for at, folders, files in os.walk(place):
            for name in (*folders, *files):
                path = os.path.join(at, name)  # noqa: PTH118
                mode = os.lstat(path).st_mode
                if not stat.S_ISLNK(mode):
                    yield Path(path), mode


def unreadable_to_others() -> str:
    """A file of Python's, ROS's or ours that another user cannot read, however it comes there."""
    for place in _needed():
        if lack := _unreadable_within(place):
            return lack.reason
    return ""


def _needed() -> list[Path]:
    return [*dict.fromkeys([HERE, Path(sys.prefix), Path(sys.base_prefix), _python().parent])]


def _unreadable_within(place: Path) -> Lack | None:
    modes = _modes_within(place)
    return next((_closed(path) for path, mode in modes if not mode & stat.S_IROTH), None)


def _closed(path: Path) -> Lack:
    """A home is never to be opened: whatever else lies there is nobody's matter."""
    opens = "" if _is_a_home(path) else f",\nor open it: chmod o+rX {path}"
    return Lack(
        f"another user cannot read {path}, and Python or ROS lies there",
        "Put roslings and its Python where every user can read them, for example below /opt"
        f"{opens or '.'}",
    )


def _is_a_home(path: Path) -> bool:
    """Somebody's, or a folder in which such lie."""
    homes = [Path(each.pw_dir) for each in pwd.getpwall()]
    return any(path == home or path in home.parents for home in (*homes, Path.home()))


def _writable(path: Path) -> Lack:
    return Lack(f"everybody can write {path}, and Python runs from there", f"chmod o-w {path}")


def _tried() -> Lack | None:
    """Prove that the kernel lets root be somebody else, and that Python starts for that user."""
    if not _hears_itself():
        return Lack("there is no loopback network", "Bring it up: ip link set lo up")
    try:
        tried = _run_as(USERS[-1], [sys.executable, "-c", "pass"])
    except (OSError, subprocess.SubprocessError, ValueError) as error:
        return Lack(f"root cannot be another user here ({error})", NOT_HERE)
    if tried.returncode == 0:
        return None
    words = tried.stderr.strip().splitlines() or ["Python does not start for another user"]
    return Lack(words[-1], NOT_HERE)


def _hears_itself() -> bool:
    """A container without a network has 127.0.0.1 as a rule; without it no node hears another."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as end, suppress(OSError):
        end.connect(("127.0.0.1", 9))
        return True
    return False


NOT_HERE = "Grade on a machine, or in a container, with the usual rights of root."
