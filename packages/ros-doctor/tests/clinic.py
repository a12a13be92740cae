"""Machines for the doctor's tests: a tree of real files, variables, small programs."""

from __future__ import annotations

import contextlib
import grp
import os
import struct
from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from pathlib import Path

from ros_doctor.breaks.injuries import HEALTHY
from ros_doctor.examine import Examination, examine
from ros_doctor.finding import Finding, Status
from ros_doctor.machine import ExaminedMachine, Interpreter
from ros_doctor.registry import find_check
from ros_doctor.screen import Paint, lines_of

TODAY = 1_780_000_000.0  # 28 May 2026
PLENTY = 50_000_000_000
UBUNTU = 'ID=ubuntu\nVERSION_ID="{}"\nVERSION_CODENAME={}\nPRETTY_NAME="Ubuntu {} LTS"\n'
COMPILED = "_rclpy_pybind11.cpython-{}-x86_64-linux-gnu.so"
NOBODY = 65534


@dataclass
class Clinic:
    """One machine under construction. It begins healthy: Ubuntu 24.04 with ROS as wheels."""

    root: Path
    env: dict[str, str] = field(default_factory=dict)
    machine: ExaminedMachine = field(init=False)

    def __post_init__(self) -> None:
        for folder in ("home/sam", "dev/shm", "usr/bin", "proc", "course", "home/sam/roslings_ws"):
            (self.root / folder).mkdir(parents=True)
        self.env = {"PATH": str(self.root / "usr/bin"), "SHELL": "/bin/bash", "DISPLAY": ":0"}
        self.machine = ExaminedMachine(
            env=self.env,
            home=self.root / "home/sam",
            here=self.root / "home/sam",
            workspace=self.root / "home/sam/roslings_ws",
            clone=self.root / "course",
            interpreter=Interpreter((3, 12, 3), Path("/usr/bin/python3"), Path("/nowhere")),
            root=self.root,
            now=TODAY,
            free_bytes=lambda path: PLENTY,
        )
        self.ubuntu("24.04", "noble")
        self.file("/proc/meminfo", "MemTotal: 8000000 kB\nMemAvailable: 4000000 kB\n")
        self.wheels()

    def change(self, **changes: object) -> Clinic:
        """Change facts of the machine, as `dataclasses.replace` does."""
        self.machine = replace(self.machine, **changes)  # type: ignore[arg-type]
        return self

    def set(self, **variables: str) -> Clinic:
        """Set variables of the shell."""
        self.env.update(variables)
        return self

    def file(self, absolute: str, text: str = "") -> Path:
        """Write a file of this machine."""
        path = self.root / absolute.lstrip("/")
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
        return path

    def program(self, name: str, script: str = "exit 0", folder: str = "/usr/bin") -> Path:
        """Put a program on PATH; it is a real shell script."""
        path = self.file(f"{folder}/{name}", f"#!/bin/sh\n{script}\n")
        path.chmod(0o755)
        return path

    def ubuntu(self, version: str, codename: str) -> None:
        """Make it this release of Ubuntu."""
        self.file("/etc/os-release", UBUNTU.format(version, codename, version))

    def packages(self) -> Path:
        """Return the folder of the Python packages of the wheels."""
        return self.root / "course/.venv/lib/python3.12/site-packages"

    def wheels(self) -> None:
        """Install ROS as wheels, as the course's set-up lays it out, and activate it."""
        venv = "/course/.venv"
        self.file(f"{venv}/pyvenv.cfg", "home = /usr/bin\nversion = 3.12.3\n")
        self.file(f"{venv}/bin/activate", f'VIRTUAL_ENV="{self.root / "course/.venv"}"\n')
        for name in ("python", "python3", "colcon"):
            self.program(name, folder=f"{venv}/bin")
        self.file(f"{venv}/lib/python3.12/site-packages/rclpy/{COMPILED.format(312)}")
        self.file(f"{venv}/lib/python3.12/site-packages/colcon_ros/__init__.py")
        self.file(f"{venv}/lib/librmw_fastrtps_cpp.so")
        self.env["PATH"] = f"{self.root / 'course/.venv/bin'}:{self.env['PATH']}"

    def no_ros(self) -> Clinic:
        """Take the wheels away."""
        import shutil

        shutil.rmtree(self.root / "course/.venv")
        return self

    def apt(self, sourced: bool) -> Clinic:
        """Install ROS from apt instead, in /opt/ros/jazzy."""
        self.no_ros()
        self.file("/opt/ros/jazzy/setup.bash")
        self.file(f"/opt/ros/jazzy/lib/python3.12/site-packages/rclpy/{COMPILED.format(312)}")
        self.file("/opt/ros/jazzy/lib/librmw_fastrtps_cpp.so")
        self.program("python3", "echo 3 12")
        if sourced:
            prefix = str(self.root / "opt/ros/jazzy")
            self.set(ROS_DISTRO="jazzy", AMENT_PREFIX_PATH=prefix)
        return self

    def package(self, name: str = "greeter") -> Path:
        """Put a healthy package into the workspace and return its folder."""
        import shutil

        target = self.machine.workspace / "src" / name
        ignored = shutil.ignore_patterns("__pycache__")
        shutil.copytree(HEALTHY / "src/greeter", target, ignore=ignored)
        return target

    def installed(self, package: Path) -> Path:
        """Lay out `install` as colcon does for a plain build, and return the prefix."""
        import shutil

        install = self.machine.workspace / "install"
        prefix = install / "greeter"
        site = prefix / "lib/python3.12/site-packages"
        ignored = shutil.ignore_patterns("__pycache__")
        shutil.copytree(package / "greeter", site / "greeter", ignore=ignored)
        share = prefix / "share/greeter"
        shutil.copytree(package / "launch", share / "launch")
        shutil.copy(package / "package.xml", share / "package.xml")
        notes = site / "greeter-0.0.1-py3.12.egg-info"
        notes.mkdir()
        points = "[console_scripts]\nhello = greeter.hello:main\n"
        (notes / "entry_points.txt").write_text(points)
        (install / "setup.bash").touch()
        return prefix

    def give_to_student(self) -> None:
        """Where root runs the tests, give the workspace to the student, whose number is 1000."""
        if os.getuid() == 0:
            for path in (self.machine.workspace, *self.machine.workspace.rglob("*")):
                os.chown(path, 1000, 1000, follow_symlinks=False)

    def look(self, id: str, **variables: str) -> Finding:
        """Set variables, run one check as the doctor does, and return what it found."""
        self.set(**variables)
        assert_typed_anywhere(examine(replace(self.machine, has_course=False), [find_check(id)]))
        return examine(self.machine, [find_check(id)]).results[0].finding


def assert_typed_anywhere(seen: Examination) -> None:
    """Where there is no folder of the course, nothing of it is to be typed."""
    (result,) = seen.results
    assert "./roslings" not in "\n".join(lines_of(seen, Paint(False), detailed=True)), result
    needs = result.finding.status in (Status.FAULT, Status.WARNING)
    assert result.finding.mend or not needs, result


def assert_ill(finding: Finding, status: str, said: str, typed: str = "") -> None:
    """The check found it, says it, and its mend holds this command."""
    assert finding.status == Status(status), finding
    assert said in finding.found
    assert finding.mend, "a finding without a mend"
    assert typed in "\n".join(step.command for step in finding.mend)


def assert_well(finding: Finding) -> None:
    """The check looked and found nothing to mend."""
    assert finding.status == Status.OK, finding


def assert_absent(finding: Finding) -> None:
    """The check does not apply to this machine, and says why."""
    assert finding.status == Status.NOT_APPLICABLE, finding
    assert finding.found


def change_text(path: Path, old: str, new: str) -> None:
    """Replace a text in a file, which must be there."""
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new))


@contextlib.contextmanager
def ordinary_user() -> Iterator[None]:
    """Act as a user without rights where the tests run as root, for whom nothing is forbidden."""
    if os.getuid() != 0:
        yield
        return
    groups = os.getgroups()
    grp.getgrgid(0)  # loads what a user without rights might not be able to load
    os.setgroups([])
    os.seteuid(NOBODY)
    try:
        yield
    finally:
        os.seteuid(0)
        os.setgroups(groups)


def public_key(made: int, life: int | None) -> bytes:
    """Return the packets of an OpenPGP key that was made at `made` and lives `life` seconds."""
    key = bytes([4]) + struct.pack(">I", made) + bytes([22, 0])
    hashed = bytes([5, 2]) + struct.pack(">I", made)
    if life is not None:
        hashed += bytes([5, 9]) + struct.pack(">I", life)
    signature = bytes([4, 0x13, 22, 8]) + struct.pack(">H", len(hashed)) + hashed + bytes(4)
    return _packet(6, key) + _packet(13, b"Somebody") + _packet(2, signature)


def _packet(tag: int, body: bytes) -> bytes:
    return bytes([0xC0 | tag, len(body)]) + body
