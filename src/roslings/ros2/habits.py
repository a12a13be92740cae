"""What works here and is refused by the full `ros2`: said in one line, for it breaks on a robot."""

from __future__ import annotations

import sys

from roslings.ros2.names import absolute


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


def _told(typed: str, right: str) -> str:
    if typed != right:
        _say(typed, right)
    return right


def _say(typed: str, right: str) -> None:
    print(f"NOTE: write {right}. On a robot, ros2 does not take '{typed}' here.", file=sys.stderr)
