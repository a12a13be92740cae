"""What works here and is refused by the full `ros2`: said in one line, for it breaks on a robot."""

from __future__ import annotations

import argparse
import sys
from typing import Any

from ros2_on_pip.names import absolute


def full_topic(name: str) -> str:
    """The name with its slash; a word is said where it was left out."""
    return _told(name, absolute(name))


def full_type(name: str, right: str) -> str:
    """The type's whole name; a word is said where the part in the middle was left out."""
    return _told(name, right)


def index_in_field(field: str) -> None:
    """`--field ranges[2]` names one element."""
    if "[" in field:
        _say(field, f"{field.partition('[')[0]}")


def full_node(name: str) -> str:
    """The name of a node with its slash, where the full tool does not add one."""
    return _told(name, absolute(name))


class ShortOnlyHere(argparse.Action):
    """A switch whose short form is ours alone."""

    def __call__(
        self,
        parser: argparse.ArgumentParser,
        namespace: argparse.Namespace,
        values: Any,
        option_string: str | None = None,
    ) -> None:
        """Set it, and say the long form where the short one was typed."""
        setattr(namespace, self.dest, True)
        if option_string and not option_string.startswith("--"):
            _say(option_string, self.option_strings[0])


class OnlyHere(argparse.Action):
    """An option that the full tool does not have with this verb."""

    def __call__(
        self,
        parser: argparse.ArgumentParser,
        namespace: argparse.Namespace,
        values: Any,
        option_string: str | None = None,
    ) -> None:
        """Keep its value, or that a switch was given, and say so."""
        setattr(namespace, self.dest, True if self.nargs == 0 else values)
        print(
            f"NOTE: on a robot, {parser.prog} does not take {option_string}. Leave it out there.",
            file=sys.stderr,
        )


def _told(typed: str, right: str) -> str:
    if typed != right:
        _say(typed, right)
    return right


def _say(typed: str, right: str) -> None:
    print(f"NOTE: write {right}. On a robot, ros2 does not take '{typed}' here.", file=sys.stderr)
