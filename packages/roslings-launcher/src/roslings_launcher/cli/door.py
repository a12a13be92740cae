"""Where the paths of a command line come in: each becomes absolute here, once."""

from __future__ import annotations

import argparse
from pathlib import Path

from roslings_launcher.paths import absolute

STDOUT = Path("-")
"""No file: what is written goes to the terminal."""


def absolute_paths(options: argparse.Namespace) -> argparse.Namespace:
    """The options, with each path in them absolute."""
    for name, value in vars(options).items():
        setattr(options, name, _absolute_in(value))
    return options


def _absolute_in(value: object) -> object:
    """A path, or each path of a list; all else as it is."""
    if isinstance(value, list):
        return [_absolute_in(each) for each in value]
    return absolute(value) if isinstance(value, Path) and value != STDOUT else value
