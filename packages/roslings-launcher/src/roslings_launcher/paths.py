"""Folders that the environment names become absolute here, before anything else is done.

A command works in several processes. Some of these stand in another folder: pip in the course's,
the measuring process in that of its run. A path that is relative would lead to another place there.
"""

import os
from collections.abc import MutableMapping
from pathlib import Path

PATH_VARIABLES = (
    "ROSLINGS_COURSE",
    "ROSLINGS_WS",
    "ROSLINGS_BREAKS",
    "ROSLINGS_WHEELS",
    "ROSLINGS_PYTHON",
)
"""Variables of ours that name a place; each process that we start reads them again."""
MAY_BE_A_WORD = ("ROSLINGS_PYTHON",)
"""Without a slash it is a program that the shell would find."""


def absolute_variables(environment: MutableMapping[str, str] = os.environ) -> None:
    """Make the places that the environment names absolute, for us and for all that we start."""
    for name in PATH_VARIABLES:
        place = environment.get(name)
        if place and (name not in MAY_BE_A_WORD or os.sep in place):
            environment[name] = str(absolute(Path(place)))


def absolute(path: Path) -> Path:
    """From the folder that the command was typed in; a shell leaves the ~ of `--to=~/x` to us."""
    return Path(os.path.expanduser(path)).absolute()  # noqa: PTH111 - Path's raises for nobody
