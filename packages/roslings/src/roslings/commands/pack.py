"""`./roslings pack`."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from ros2_on_pip.errors import OK
from ros2_on_pip.label_column import wrapped
from ros2_on_pip.language import counted, said
from ros2_on_pip.typed_paths import shown
from roslings.commands.options import package_options, soak_option
from roslings.workspace.student import package_of

if TYPE_CHECKING:
    from roslings.course import Lab
    from roslings.workspace.student import Packed


def add_options(word: argparse.ArgumentParser) -> None:
    """What it takes."""
    package_options(word)
    word.add_argument("--out", metavar="FILE", type=Path, help="the zip (default: LAB.zip here)")
    soak_option(word, "as where it is graded; 0 skips it")


def run(options: argparse.Namespace) -> int:
    """Make the zip to hand in."""
    from roslings.workspace.own_card import own_lab
    from roslings.workspace.student import pack as zip_it

    lab = own_lab(options.lab)
    packed = zip_it(lab, options.out, options.path)
    print("\n".join(wrapped(_told(packed))))
    print(said("pack.hand_in", "Hand in this one file."), flush=True)
    _let_run(lab, options)
    return OK


def _told(packed: Packed) -> str:
    fields = {"file": shown(packed.path), "size": packed.size_bytes}
    count = len(packed.files)
    if packed.replaced:
        one = "Replaced {file}: {count} file, {size:,} bytes."
        other = "Replaced {file}: {count} files, {size:,} bytes."
        return counted("pack.replaced", count, one=one, other=other, **fields)
    one = "Made {file}: {count} file, {size:,} bytes."
    other = "Made {file}: {count} files, {size:,} bytes."
    return counted("pack.made", count, one=one, other=other, **fields)


def _let_run(lab: Lab, options: argparse.Namespace) -> None:
    """Let the nodes run as they will where they are graded; the file is there, whatever comes."""
    from roslings.course.soak import soak_seconds
    from roslings.grading.handing_in import left_running
    from roslings.report.progress import ProgressLine

    if for_s := soak_seconds(lab.card, options.soak):
        try:
            with ProgressLine() as progress:
                lines = left_running(lab, package_of(lab, options.path), for_s, progress.step)
        except KeyboardInterrupt:
            unwatched = "Your nodes were not watched to the end. The file is whole."
            lines = [said("pack.unwatched", unwatched)]
        print("\n".join(part for line in lines for part in wrapped(line)))
