"""`ros2 doctor`: the doctor of roslings, which looks at more than the real one."""

from __future__ import annotations

import argparse


def declare(command: argparse.ArgumentParser) -> None:
    """Every word after `doctor` goes to the doctor."""
    command.add_argument("rest", nargs=argparse.REMAINDER, help="words for ./roslings doctor")
    command.set_defaults(run=examine)


def examine(options: argparse.Namespace) -> int:
    """`ros2 doctor ...`."""
    from roslings.doctor.cli import main

    return main(options.rest)
