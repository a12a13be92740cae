"""A user of its own for each grading: what it cannot do, and that nothing stays of it."""

from __future__ import annotations

import os
import subprocess
import sys
import textwrap
from pathlib import Path

from shown import shown
from skips import needs

from roslings.arena.users import _lack_above, _lack_within

needs_users = needs("root", "other users")

AS_STRANGER = """
    import sys
    from pathlib import Path
    from roslings.arena import Launch, Process, base_environment
    from roslings.arena.users import leased_user
    with leased_user() as user:
        home = user.folder / "home"
        home.mkdir()
        user.own(home)
        Path(user.folder, "ours").write_text("ours")
        Path(user.folder, "ours").chmod(0o600)
        command = [sys.executable, "-c", sys.argv[1], str(user.folder)]
        environment = {**base_environment(home), "LEFT": sys.argv[2]}
        launch = Launch(command, environment, home, False, user=user)
        with Process("it", launch) as process:
            process.wait_ended(60)
        print("\\n".join(line.text for line in process.lines()))
        uid = user.uid
    print("UID", uid, user.folder.exists())
"""


def run(source: str, left: str = "") -> list[str]:
    """What a stranger's Python says, and the last line of the one that ran it."""
    words = [sys.executable, "-c", textwrap.dedent(AS_STRANGER), textwrap.dedent(source), left]
    done = subprocess.run(shown(*words), capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return done.stdout.splitlines()


@needs_users
def test_it_is_nobody_and_stays_nobody() -> None:
    """No group, no right, no descriptor but its terminal, and no program gives a right back."""
    lines = run(
        """
        import os
        status = dict(x.split(":", 1) for x in open("/proc/self/status").read().splitlines())
        print(len(set(os.getresuid() + os.getresgid())), os.getuid() != 0, os.getgroups())
        print(status["NoNewPrivs"].strip(), int(status["CapEff"], 16), int(status["CapPrm"], 16))
        print(sorted({os.readlink(f"/proc/self/fd/{n}") for n in range(64)
                      if os.path.exists(f"/proc/self/fd/{n}")} - {os.ttyname(0)}))
        """
    )
    assert lines[:3] == ["1 True []", "1 0 0", "[]"]


@needs_users
def test_ours_is_out_of_its_reach() -> None:
    """It writes into its home, and not beside it; it reads nothing that is closed to others."""
    lines = run(
        """
        import os, sys
        def tried(act):
            try:
                act()
                return "reached"
            except OSError as error:
                return type(error).__name__
        folder = sys.argv[1]
        print(tried(lambda: open("mine", "w").close()))
        print(tried(lambda: open(folder + "/ours").read()))
        print(tried(lambda: open(folder + "/new", "w")))
        print(tried(lambda: os.listdir(folder)))
        print(tried(lambda: os.kill(os.getppid(), 0)))
        print(tried(lambda: open(f"/proc/{os.getppid()}/environ").read()))
        """
    )
    assert lines[:6] == ["reached", *["PermissionError"] * 5]


@needs_users
def test_nothing_stays_of_it(tmp_path: Path) -> None:
    """No process however it hides, no file where everybody may write, no shared memory."""
    mark = f"left-by-a-stranger-{os.getpid()}"
    lines = run(
        """
        import ctypes, os, time
        mark = os.environ["LEFT"]
        for folder in ("/tmp", "/var/tmp", "/dev/shm"):
            open(f"{folder}/{mark}", "w").close()
        os.mkdir(f"/tmp/{mark}.d")
        print("shm", ctypes.CDLL(None).shmget(0, 4096, 0o1600) >= 0)
        if os.fork() == 0:
            os.setsid()
            if os.fork() == 0:
                os.execvp("sleep", ["sleep", "1000.5"])
        time.sleep(0.2)
        """,
        mark,
    )
    assert lines[0] == "shm True"
    _, uid, folder_is_there = lines[-1].split()
    assert folder_is_there == "False"
    left = [
        path for place in ("/tmp", "/var/tmp", "/dev/shm") for path in Path(place).glob(f"{mark}*")
    ]
    assert left == []
    assert uid not in Path("/proc/sysvipc/shm").read_text().split()
    listing = ["ps", "-U", uid, "-o", "stat="]
    listed = subprocess.run(listing, capture_output=True, text=True, check=False)
    assert [state for state in listed.stdout.split() if not state.startswith("Z")] == []


@needs_users
def test_two_gradings_are_two_users() -> None:
    """And a third one gets the first one's number only when that is gone."""
    source = """
        from roslings.arena.users import leased_user
        with leased_user() as one, leased_user() as other:
            print(one.uid != other.uid)
    """
    words = shown(sys.executable, "-c", textwrap.dedent(source))
    assert subprocess.run(words, capture_output=True, text=True, check=True).stdout == "True\n"


def test_what_others_could_change_or_not_read_is_named(tmp_path: Path) -> None:
    """With the mend: nobody runs a Python that a stranger may have written."""
    inside = tmp_path / "python" / "lib"
    inside.mkdir(parents=True)
    file = inside / "os.py"
    file.touch(0o644)
    assert _lack_within(tmp_path / "python") is None
    file.chmod(0o666)
    found = _lack_within(tmp_path / "python")
    assert found and found.next_step == f"chmod o-w {file}"
    file.chmod(0o600)
    found = _lack_within(tmp_path / "python")
    assert found and f"chmod o+rX {file}" in found.next_step
    inside.chmod(0o700)
    found = _lack_above(inside)
    assert found and str(inside) in found.reason
    inside.chmod(0o777)
    found = _lack_above(inside)
    assert found and found.next_step == f"chmod o-w {inside}"
