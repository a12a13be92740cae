"""`./roslings start`."""

from __future__ import annotations

import argparse

from ros2_on_pip.errors import OK
from ros2_on_pip.typed_paths import from_here, shown
from roslings.commands.options import lab_options, whose_option
from roslings.typed import program


def add_options(word: argparse.ArgumentParser) -> None:
    """The lab."""
    lab_options(word)
    whose_option(
        word,
        "whose card it is, where each student has another one: the number or the"
        " name that your teacher has in the class list",
    )


def run(options: argparse.Namespace) -> int:
    """Put a lab's starter into the workspace."""
    from roslings.own_card import own_lab, take_name, told_of
    from roslings.workspace.student import start as put

    if options.whose is not None:
        take_name(options.whose)
    told = list(told_of(options.lab))
    lab = own_lab(options.lab)
    started = put(lab)
    print(f"The starter of {lab.name!r} is in {shown(started.package)} ({started.files} files).")
    print("".join(f"{line}\n" for line in told), end="")
    print(f"Read the task: {from_here(lab.task)}")
    print(f"Then check what you built: {program()} check {lab.name}")
    return OK
