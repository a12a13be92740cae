"""`./roslings camera`: the rover's camera, for a node to read."""

from __future__ import annotations

import argparse
from pathlib import Path

from ros2_on_pip.errors import OK


def add_options(word: argparse.ArgumentParser) -> None:
    """What it takes."""
    word.add_argument(
        "--device",
        metavar="PATH",
        type=Path,
        help="default: /tmp/rover_camera; your own folder, if that is another user's",
    )
    word.add_argument(
        "--hue", type=int, default=5, metavar="0..179", help="the ball's colour, as OpenCV counts"
    )
    word.add_argument(
        "--noise", type=float, default=4.0, metavar="LEVELS", help="of each value, of 255"
    )


def run(options: argparse.Namespace) -> int:
    """Run the rover's camera until Ctrl-C."""
    from roslings_rover.camera.live import run as run_camera

    run_camera(options.device, options.hue, options.noise)
    return OK
