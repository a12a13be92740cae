"""`./roslings diff`."""

from __future__ import annotations

import argparse

from ros2_on_pip.errors import OK
from ros2_on_pip.language import said
from roslings.commands.options import lab_options


def add_options(word: argparse.ArgumentParser) -> None:
    """The lab."""
    lab_options(word)


def run(options: argparse.Namespace) -> int:
    """Show what changed since the starter."""
    from ros2_on_pip.safe_text import harmless
    from roslings.workspace.own_card import own_lab
    from roslings.workspace.student import diff as changes

    lines = changes(own_lab(options.lab))
    for line in lines:
        print(harmless(line.rstrip("\n")))
    if not lines:
        print(said("diff.nothing", "Nothing is changed: this is the starter."))
    return OK
