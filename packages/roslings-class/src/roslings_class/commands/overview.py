"""`./roslings overview`: all labs of a class in one table."""

from __future__ import annotations

import argparse
from pathlib import Path

from ros2_on_pip.errors import OK


def add_options(word: argparse.ArgumentParser) -> None:
    """What it takes."""
    word.add_argument(
        "folders",
        metavar="DIR",
        type=Path,
        nargs="+",
        help="the --out of ./roslings grade, one for each lab",
    )
    word.add_argument(
        "--out",
        metavar="DIR",
        type=Path,
        required=True,
        help="where overview.html and overview.csv go",
    )
    word.add_argument(
        "--roster",
        metavar="FILE",
        type=Path,
        help="the class list (default: all who are in the lists of the labs)",
    )


def run(options: argparse.Namespace) -> int:
    """Write the table, and say who has not begun and who stopped where."""
    from roslings_class.command import make_private
    from roslings_class.overview import overview
    from roslings_class.overview_page import write_overview

    found = overview(options.folders, options.roster)
    make_private(options.out)
    print("\n".join(write_overview(found, options.out)))
    return OK
