"""Which of a node's last lines help: the end of the log, or of a traceback the student's part."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence

# Folders of code that the student did not write.
_LIBRARIES = ("/site-packages/", "/dist-packages/", "/lib/python3", "/opt/ros/", "<frozen ")
# Python 3.13 and rcutils colour what they write to a terminal (ECMA-48, 8.3.117).
_COLOUR = re.compile(r"\x1b\[[0-9;]*m")
# A line of a traceback that holds only Python's pointers to the line above it.
_EMPTY = " \t^~"


def without_colour(line: str) -> str:
    """`line` without the codes that colour it in a terminal."""
    return _COLOUR.sub("", line)


def helpful(lines: Sequence[str], package: str, at_most: int) -> list[str]:
    """At most `at_most` of `lines`: the last ones; of a traceback, the frames that help.

    Frames of libraries go where the student's own are there, or where there are too many lines.

    Colours go, and the path to an installed file of `package` becomes `.../`. The student mends the
    file in src, not the copy that colcon installed.
    """
    plain = [without_colour(line) for line in lines]
    kept = _without_frames(
        [line for line in plain if line.strip(_EMPTY)], lambda line: _starts(line, package)
    )
    if len(kept) > at_most or any(_is_own(line, package) for line in kept):
        kept = _without_frames(kept, lambda line: _is_library(line, package))
    installed = re.compile(rf'(File ")[^"]*/(?:site-packages|share)/(?={re.escape(package)}/)')
    return [installed.sub(r"\1.../", line) for line in kept[-at_most:]]


def _without_frames(lines: list[str], unwanted: Callable[[str], bool]) -> list[str]:
    """`lines` without the frames whose first line is `unwanted`, each with its line of code."""
    kept: list[str] = []
    leave_out = False
    for line in lines:
        if line.lstrip().startswith('File "'):
            leave_out = unwanted(line)
        elif not line.startswith("    "):
            leave_out = False
        if not leave_out:
            kept.append(line)
    return kept


def _is_library(line: str, package: str) -> bool:
    return not _is_own(line, package) and any(folder in line for folder in _LIBRARIES)


def _is_own(line: str, package: str) -> bool:
    return f"/site-packages/{package}/" in line


def _starts(line: str, package: str) -> bool:
    """colcon's start script, which calls the student's main(): nobody can mend anything in it."""
    return f"/lib/{package}/" in line and "/site-packages/" not in line
