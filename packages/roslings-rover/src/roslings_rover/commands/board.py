"""`./roslings board`: the rover's Arduino board on a serial port."""

from __future__ import annotations

import argparse
from pathlib import Path

from ros2_on_pip.errors import OK


def add_options(word: argparse.ArgumentParser) -> None:
    """What it takes."""
    word.add_argument(
        "--port",
        metavar="FILE",
        type=Path,
        help="default: /tmp/ttyROVER; your own folder, if that is another user's",
    )
    word.add_argument(
        "--sketch",
        metavar="FILE.ino",
        type=Path,
        help="run this sketch, in an emulated Mega",
    )


def run(options: argparse.Namespace) -> int:
    """Run the rover's board on a serial port until Ctrl-C."""
    from roslings_rover.board.live import run as run_board

    run_board(options.port, options.sketch)
    return OK
