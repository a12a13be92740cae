"""This terminal: what it has sourced, in which order, and what is gone since."""

from __future__ import annotations

import os
import re
from dataclasses import dataclass
from pathlib import Path

from ros_doctor.finding import (
    Finding,
    advice,
    do,
    not_applicable,
    ok,
    say,
    warning,
)
from ros_doctor.machine import ExaminedMachine, exists, read_text
from ros_doctor.mends import STARTUP_FILES, new_terminal, quoted, shell_name
from ros_doctor.registry import check
from ros_doctor.texts import said


@dataclass(frozen=True)
class StartupLine:
    """One line of a file that a new terminal reads, and the file that it sources."""

    file: str
    number: int
    text: str
    sourced: Path


def startup_lines(machine: ExaminedMachine) -> list[StartupLine]:
    """Return the lines that source a setup file of ROS or of a workspace."""
    found = []
    for name in STARTUP_FILES:
        for number, line in enumerate(read_text(machine.home / name).splitlines(), start=1):
            sourced = re.match(r"\s*(?:source|\.)\s+[\"']?(\S*setup\.(?:ba|z)?sh)\b", line)
            if sourced:
                path = _expanded(sourced.group(1), machine.home)
                found.append(StartupLine(f"~/{name}", number, line.strip(), path))
    return found


def _expanded(text: str, home: Path) -> Path:
    for short in ("~", "$HOME", "${HOME}"):
        if text.startswith(short + "/"):
            return home / text[len(short) + 1 :]
    return Path(text)


@check(
    "startup-files",
    "A new terminal sources files that exist",
    looks_at="the lines with setup.bash in ~/.bashrc, ~/.zshrc and ~/.profile",
    lesson="01-install#source",
    rows=(9,),
)
def startup_files(machine: ExaminedMachine) -> Finding:
    """Each new terminal greets you with 'No such file or directory'."""
    lines = startup_lines(machine)
    gone = [line for line in lines if line.sourced.is_absolute() and not _there(machine, line)]
    if not gone:
        return ok(
            said(
                "doctor.shell.startup_files.ok_if",
                "{count} lines source a setup file.",
                count=len(lines),
            )
            if lines
            else said("doctor.shell.startup_files.ok_else", "No such line.")
        )
    first = gone[0]
    return warning(
        said(
            "doctor.shell.startup_files.warning",
            "Line {number} of {file} sources a file that does not exist: {sourced}",
            number=first.number,
            file=first.file,
            sourced=first.sourced,
        ),
        say(
            said(
                "doctor.shell.startup_files.say",
                "Delete this line from {file}:  {text}",
                file=first.file,
                text=first.text,
            )
        ),
        do(
            f"nano +{first.number} {first.file}",
            said("doctor.shell.startup_files.do", "This opens the file at that line:"),
        ),
    )


def _there(machine: ExaminedMachine, line: StartupLine) -> bool:
    system = str(line.sourced).startswith("/opt/")
    return exists(machine.path(str(line.sourced)) if system else line.sourced)


@check(
    "dead-prefixes",
    "All folders that this terminal searches exist",
    looks_at="AMENT_PREFIX_PATH, COLCON_PREFIX_PATH and CMAKE_PREFIX_PATH",
    lesson="03-topics#source",
    rows=(9,),
)
def dead_prefixes(machine: ExaminedMachine) -> Finding:
    """colcon warns: 'The path ... in the environment variable AMENT_PREFIX_PATH doesn't exist'."""
    for variable in ("AMENT_PREFIX_PATH", "COLCON_PREFIX_PATH", "CMAKE_PREFIX_PATH"):
        gone = [path for path in machine.variable_paths(variable) if not exists(path)]
        if gone:
            return warning(
                said(
                    "doctor.shell.dead_prefixes.warning",
                    "{variable} names a folder that is gone: {gone}",
                    variable=variable,
                    gone=gone[0],
                ),
                new_terminal(),
                say(
                    said(
                        "doctor.shell.dead_prefixes.say",
                        "Source your workspace again there, after you built it.",
                    )
                ),
            )
    return ok(said("doctor.shell.dead_prefixes.ok", "Every folder exists."))


@check(
    "overlay",
    "This terminal knows the packages that you built",
    looks_at="the install folder of the workspace, and AMENT_PREFIX_PATH",
    lesson="03-topics#source",
    rows=(8,),
)
def overlay(machine: ExaminedMachine) -> Finding:
    """ros2 run says: 'Package not found'."""
    install = machine.workspace / "install"
    setup = install / f"setup.{shell_name(machine)}"
    if not exists(setup):
        return not_applicable(
            said("doctor.shell.overlay.not_applicable", "nothing is built in the workspace yet")
        )
    known = [path.resolve() for path in machine.variable_paths("AMENT_PREFIX_PATH")]
    built = [path.parents[1].resolve() for path in install.glob("*/share/*/package.xml")]
    missing = [path for path in built if path.parent not in known and path not in _parents(known)]
    if not missing:
        return ok(said("doctor.shell.overlay.ok", "The workspace is sourced."))
    mend = do(
        f"source {quoted(setup)}",
        said("doctor.shell.overlay.do", "Type this in each terminal where you run your nodes:"),
    )
    names = ", ".join(sorted({path.parent.name for path in missing}))
    if len(missing) < len(built):  # sourced before they were built
        return warning(
            said(
                "doctor.shell.overlay.warning",
                "This terminal does not know what you built later: {names}.",
                names=names,
            ),
            mend,
        )
    return advice(
        said(
            "doctor.shell.overlay.advice",
            "This terminal does not know the packages of {workspace}: {names}. In a "
            "terminal where you only build, that is right.",
            workspace=machine.workspace,
            names=names,
        ),
        mend,
    )


def _parents(paths: list[Path]) -> set[Path]:
    return {*paths, *(path.parent for path in paths)}


@check(
    "build-terminal",
    "You build in one terminal and run in another",
    looks_at="the variables that colcon noted in log/latest_build/events.log",
    lesson="03-topics/step-by-step#two-terminals",
    rows=(10,),
)
def build_terminal(machine: ExaminedMachine) -> Finding:
    """A deleted file still runs, or colcon warns about packages that it would override."""
    events = machine.workspace / "log" / "latest_build" / "events.log"
    noted = re.search(r"'AMENT_PREFIX_PATH': '([^']*)'", read_text(events))
    if not exists(events):
        return not_applicable(
            said("doctor.shell.build_terminal.not_applicable", "colcon has built nothing here yet")
        )
    install = str(machine.workspace / "install")
    before = noted.group(1).split(os.pathsep) if noted else []
    if not any(path == install or path.startswith(install + os.sep) for path in before):
        return ok(
            said(
                "doctor.shell.build_terminal.ok",
                "The last build was made in a terminal of its own.",
            )
        )
    return advice(
        said(
            "doctor.shell.build_terminal.advice",
            "Your last build was made in a terminal that had sourced the same workspace.",
        ),
        say(
            said("doctor.shell.build_terminal.say", "Open a second terminal and build only there:")
        ),
        do(f"cd {quoted(machine.workspace)}\ncolcon build"),
        say(
            said(
                "doctor.shell.build_terminal.say_2",
                "Source install/setup.bash only in the terminals where you run nodes.",
            )
        ),
    )


@check(
    "python-path",
    "No file of yours hides a package of Python or ROS",
    looks_at="names like rclpy.py or logging.py in the folder where you are",
    lesson="02-nodes#names",
)
def python_path(machine: ExaminedMachine) -> Finding:
    """'partially initialized module rclpy', or 'cannot import name ... from rclpy'."""
    hiding = sorted(
        path.name for path in machine.here.glob("*.py") if path.stem in HIDDEN_BY_ACCIDENT
    )
    if not hiding:
        return ok(said("doctor.shell.python_path.ok", "No such file in this folder."))
    path = machine.here / hiding[0]
    return warning(
        said(
            "doctor.shell.python_path.warning",
            "Your file {path} has the name of a package. Python imports it instead.",
            path=path,
        ),
        do(
            f"mv {quoted(path)} {quoted(path.with_name('my_' + path.name))}",
            said("doctor.shell.python_path.do", "Give it another name:"),
        ),
    )


HIDDEN_BY_ACCIDENT = frozenset(
    [
        "rclpy",
        "std_msgs",
        "sensor_msgs",
        "geometry_msgs",
        "serial",
        "logging",
        "random",
        "queue",
        "signal",
        "string",
        "struct",
        "threading",
        "types",
        "numpy",
        "cv2",
        "yaml",
    ]
)
