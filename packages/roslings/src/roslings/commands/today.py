"""`./roslings`: what is next."""

from __future__ import annotations

import argparse

from ros2_on_pip.errors import OK
from roslings.commands.way import bar, next_lines
from roslings.workspace import progress


def add_options(word: argparse.ArgumentParser) -> None:
    """Nothing."""


def run(options: argparse.Namespace) -> int:
    """Say what is next."""
    labs = progress.status()
    print("\n".join([bar(labs), "", *next_lines(labs, progress.today())]))
    return OK
