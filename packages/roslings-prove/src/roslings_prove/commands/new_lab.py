"""`./roslings new-lab`: make a small lab that works, to change it."""

from __future__ import annotations

import argparse

from ros2_on_pip.errors import OK
from ros2_on_pip.typed_paths import from_here


def add_options(word: argparse.ArgumentParser) -> None:
    """What it takes."""
    word.add_argument("lab", metavar="NAME", help="for example: line-follower")
    word.add_argument("--package", metavar="NAME", help="default: the lab's name, with _ for -")
    word.add_argument("--day", metavar="DAY", help="a folder of days/ (default: the last)")


def run(options: argparse.Namespace) -> int:
    """Make a small lab that works."""
    from roslings_prove.new_lab import new_lab as make

    lab = make(options.lab, options.package, options.day)
    print(f"The lab {lab.name!r} is in {from_here(lab.folder)}.")
    print(f"Its grader is {from_here(lab.grader)}. Both work as they are; change them.")
    print(f"Then prove it: ./roslings prove {lab.name}")
    return OK
