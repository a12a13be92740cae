"""`./roslings forget`."""

from __future__ import annotations

import argparse
from pathlib import Path

from ros2_on_pip.errors import OK


def add_options(word: argparse.ArgumentParser) -> None:
    """What it takes."""
    word.add_argument("folder", metavar="DIR", type=Path, help="the --out of ./roslings grade")
    word.add_argument("submission", metavar="SUBMISSION", help="its name, as in grades.csv")


def run(options: argparse.Namespace) -> int:
    """Delete what is kept of one submission."""
    from roslings_class.forgetting import forget

    print("\n".join(forget(options.folder, options.submission)))
    return OK
