"""A user of its own for each grading: what it cannot do, and that nothing stays of it."""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import textwrap
from collections.abc import Iterator
from pathlib import Path

import pytest
from shown import shown

from roslings.arena.users import PREFIX, _lack_above, _lack_within
from skips import needs

needs_users = needs("root", "other users")

AS_STRANGER = """
    import sys
    from pathlib import Path
    from roslings.arena import Launch, Process, base_environment
    from roslings.arena.users import give, leased_user
    if sys.argv[3]:  # a wall is taken away
        exec(sys.argv[3])
    with leased_user() as user:
        home = user.folder / "home"
        home.mkdir()
        give(home, user.uid)
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


def run(source: str, left: str = "", without: str = "") -> list[str]:
    """What a stranger's Python says, and the last line of the one that ran it."""
    script, source = textwrap.dedent(AS_STRANGER), textwrap.dedent(source)
    words = [sys.executable, "-c", script, source, left, without]
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


READS_IT = """
    import os
    try:
        print(open(os.environ["LEFT"] + "/labs/topics/solution/it").read())
    except OSError as error:
        print(type(error).__name__)
"""
NO_LANDLOCK = "from roslings.arena import reach; reach.rules = lambda *words: []"


@pytest.fixture
def open_clone() -> Iterator[Path]:
    """A copy of the course that every user may read, where clones lie: not in /tmp."""
    with tempfile.TemporaryDirectory(dir="/srv", prefix="clone-") as name:
        answers = Path(name, "labs/topics/solution")
        answers.mkdir(parents=True)
        (answers / "it").write_text("the answer")
        Path(name).chmod(0o755)
        yield Path(name)


@needs_users
@needs("Landlock")
def test_a_clone_that_is_open_is_out_of_its_reach(open_clone: Path) -> None:
    """The kernel lets it reach what is listed; without that, it reads what everybody may."""
    assert run(READS_IT, str(open_clone))[0] == "PermissionError"
    assert run(READS_IT, str(open_clone), NO_LANDLOCK)[0] == "the answer"


CLOSED_TMP = """
from roslings.arena import reach
rules = reach.rules
reach.rules = lambda own, shown, closed: rules(own, shown, ("/tmp", "/dev/shm"))
"""


@needs_users
@needs("Landlock")
def test_a_closed_place_is_out_of_its_reach() -> None:
    """Its home is not, though it may lie there, and its terminal and /dev/null are not."""
    source = """
        import os
        for place in ("/tmp", "/dev/shm", os.environ["HOME"], "/dev/null"):
            try:
                open(place if place == "/dev/null" else place + "/it", "w").close()
                print("written")
            except PermissionError:
                print("closed")
    """
    assert run(source, without=CLOSED_TMP)[:4] == ["closed", "closed", "written", "written"]


@needs_users
@needs("Landlock")
def test_it_can_do_what_nodes_do() -> None:
    """Import ROS, write at home and in /tmp, make a link and a socket there, and run programs."""
    lines = run(
        """
        import os, socket, subprocess, tempfile
        import numpy, rclpy
        rclpy.init(); rclpy.create_node("it"); rclpy.shutdown()
        with tempfile.TemporaryDirectory() as own, tempfile.TemporaryDirectory(dir="/tmp") as other:
            os.mkdir(own + "/a")
            open(own + "/it", "w").close()
            os.rename(own + "/it", own + "/a/it")
            os.link(own + "/a/it", own + "/b")
            os.symlink("b", own + "/c")
            with socket.socket(socket.AF_UNIX) as ear:
                ear.bind(own + "/ear")
            open(other + "/it", "w").write("it")
            os.truncate(other + "/it", 1)
            open("/dev/null", "w").write("it")
            print(subprocess.run(["sh", "-c", "ls /usr >/dev/null && echo $((6*7))"],
                                 capture_output=True, text=True).stdout.strip())
        """
    )
    assert lines[0] == "42"


@needs_users
def test_no_file_stays_in_a_folder_of_somebody_else() -> None:
    """One below /tmp that everybody may write."""
    with tempfile.TemporaryDirectory(dir="/tmp") as name:
        Path(name, "shared").mkdir()
        for folder in (Path(name), Path(name, "shared")):
            folder.chmod(0o777)
        source = """
            import os
            for place in ("", "/shared"):
                open(os.environ["LEFT"] + place + "/from-a-stranger", "w").close()
            os.mkdir(os.environ["LEFT"] + "/a-folder")
            print(sorted(os.listdir(os.environ["LEFT"])))
        """
        assert run(source, name)[0] == "['a-folder', 'from-a-stranger', 'shared']"
        assert [path.name for path in Path(name).rglob("*")] == ["shared"]


ADDS_A_KEY = """
import ctypes, os
libc = ctypes.CDLL(None, use_errno=True)
add, keyctl = {"x86_64": (248, 250), "aarch64": (217, 219)}[os.uname().machine]
kind, name, user = ctypes.c_char_p(b"user"), ctypes.c_char_p(b"for-my-friend"), -4
print("found" if libc.syscall(keyctl, 10, user, kind, name, 0) > 0 else "none")
libc.syscall(add, kind, name, name, ctypes.c_size_t(6), user)
"""


@needs_users
@needs("keys of the kernel")
def test_no_key_stays_of_it() -> None:
    """What a user has kept for all its processes is gone before its number is leased again."""
    source = f"""
        from roslings.arena import users
        command, uid = [*users.BARE, "-c", {ADDS_A_KEY!r}], users.USERS[0]
        first = users._run_as(uid, command).stdout.strip()
        second = users._run_as(uid, command).stdout.strip()
        users._leave_nothing(uid)
        third = users._run_as(uid, command).stdout.strip()
        users._leave_nothing(uid)
        print(first, second, third)
    """
    words = shown(sys.executable, "-c", textwrap.dedent(source))
    done = subprocess.run(words, capture_output=True, text=True, check=False)
    assert done.stdout == "none found none\n", done.stderr


@needs_users
def test_no_user_is_leased_twice_in_a_run() -> None:
    """Whoever was leased longest ago comes next."""
    source = """
        from roslings.arena.users import leased_user
        seen = []
        for _ in range(4):
            with leased_user() as user:
                seen.append(user.uid)
        print(len(set(seen)))
    """
    words = shown(sys.executable, "-c", textwrap.dedent(source))
    assert subprocess.run(words, capture_output=True, text=True, check=True).stdout == "4\n"


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


IS_KILLED = """
    import os, signal, sys
    from roslings.arena.users import leased_user
    with leased_user(sys.argv[1] == "in sandboxes") as user:
        print(user.folder, flush=True)
        if sys.argv[2:]:
            os.kill(os.getpid(), signal.SIGKILL)
"""


def user_of(told: subprocess.CompletedProcess[str]) -> str:
    """Its number, from the name of its folder."""
    return Path(told.stdout.strip()).name.removeprefix(PREFIX).partition("-")[0]


@needs_users
@pytest.mark.parametrize("kind", ["in sandboxes", "bare"])
def test_what_a_killed_grading_left_goes_with_the_next_one(kind: str, tmp_path: Path) -> None:
    """The next one is another user."""
    tmp_path.chmod(0o755)
    words = shown(sys.executable, "-c", textwrap.dedent(IS_KILLED), kind)

    def lease(*more: str) -> subprocess.CompletedProcess[str]:
        own = {**os.environ, "TMPDIR": str(tmp_path)}
        return subprocess.run([*words, *more], capture_output=True, text=True, check=False, env=own)

    first = lease("is killed")
    assert first.returncode != 0
    assert Path(first.stdout.strip()).is_dir()
    second = lease()
    assert second.returncode == 0, second.stderr
    assert user_of(second) != user_of(first)
    assert list(tmp_path.iterdir()) == []
