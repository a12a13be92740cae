"""`ros2 run`: becomes the executable, so that Ctrl-C and the exit code are the node's own."""

from __future__ import annotations

import argparse
import os
import shlex
import shutil
import signal
import sys
from typing import Any

from ros2_on_pip.problem import CommandProblem
from ros2_on_pip.shared_options import complete_packages
from ros2_on_pip.words import add


class CannotRunExecutable(CommandProblem):
    """The system refused to start the executable."""

    def __init__(self, command: list[str], error: OSError) -> None:
        super().__init__(
            f"{command[0]} could not be started: {error.strerror or error}."
            " If the package was moved or its environment is gone, build it again: colcon build"
        )


def declare(command: argparse.ArgumentParser) -> None:
    """Package, executable, and words for the executable."""
    command.add_argument(
        "--prefix",
        help="Prefix command, which should go before the executable."
        " Put it in quotes if it contains spaces (e.g. --prefix 'gdb -ex run --args').",
    )
    add(command, "package_name", complete=complete_packages, help="Name of the ROS package")
    add(command, "executable_name", complete=complete_executables, help="Name of the executable")
    command.add_argument(
        "argv", nargs=argparse.REMAINDER, help="Pass arbitrary arguments to the executable"
    )
    command.set_defaults(run=run)


def complete_executables(parsed_args: argparse.Namespace, **_: Any) -> list[str]:
    """The executables of the package just typed, for the Tab key."""
    from ros2_on_pip.packages import executables, name_of

    return [name_of(place) for place in executables(parsed_args.package_name)]


def run(options: argparse.Namespace) -> int:
    """`ros2 run PACKAGE EXECUTABLE ...`; comes back from a window in place of another one only."""
    from ros2_on_pip.packages import PackageNotFound, executable
    from ros2_on_pip.programs import command_of, environment_of
    from ros2_on_pip.well_known import answer_for

    try:
        program = executable(options.package_name, options.executable_name)
    except PackageNotFound:
        from ros2_on_pip.windows import window_of  # only now: it asks what is installed

        if window := window_of(options.package_name):
            return window.open(options.argv)
        answer_for(options.package_name)
        raise
    command = [*shlex.split(options.prefix or ""), *command_of(program), *options.argv]
    become(command, environment_of(program))
    raise AssertionError("execve does not return")


def become(command: list[str], environment: dict[str, str]) -> None:
    """Replace this process by `command`, which Ctrl-C can end again. Raises CannotRunExecutable."""
    sys.stdout.flush()
    # A shell that starts us in the background makes us deaf to Ctrl-C; the node must hear it.
    signal.signal(signal.SIGINT, signal.SIG_DFL)
    program = shutil.which(command[0]) or command[0]
    try:
        os.execve(program, command, environment)
    except OSError as error:
        raise CannotRunExecutable(command, error) from error
