"""The machine as the checks see it: variables, files, programs. A test builds an ill one."""

from __future__ import annotations

import os
import platform
import shutil
import subprocess
import sys
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

LARGEST_TEXT = 2_000_000  # bytes; a file of settings is never longer


@dataclass(frozen=True)
class CommandOutput:
    """What a command answered: its exit code and its output, both streams together."""

    code: int
    output: str


@dataclass(frozen=True)
class Interpreter:
    """The Python that runs the doctor: its version, its program, the folder it lives in."""

    version: tuple[int, int, int]
    program: Path
    prefix: Path


@dataclass(frozen=True)
class ExaminedMachine:
    """Everything that a check may look at.

    `root` stands for `/`, so that a test can show a tree of its own. It is applied to the paths
    that a check names (`machine.path("/etc/os-release")`), never to paths that come from
    variables or from the workspace.
    """

    env: Mapping[str, str]
    home: Path
    here: Path
    workspace: Path
    clone: Path
    interpreter: Interpreter
    root: Path = Path("/")
    system: str = "Linux"  # as platform.system() says it: Linux, Darwin, Windows
    architecture: str = "x86_64"
    glibc: tuple[int, ...] = (2, 39)  # empty where the C library is another one
    user: int = 1000
    now: float = 0.0  # seconds since 1970, as this machine believes
    has_course: bool = True  # `clone` is a folder of the roslings course
    free_bytes: Callable[[Path], int] = lambda path: shutil.disk_usage(path).free

    @property
    def linux(self) -> bool:
        """True on Linux, WSL and containers included."""
        return self.system == "Linux"

    def path(self, absolute: str) -> Path:
        """Return where the file `absolute` of this machine really lies."""
        return self.root / absolute.lstrip("/")

    def read(self, absolute: str) -> str:
        """Return the text of a file of this machine, or "" where it cannot be read."""
        return read_text(self.path(absolute))

    def which(self, program: str) -> Path | None:
        """Return where the student's shell would find `program`."""
        found = shutil.which(program, path=self.env.get("PATH", ""))
        return Path(found) if found else None

    def run(self, *command: str, timeout_s: float = 2.0) -> CommandOutput | None:
        """Run a program that only reads, with the student's variables.

        Returns None where it is missing, cannot start, or takes longer than `timeout_s`.
        """
        program = self.which(command[0])
        if program is None:
            return None
        try:
            done = subprocess.run(
                [str(program), *command[1:]],
                env=dict(self.env),
                stdin=subprocess.DEVNULL,
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                timeout=timeout_s,
                check=False,
            )
        except (OSError, subprocess.TimeoutExpired):
            return None
        return CommandOutput(done.returncode, done.stdout.decode(errors="replace"))

    def variable_paths(self, name: str) -> list[Path]:
        """Return the folders that a variable like PATH lists, without the empty ones."""
        return [Path(part) for part in self.env.get(name, "").split(os.pathsep) if part]


def read_text(path: Path) -> str:
    """Return the text of `path`, or "" where it cannot be read. Device files have a zero at
    the end of a line; it is dropped."""
    try:
        with path.open("rb") as file:
            return file.read(LARGEST_TEXT).decode(errors="replace").replace("\0", "")
    except OSError:
        return ""


def exists(path: Path) -> bool:
    """Tell whether `path` exists; a folder that may not be entered counts as absent."""
    try:
        return path.exists()
    except OSError:
        return False


def default_workspace(env: Mapping[str, str], home: Path) -> Path:
    """Return the student's workspace: ROSLINGS_WS, or `~/roslings_ws`."""
    named = env.get("ROSLINGS_WS", "")
    return Path(named).expanduser() if named else home / "roslings_ws"


def _here(home: Path) -> Path:
    try:
        return Path.cwd()
    except OSError:  # the folder was deleted under the shell
        return home


def _glibc() -> tuple[int, ...]:
    try:
        name = os.confstr("CS_GNU_LIBC_VERSION") or ""
    except (AttributeError, OSError, ValueError):  # not Linux, or musl
        return ()
    return tuple(int(part) for part in name.split()[-1].split(".") if part.isdigit())


def _course() -> Path | None:
    """Return the course's folder that this package lies in; None where it came by pip."""
    folder = Path(__file__).resolve().parents[4]
    return folder if exists(folder / "roslings") and exists(folder / "labs") else None


def this_machine(workspace: Path | None = None) -> ExaminedMachine:
    """Return the machine that this process runs on."""
    course = _course()
    env = dict(os.environ)
    home = Path(os.path.expanduser("~"))  # noqa: PTH111  Path.home() raises without HOME
    return ExaminedMachine(
        env=env,
        home=home,
        here=_here(home),
        workspace=workspace or default_workspace(env, home),
        clone=course or Path(sys.prefix),
        has_course=course is not None,
        interpreter=Interpreter(
            sys.version_info[:3], Path(sys.executable or "python3"), Path(sys.prefix)
        ),
        system=platform.system(),
        architecture=platform.machine(),
        glibc=_glibc(),
        user=os.getuid() if hasattr(os, "getuid") else 1000,
        now=time.time(),
    )
