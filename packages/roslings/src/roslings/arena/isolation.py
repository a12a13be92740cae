"""Which walls this machine allows between the student's nodes and everybody else's.

`namespace`: a network of its own, where only loopback exists: nothing can come in or go out.
`domain`: a leased ROS domain with discovery kept on this machine; for kernels that refuse more.
Behind the first, and where bubblewrap is installed, a sandbox stands around each process too.
`user`: for others' submissions where there is no such sandbox, and only as root.
"""

from __future__ import annotations

import os
import shutil
import subprocess
import sys
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path

from ros2_on_pip.errors import RoslingsError
from roslings.arena import cgroup, kernel, ways
from roslings.arena.bounds import MB, kernel_counts_by_namespace
from roslings.arena.environment import HERE, Wall
from roslings.arena.sandbox import SETPRIV, Sandbox, is_open_to_all
from roslings.arena.users import VIEW, Lack, User, lack_of_users, leased_user, unreadable_to_others

ENTER = HERE / "enter.py"
GUARD = """
import gc, sys
gc.disable()
sys.path.insert(0, sys.argv[1])
import guardian
guardian.main(int(sys.argv[2]))
"""
"""As a module, not as a script: a script is compiled anew each time."""
BARE = (sys.executable, "-I", "-S")
"""A Python without site packages: quick to start, and without the threads that forbid unshare."""

OPEN_UMASK = 0o022
"""What is made for a leased user can be read by it."""
CLOSED_TMPDIR = "other users may not enter the folder for temporary files (TMPDIR)"
ROOM_BYTES = 512 * MB
"""For one package's build and installation."""
TRIED_WITHIN_S = 60


def guardian_command(channel: int) -> list[str]:
    """Start a guardian; `channel` is its end of a stream socket pair."""
    return [*BARE, "-c", GUARD, str(HERE), str(channel)]


@dataclass(frozen=True)
class Isolation:
    """The walls that are used, and why they are not better ones."""

    wall: Wall
    because: str = ""
    sandbox: Sandbox | None = None
    lack: Lack | None = None
    """None where each process is in a sandbox, and all that it can take is bounded."""
    leases: bool = False
    """Whether root leases a user for each grading, who the processes in its sandboxes are."""
    as_root: str = ""
    """Why they are root outside, though without its rights, where they are."""

    def command(self, inner: Sequence[str], room: Path | None = None) -> list[str]:
        """The command that runs `inner` behind this wall.

        With a sandbox, `room` is an empty folder, which then holds ROOM_BYTES at most. It is seen
        by `inner` and its children only, and is gone with them.
        """
        if self.wall != "namespace":
            return list(inner)
        roomy = ["--room", str(room), str(ROOM_BYTES)] if self.sandbox and room else []
        return [*BARE, str(ENTER), *roomy, *inner]

    def enter(self, room: Path, sandbox: Sandbox | None) -> None:
        """Go behind this wall with this process, as `command` does. Raises OSError.

        It must have one thread only: a fork has, whatever its parent has.
        """
        if self.wall != "namespace":
            return
        if sandbox and sandbox.view:
            os.umask(OPEN_UMASK)
            kernel.enter_with_room(str(room), ROOM_BYTES, sandbox.other, str(sandbox.view))
        elif sandbox:
            kernel.enter_with_room(str(room), ROOM_BYTES)
        else:
            kernel.enter()

    def sandbox_of(self, user: User | None) -> Sandbox | None:
        """What stands around the processes of one grading, which are this user outside."""
        if not (self.leases and self.sandbox and user):
            return self.sandbox
        return self.sandbox.held_by(user.uid, view_of(user))

    @contextmanager
    def user(self) -> Iterator[User | None]:
        """Who runs the code of one grading; None where that is ourselves. Raises NoFreeUser."""
        if self.wall == "user" or self.leases:
            with leased_user(in_sandboxes=self.leases) as user:
                yield user
        else:
            yield None


CHOICE = "ROSLINGS_ISOLATION"
"""`domain` does without namespaces; `user` takes, for others' submissions, a user of its own where
a sandbox could be had too."""


def choose_isolation() -> Isolation:
    """Namespaces where the kernel allows them, for what one runs of one's own."""
    if os.environ.get(CHOICE) == "domain":
        because = f"{CHOICE} asks for it"
        return Isolation("domain", because, lack=Lack(because, "Leave that variable out."))
    return _best()


def isolation_for_strangers() -> Isolation:
    """The best wall there is for somebody else's submission; it says so where none holds."""
    if os.environ.get(CHOICE) == "user":
        return _as_user()
    best = _leasing() if os.geteuid() == 0 else choose_isolation()
    if best.lack is None or CHOICE in os.environ or os.geteuid() != 0:
        return best
    user = _as_user()
    if user.lack is None:
        return user
    both = f"{best.lack.reason}; and no user of its own can hold it: {user.lack.reason}"
    return replace(best, lack=Lack(both, f"{best.lack.next_step}\nOr: {user.lack.next_step}"))


def _leasing() -> Isolation:
    """As `choose_isolation`, with a leased user behind each sandbox where that can be had."""
    best = choose_isolation()
    return _with_leased_user() if best.sandbox else best


@cache
def _with_leased_user() -> Isolation:
    """The kernel bounds the processes of a user who is not root, with or without a group."""
    best = _best()
    refusal = "" if Path(SETPRIV).exists() else f"there is no {SETPRIV}"
    if refusal := refusal or unreadable_to_others() or _refusal_of_leased_user(best):
        return replace(best, as_root=refusal)
    return replace(best, leases=True, lack=None if kernel_counts_by_namespace() else best.lack)


def _refusal_of_leased_user(best: Isolation) -> str:
    """Why no sandbox stands up that is another user's outside; empty where one does."""
    assert best.sandbox
    try:
        with tempfile.TemporaryDirectory() as room, leased_user(True) as user:
            sandbox = best.sandbox.held_by(user.uid, view_of(user))
            shown = [word for pair in sandbox.to_be_shown() for word in ("--show", *map(str, pair))]
            other = ["--other", str(user.uid), str(sandbox.view), *shown]
            inner = sandbox.command([*BARE, "-c", "pass"])
            command = [*BARE, str(ENTER), "--room", room, str(ROOM_BYTES), *other, *inner]
            return _tried(command) if is_open_to_all(user.folder) else CLOSED_TMPDIR
    except (OSError, RoslingsError) as error:
        return str(error)


def view_of(user: User) -> Path:
    """A folder for what a user is shown of what lies where it may not go."""
    view = user.folder / VIEW
    view.mkdir(mode=0o711, exist_ok=True)
    return view


def _as_user() -> Isolation:
    return Isolation("user", lack=lack_of_users())


@cache
def _best() -> Isolation:
    if refusal := _refusal():
        return Isolation("domain", refusal, lack=_lack_of_namespaces(refusal))
    program = shutil.which("bwrap")
    if program is None:
        step = "Install it: sudo apt install bubblewrap"
        return Isolation("namespace", lack=Lack("bubblewrap is not installed", step))
    best = Isolation("namespace", sandbox=Sandbox(Path(program), cgroup.trees()))
    if refusal := _refusal_of_sandbox(best):
        lack = Lack(f"bubblewrap cannot work: {refusal}", ways.to_a_sandbox(ways.facts()))
        return Isolation("namespace", lack=lack)
    return Isolation("namespace", sandbox=best.sandbox, lack=_lack_of_bounds(best.sandbox))


def _lack_of_namespaces(refusal: str) -> Lack:
    reason = f"this system allows no namespaces of one's own ({refusal})"
    return Lack(reason, ways.to_namespaces(ways.facts()))


def _lack_of_bounds(sandbox: Sandbox | None) -> Lack | None:
    """A process of root's is bounded by a control group only: RLIMIT_NPROC leaves root alone."""
    controlled = {name for tree in (sandbox.trees if sandbox else ()) for name in tree.controllers}
    if "pids" in controlled or (os.getuid() != 0 and kernel_counts_by_namespace()):
        return None
    return Lack("nothing here bounds the number of processes", ways.to_bounds(ways.facts()))


def _refusal() -> str:
    """Why this machine refuses namespaces; empty where it does not."""
    if sys.platform != "linux":
        return "only Linux has them"
    return _tried([*BARE, str(ENTER), "--try"])


def _refusal_of_sandbox(isolation: Isolation) -> str:
    """Why no sandbox stands up here; empty where one does."""
    assert isolation.sandbox
    try:
        with (
            tempfile.TemporaryDirectory() as room,
            isolation.sandbox.around(["/bin/sh", "-c", "exit 0"]) as (command, _),
        ):
            return _tried(isolation.command(command, Path(room)))
    except OSError as error:
        return str(error)


def _tried(command: Sequence[str]) -> str:
    tried = subprocess.run(
        command, capture_output=True, text=True, check=False, timeout=TRIED_WITHIN_S
    )
    if tried.returncode == 0:
        return ""
    words = tried.stderr.strip().splitlines()
    return ways.in_words(words[-1], ways.facts()) if words else "the kernel refused"
