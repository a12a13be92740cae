"""Options that several commands take."""

from __future__ import annotations

import argparse
from pathlib import Path

from roslings.grading.shapes import SHAPES


def lab_options(word: argparse.ArgumentParser) -> None:
    """The lab's name."""
    word.add_argument("lab", metavar="LAB", help="for example: topics")


def package_options(word: argparse.ArgumentParser) -> None:
    """The lab, and where its package lies."""
    lab_options(word)
    path_option(word)


def path_option(word: argparse.ArgumentParser) -> None:
    """Where a package lies."""
    word.add_argument(
        "path",
        metavar="PATH",
        type=Path,
        nargs="?",
        help="your package, or a folder that holds it (default: your workspace, ~/roslings_ws)",
    )


def whose_option(word: argparse.ArgumentParser, help_text: str) -> None:
    """Whose card it is, of a lab of which students have different ones."""
    word.add_argument("--for", dest="whose", metavar="NAME", help=help_text)


def verdict_options(word: argparse.ArgumentParser) -> None:
    """Where a verdict goes, and how much of it is shown."""
    word.add_argument(
        "--json", metavar="FILE", type=Path, help="write the verdict to FILE (- here)"
    )
    word.add_argument(
        "--html", metavar="FILE", type=Path, help="write a page for a browser, with pictures"
    )
    for name, whose in SHAPES.items():
        word.add_argument(f"--{name}", metavar="FILE", type=Path, help=f"write it for {whose}")
    word.add_argument("--only", metavar="ID", help="show one check only, by its short name")
    word.add_argument(
        "--all", action="store_true", help="show every check whole; a screen folds what can wait"
    )


def hidden_option(word: argparse.ArgumentParser) -> None:
    """Checks beyond the lab's own."""
    word.add_argument(
        "--hidden", metavar="FILE", type=Path, help="a grader with checks that students do not have"
    )


def trust_option(word: argparse.ArgumentParser) -> None:
    """Whether strangers' code runs where no wall holds it."""
    word.add_argument(
        "--trust", action="store_true", help="run submissions although there is no sandbox"
    )


def soak_option(word: argparse.ArgumentParser, default: str) -> None:
    """How long nodes are left running."""
    word.add_argument(
        "--soak",
        metavar="SECONDS",
        type=seconds_of_soak,
        help=f"let the nodes run on for so long, to see that they stay (default: {default})",
    )


def seconds_of_soak(text: str) -> float:
    """A number from 0 to 600. Raises ArgumentTypeError."""
    try:
        seconds = float(text)
    except ValueError:
        seconds = -1.0
    if not 0 <= seconds <= 600:
        raise argparse.ArgumentTypeError(f"{text!r} is no number of seconds from 0 to 600")
    return seconds


def whole_number(text: str) -> int:
    """A number from 1 on."""
    number = int(text)
    if number < 1:
        raise argparse.ArgumentTypeError("give a number from 1 on")
    return number
