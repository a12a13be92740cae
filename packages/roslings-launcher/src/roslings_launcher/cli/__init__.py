"""The command line: which words there are, and what runs for each.

Only the standard library is imported at the top, so that `./roslings --help` answers at once and
`./roslings doctor` runs where nothing is installed yet.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Sequence
from difflib import get_close_matches
from typing import Any, NoReturn

from roslings_launcher.cli.door import absolute_paths
from roslings_launcher.cli.parser import parser
from roslings_launcher.cli.table import commands
from roslings_launcher.cli.unlisted import unlist
from roslings_launcher.paths import absolute_variables

__all__ = ["begin", "for_pytest", "main", "parser", "run"]

OK, WRONG_USE, INTERRUPTED = 0, 2, 130
MEANT = {
    "build": "check",
    "run": "check",
    "grade-me": "check",
    "verify": "check",
    "submit": "pack",
    "hand-in": "pack",
    "zip": "pack",
    "exercise": "drill",
    "drills": "drill",
    "drill-list": "drill --list",
    "list": "status",
    "hint": "check LAB --hint, or drill NAME --hint",
    "hints": "check LAB --hint, or drill NAME --hint",
    "solution": "check LAB --solution, or drill NAME --solution",
    "lesson": "lab",
    "lessons": "lab",
    "notebook": "lab",
    "jupyter": "lab",
    "day": "lab",
    "labs": "status",
    "progress": "status",
    "score": "status",
    "scores": "status",
    "reset": "watch, and then the key x",
    "skip": "watch, and then the key s",
    "next": "./roslings without a word",
    "today": "./roslings without a word",
    "questions": "quiz",
    "drive": "rover --keys",
    "sim": "rover",
    "simulator": "rover",
    "map": "rover",
    "docs": "site",
    "web": "site",
    "install": "doctor",
}
"""What people type to what they mean: words of other programs, and of speech."""
STATUS = "exit_status"
"""An error that has it is one of ours: its text is for whoever typed the command."""


def begin() -> NoReturn:
    """The whole life of a process: run the words that it was given."""
    words = sys.argv[1:]
    status = main(words)
    command = commands().get(words[0]) if words else None
    if command and (leave := getattr(command.load(), "leave", None)):
        leave(status)
    sys.exit(status)


def main(arguments: Sequence[str]) -> int:
    """Run one command; returns its exit code."""
    absolute_variables()
    name, rest = (arguments[0], list(arguments[1:])) if arguments else ("", [])
    command = commands().get(name)
    if command and command.reads_its_words:
        status: int = command.load()(rest)
        return status
    if not command and not name.startswith("-"):
        return _unknown(name)
    words = ["test", "--", *rest] if for_pytest(arguments) else arguments
    options = parser([name]).parse_args(words)
    if hidden := getattr(options, "hidden", None):
        unlist(hidden)
    return run(commands()[options.command].load().run, absolute_paths(options))


def _unknown(name: str) -> int:
    known = [each for each, command in commands().items() if command.about and each]
    near = get_close_matches(name.lower(), [*known, *MEANT], n=1)
    meant = MEANT.get(near[0], near[0]) if near else ""
    said = f"Did you mean {meant}?" if near else "All commands: ./roslings --help"
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


def explain(error: Exception) -> int:
    """Say what went wrong; the exit code tells whose fault it is. Raises what nobody expects."""
    code = exit_code_of(error)
    if code is None:
        raise error
    print(f"roslings: {error}", file=sys.stderr)
    return code


def exit_code_of(error: Any) -> int | None:
    """The exit code for what went wrong; None for what nobody expected."""
    if isinstance(error, FileExistsError | NotADirectoryError):
        return WRONG_USE
    status: int | None = getattr(error, STATUS, None)
    return status
