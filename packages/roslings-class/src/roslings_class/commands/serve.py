"""`./roslings serve`: hand out the course in a room without the internet."""

from __future__ import annotations

import argparse
import tempfile
from pathlib import Path

from ros2_on_pip.errors import OK

PORT = 8000


def add_options(word: argparse.ArgumentParser) -> None:
    """What it takes."""
    word.add_argument(
        "--wheels", metavar="DIR", type=Path, help="the packages: what `./roslings wheels DIR` made"
    )
    word.add_argument(
        "--site", metavar="DIR", type=Path, help="the built website (default: build/site/html)"
    )
    word.add_argument("--host", default="0.0.0.0", help="this card only (default: all)")
    word.add_argument("--port", type=int, default=PORT, help=f"default: {PORT}")


def run(options: argparse.Namespace) -> int:
    """Make the edition and the wheel, and hand them out until Ctrl-C."""
    from roslings_class.classroom import made_in, serving, told
    from roslings_rover.stop_signal import listening

    with tempfile.TemporaryDirectory(prefix="roslings-") as scratch:
        print("Making the students' edition and its wheel ...", flush=True)
        offered = made_in(Path(scratch).resolve(), options.wheels, options.site)
        with listening() as asked, serving(offered, options.host, options.port) as addresses:
            print(told(offered, addresses), flush=True)
            asked.wait()
            print()
    return OK
