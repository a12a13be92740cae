"""The command line: which words there are, and what runs for each.

Only the standard library is imported at the top, so that `./roslings --help` answers at once and
`./roslings doctor` runs where nothing is installed yet.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Sequence
from difflib import get_close_matches
from importlib import import_module

from roslings.bootstrap.paths import absolute_variables
from roslings.cli.door import absolute_paths
from roslings.cli.parser import NAMES, parser
from roslings.cli.unlisted import unlist
from roslings.errors import INTERRUPTED, OK, WRONG_USE, explain

__all__ = ["for_pytest", "main", "parser", "run"]

OTHERS = {
    "doctor": "roslings.doctor.cli",
    "break": "roslings.doctor.breaks",
    "ros2": "roslings.ros2.cli",
    "rqt_graph": "roslings.ros2.rqt_graph",
}
"""Commands that read their words themselves, to the module whose `main` takes them."""
ONLY_IN_FULL = ("rqt", "rqt_console", "rqt_plot", "rviz2")
"""Commands of the full ROS that say what to use here, as `roslings.ros2.absent.COMMANDS`."""


def main(arguments: Sequence[str]) -> int:
    """Run one command; returns its exit code."""
    absolute_variables()
    name, rest = (arguments[0], list(arguments[1:])) if arguments else ("", [])
    if name in OTHERS:
        other: Callable[[list[str]], int] = import_module(OTHERS[name]).main
        return other(rest)
    if name in ONLY_IN_FULL:
        from roslings.ros2.absent import main as absent

        return absent(name, rest)
    if name and not name.startswith("-") and name not in NAMES:
        return _unknown(name)
    options = parser().parse_args(["test", "--", *rest] if for_pytest(arguments) else arguments)
    if hidden := getattr(options, "hidden", None):
        unlist(hidden)
    return run(options.command, absolute_paths(options))


def _unknown(name: str) -> int:
    near = get_close_matches(name, NAMES, n=1)
    said = f"Did you mean {near[0]}?" if near else "All commands: ./roslings --help"
    print(f"roslings: there is no command {name!r}. {said}", file=sys.stderr)
    return WRONG_USE


def for_pytest(arguments: Sequence[str]) -> bool:
    """What follows `test` is pytest's, options too; only the help is ours."""
    return arguments[:1] == ["test"] and not {"-h", "--help"} & set(arguments)


def run(command: Callable[[argparse.Namespace], int], options: argparse.Namespace) -> int:
    """Run a command; what it cannot do is one clear message, never a traceback of ours."""
    try:
        return command(options)
    except KeyboardInterrupt:
        print("\nStopped.", file=sys.stderr)
        return INTERRUPTED
    except BrokenPipeError:
        sys.stderr.close()  # nobody reads any more: end without a complaint
        return OK
    except Exception as error:
        return explain(error)
