"""`ros2 component`: nodes in C++ that share a process; Python has none."""

from __future__ import annotations

import argparse
import sys

from ros2_on_pip.words import FAILED, OK, Run, Verbs

WHAT = (
    "A component is a node in C++ that is loaded into a running process, the container, so that"
    " several nodes share it. Nodes in Python are no components: each runs in its own process, or"
    " several in one by an executor."
)


def declare(command: argparse.ArgumentParser) -> None:
    """The verbs; of the list and the types it is true that there are none."""
    verbs = Verbs(command)
    for verb, about, code in (
        ("list", "Output a list of running containers and components", OK),
        ("types", "Output a list of components registered in the ament index", OK),
        ("load", "Load a component into a container node", FAILED),
        ("unload", "Unload a component from a container node", FAILED),
        ("standalone", "Run a component into its own standalone container node", FAILED),
    ):
        word = verbs(verb, about, tell(code))
        word.add_argument("words", nargs=argparse.REMAINDER, help="what it is about")


def tell(code: int) -> Run:
    """A verb that says what a component is."""

    def say(_: argparse.Namespace) -> int:
        print(WHAT, file=sys.stderr)
        return code

    return say
