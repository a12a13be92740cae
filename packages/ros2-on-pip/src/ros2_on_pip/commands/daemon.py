"""`ros2 daemon`: there is none here to start or to stop, and nothing goes stale."""

from __future__ import annotations

import argparse

from ros2_on_pip.words import OK, Run, Verbs

WHY = "ros2 needs none here: each command asks the nodes themselves."


def declare(command: argparse.ArgumentParser) -> None:
    """The verbs."""
    verbs = Verbs(command)
    start = verbs("start", "Start the daemon if it isn't running", tell("No daemon is started"))
    start.add_argument(
        "-d", "--debug", action="store_true", help="Tell more (here there is no more)"
    )
    for verb, about in (
        ("stop", "Stop the daemon if it is running"),
        ("status", "Output the status of the daemon"),
    ):
        verbs(verb, about, tell("The daemon is not running"))


def tell(what: str) -> Run:
    """A verb that says so."""

    def say(_: argparse.Namespace) -> int:
        print(f"{what}: {WHY}")
        return OK

    return say
