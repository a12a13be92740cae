"""How the student called roslings, to be named again where something is to be typed next."""

from __future__ import annotations

import argparse
import shutil
from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from ros2_on_pip.typed_paths import quoted_from_here
from roslings import course

if TYPE_CHECKING:
    from roslings.report.command_line import CommandLine

FLAGS = ("solution", "trust", "as_stranger")
VALUES = ("hidden", "port")
"""Options of `check` that decide what is checked; what decides where it is written is not told."""


def program() -> str:
    """`./roslings` in its own folder, else `roslings` where this terminal knows it."""
    own = (course.root() / "roslings").resolve()
    found = None if Path.cwd().resolve() == own.parent else shutil.which("roslings")
    return "roslings" if found and Path(found).resolve() == own else "./roslings"


def command_line(options: argparse.Namespace) -> CommandLine:
    """The words that ask for the same verdict again."""
    from roslings.report.command_line import CommandLine

    path = getattr(options, "path", None)
    place = (quoted_from_here(path),) if path else ()
    is_of_the_course = (course.root() / "labs" / options.lab).is_dir()
    return CommandLine(options.lab, program(), place, tuple(_options(options)), is_of_the_course)


def _options(options: argparse.Namespace) -> Iterator[str]:
    given = vars(options)
    yield from (f"--{name.replace('_', '-')}" for name in FLAGS if given.get(name))
    for name in VALUES:
        if value := given.get(name):
            yield f"--{name} {quoted_from_here(value)}"
    if given.get("clock", "auto") != "auto":
        yield f"--clock {given['clock']}"
