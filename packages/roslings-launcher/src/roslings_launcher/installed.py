"""The command `roslings` where it came by pip or uv, and not from a clone.

    roslings new [DIR]   unpacks the course into a new folder, which then works as a clone does
    roslings doctor      where there is no course yet: looks at the computer alone
    roslings ...         hands over to the `./roslings` of the course that is nearest
    ROSLINGS_COURSE=DIR roslings ...
                         runs this engine in this environment on the course in DIR; it needs the
                         extras that the command needs: pip install 'roslings[ros,colcon,check]'

Standard library only: it runs where nothing else is installed, on any system.
"""

from __future__ import annotations

import os
import shutil
import sys
import tarfile
import tempfile
from collections.abc import Sequence
from importlib.metadata import EntryPoint, entry_points
from importlib.util import find_spec
from pathlib import Path, PurePosixPath
from typing import NoReturn

from roslings_launcher import __version__
from roslings_launcher.cli import begin
from roslings_launcher.cli.table import GROUP
from roslings_launcher.errors import LauncherTrouble, of_the_disk, say
from roslings_launcher.machine import require_unix, this_machine
from roslings_launcher.place import require_usable
from roslings_launcher.readiness import readiness
from roslings_launcher.seeds import interpreter
from roslings_launcher.sources import OFFERS

ARCHIVE = "course.tar.xz"
"""The whole course, in the students' edition; it lies in the engine's package in the wheel."""
SCRIPT = "roslings"
FOLDER = "roslings-course"
LAUNCHER = PurePosixPath("packages/roslings-launcher/src/roslings_launcher")
"""Where a course keeps what makes its environment."""
HERE = Path(__file__).parents[1] / "roslings"
HELP = ("-h", "--help", "help")

_WELCOME = f"""\
roslings {__version__}: learn ROS 2 Jazzy, with labs graded by running what you built.

There is no course in this folder yet.
  Next: roslings new               (makes the folder {FOLDER} here)
        roslings new DIR           (the same in DIR)
Then, in this folder or in the new one: roslings doctor, roslings lab, roslings check LAB"""

_MADE = """\
The course is in {folder}
  Next: cd {folder}
        ./roslings check example --solution   (a first grading, for real)
        ./roslings lab                        (today's lesson in JupyterLab)
        ./roslings doctor                     (a closer look at this machine)
Your own work lies elsewhere, in ~/roslings_ws: nothing here overwrites it."""


def main() -> int:
    """Run the command of this process; its exit code."""
    try:
        return _run(sys.argv[1:])
    except LauncherTrouble as trouble:
        say(str(trouble))
    except OSError as error:
        say(str(of_the_disk(error, Path())))
    return 2


def _run(words: Sequence[str]) -> int:
    if words[:1] == ["new"]:
        return _new(words[1:])
    if os.environ.get("ROSLINGS_COURSE"):
        return _run_here(words)
    if words == ["--version"]:
        print(f"roslings {__version__}")
        return 0
    if course := nearest_course(Path.cwd()):
        _hand_over(course, words)
    if words[:1] == ["doctor"]:
        say("There is no course in this folder: this looks at the computer alone.")
        begin()
    if not words or words[0] in HELP:
        print(_WELCOME)
        return 0
    raise LauncherTrouble(
        "There is no course in this folder or above it.", "Make one: roslings new"
    )


# --- the course's folder -----------------------------------------------------------------------


def _new(words: Sequence[str]) -> int:
    if len(words) > 1 or any(word.startswith("-") for word in words):
        print(f"roslings new [DIR]: put the course into a new folder (default: {FOLDER})")
        return 0 if set(words) & set(HELP) else 2
    folder = Path(*words or [FOLDER])
    unpack(folder.absolute())
    print(_MADE.format(folder=folder))
    print("\nThis machine:")
    for line in readiness(this_machine(), os.environ, folder.absolute()):
        print(line)
    return 0


def unpack(folder: Path) -> None:
    """Put the course into the new folder `folder`, whole or not at all.

    Raises LauncherTrouble where `folder` holds something, or the course would not run from there.
    """
    if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
        raise LauncherTrouble(
            f"{folder} holds something already, and nothing is ever overwritten.",
            "Give a new folder: roslings new DIR",
        )
    folder.parent.mkdir(parents=True, exist_ok=True)
    part = Path(tempfile.mkdtemp(prefix=f"{folder.name}.", dir=folder.parent))
    try:
        if os.name == "posix":  # on Windows only a container or WSL will run it
            require_usable(part)
        _fill(part)
        if folder.is_dir():
            folder.rmdir()
        part.rename(folder)
    finally:
        shutil.rmtree(part, ignore_errors=True)


def _fill(folder: Path) -> None:
    archive = HERE / ARCHIVE
    if not archive.is_file():
        raise LauncherTrouble(
            "This copy of roslings carries no course: it was not installed from a wheel.",
            "In a clone, use ./roslings. Elsewhere: pip install roslings",
        )
    folder.chmod(0o755)
    with tarfile.open(archive) as packed:
        if hasattr(tarfile, "data_filter"):
            packed.extraction_filter = tarfile.data_filter
        packed.extractall(folder)
    for point in entry_points(group=GROUP):
        _bring(point, folder)


def _bring(point: EntryPoint, folder: Path) -> None:
    """A package that is installed besides, as an instructor's are, comes along into the course."""
    module = point.module.partition(".")[0]
    found = find_spec(module)
    if any(folder.glob(f"packages/*/src/{module}")) or not (found and found.origin and point.dist):
        return
    package = folder / "packages" / point.dist.name
    ignored = shutil.ignore_patterns("__pycache__")
    shutil.copytree(Path(found.origin).parent, package / "src" / module, ignore=ignored)
    (package / OFFERS).write_text(point.dist.read_text(OFFERS) or "", "utf-8")


def nearest_course(start: Path) -> Path | None:
    """The course in `start`, above it, or in a folder `roslings-course` of one of these."""
    above = [start, *start.parents]
    around = [place for folder in above for place in (folder, folder / FOLDER)]
    return next(filter(is_course, around), None)


def is_course(folder: Path) -> bool:
    """Whether a folder works as a clone does."""
    return (folder / SCRIPT).is_file() and (folder / LAUNCHER).is_dir()


# --- where the command runs --------------------------------------------------------------------


def _hand_over(course: Path, words: Sequence[str]) -> NoReturn:
    """Become the course's own `./roslings`, which has an engine and an environment of its own."""
    require_unix(this_machine())
    if not os.environ.get("ROS_DISTRO"):  # a sourced ROS has a Python of its own
        os.environ.setdefault("ROSLINGS_PYTHON", interpreter())
    script = str(course / SCRIPT)
    os.execv(script, [script, *words])


def _run_here(words: Sequence[str]) -> int:
    sys.argv[1:] = words
    try:
        begin()
    except ModuleNotFoundError as error:
        raise LauncherTrouble(
            f"ROSLINGS_COURSE asks for this environment, and it has no {error.name}.",
            f"pip install 'roslings[ros,colcon,check]=={__version__}'",
            "Or leave ROSLINGS_COURSE away: each course has an environment of its own.",
        ) from None
    return 0
