"""`ros2 launch`: start the nodes that an XML or a YAML launch file names."""

from __future__ import annotations

import argparse
import signal
import sys
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Any

from roslings.ros2 import stopping
from roslings.ros2.problem import Problem, did_you_mean
from roslings.ros2.shared_options import complete_packages
from roslings.ros2.words import OK, add

if TYPE_CHECKING:
    from roslings.ros2.launch.plan import Declared

ENDINGS = (".xml", ".yaml", ".yml", ".py")
ASSIGN = ":="


class LaunchFileNotFound(Problem):
    """The package, or the folder, has no such launch file."""

    def __init__(self, name: str, where: Path, there: list[str]) -> None:
        near = did_you_mean(name, there)
        has = f" It has: {', '.join(there)}." if there else ""
        super().__init__(
            f"file '{name}' was not found in the share directory of the package: {where}."
            f"{near}{has}\nIf it lies in your package, add it to data_files in setup.py,"
            " build again, and source install/setup.bash"
        )


class NoFile(Problem):
    """The path leads to no file."""

    def __init__(self, path: Path) -> None:
        super().__init__(
            f"No launch file at {path}. Give the path of a file, or a package and a file:"
            " ros2 launch PACKAGE FILE"
        )


class BadArgument(Problem):
    """An argument is not of the form name:=value."""

    def __init__(self, word: str) -> None:
        super().__init__(f"malformed launch argument '{word}', expected format '<name>:=<value>'")


def declare(command: argparse.ArgumentParser) -> None:
    """The file and its arguments."""
    command.add_argument(
        "-s", "--show-args", "--show-arguments", action="store_true",
        help="Show arguments that may be given to the launch file.",
    )  # fmt: skip
    add(
        command, "package_name", complete=complete_packages,
        help="Name of the ROS package which contains the launch file, or a path to a launch file",
    )  # fmt: skip
    command.add_argument("launch_file_name", nargs="?", help="Name of the launch file")
    command.add_argument(
        "launch_arguments", nargs="*",
        help="Arguments to the launch file; '<name>:=<value>' (for duplicates, last one wins)",
    )  # fmt: skip
    command.set_defaults(run=launch)


def launch(options: argparse.Namespace) -> int:
    """`ros2 launch PACKAGE FILE ...` and `ros2 launch PATH ...`."""
    from roslings.ros2.launch.crew import Crew
    from roslings.ros2.launch.plan import declared_in, plan

    path, words = chosen_file(options)
    if options.show_args:
        print("\n".join(argument_lines(declared_in(path))))
        return OK
    given = dict(_argument(word) for word in words)
    steps, declared = plan(path, given)
    _warn(given, [arg.name for arg in declared])
    stopping.listen(signal.SIGTERM)
    rooms = tempfile.TemporaryDirectory(prefix="roslings_launch_")
    with rooms as folder, Crew(Path(folder)) as crew:
        crew.say("[INFO] [launch]: Default logging verbosity is set to INFO")
        crew.carry_out(steps)
        return crew.run()


def chosen_file(options: argparse.Namespace) -> tuple[Path, list[str]]:
    """The launch file, and the words that are arguments. Raises LaunchFileNotFound, NoFile."""
    first, second = options.package_name, options.launch_file_name
    words = list(options.launch_arguments)
    if second is None or ASSIGN in second:
        path = Path(first)
        if not path.is_file():
            raise NoFile(path)
        return path, [*([second] if second else []), *words]
    return _in_package(first, second), words


def _in_package(package: str, name: str) -> Path:
    from roslings.ros2.packages import share_of

    share = share_of(package)
    files = [p for p in sorted(share.rglob("*")) if p.is_file()]
    for path in files:
        if path.name == name:
            return path
    there = [p.name for p in files if "launch" in p.name and p.suffix in ENDINGS]
    raise LaunchFileNotFound(name, share, there)


def _argument(word: str) -> tuple[str, str]:
    name, assign, value = word.partition(ASSIGN)
    if not assign or not name:
        raise BadArgument(word)
    return name, value


def _warn(given: dict[str, Any], known: list[str]) -> None:
    """An argument that the file does not have changes nothing: most likely it is misspelt."""
    for name in given:
        if name not in known:
            print(f"[WARNING] [launch]: the launch file has no argument '{name}'."
                  f"{did_you_mean(name, known)}", file=sys.stderr)  # fmt: skip


def argument_lines(declared: list[Declared]) -> list[str]:
    """The arguments of a launch file as the real tool lists them."""
    if not declared:
        return ["No arguments."]
    lines = ["Arguments (pass arguments as '<name>:=<value>'):"]
    for arg in declared:
        lines += ["", f"    '{arg.name}':", f"        {arg.description or 'no description given'}"]
        lines += [f"        (default: '{arg.default}')"] if arg.default is not None else []
    return lines
