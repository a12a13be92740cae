"""The reader of words, made from the table of commands."""

from __future__ import annotations

import argparse
from collections.abc import Sequence

from roslings_launcher import __version__
from roslings_launcher.cli.table import LEARNERS, TEACHERS, CommandEntry, commands, listed


def parser(names: Sequence[str] | None = None) -> argparse.ArgumentParser:
    """The commands of these names with their options, all where none is named; and what is next."""
    top = argparse.ArgumentParser(
        prog="./roslings",
        usage="./roslings [-h] [--version] COMMAND ...",
        description="Learn ROS 2 Jazzy day by day.",
        epilog=f"{_told('for learners', LEARNERS)}\n\n"
        f"{_told('for instructors and authors', TEACHERS)}\n\n"
        "Without a command it says what is next.",
        formatter_class=argparse.RawDescriptionHelpFormatter,
        allow_abbrev=False,
    )
    top.add_argument("--version", action="version", version=f"roslings {__version__}")
    top.set_defaults(command="")
    words = top.add_subparsers(metavar="COMMAND", help=argparse.SUPPRESS, prog=top.prog)
    for name, command in commands().items():
        if command.about and name and (names is None or name in names):
            _add(words, command)
    return top


def _add(words: argparse._SubParsersAction[argparse.ArgumentParser], command: CommandEntry) -> None:
    about = command.about[0].upper() + command.about[1:]
    word = words.add_parser(command.name, description=about, allow_abbrev=False)
    word.set_defaults(command=command.name)
    if not command.reads_its_words:
        command.load().add_options(word)


def _told(title: str, typed_by: str) -> str:
    width = 2 + max(len(name) for name, command in commands().items() if command.about)
    rows = [f"  {command.name:{width}}{command.about}" for command in listed(typed_by)]
    return "\n".join([f"{title}:", *rows])
