"""Which of a node's last lines help: the end of the log, or of a traceback the student's part."""

from __future__ import annotations

import re
from collections.abc import Sequence

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
    """At most `at_most` of `lines`: the last ones; of a traceback, frames of libraries go first.

    Colours go, and the path to an installed file of `package` becomes `.../`: the student mends
    the file in src, not the copy that colcon installed.
    """
    plain = [without_colour(line) for line in lines]
    kept = [line for line in plain if line.strip(_EMPTY)]
    if len(kept) > at_most:
        kept = _without_library_frames(kept, package)
    installed = re.compile(rf'(File ")[^"]*/site-packages/(?={re.escape(package)}/)')
    return [installed.sub(r"\1.../", line) for line in kept[-at_most:]]


def _without_library_frames(lines: list[str], package: str) -> list[str]:
    kept: list[str] = []
    in_library = False
    for line in lines:
        if line.lstrip().startswith('File "'):
            in_library = _is_library(line, package)
        elif not line.startswith("    "):
            in_library = False
        if not in_library:
            kept.append(line)
    return kept


def _is_library(line: str, package: str) -> bool:
    if f"/site-packages/{package}/" in line:
        return False
    # colcon's start script calls the student's main(); nobody can mend anything in it.
    return f"/lib/{package}/" in line or any(folder in line for folder in _LIBRARIES)
