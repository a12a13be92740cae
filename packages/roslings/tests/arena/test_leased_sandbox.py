"""Where root grades, a sandbox's processes are a leased user's outside, or a reason is told."""

from __future__ import annotations

import os
import subprocess
import sys
import textwrap
from collections.abc import Iterator
from pathlib import Path

import pytest

from roslings.arena import isolation, isolation_for_strangers
from roslings.arena.users import USERS
from skips import needs

needs_root_and_sandbox = needs("root", "namespaces", "bubblewrap", "setpriv")

NUMBERS_OUTSIDE = """
    import os, sys, traceback
    from dataclasses import replace
    from pathlib import Path
    from tempfile import TemporaryDirectory
    from roslings.arena import Launch, Process, isolation_for_strangers, base_environment

    def numbers_of(pids):
        for pid in pids:
            for line in Path("/proc", pid, "status").read_text().splitlines():
                if line.startswith(("Uid", "Gid")):
                    yield from line.split()[1:]

    def says_it(pid, says):
        try:
            told = Path("/proc", pid, "cmdline").read_bytes()
        except FileNotFoundError:  # somebody else's process, which has ended since it was listed
            return False
        return told.endswith(says.encode() + b"\\0") and pid != str(os.getpid())

    def look(walls, held, room, home):
        walls.enter(room, held)
        says = "import os; print(os.getuid(), os.getgid(), os.getgroups()); import rclpy; input()"
        command = [sys.executable, "-c", says]
        launch = Launch(command, base_environment(home), home, True, sandbox=held)
        with Process("it", launch) as it:
            it.wait_until(lambda: bool(it.lines()), 60)
            print("inside", *(line.text for line in it.lines()))
            there = [pid for pid in os.listdir("/proc") if pid.isdigit() and says_it(pid, says)]
            print("outside", *sorted(set(numbers_of(there))))

    walls = isolation_for_strangers()
    print("why", walls.as_root, flush=True)
    with TemporaryDirectory() as name, walls.user() as user:
        room, home = Path(name, "room"), Path(name, "home")
        room.mkdir(); home.mkdir()
        held = replace(walls.sandbox_of(user), home=home)
        child = os.fork()  # as in a grading: who tidies is never where things are mounted
        if child == 0:
            try:
                look(walls, held, room, home)
                sys.stdout.flush()
            except BaseException:
                traceback.print_exc()
                os._exit(1)
            os._exit(0)
        ended = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    print("left", user is not None and user.folder.exists())
    sys.exit(ended)
"""


def told(*before: str, environment: dict[str, str] | None = None) -> dict[str, str]:
    """Why root's own number is used, and the process's numbers inside and outside."""
    words = [*before, sys.executable, "-c", textwrap.dedent(NUMBERS_OUTSIDE)]
    done = subprocess.run(
        words,
        capture_output=True,
        text=True,
        check=False,
        env={**os.environ, **(environment or {})},
    )
    assert done.returncode == 0, done.stderr
    pairs = (line.partition(" ") for line in done.stdout.splitlines())
    return {name: value for name, _, value in pairs}


@needs_root_and_sandbox
def test_nobody_in_a_sandbox_is_root_outside() -> None:
    """Inside it is the same user as for everybody, without any group."""
    found = told()
    assert found["why"] == ""
    assert found["inside"] == "1000 1000 []"
    assert int(found["outside"]) in USERS
    assert found["left"] == "False"


@needs_root_and_sandbox
def test_where_tmpdir_is_closed_the_sandbox_stands_as_before(tmp_path: Path) -> None:
    """It is root's own number then, and the reason is told."""
    closed = tmp_path / "closed"
    closed.mkdir(mode=0o700)
    found = told(environment={"TMPDIR": str(closed)})
    assert found["why"] == isolation.CLOSED_TMPDIR
    assert found["inside"].startswith("1000 1000")
    assert found["outside"] == "0"


@needs_root_and_sandbox
def test_where_root_has_one_number_only_the_sandbox_stands_as_before() -> None:
    """As in a container whose root is nobody else: the kernel's own refusal is told."""
    found = told("unshare", "--user", "--map-root-user")
    assert found["why"]
    assert found["inside"].startswith("1000 1000")
    assert found["outside"] == "0"


@pytest.fixture
def asked_anew(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """What was tried before counts no more, nor does what is tried now count later."""
    monkeypatch.delenv("ROSLINGS_ISOLATION", raising=False)
    isolation._with_leased_user.cache_clear()
    yield
    isolation._with_leased_user.cache_clear()


@needs_root_and_sandbox
@pytest.mark.usefixtures("asked_anew")
@pytest.mark.parametrize("lacks", ["setpriv", "a file that others can read"])
def test_what_is_missing_takes_no_wall_away(lacks: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """There is a sandbox as before, and the reason."""
    if lacks == "setpriv":
        monkeypatch.setattr(isolation, "SETPRIV", "/nowhere/setpriv")
    else:
        monkeypatch.setattr(
            isolation, "unreadable_to_others", lambda: "another user cannot read it"
        )
    found, best = isolation_for_strangers(), isolation._best()
    assert (found.sandbox, found.lack, found.leases) == (best.sandbox, best.lack, False)
    assert found.as_root in ("there is no /nowhere/setpriv", "another user cannot read it")


MOUNTS_A_DECOY = """
    import os, subprocess, sys, tempfile
    from pathlib import Path
    from roslings.arena import kernel, users
    tempfile.tempdir = sys.argv[1]
    kept, uid = Path(sys.argv[1], "kept"), users.USERS[-1]
    kernel.keep_mounts_private()
    for sweep in (users._leave_no_process, lambda uid: users._remove(folder)):
        folder = Path(sys.argv[1], f"{users.PREFIX}{uid}-it")
        place = folder / users.VIEW / "shown"
        place.parent.mkdir(parents=True, exist_ok=True)
        kernel.show(str(kept), str(place))
        try:
            (place / "new").touch()
            print("written")
        except OSError as error:
            print(error.strerror)
        sweep(uid)
        print(*(path.name for path in kept.iterdir()))
        subprocess.run(["umount", place], check=True)
        place.rmdir()
    users._leave_no_process(uid)
    print(folder.exists())
"""


@needs("root", "small disk of root's")
def test_to_tidy_removes_nothing_that_is_only_shown(tmp_path: Path) -> None:
    """A view shows Python itself: where it is mounted, it can neither be written nor removed."""
    kept = tmp_path / "kept"
    kept.mkdir()
    (kept / "it").write_text("to be kept")
    words = ["unshare", "--mount", sys.executable, "-c", textwrap.dedent(MOUNTS_A_DECOY)]
    done = subprocess.run([*words, str(tmp_path)], capture_output=True, text=True, check=False)
    read_only = "Read-only file system"
    assert done.stdout.splitlines() == [read_only, "it", read_only, "it", "False"], done.stderr
    assert (kept / "it").read_text() == "to be kept"
