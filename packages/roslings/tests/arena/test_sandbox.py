"""What a process in a sandbox can see, write and take; each is tried from inside."""

from __future__ import annotations

import os
import subprocess
import sys
import textwrap
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import pytest
from in_sandbox import LONG_S, bounded, run, said

from roslings.arena import Isolation, Launch, Process, Sandbox
from roslings.arena import sandbox as sandbox_module
from roslings.arena.bounds import MB, Bounds
from roslings.arena.environment import base_environment
from roslings.arena.sandbox import installations
from skips import imported, needs, skip_without


def test_only_what_is_listed_can_be_seen(sandbox: Sandbox, tmp_path: Path) -> None:
    """A file beside its home, the course and the machine's own folders are not there."""
    (tmp_path / "secret").write_text("the answers")
    shown = tmp_path / "shown"
    shown.mkdir()
    (shown / "file").write_text("to be seen")
    hidden = [tmp_path / "secret", Path(__file__), Path("/etc/shadow"), Path("/var")]
    source = f"""
        import os
        print([path for path in {list(map(str, hidden))!r} if os.path.exists(path)])
        print(open({str(shown / "file")!r}).read())
    """
    assert said(sandbox.showing(shown), source).splitlines() == ["[]", "to be seen"]


def test_what_is_seen_cannot_be_written(sandbox: Sandbox, tmp_path: Path) -> None:
    """Neither the system, nor Python, nor the root, nor what is shown; its home and /tmp can."""
    shown = tmp_path / "shown"
    shown.mkdir()
    places = [Path("/usr"), Path(sys.prefix), Path("/"), Path("/dev"), Path("/etc"), shown]
    source = f"""
        import os
        def can_write(folder):
            try:
                open(os.path.join(folder, "mark"), "w").close()
            except OSError:
                return False
            return True
        print([place for place in {list(map(str, places))!r} if can_write(place)])
        print([can_write(place) for place in (os.environ["HOME"], "/tmp", "/dev/shm")])
    """
    assert said(sandbox.showing(shown), source).splitlines() == ["[]", "[True, True, True]"]
    assert not (tmp_path / "home").exists()


def test_a_folder_that_may_be_written_stays(sandbox: Sandbox, tmp_path: Path) -> None:
    """It is seen at another place than where it lies."""
    lies = tmp_path / "lies"
    lies.mkdir()
    run(sandbox.writing(lies, Path("/built/here")), "open('/built/here/it', 'w').write('done')")
    assert (lies / "it").read_text() == "done"


OPENS_EACH_SETTING = """
    import collections, errno, os
    came = collections.Counter()
    for folder, folders, names in os.walk("/proc"):
        if folder == "/proc":
            folders[:] = [name for name in folders if not name.isdigit()]
        for path in (os.path.join(folder, name) for name in names):
            if os.path.islink(path) or not os.stat(path).st_mode & 0o222:
                continue
            if os.stat(path).st_rdev != os.stat(os.devnull).st_rdev:
                try:
                    os.close(os.open(path, os.O_WRONLY))  # nothing is written, nothing is changed
                    came["opened"] += 1
                except OSError as error:
                    came[errno.errorcode[error.errno]] += 1
    print(*sorted(came))
"""
READS_WHAT_IS_ROOTS = """
    for name in ("keys", "key-users", "kpagecount", "slabinfo", "timer_list", "vmallocinfo"):
        try:
            print(name if open(f"/proc/{name}", "rb").read(64) else "", end=" ")
        except OSError:
            pass
"""
needs_root = needs("root")


def without_covers(monkeypatch: pytest.MonkeyPatch) -> None:
    """Take these words out of bubblewrap's command."""
    words = [*sandbox_module._settings_and_keys()]
    assert words[:3] == ["--ro-bind-try", "/proc/sys", "/proc/sys"]
    monkeypatch.setattr(sandbox_module, "_settings_and_keys", tuple)


def test_no_setting_of_the_kernel_can_be_written(sandbox: Sandbox) -> None:
    """They hold for the whole machine. They can be read, and the folder is there."""
    came = set(said(sandbox, OPENS_EACH_SETTING).split())
    assert "EROFS" in came
    assert came <= {"EROFS", "EACCES"}


@needs_root
def test_the_bind_is_what_holds_root_off(sandbox: Sandbox, monkeypatch: pytest.MonkeyPatch) -> None:
    """Without these words of bubblewrap's command, settings can be opened for writing."""
    without_covers(monkeypatch)
    assert "opened" in said(sandbox, OPENS_EACH_SETTING).split()


def test_what_only_root_reads_of_the_kernel_is_empty(sandbox: Sandbox) -> None:
    """So are the names of keys."""
    assert said(sandbox, READS_WHAT_IS_ROOTS).split() == []


def test_the_cover_is_what_hides_it(sandbox: Sandbox, monkeypatch: pytest.MonkeyPatch) -> None:
    """Without it, the names of the keys can be read, at least."""
    without_covers(monkeypatch)
    assert "key-users" in said(sandbox, READS_WHAT_IS_ROOTS).split()


def test_it_is_nobody_special(sandbox: Sandbox) -> None:
    """An ordinary user without any right of root's, and no way to a namespace of its own."""
    source = """
        import ctypes, os
        rights = [line.split()[1] for line in open("/proc/self/status") if line.startswith("Cap")]
        print(os.getuid(), set(map(lambda right: int(right, 16), rights)))
        libc = ctypes.CDLL(None, use_errno=True)
        print(libc.mount(b"none", b"/tmp", b"tmpfs", 0, None))
    """
    assert said(sandbox, source).splitlines() == ["1000 {0}", "-1"]


def test_it_sees_no_process_but_its_own(sandbox: Sandbox) -> None:
    """The guardian is the first, and can be neither ended, nor stopped, nor traced, nor read."""
    source = """
        import ctypes, os, signal
        print(sorted(int(name) for name in os.listdir("/proc") if name.isdigit())[0])
        for number in (signal.SIGKILL, signal.SIGSTOP, signal.SIGINT, signal.SIGTERM):
            os.kill(1, number)
        libc = ctypes.CDLL(None, use_errno=True)
        print(libc.ptrace(16, 1, 0, 0))
        for what in ("mem", "environ", "root/usr", *(f"fd/{number}" for number in range(30))):
            try:
                print("has", what, os.open(f"/proc/1/{what}", os.O_RDONLY))
            except OSError:
                pass
        print("is here still")
    """
    assert said(sandbox, source).splitlines() == ["1", "-1", "is here still"]


def test_nothing_outlives_it(sandbox: Sandbox) -> None:
    """A daemon in a session of its own is counted, and ended with the rest."""
    source = """
        import os, time
        if os.fork() == 0:
            os.setsid()
            if os.fork() == 0:
                time.sleep(1000)
            os._exit(0)
        os.wait()
    """
    assert run(sandbox, source).left_behind == 1


def test_a_fork_bomb_meets_its_bound(sandbox: Sandbox) -> None:
    """And ends with it; who is root meets it in the control group only."""
    source = """
        import os, time
        count = 0
        try:
            while True:
                if os.fork() == 0:
                    time.sleep(1000)
                count += 1
        except OSError as error:
            print(count, error.strerror)
    """
    seen = run(bounded(sandbox, tasks=40), source)
    count, reason = seen.lines[-1].text.split(" ", 1)
    assert 20 < int(count) < 40
    assert "unavailable" in reason
    if any("pids" in tree.controllers for tree in sandbox.trees):
        assert seen.bounds_met == ["pids"]


HOG = """
    hold = []
    for _ in range(200):
        hold.append(bytearray(b"x" * 4_000_000))
    print("has all")
"""
HOGS = """
    import os, time
    for _ in range(8):
        if os.fork() == 0:
            hold = bytearray(b"x" * 40_000_000)
            time.sleep(1000)
    while True:
        time.sleep(1000)
"""


def test_one_process_has_so_much_memory(sandbox: Sandbox) -> None:
    """By the group, or by its own limit."""
    seen = run(bounded(sandbox, memory_bytes=200 * MB), HOG)
    assert seen.status != 0
    assert all("has all" not in line.text for line in seen.lines)


@pytest.mark.parametrize("grouped", [True, False])
def test_many_processes_have_so_much_memory(sandbox: Sandbox, grouped: bool) -> None:
    """Together: by the group, and where there is none, because the guardian looks."""
    if grouped and not any("memory" in tree.controllers for tree in sandbox.trees):
        skip_without("control group for memory")
    trees = sandbox.trees if grouped else ()
    bounds = replace(Bounds(), memory_bytes=160 * MB)
    launch = Launch(
        [sys.executable, "-I", "-S", "-c", textwrap.dedent(HOGS)],
        {"PATH": os.defpath},
        Path("/"),
        namespaces=True,
        sandbox=replace(sandbox, trees=trees, bounds=bounds),
    )
    with Process("it", launch) as process:
        process.wait_ended(2.0 if grouped else LONG_S)
    assert process.seen.bounds_met == ["memory"]


def test_its_home_holds_so_much(sandbox: Sandbox) -> None:
    """No file can be larger than allowed, and all together neither."""
    source = """
        import os, time
        with open(os.environ["HOME"] + "/big", "wb") as big:
            try:
                for _ in range(100):
                    big.write(b"x" * 1_000_000)
                    big.flush()
            except OSError as error:
                print(error.strerror)
        time.sleep(2)
    """
    seen = run(bounded(sandbox, home_bytes=3 * MB), source)
    assert [line.text for line in seen.lines] == ["No space left on device"]
    assert seen.filled_its_disk


def test_it_has_so_many_files(sandbox: Sandbox) -> None:
    """Empty ones too; their memory is the kernel's."""
    source = """
        import os, time
        for number in range(2000):
            open(f"/tmp/{number}", "w").close()
        time.sleep(1000)
    """
    assert run(bounded(sandbox, files=1000), source).bounds_met == ["files"]


def test_no_group_is_left(sandbox: Sandbox) -> None:
    """While the process runs it is in one in each tree; then there is none."""
    if not sandbox.trees:
        skip_without("control group for memory")
    command = [sys.executable, "-I", "-S", "-c", "import time; time.sleep(1000)"]
    launch = Launch(command, {"PATH": os.defpath}, Path("/"), namespaces=True, sandbox=sandbox)
    with Process("it", launch) as process:
        assert all(own_groups(sandbox)) and len(own_groups(sandbox)) == len(sandbox.trees)
        assert process.commands(), "nothing ran while the groups were looked at"
    assert own_groups(sandbox) == []


def own_groups(sandbox: Sandbox) -> list[str]:
    """Of each group that this process has made: the processes in it."""
    made = (tree.folder.glob(f"roslings-{os.getpid()}-*") for tree in sandbox.trees)
    return [(group / "cgroup.procs").read_text("ascii") for found in made for group in found]


def behind(isolation: Isolation, room: Path, source: str, *words: str) -> str:
    """What a program behind the outer wall writes, where rooms and terminals are its own."""
    inner = [sys.executable, "-c", textwrap.dedent(source), *words]
    done = subprocess.run(
        isolation.command(inner, room), capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr
    return done.stdout


IN_THE_ROOM = """
    import os, sys
    room = sys.argv[1]
    print(os.listdir("/dev/pts"))
    ours, theirs = os.openpty()
    print(os.ttyname(theirs))
    with open(os.path.join(room, "it"), "w") as file:
        file.write("here")
    print(os.statvfs(room).f_blocks * os.statvfs(room).f_bsize)
"""


def test_what_a_room_holds_is_gone(isolation: Isolation, tmp_path: Path) -> None:
    """It is bounded, and nobody else sees it; the terminals are no one else's."""
    lines = behind(isolation, tmp_path, IN_THE_ROOM, str(tmp_path)).splitlines()
    assert lines == ["['ptmx']", "/dev/pts/0", str(512 * MB)]
    assert list(tmp_path.iterdir()) == []


def test_only_our_own_variables_name_installations(tmp_path: Path) -> None:
    """Once each, and nothing below another, or below /usr."""
    ros, below = tmp_path / "ros", tmp_path / "ros" / "lib"
    below.mkdir(parents=True)
    named = os.pathsep.join(map(str, (ros, below, Path("/usr/bin"), tmp_path / "gone")))
    found = installations({"AMENT_PREFIX_PATH": named})
    assert found.count(ros) == 1
    assert not {below, Path("/usr/bin"), tmp_path / "gone"} & set(found)
    assert all(_covered(path, [*found, Path("/usr")]) for path in (sys.prefix, sys.base_prefix))


def _covered(path: str, folders: Sequence[Path]) -> bool:
    return any(Path(path).is_relative_to(folder) for folder in folders)


def test_what_stands_in_for_packages_of_ros_is_there(sandbox: Sandbox) -> None:
    """A program writes a bag with `rosbag2_py`, as outside; of the engine it sees no more."""
    imported("rosbags")
    source = """
        import importlib.util, rosbag2_py
        from rclpy.serialization import serialize_message
        from std_msgs.msg import String
        writer = rosbag2_py.SequentialWriter()
        writer.open(rosbag2_py.StorageOptions("bag"), rosbag2_py.ConverterOptions())
        topic = rosbag2_py.TopicMetadata(0, "/heard", "std_msgs/msg/String", "cdr")
        writer.create_topic(topic)
        writer.write("/heard", serialize_message(String(data="one")), 1)
        writer.close()
        reader = rosbag2_py.SequentialReader()
        reader.open_uri("bag")
        print(reader.read_next()[::2], importlib.util.find_spec("roslings.course"))
    """
    assert said_in(sandbox, source) == ["('/heard', 1) None"]


def test_frames_are_looked_up_there(sandbox: Sandbox) -> None:
    """By `tf2_ros` and what goes with it, as outside."""
    source = """
        import tf2_geometry_msgs, tf2_ros
        from geometry_msgs.msg import PointStamped, TransformStamped
        from tf_transformations import euler_from_quaternion, quaternion_from_euler
        step = TransformStamped(child_frame_id="laser")
        step.header.frame_id = "base_link"
        turn = step.transform.rotation
        turn.x, turn.y, turn.z, turn.w = quaternion_from_euler(0, 0, 1.5)
        buffer = tf2_ros.Buffer()
        buffer.set_transform_static(step, "it")
        point = PointStamped()
        point.header.frame_id = "laser"
        print(buffer.transform(point, "base_link").header.frame_id)
        print(round(euler_from_quaternion((turn.x, turn.y, turn.z, turn.w))[2], 3))
    """
    assert said_in(sandbox, source) == ["base_link", "1.5"]


def said_in(sandbox: Sandbox, source: str) -> list[str]:
    """What a program prints there, line by line."""
    assert sandbox.home
    environment = base_environment(sandbox.home)
    command = [sys.executable, "-c", textwrap.dedent(source)]
    launch = Launch(command, environment, sandbox.home, namespaces=True, sandbox=sandbox)
    with Process("it", launch) as process:
        assert process.wait_ended(LONG_S)
    return [line.text for line in process.seen.lines]
