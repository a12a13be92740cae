"""`./roslings export`."""

from __future__ import annotations

import argparse
from pathlib import Path

from ros2_on_pip.errors import OK
from roslings import course
from roslings.commands.options import hidden_option, lab_options


def add_options(word: argparse.ArgumentParser) -> None:
    """What it takes."""
    word.add_argument("system", metavar="SYSTEM", help="gradescope, prairielearn, ... (any: help)")
    lab_options(word)
    word.add_argument("--to", metavar="DIR", type=Path, required=True, help="a new folder")
    hidden_option(word)


def run(options: argparse.Namespace) -> int:
    """Make what an instructor uploads to a grading platform."""
    from roslings_class.export import export as make

    lab = course.lab(options.lab, options.hidden)
    for line in make(options.system, lab, options.to):
        print(line)
    return OK
