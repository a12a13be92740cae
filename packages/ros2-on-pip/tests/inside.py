"""`ros2` in the process of the test: the same words, without the start of Python."""

from __future__ import annotations

import io
import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stderr, redirect_stdout
from importlib import import_module

from terminal import Ran, Shell

from ros2_on_pip import cli


def run(shell: Shell, *words: str, stdin: str = "") -> Ran:
    """Run `ros2 words...` to its end, as the terminal `shell` would."""
    out, err = io.StringIO(), io.StringIO()
    with surroundings_of(shell), typed(stdin), redirect_stdout(out), redirect_stderr(err):
        try:
            code = cli.explained(lambda: cli.run_here(list(words)))
        except SystemExit as end:  # argparse
            code = int(end.code or 0)
    print(err.getvalue(), end="")  # pytest shows it where a test fails
    return Ran(code, out.getvalue(), err.getvalue())


@contextmanager
def surroundings_of(shell: Shell) -> Iterator[None]:
    """The environment of `shell`.

    ROS is there before: the first import says in the environment where its files lie, and all later
    tests of this process need that.
    """
    import_module("rclpy")
    before = dict(os.environ)
    os.environ.clear()
    os.environ.update(shell.environment)
    try:
        yield
    finally:
        os.environ.clear()
        os.environ.update(before)


@contextmanager
def typed(text: str) -> Iterator[None]:
    """What stands on standard input."""
    before, sys.stdin = sys.stdin, io.StringIO(text)
    try:
        yield
    finally:
        sys.stdin = before
