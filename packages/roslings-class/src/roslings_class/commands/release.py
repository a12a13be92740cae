"""`./roslings release`: make the students' edition, without solutions."""

from __future__ import annotations

import argparse
from pathlib import Path

from ros2_on_pip.errors import OK
from ros2_on_pip.typed_paths import from_here


def add_options(word: argparse.ArgumentParser) -> None:
    """What it takes."""
    word.add_argument("--to", metavar="DIR", type=Path, required=True, help="a new folder")


def run(options: argparse.Namespace) -> int:
    """Make the students' edition."""
    from roslings_class.release import release as make

    edition = make(options.to)
    print(f"The students' edition is in {from_here(options.to)}: {len(edition.names)} files.")
    print("No solution, no mutant and no hidden check is in it.")
    for remark in edition.remarks:
        print(remark)
    return OK
