"""`./roslings start`."""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from typing import TYPE_CHECKING

from ros2_on_pip.errors import OK
from ros2_on_pip.label_column import wrapped
from ros2_on_pip.language import counted, said
from ros2_on_pip.typed_paths import from_here, shown
from roslings.commands.invocation import program
from roslings.commands.options import lab_options, whose_option

if TYPE_CHECKING:
    from roslings.course import Lab
    from roslings.workspace.student import Started


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
    from roslings.workspace.own_card import own_lab, take_name, told_of
    from roslings.workspace.student import start as put

    if options.whose is not None:
        take_name(options.whose)
    told = list(told_of(options.lab))
    lab = own_lab(options.lab)
    started = put(lab)
    print("\n".join([*_told(lab, started), *told, *_next(lab)]))
    return OK


def _told(lab: Lab, started: Started) -> list[str]:
    one = "The starter of {lab!r} is in {package} ({count} file)."
    other = "The starter of {lab!r} is in {package} ({count} files)."
    package = shown(started.package)
    return wrapped(
        counted("start.done", started.files, one=one, other=other, lab=lab.name, package=package)
    )


def _next(lab: Lab) -> Iterator[str]:
    yield from wrapped(said("start.task", "Read the task: {task}", task=from_here(lab.task)))
    check = f"{program()} check {lab.name}"
    yield said("start.check", "Then check what you built: {command}", command=check)
