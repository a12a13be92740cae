"""Commands that the script `./roslings` runs by itself: here stands what `--help` says of them."""

from __future__ import annotations

import argparse


def add_options(word: argparse.ArgumentParser) -> None:
    """Nothing that the script would not read by itself."""


def run(options: argparse.Namespace) -> int:
    """Reached only where the script is not: on a course that came by pip, for example."""
    raise NotADirectoryError(
        f"`{options.command}` is a command of the script ./roslings of a course's own folder."
    )
