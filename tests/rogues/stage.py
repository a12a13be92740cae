"""Where the rogues are graded: a course, a home, a user; and the witnesses who watch outside.

A witness never asks the rogue: it looks at the machine's processes, files, sockets and ROS domain.
"""

from __future__ import annotations

import os
import shutil
import socket
import sqlite3
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path

from rogue import LAB

from roslings.arena import base_environment, kernel
from roslings.course import root
from roslings.evidence import Evidence
from roslings_class.gradebook import gradebook
from roslings_class.grading import unpacked
from roslings_class.result import GradingResult
from roslings_class.signed_gradebook import take_key
from sources import python_path

HERE = Path(__file__).parent
NOBODY = 65534
LONG_S = 7200.0
UNTIL_S = float(os.environ.get("ROSLINGS_TESTS_UNTIL", "inf"))
"""After this moment of time.time(), what takes the whole machine begins no more."""
TIME = "time for what takes the whole machine"
SANDBOX = ("namespaces", "bubblewrap", "bounded processes")
"""What a machine must have for it, by the names of `machine.py`."""
BUILDS_WITHIN_S = 45.0
"""What never comes to an end burns a processor for that long; an honest build takes a second."""
QUIET_WITHIN_S = 60.0
SECRET = "the instructor's own secret"
HIDDEN = '''
from roslings.judge import PackageView, check

POINTS = {"is_hidden": 5}
SECRET = "%s"


@check()
def test_is_hidden(package: PackageView) -> None:
    """A check that students do not have."""
    assert package.files.name
'''
WITH_A_KEY = """
import ctypes, os, sys
libc = ctypes.CDLL(None, use_errno=True)
calls = {"x86_64": (248, 250), "aarch64": (217, 219)}.get(os.uname().machine)
if calls:
    add, keyctl = calls
    libc.syscall(keyctl, 1, None)
    name = ctypes.c_char_p(b"instructors-key")
    libc.syscall(add, ctypes.c_char_p(b"user"), name, name, ctypes.c_size_t(3), -3)
os.execv(sys.argv[1], sys.argv[1:])
"""
"""The instructor's session keeps a key in the kernel, where the kernel keeps any."""
GRADES = (
    "ros2-on-pip",
    "ros-doctor",
    "roslings-launcher",
    "roslings-rover",
    "roslings",
    "roslings-class",
)
"""The packages that `grade` runs; no other is in the stage."""
COURSE = (
    *(f"packages/{name}/src" for name in GRADES),
    "graders",
    f"labs/{LAB.name}",
    "labs/actions/solution/drive_to/package.xml",
    "pyproject.toml",
)
"""What grades, and what rogues reach for: a lesson or another lab that changes is nothing to them,
and the gate sees it."""
SHARED_PLACES = ("/tmp", "/var/tmp", "/dev/shm", "/", "/run", "/etc", "/opt", "/usr")


@dataclass
class Stage:
    """All that one grading of rogues needs, in folders of its own."""

    folder: Path
    ordinary: bool
    """As an ordinary user, where the tests run as root."""
    mark: str = field(default_factory=lambda: f"rogue-{os.urandom(4).hex()}")
    """15 letters at most: so long is a process's name."""
    begun: list[subprocess.Popen[str]] = field(default_factory=list)

    @property
    def submissions(self) -> Path:
        """What was handed in."""
        return self.folder / "in"

    @property
    def out(self) -> Path:
        """The gradebook's folder."""
        return self.folder / "out"

    @property
    def course(self) -> Path:
        """The course that grades: its own copy, which a rogue may hurt without harm."""
        return self.folder / "course"

    @property
    def home(self) -> Path:
        """The instructor's."""
        return self.folder / "home"

    @property
    def scratch(self) -> Path:
        """The command's TMPDIR."""
        return self.folder / "tmp"

    @property
    def hidden(self) -> Path:
        """Checks that students do not have."""
        return self.home / "hidden_topics.py"

    def furnish(self) -> None:
        """Make all folders."""
        for folder in (self.submissions, self.home, self.scratch, self.course):
            folder.mkdir()
        for name in COURSE:
            source, to = root() / name, self.course / name
            to.parent.mkdir(parents=True, exist_ok=True)
            if source.is_dir():
                shutil.copytree(source, to, ignore=shutil.ignore_patterns("__pycache__"))
            else:
                shutil.copy(source, to)
        card = self.course / "labs" / LAB.name / "card.yaml"
        card.write_text(f"{card.read_text('utf-8')}\nbuilds_within_s: {BUILDS_WITHIN_S}\n", "utf-8")
        (self.home / "secret.txt").write_text(SECRET)
        self.hidden.write_text(HIDDEN % SECRET)
        self.course.chmod(0o700)  # an open copy of the course is no wall, for whoever tests beside

    def give_away(self) -> None:
        """Everything belongs to the ordinary user from now on."""
        if self.ordinary:
            for at, folders, files in os.walk(self.folder):
                for name in (at, *(os.path.join(at, each) for each in (*folders, *files))):  # noqa: PTH118
                    os.chown(name, NOBODY, NOBODY, follow_symlinks=False)

    def command(self, *more: str) -> list[str]:
        """`./roslings grade` of all submissions."""
        grade = ["grade", LAB.name, str(self.submissions), "--out", str(self.out), *more]
        words = [
            sys.executable,
            "-I",
            "-S",
            "-c",
            WITH_A_KEY,
            sys.executable,
            "-m",
            "roslings",
            *grade,
        ]
        return [*ordinary_user(), *words] if self.ordinary else words

    def environment(self) -> dict[str, str]:
        """The instructor's variables, one of them a secret."""
        kept = {name: os.environ[name] for name in ("PATH", "LANG") if name in os.environ}
        own = {"HOME": str(self.home), "TMPDIR": str(self.scratch), "INSTRUCTORS_TOKEN": SECRET}
        return {
            **kept,
            **own,
            "PYTHONPATH": python_path(self.course),
            "PYTHONDONTWRITEBYTECODE": "1",
        }

    def begin(self, *more: str) -> subprocess.Popen[str]:
        """Start the command, in a session of its own; it ends with the stage at the latest."""
        command = subprocess.Popen(
            self.command(*more),
            cwd=self.folder,
            env=self.environment(),
            text=True,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            start_new_session=True,
        )
        self.begun.append(command)
        return command

    def end_all(self) -> None:
        """End what still runs: a test that fails, or is interrupted, leaves nothing."""
        for command in self.begun:
            command.kill()
            command.wait()

    def results(self) -> dict[str, GradingResult]:
        """What stands in the gradebook. Raises where that is not whole."""
        connection = sqlite3.connect(self.out / "gradebook.sqlite")
        assert connection.execute("PRAGMA integrity_check").fetchall() == [("ok",)]
        connection.close()
        with gradebook(self.out, LAB.name) as book:
            return book.latest()

    def evidence(self, result: GradingResult) -> Evidence | None:
        """What a result was judged from."""
        with gradebook(self.out, LAB.name) as book:
            take_key(book, self.out)
            content = book.evidence(result)
        return unpacked(content) if content else None


@contextmanager
def stage(ordinary: bool) -> Iterator[Stage]:
    """A furnished stage; pytest's own folders are closed to other users."""
    place = Path(tempfile.mkdtemp(prefix="gallery-"))
    place.chmod(0o755)
    made = Stage(place, ordinary)
    try:
        made.furnish()
        yield made
    finally:
        made.end_all()
        subprocess.run(["chmod", "-R", "u+rwX", place], check=False, capture_output=True)
        subprocess.run(["rm", "-rf", place], check=False)


# --- an ordinary user --------------------------------------------------------------------------


def ordinary_user() -> list[str]:
    """The beginning of a command that root runs as an ordinary user."""
    return readable_to_all(NOBODY)


def readable_to_all(user: int, *more: str) -> list[str]:
    """The beginning of a command that root runs as `user`, where everybody can read its Python.

    `more` are further words for `as_ordinary.py`.
    """
    return [
        "unshare",
        "--mount",
        sys.executable,
        "-I",
        "-S",
        str(HERE / "as_ordinary.py"),
        str(user),
        sys.prefix,
        sys.base_prefix,
        *more,
        "--",
    ]


# --- witnesses ---------------------------------------------------------------------------------


def living(mark: str) -> dict[int, str]:
    """Every process of this machine that carries the mark: by name, or on its command line."""
    found = {}
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit():
            with suppress(OSError):
                words = (
                    (entry / "cmdline").read_bytes().replace(b"\0", b" ").decode(errors="replace")
                )
                name = (entry / "comm").read_text(errors="replace").strip()
                state = (entry / "stat").read_text(errors="replace").rpartition(")")[2].split()[0]
                if state != "Z" and (mark in words or name == mark[:15]):
                    found[int(entry.name)] = f"{name}: {words}"
    return found


def children() -> dict[int, str]:
    """Every process below this one that is no zombie: who lost its parent comes to us."""
    parents: dict[int, int] = {}
    words: dict[int, str] = {}
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit():
            with suppress(OSError):
                state, parent, *_ = (
                    (entry / "stat").read_text(errors="replace").rpartition(")")[2].split()
                )
                if state != "Z":
                    parents[int(entry.name)] = int(parent)
                    words[int(entry.name)] = (
                        (entry / "cmdline").read_bytes().decode(errors="replace")
                    )
    found: set[int] = set()
    fresh = {os.getpid()}
    while fresh := {pid for pid, parent in parents.items() if parent in fresh} - found:
        found |= fresh
    return {pid: words[pid] for pid in found}


@contextmanager
def adopting() -> Iterator[Callable[[], dict[int, str]]]:
    """Orphans of what is started meanwhile come to us, however they hide; who is there."""
    kernel.adopt_orphans()
    before = set(children())
    yield lambda: {pid: words for pid, words in children().items() if pid not in before}


def quiet(left: Callable[[], dict[int, str]]) -> dict[int, str]:
    """Wait until nothing is left running; what still is."""
    end_s = time.monotonic() + QUIET_WITHIN_S
    while (there := left()) and time.monotonic() < end_s:
        time.sleep(0.1)
    return there


def files_in(folder: Path) -> set[str]:
    """Every file and folder, with its size where it is a file: what changed can be told."""
    found = set()
    for at, folders, files in os.walk(folder):
        folders[:] = [name for name in folders if name != "__pycache__"]
        for name in (*folders, *files):
            path = Path(at, name)
            with suppress(OSError):
                stat = path.lstat()
                found.add(f"{path} {stat.st_mtime_ns if name in files else ''}")
    return found


def abandoned_groups() -> set[str]:
    """Control groups below our own whose maker has ended: their names hold its pid."""
    found = set()
    for line in Path("/proc/self/cgroup").read_text("utf-8").splitlines():
        _, controller, own = line.split(":", 2)
        for each in Path("/sys/fs/cgroup", controller, own[1:]).glob("roslings-*"):
            if not Path("/proc", each.name.split("-")[1]).exists():
                found.add(str(each))
    return found


def signs_of(token: str) -> list[str]:
    """Files of a rogue's in the machine's own folders."""
    found = []
    for folder in map(Path, SHARED_PLACES):
        with suppress(OSError):
            found += [str(path) for path in folder.iterdir() if token in path.name]
    return found


@dataclass
class Ear:
    """Listens on the machine's own network for what must not come."""

    port: int
    heard: list[str] = field(default_factory=list)


@contextmanager
def listening(mark: str, folder: Path) -> Iterator[Ear]:
    """TCP, UDP and UNIX sockets outside of every sandbox."""
    with ExitStack() as stack:
        tcp = stack.enter_context(socket.socket(socket.AF_INET, socket.SOCK_STREAM))
        tcp.bind(("0.0.0.0", 0))
        port = tcp.getsockname()[1]
        udp = stack.enter_context(socket.socket(socket.AF_INET, socket.SOCK_DGRAM))
        udp.bind(("0.0.0.0", port))
        abstract = stack.enter_context(socket.socket(socket.AF_UNIX, socket.SOCK_STREAM))
        abstract.bind("\0" + mark)
        named = stack.enter_context(socket.socket(socket.AF_UNIX, socket.SOCK_STREAM))
        named.bind(str(folder / "socket"))
        (folder / "socket").chmod(0o777)
        listener = Ear(port)
        for each in (tcp, abstract, named):
            each.listen()
        done = threading.Event()
        thread = threading.Thread(target=_hear, args=(listener, (tcp, abstract, named), udp, done))
        thread.start()
        stack.callback(thread.join)
        stack.callback(done.set)
        yield listener


def _hear(
    listener: Ear, streams: tuple[socket.socket, ...], udp: socket.socket, done: threading.Event
) -> None:
    for each in (*streams, udp):
        each.settimeout(0.05)
    while not done.is_set():
        for each in streams:
            with suppress(TimeoutError), each.accept()[0]:
                listener.heard.append(f"a connection to {each.getsockname()}")
        with suppress(TimeoutError):
            listener.heard.append(f"a datagram: {udp.recv(100)!r}")


def own_address() -> str:
    """The address of this machine's network card; loopback where it has none."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as asked, suppress(OSError):
        asked.connect(("192.0.2.1", 9))  # a datagram socket sends nothing to connect
        return str(asked.getsockname()[0])
    return "127.0.0.1"


LISTENER = """
import sys, rclpy
from std_msgs.msg import String
rclpy.init()
node = rclpy.create_node('robot_of_the_machine')
node.create_subscription(String, 'intruder', lambda m: print(m.data, flush=True), 10)
print('ready', flush=True)
rclpy.spin(node)
"""


@contextmanager
def robot(domain: int, home: Path) -> Iterator[list[str]]:
    """A node in a ROS domain of the machine itself; what it hears on /intruder."""
    environment = {
        **base_environment(home),
        "ROS_DOMAIN_ID": str(domain),
        "ROS_AUTOMATIC_DISCOVERY_RANGE": "LOCALHOST",
    }
    heard: list[str] = []
    with subprocess.Popen(
        [sys.executable, "-c", LISTENER],
        env=environment,
        text=True,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
    ) as node:
        out = node.stdout
        assert out is not None
        thread = threading.Thread(target=lambda: heard.extend(out))
        try:
            assert out.readline() == "ready\n"
            thread.start()
            yield heard
        finally:
            node.kill()
        thread.join()


def known(made: Stage, token: str, port: int, domain: int) -> dict[str, str]:
    """All that an attacker could know of this machine."""
    return {
        "mark": made.mark,
        "token": token,
        "secret": SECRET,
        "out": str(made.out),
        "course": str(made.course),
        "home": str(made.home),
        "hidden": str(made.hidden),
        "submissions": str(made.submissions),
        "tmp": str(made.scratch),
        "port": str(port),
        "address": own_address(),
        "domain": str(domain),
        "witness": "roslings_class.fork_server",
        "terminals": str(Path("/dev/pts").stat().st_dev),
    }


def said(evidence: Evidence) -> Iterator[str]:
    """Every line that the package's processes wrote, the build's too."""
    if evidence.build:
        yield from evidence.build.output
    for seen in evidence.runs:
        for process in seen.processes.values():
            yield from (line.text for line in process.lines)
