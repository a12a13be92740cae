"""`ros2 launch`: start the nodes that a launch file names."""

from __future__ import annotations

import argparse
import signal
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ros2_on_pip import stopping
from ros2_on_pip.problem import CommandProblem, did_you_mean
from ros2_on_pip.shared_options import complete_packages
from ros2_on_pip.words import OK, add

if TYPE_CHECKING:
    from ros2_on_pip.launching.context import LaunchContext
    from ros2_on_pip.launching.screen import LaunchOutput

ENDINGS = (".xml", ".yaml", ".yml", ".py")
ASSIGN = ":="


class LaunchFileNotFound(CommandProblem):
    """The package, or the folder, has no such launch file."""

    def __init__(self, name: str, where: Path, there: list[str]) -> None:
        near = did_you_mean(name, there)
        has = f" It has: {', '.join(there)}." if there else ""
        super().__init__(
            f"file '{name}' was not found in the share directory of the package: {where}."
            f"{near}{has}\nIf it lies in your package, add it to data_files in setup.py,"
            " build again, and source install/setup.bash"
        )


class SeveralLaunchFiles(CommandProblem):
    """The package has two launch files of one name."""

    def __init__(self, name: str, package: str, found: list[Path]) -> None:
        paths = ", ".join(f"'{path}'" for path in found)
        super().__init__(
            f"file '{name}' was found more than once in the share directory of package"
            f" '{package}': [{paths}]. Give one of these paths instead: ros2 launch PATH"
        )


class NotALaunchFile(CommandProblem):
    """The path leads to no file."""

    def __init__(self, path: Path) -> None:
        super().__init__(
            f"No launch file at {path}. Give the path of a file, or a package and a file:"
            " ros2 launch PACKAGE FILE"
        )


class BadArgument(CommandProblem):
    """An argument is not of the form name:=value."""

    def __init__(self, word: str) -> None:
        super().__init__(f"malformed launch argument '{word}', expected format '<name>:=<value>'")


def declare(command: argparse.ArgumentParser) -> None:
    """The file and its arguments."""
    add(
        command,
        "package_name",
        complete=complete_packages,
        help="Name of the ROS package which contains the launch file, or a path to a launch file",
    )
    command.add_argument("launch_file_name", nargs="?", help="Name of the launch file")
    command.add_argument(
        "launch_arguments",
        nargs="*",
        help="Arguments to the launch file; '<name>:=<value>' (for duplicates, last one wins)",
    )
    command.add_argument(
        "-n",
        "--noninteractive",
        action="store_true",
        help="Run non-interactively (here it always does)",
    )
    command.add_argument(
        "-d",
        "--debug",
        action="store_true",
        help="Show the traceback of a fault in a launch file, too.",
    )
    one_of_them = command.add_mutually_exclusive_group()
    for short, long, about in (
        ("-p", "--print", "Print the launch description to the console without launching it."),
        ("-s", "--show-args", "Show arguments that may be given to the launch file."),
    ):
        names = [short, long] + (["--print-description"] if short == "-p" else ["--show-arguments"])
        one_of_them.add_argument(*names, action="store_true", help=about)
    command.add_argument(
        "-a",
        "--show-all-subprocesses-output",
        action="store_true",
        help="Show all launched subprocesses' output by overriding their output configuration.",
    )
    for name, about in (
        ("--launch-prefix", "Prefix command, which should go before all executables."),
        ("--launch-prefix-filter", "Regex pattern for which executables the prefix is for."),
    ):
        command.add_argument(name, help=about)
    command.set_defaults(run=launch)


def launch(options: argparse.Namespace) -> int:
    """`ros2 launch PACKAGE FILE ...` and `ros2 launch PATH ...`."""
    path, words = chosen_file(options)
    stopping.listen(signal.SIGTERM)
    with _context(options) as (context, screen):
        if options.show_args or options.print:
            return _show(options, context, path)
        return _carry_out(context, screen, path, dict(_argument(word) for word in words))


@contextmanager
def _context(options: argparse.Namespace) -> Iterator[tuple[LaunchContext, LaunchOutput]]:
    """What a launch needs around it, with what the options say."""
    from ros2_on_pip.launching.context import Around, LaunchContext
    from ros2_on_pip.launching.processes import OVERRIDE_OUTPUT
    from ros2_on_pip.launching.provided import offer
    from ros2_on_pip.launching.python_file import show_traces
    from ros2_on_pip.launching.reading import description_in
    from ros2_on_pip.launching.screen import LaunchOutput

    room = tempfile.TemporaryDirectory(prefix="roslings_launch_")
    with room as folder, LaunchOutput() as screen:
        offer()
        context = LaunchContext(around=Around(screen, Path(folder), description_in))
        for name in ("launch_prefix", "launch_prefix_filter"):
            if value := getattr(options, name):
                context.launch_configurations[name.replace("_", "-")] = value
        if options.debug:
            show_traces()
        if options.show_all_subprocesses_output:
            context.environment[OVERRIDE_OUTPUT] = "both"
        yield context, screen


def _show(options: argparse.Namespace, context: LaunchContext, path: Path) -> int:
    from ros2_on_pip.launching.showing import all_arguments, argument_lines, tree_lines

    path = path.absolute()
    with context.reading(path):
        description = context.description_in(path, "")
        if options.print:
            print("\n".join(tree_lines(description)))
        else:
            print("\n".join(argument_lines(all_arguments(context, description).values())))
    return OK


def _carry_out(
    context: LaunchContext, screen: LaunchOutput, path: Path, given: dict[str, str]
) -> int:
    from ros2_on_pip.launching.service import LaunchService
    from ros2_on_pip.launching.sources import IncludeLaunchDescription

    screen.say(f"[INFO] [launch]: All log files can be found below {screen.folder}")
    screen.say("[INFO] [launch]: Default logging verbosity is set to INFO")
    whole = IncludeLaunchDescription(str(path), launch_arguments=given.items())
    return LaunchService(context, screen).run(whole, lambda: _warn(given, context.declared))


def chosen_file(options: argparse.Namespace) -> tuple[Path, list[str]]:
    """The launch file, and the words that are arguments.

    Raises LaunchFileNotFound, NotALaunchFile.
    """
    first, second = options.package_name, options.launch_file_name
    words = list(options.launch_arguments)
    path = Path(first)
    if second is None or ASSIGN in second or (path.is_file() and not _is_package(first)):
        if not path.is_file():
            raise NotALaunchFile(path)
        return path, [*([second] if second else []), *words]
    return _in_package(first, second), words


def _is_package(name: str) -> bool:
    from ros2_on_pip.packages import packages

    return name in packages()


def _in_package(package: str, name: str) -> Path:
    from ros2_on_pip.packages import share_of

    share = share_of(package)
    files = [p for p in sorted(share.rglob("*")) if p.is_file()]
    found = [path for path in files if path.name == name]
    if len(found) > 1:
        raise SeveralLaunchFiles(name, package, found)
    if found:
        return found[0]
    there = [p.name for p in files if "launch" in p.name and p.suffix in ENDINGS]
    raise LaunchFileNotFound(name, share, there)


def _argument(word: str) -> tuple[str, str]:
    """Name and value; `a:=` has no value, and `a:=b:=` has one. Raises BadArgument."""
    name, assign, value = word.partition(ASSIGN)
    if not assign or not name or not value:
        raise BadArgument(word)
    return name, value


def _warn(given: dict[str, Any], known: list[str]) -> None:
    """An argument that the file does not have changes nothing: most likely it is misspelt."""
    for name in given:
        if name not in known:
            print(
                f"[WARNING] [launch]: the launch file has no argument '{name}'."
                f"{did_you_mean(name, known)}",
                file=sys.stderr,
            )
