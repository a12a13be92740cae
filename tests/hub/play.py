"""Script: a JupyterHub with two users of a server, and what each of them sees. As root:

    unshare --mount --pid --fork --kill-child --mount-proc --net python play.py SETTINGS

SETTINGS is a JSON file with what `Played` has. The users are made by `useradd` in a copy of /etc
that is seen in here alone; /tmp is another one, too, and the network is the loopback. So nothing
of it is left on the computer, and JupyterHub has the ports that its page names. What was seen is
printed as JSON.
"""

from __future__ import annotations

import fcntl
import json
import os
import shutil
import socket
import struct
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from students import Student, Terminal

ROGUES = Path(__file__).resolve().parents[1] / "rogues"
sys.path.insert(0, str(ROGUES))
import as_ordinary  # noqa: E402

SIOCSIFFLAGS, IFF_UP, IFF_MULTICAST = 0x8914, 1, 0x1000

USERS = {"anna": 2015, "ben": 2016}
"""Numbers as the second and third account of a class have them: two domains."""
SPEEDS = {"anna": 0.5, "ben": 0.25}
TWIST = "geometry_msgs/msg/Twist"
ECHO = "ros2 topic echo --once --field linear.x /cmd_vel"
ACROSS = f"for id in 97 98; do ROS_DOMAIN_ID=$id {ECHO}; done"
"""Nothing but the number keeps them apart: who asks for the other's hears it."""
OPEN = {"ROS_AUTOMATIC_DISCOVERY_RANGE": "SUBNET", "FASTDDS_BUILTIN_TRANSPORTS": "UDPv4"}
"""On one computer and without a network, two users do not hear each other anyway: neither may open
the other's shared memory. So they drive as beside a robot in a network, where all is heard."""
LISTENING = f"""
import os
os.environ.update({OPEN})
from roslings_learn.notebook import session
with session() as ros:
    speeds = [each.linear.x for each in ros.collect('/cmd_vel', count=20)]
print('domain', os.environ['ROS_DOMAIN_ID'], 'heard', sorted(set(speeds)))
"""


@dataclass(frozen=True)
class Played:
    """Folders of this play, and what the page says."""

    folder: str
    """Homes, and what JupyterHub keeps; it lies below /tmp, and everybody may enter it."""
    course: str
    python: tuple[str, ...]
    """Folders that a Python of this computer needs; users may not enter the home around it."""
    config: str
    start: str
    """The lines that start JupyterHub."""


# --- the stage ----------------------------------------------------------------------------------


def set_up(played: Played) -> None:
    """Another /etc with two more users, another /tmp, a loopback, and a Python for all."""
    as_ordinary.show([Path(each) for each in played.python])
    _own_tmp(Path(played.folder))
    etc = Path(played.folder, "etc")
    shutil.copytree("/etc", etc, symlinks=True)
    as_ordinary.mount(str(etc), "/etc", None, as_ordinary.MS_BIND)
    for name, number in USERS.items():
        _account(name, number, Path(played.folder, "home"))
    Path("/etc/jupyterhub_config.py").write_text(played.config, "utf-8")
    _raise_loopback()


def _raise_loopback() -> None:
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as control:
        fcntl.ioctl(control, SIOCSIFFLAGS, struct.pack("16sH14x", b"lo", IFF_UP | IFF_MULTICAST))


def _own_tmp(kept: Path) -> None:
    """/tmp has the names of devices, which a grading beside us may use."""
    held = tempfile.mkdtemp(dir="/var/tmp")
    flags = as_ordinary.MS_BIND | as_ordinary.MS_REC
    as_ordinary.mount(str(kept), held, None, flags)
    as_ordinary.mount("tmpfs", "/tmp", "tmpfs", 0, "mode=1777")
    kept.mkdir(parents=True)
    as_ordinary.mount(held, str(kept), None, flags)
    as_ordinary.libc.umount2(held.encode(), as_ordinary.MNT_DETACH)
    Path(held).rmdir()


def _account(name: str, number: int, homes: Path) -> None:
    homes.mkdir(exist_ok=True)
    words = ["useradd", "--create-home", "--base-dir", str(homes), "--shell", "/bin/bash"]
    subprocess.run([*words, "--uid", str(number), name], check=True)
    subprocess.run(["chpasswd"], input=f"{name}:{name}'s word\n", text=True, check=True)


@contextmanager
def hub(played: Played) -> Iterator[None]:
    """JupyterHub, as the page starts it. What it says lies in `hub.log`."""
    plain = {"PATH": "/usr/sbin:/usr/bin:/sbin:/bin", "HOME": "/root", "LANG": "C.UTF-8"}
    with (
        Path(played.folder, "hub.log").open("w") as log,
        subprocess.Popen(
            ["bash", "-ec", f"{played.start}\n"], stdout=log, stderr=log, env=plain
        ) as server,
    ):
        try:
            yield
        finally:
            server.kill()


# --- what they do -------------------------------------------------------------------------------


def play(course: str) -> dict[str, Any]:
    """What each has seen."""
    students = {name: Student(name, f"{name}'s word") for name in USERS}
    for student in students.values():
        student.log_in()
    said = {name: _ready(student.terminal(), course) for name, student in students.items()}
    seen = {name: {"terminal": text} for name, (_, text) in said.items()}
    for name, (terminal, _) in said.items():
        _drive(terminal, SPEEDS[name])
    for name, student in students.items():
        seen[name]["kernel"] = student.run(LISTENING)
    for device in ("board", "camera"):
        for name, student in students.items():
            terminal, _ = _ready(student.terminal(), course)
            seen[name][device] = terminal.type(f"roslings {device}", until="Ctrl-C ends it")
    for name, (terminal, _) in said.items():
        seen[name]["topic"] = terminal.type("ros2 topic info /cmd_vel")
        seen[name]["across"] = terminal.type(ACROSS)
        seen[name]["who"] = terminal.type("id -un; ls -d ~/roslings_ws/notebooks/01-install")
    return seen


def _ready(terminal: Terminal, course: str) -> tuple[Terminal, str]:
    """With what a terminal says that is made ready twice, and the domain."""
    line = f"source {course}/setup.bash"
    said = terminal.type(line) + terminal.type(line) + terminal.type("env | grep ^ROS_")
    terminal.type(f"export {' '.join(f'{name}={value}' for name, value in OPEN.items())}")
    return terminal, said


def _drive(terminal: Terminal, speed: float) -> None:
    """In the background, until the terminal goes."""
    command = f"ros2 topic pub -r 20 /cmd_vel {TWIST} '{{linear: {{x: {speed}}}}}'"
    terminal.type(f"({command} >/dev/null &)")


def main(settings: Path) -> None:
    """Set up, play, print."""
    os.umask(0o022)
    played = Played(**json.loads(settings.read_text("utf-8")))
    set_up(played)
    with hub(played):
        print(json.dumps(play(played.course)), flush=True)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
