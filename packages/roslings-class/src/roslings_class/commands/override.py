"""`./roslings override`."""

from __future__ import annotations

import argparse
from pathlib import Path

from ros2_on_pip.errors import OK


def add_options(word: argparse.ArgumentParser) -> None:
    """What it takes."""
    word.add_argument("folder", metavar="DIR", type=Path, help="the --out of ./roslings grade")
    word.add_argument("submission", metavar="SUBMISSION", help="its name, or the student's")
    word.add_argument("score", metavar="SCORE", type=float, help="0 to 100")
    word.add_argument("--reason", required=True, help="kept beside the score")
    word.add_argument(
        "--by", metavar="NAME", required=True, help="who says so; the student reads it"
    )


def run(options: argparse.Namespace) -> int:
    """Give a score by hand."""
    from roslings_class.regrade import override as give

    told = give(options.folder, options.submission, options.score, options.reason, options.by)
    print("\n".join(told))
    return OK
