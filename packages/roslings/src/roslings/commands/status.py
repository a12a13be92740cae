"""`./roslings status`: which days and labs are done."""

from __future__ import annotations

import argparse

from ros2_on_pip.errors import OK
from roslings.way import FIRST_DAY, bar, how_far, how_far_is_the_first_day
from roslings.workspace import progress


def add_options(word: argparse.ArgumentParser) -> None:
    """Nothing."""


def run(options: argparse.Namespace) -> int:
    """Show days and labs done."""
    labs = progress.status()
    day_width = 2 + max(len(each.lab.outline.day) for each in labs)
    lab_width = 2 + max(len(each.lab.name) for each in labs)
    day = FIRST_DAY
    print(f"{day:{day_width}}{'':{lab_width}}{how_far_is_the_first_day(labs)}")
    for each in labs:
        shown = "" if each.lab.outline.day == day else each.lab.outline.day
        day = each.lab.outline.day
        print(f"{shown:{day_width}}{each.lab.name:{lab_width}}{how_far(each)}")
    print(f"\n{bar(labs)}")
    return OK
