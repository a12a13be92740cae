"""`./roslings cluster`."""

from __future__ import annotations

import argparse


def add_options(word: argparse.ArgumentParser) -> None:
    """What it takes."""
    word.add_argument("part", choices=("scheduler", "worker"))
    word.add_argument("rest", nargs=argparse.REMAINDER, metavar="...", help="options for dask")


def run(options: argparse.Namespace) -> int:
    """Run a part of a Dask cluster, in this environment, until Ctrl-C."""
    from roslings_class.cluster import run_part

    return run_part(options.part, options.rest)
