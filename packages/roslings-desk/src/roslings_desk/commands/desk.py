"""`./roslings desk`: a page in the browser to drive, and to look at topics and services."""

from __future__ import annotations

import argparse
from pathlib import Path

from ros2_on_pip.errors import OK


def add_options(word: argparse.ArgumentParser) -> None:
    """What it takes."""
    word.add_argument(
        "tab",
        metavar="TAB",
        nargs="?",
        default="rover",
        help="the tab that opens: rover, topics, ... (default: rover)",
    )
    word.add_argument(
        "shown",
        metavar="WORD",
        nargs="*",
        default=[],
        help="what it shows at once: plot /odom/twist/twist/linear/x, image /image",
    )
    word.add_argument(
        "--bag",
        metavar="BAG",
        type=Path,
        help="show what a bag holds, with Pause and any place in it",
    )
    word.add_argument("--port", metavar="N", type=int, default=0, help="default: any free one")
    word.add_argument("--no-browser", action="store_true", help="open no browser by itself")
    word.add_argument(
        "--phone",
        action="store_true",
        help="show a QR code: one telephone of your network drives, until you end it",
    )
    word.add_argument(
        "--phone-address",
        metavar="ADDRESS",
        default="",
        help="with --phone: the address of this computer, where it has several",
    )
    word.add_argument(
        "--hidden-node",
        action="store_true",
        help="its node stands in no list and no graph, as that of a notebook",
    )
    word.add_argument(
        "--allow-host",
        metavar="HOST:PORT",
        action="append",
        default=[],
        help="a proxy or a container leads to it by this host; the key is asked for all the same",
    )


def run(options: argparse.Namespace) -> int:
    """Serve the desk until Ctrl-C."""
    from ros2_on_pip.surroundings import prepare
    from roslings_desk.server import DeskOptions, run

    prepare()
    run(
        DeskOptions(
            tab=options.tab,
            port=options.port,
            browser=not options.no_browser,
            allowed=tuple(options.allow_host),
            shown=options.shown,
            phone=options.phone,
            phone_address=options.phone_address,
            bag=options.bag,
            hidden=options.hidden_node,
        )
    )
    return OK
