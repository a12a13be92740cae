"""What a machine may lack, so that a test is skipped: each has a name and a probe, which tries it.

A test skips by such a name only: `needs` and `skip_without` of `skips.py`. A probe asks nothing of
`roslings`: an engine that finds no walls where there are some must fail its tests, not skip them.
A probe says why there is none; nothing where there is one.
"""

from __future__ import annotations

import importlib
import os
import shutil
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Literal

Environment = Mapping[str, str]
Probe = Callable[[Environment], str]

ROOT = Path(__file__).resolve().parents[1]
STARTED_WITH: Environment = dict(os.environ)
"""What a test changes for itself changes no probe."""
ANSWERS_WITHIN_S = 120
SPARE_UID = 65534
BARE = (sys.executable, "-I", "-S", "-c")


@dataclass(frozen=True)
class Need:
    """One thing that is not on every machine."""

    name: str
    """A noun: the summary says "12 no NAME"."""
    probe: Probe
    kind: Literal["machine", "time"] = "machine"


# --- programs ----------------------------------------------------------------------------------


def answer(environment: Environment, *words: str) -> str:
    """Run a command to its end: nothing where it succeeds, else the last line that it says."""
    if shutil.which(words[0], path=environment.get("PATH", "")) is None:
        return f"there is no program {words[0]}"
    try:
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run(
                words,
                env=dict(environment),
                cwd=folder,
                capture_output=True,
                text=True,
                check=False,
                timeout=ANSWERS_WITHIN_S,
                stdin=subprocess.DEVNULL,
            )
    except (OSError, subprocess.TimeoutExpired) as error:
        return str(error)
    said = (done.stderr or done.stdout).strip().splitlines()
    return (said[-1:] or [f"{words[0]} ends with {done.returncode}"])[0] if done.returncode else ""


def runs(*words: str) -> Probe:
    """A command that succeeds."""
    return lambda environment: answer(environment, *words)


def one_of(*probes: Probe) -> Probe:
    """The first that is there; why the last is not."""

    def probe(environment: Environment) -> str:
        lack = ""
        for each in probes:
            if not (lack := each(environment)):
                return ""
        return lack

    return probe


def all_of(*probes: Probe) -> Probe:
    """Why the first that is not there is not."""
    return lambda environment: next(filter(None, (each(environment) for each in probes)), "")


def colcon(environment: Environment) -> str:
    """In the environment that runs the tests, or wherever ROS has it."""
    path = os.pathsep.join([str(Path(sys.executable).parent), environment.get("PATH", "")])
    return answer({**environment, "PATH": path}, "colcon", "--help")


ARDUINO = Path("/usr/share/arduino/hardware/arduino/avr/cores/arduino/Arduino.h")
COMPILES_FOR_THE_BOARD = """
echo '#include <avr/io.h>' >board.cpp && avr-g++ -mmcu=atmega2560 -c board.cpp &&
echo '#include <simavr/sim_avr.h>' >runner.c && gcc $(pkg-config --cflags simavr) -c runner.c
"""


def emulated_board(environment: Environment) -> str:
    """The Arduino's compiler, its core, and the emulator's headers: a line for each is compiled."""
    if not ARDUINO.is_file():
        return f"there is no {ARDUINO}"
    return answer(environment, "sh", "-c", COMPILES_FOR_THE_BOARD)


def python(minor: int) -> Need:
    """Of the path, and it is that one: a stub of pyenv's may be none."""
    asks = f"import sys; sys.exit(sys.version_info[:2] != (3, {minor}))"
    return Need(f"Python 3.{minor}", runs(f"python3.{minor}", "-c", asks))


# --- what the kernel allows --------------------------------------------------------------------

OWN_NAMESPACES = """
import ctypes, fcntl, os, pathlib, socket, struct, sys
user, group = os.getuid(), os.getgid()
if ctypes.CDLL(None, use_errno=True).unshare(0x10000000 | 0x20000000 | 0x40000000 | 0x20000):
    sys.exit(os.strerror(ctypes.get_errno()))
for name, words in (("setgroups", "deny"), ("uid_map", f"{user} {user} 1"),
                    ("gid_map", f"{group} {group} 1")):
    pathlib.Path("/proc/self", name).write_text(words)
with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as control:
    fcntl.ioctl(control, 0x8914, struct.pack("16sH14x", b"lo", 1))  # SIOCSIFFLAGS, IFF_UP
os.waitpid(os.fork() or os._exit(0), 0)
"""


def namespaces(environment: Environment) -> str:
    """Of users, mounts, processes and a network whose loopback can be raised."""
    if chosen := environment.get("ROSLINGS_ISOLATION"):
        return f"ROSLINGS_ISOLATION={chosen} asks for another wall"
    return answer(environment, *BARE, OWN_NAMESPACES)


MOUNTS = ("mount", "-t", "tmpfs", "-o", "size=64k", "none", "/mnt")
AS_ROOT_THERE = ("unshare", "--user", "--map-root-user")
LIMITS = "echo 0 >/proc/sys/user/max_net_namespaces"


def tun(_: Environment) -> str:
    """Opened: in many containers it is only named."""
    try:
        os.close(os.open("/dev/net/tun", os.O_RDWR))
    except OSError as error:
        return str(error.strerror)
    return ""


def root(_: Environment) -> str:
    """The user who may be every other."""
    return "" if os.geteuid() == 0 else f"the tests run as user {os.geteuid()}"


def other_users(environment: Environment) -> str:
    """Root becomes somebody who can read the Python that runs these tests."""
    script = str(ROOT / "tests/rogues/as_ordinary.py")
    shows = ("unshare", "--mount", *BARE[:-1], script, str(SPARE_UID), sys.prefix, sys.base_prefix)
    return root(environment) or answer(environment, *shows, "--", sys.executable, "-c", "")


def control_group(*controllers: str) -> Probe:
    """A group is made where this process's own is, or above it, and taken away again."""

    def probe(_: Environment) -> str:
        wanted = set(controllers)
        places = [folder for folder, held in group_places() if wanted & held]
        if any(_can_make_in(folder) for folder in places):
            return ""
        return f"no group for {' and '.join(controllers)} can be made"

    return probe


def group_places() -> Iterator[tuple[Path, set[str]]]:
    """Folders for groups, with what is controlled in them: cgroups(7), version 1 and 2."""
    own = dict(
        line.split(":", 2)[1:] for line in Path("/proc/self/cgroup").read_text().splitlines()
    )
    for line in Path("/proc/self/mountinfo").read_text().splitlines():
        words = line.split()
        kind, options = words[words.index("-") + 1], words[-1].split(",")
        mount = Path(words[4])
        if kind == "cgroup2" and "" in own:
            folder = mount / own[""].lstrip("/")
            above = [each for each in (folder, *folder.parents) if each.is_relative_to(mount)]
            for each in above:
                yield each, _handed_down(each)
        elif kind == "cgroup":
            for name in own.keys() & set(options):
                yield _inside(mount, own[name], words[3]), {name}


def _inside(mount: Path, own: str, shown: str) -> Path:
    """Where the own group lies below a mount that shows the part `shown` of the tree."""
    return mount / os.path.relpath(own, shown) if own.startswith(shown) else mount


def _handed_down(folder: Path) -> set[str]:
    try:
        held = set((folder / "cgroup.subtree_control").read_text().split())
    except OSError:
        return set()
    return held if held >= {"pids", "memory"} else set()


def _can_make_in(folder: Path) -> bool:
    made = folder / f"probe-{os.getpid()}"
    try:
        made.mkdir()
        made.rmdir()
    except OSError:
        return False
    return True


COUNTS_BY_NAMESPACE = (5, 14)
"""From this Linux on, RLIMIT_NPROC holds what is in a namespace, and not root's."""


def bounded_processes(environment: Environment) -> str:
    """By a group; for an ordinary user by a limit too."""
    release = tuple(int(word) for word in os.uname().release.split(".")[:2] if word.isdecimal())
    if os.geteuid() != 0 and release >= COUNTS_BY_NAMESPACE:
        return ""
    return control_group("pids")(environment)


FILTERS_CALLS = """
import ctypes, os, sys
if os.uname().machine not in ("x86_64", "aarch64"):
    sys.exit("no filter is known for " + os.uname().machine)
libc = ctypes.CDLL(None, use_errno=True)
class Filter(ctypes.Structure):
    _fields_ = (("lines", ctypes.c_ushort), ("program", ctypes.c_char_p))
libc.prctl(38, 1, 0, 0, 0)
allowed = Filter(1, bytes.fromhex("060000000000ff7f"))
if libc.prctl(22, 2, ctypes.byref(allowed), 0, 0):
    sys.exit(os.strerror(ctypes.get_errno()))
"""
HAS_KEYS = """
import ctypes, os, sys
number = {"x86_64": 250, "aarch64": 219}.get(os.uname().machine)
libc = ctypes.CDLL(None, use_errno=True)
if number is None or libc.syscall(number, 1, None) < 0:
    sys.exit(os.strerror(ctypes.get_errno()) if number else "no number of keyctl is known")
"""
CONFINES_FILES = """
import ctypes, os, sys
libc = ctypes.CDLL(None, use_errno=True)
if libc.syscall(444, None, ctypes.c_size_t(0), 1) < 1:
    sys.exit(os.strerror(ctypes.get_errno()))
"""
"""Landlock's version."""


def bare(source: str) -> Probe:
    """A script in a Python without site packages; what it exits with is why not."""
    return runs(*BARE, source)


def schedstat(_: Environment) -> str:
    """How long a thread has waited for a processor."""
    try:
        counts = Path("/proc/self/schedstat").read_text("ascii").split()
    except OSError as error:
        return str(error.strerror)
    return "" if counts[1:2] != ["0"] or int(counts[0]) > 0 else "the kernel counts nothing"


def loopback_multicast(_: Environment) -> str:
    """One packet, to nobody but this machine."""
    group = "239.255.77.77"
    try:
        with (
            socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as receiver,
            socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as sender,
        ):
            own = socket.inet_aton("127.0.0.1")
            receiver.bind(("", 0))
            receiver.settimeout(5)
            receiver.setsockopt(
                socket.IPPROTO_IP, socket.IP_ADD_MEMBERSHIP, socket.inet_aton(group) + own
            )
            sender.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_IF, own)
            sender.setsockopt(socket.IPPROTO_IP, socket.IP_MULTICAST_TTL, 0)
            sender.sendto(b"one", (group, receiver.getsockname()[1]))
            receiver.recv(16)
    except OSError as error:
        return str(error)
    return ""


def packets(_: Environment) -> str:
    """Reading along on the loopback."""
    try:
        with socket.socket(socket.AF_PACKET, socket.SOCK_DGRAM, socket.htons(3)) as source:
            source.bind(("lo", 3))
    except OSError as error:
        return str(error.strerror)
    return ""


# --- the environment of the tests --------------------------------------------------------------


def module(name: str) -> Need:
    """Imported here. One that is there and cannot be imported is no reason to skip."""

    def probe(_: Environment) -> str:
        try:
            importlib.import_module(name)
        except ModuleNotFoundError as error:
            return str(error) if error.name == name else ""
        except Exception:
            return ""
        return ""

    return Need(f"module {name}", probe)


def beside_pytest(_: Environment) -> str:
    """`./roslings test` has both; a bare virtual environment has not."""
    try:
        return "" if version("pip") and version("setuptools") else "one has no version"
    except PackageNotFoundError as error:
        return f"{error} is not installed beside pytest"


def ros_from_pip(_: Environment) -> str:
    """Where apt's is sourced, pip installs less."""
    try:
        return "" if version("ros-rclpy") else "it has no version"
    except PackageNotFoundError:
        return "ros-rclpy is not installed by pip"


def own_environment(_: Environment) -> str:
    """That `setup.bash` sources."""
    there = Path(sys.prefix) == ROOT / ".venv"
    return "" if there else f"{sys.prefix} runs the tests"


def made_by_us(_: Environment) -> str:
    """With what the first use of `./roslings` compiles."""
    there = Path(sys.prefix, "roslings/bytecode").exists()
    return "" if there else f"{sys.prefix} was made by something else"


def copied_python(environment: Environment) -> str:
    """Copied to another folder, it takes the library of that folder, here an empty one."""
    base = getattr(sys, "_base_executable", "") or sys.executable
    with tempfile.TemporaryDirectory() as name:
        library = Path(name, "lib", f"python3.{sys.version_info.minor}")
        library.mkdir(parents=True)
        for part in Path(os.__file__).parent.iterdir():
            if part.name not in ("ensurepip", "site-packages", "dist-packages"):
                (library / part.name).symlink_to(part)
        Path(name, "bin").mkdir()
        copy = shutil.copy(base, Path(name, "bin", library.name))
        sees = answer(environment, str(copy), "-c", "import ensurepip")
    return "" if "No module named" in sees else "it still sees the whole library"


# --- time --------------------------------------------------------------------------------------


def time_for(what: str, variable: str) -> Need:
    """`.ci/run` names the moment, in seconds since 1970, after which none of it begins."""

    def probe(environment: Environment) -> str:
        over = time.time() >= float(environment.get(variable, "inf"))
        return f"the moment in {variable} is over" if over else ""

    return Need(f"time for {what}", probe, "time")


# --- the table ---------------------------------------------------------------------------------

MODULES = (
    "ros_doctor",
    "axe_playwright_python",
    "distributed",
    "jsonschema",
    "matplotlib",
    "numpy",
    "playwright",
    "rclpy",
    "rosbags",
    "serial",
    "test_msgs",
    "tf2_msgs",
)
PYTHONS = range(9, 16)
FROM_APT: Environment = {"PATH": "/usr/bin:/bin"}

NEEDS = (
    Need("namespaces", namespaces),
    Need("unshare", runs(*AS_ROOT_THERE, "--net", "true")),
    Need("small disk", runs(*AS_ROOT_THERE, "--mount", *MOUNTS)),
    Need("small disk of root's", all_of(root, runs("unshare", "--mount", *MOUNTS))),
    Need(
        "user without rights",
        runs("unshare", "--user", "--map-user=1000", "--map-group=1000", "true"),
    ),
    Need(
        "limit one level down", runs("unshare", "--user", "--map-current-user", "sh", "-c", LIMITS)
    ),
    Need("bubblewrap", runs("bwrap", "--unshare-all", "--ro-bind", "/", "/", "true")),
    Need("setpriv", runs("/usr/bin/setpriv", "--version")),
    Need("bounded processes", bounded_processes),
    Need("control group for memory", control_group("memory")),
    Need("root", root),
    Need("other users", other_users),
    Need("useradd", runs("useradd", "--help")),
    Need("filter of system calls", bare(FILTERS_CALLS)),
    Need("keys of the kernel", bare(HAS_KEYS)),
    Need("Landlock", bare(CONFINES_FILES)),
    Need("/dev/net/tun", tun),
    Need("loopback with multicast", loopback_multicast),
    Need("packets of the loopback", packets),
    Need("schedstat", schedstat),
    Need("Chromium", one_of(runs("chromium", "--version"), runs("chromium-browser", "--version"))),
    Need("colcon", colcon),
    Need("buildah", runs("buildah", "--version")),
    Need("debootstrap", runs("debootstrap", "--version")),
    Need("uvx", runs("uvx", "--version")),
    Need("C and C++ compiler", all_of(runs("cc", "--version"), runs("c++", "--version"))),
    Need("emulated board", emulated_board),
    Need("apt", lambda _: all_of(runs("apt-get", "--version"), runs("python3", "-V"))(FROM_APT)),
    Need("pip from apt", lambda _: answer(FROM_APT, "apt-get", "download", "python3-pip-whl")),
    Need("pip beside pytest", beside_pytest),
    Need("ROS from pip", ros_from_pip),
    Need("environment for setup.bash", own_environment),
    Need("environment made by ./roslings", made_by_us),
    Need("Python that can be copied", copied_python),
    *map(python, PYTHONS),
    *map(module, MODULES),
    time_for("slow tests", "ROSLINGS_SLOW_UNTIL"),
    time_for("what takes the whole machine", "ROSLINGS_TESTS_UNTIL"),
    time_for("packages", "ROSLINGS_MUTANTS_UNTIL"),
)
TABLE = {each.name: each for each in NEEDS}


def lack_of(name: str) -> str:
    """Why it is not here; nothing where it is. What is no matter of time is tried once."""
    need = TABLE[name]
    return need.probe(STARTED_WITH) if need.kind == "time" else _tried_once(name)


@cache
def _tried_once(name: str) -> str:
    return TABLE[name].probe(STARTED_WITH)
