"""`./roslings start`."""

from __future__ import annotations

import argparse

from ros2_on_pip.errors import OK
from ros2_on_pip.typed_paths import from_here, shown
from roslings import course
from roslings.commands.options import lab_options
from roslings.typed import program


def add_options(word: argparse.ArgumentParser) -> None:
    """The lab."""
    lab_options(word)


def run(options: argparse.Namespace) -> int:
    """Put a lab's starter into the workspace."""
    from roslings.workspace.student import start as put

    lab = course.lab(options.lab)
    started = put(lab)
    print(f"The starter of {lab.name!r} is in {shown(started.package)} ({started.files} files).")
    print(f"Read the task: {from_here(lab.task)}")
    print(f"Then check what you built: {program()} check {lab.name}")
    return OK
