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
        if isinstance(value, Path) and value != STDOUT:
            setattr(options, name, absolute(value))
    return options
