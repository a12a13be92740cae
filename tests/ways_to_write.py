"""The ways in which a program can write the same lines, as each of them looks in evidence."""

from __future__ import annotations

from collections.abc import Callable

from roslings.evidence import ExperimentSeen, LogLine

Lines = list[LogLine]
LATER_NS = 1_000_000
"""/rosout is heard a moment after the terminal."""


def _printed(lines: Lines) -> tuple[Lines, Lines]:
    return lines, []


def _logged(lines: Lines) -> tuple[Lines, Lines]:
    """As `get_logger()` of a node does it."""
    shown = [
        LogLine(arrival_ns=one.arrival_ns, text=f"[INFO] [1.0] [it]: {one.text}", source="terminal")
        for one in lines
    ]
    return shown, _in_rosout(lines)


def _logged_unheard(lines: Lines) -> tuple[Lines, Lines]:
    """A logger without a node, or one whose program ended before anybody heard /rosout."""
    return _logged(lines)[0], []


def _logged_unseen(lines: Lines) -> tuple[Lines, Lines]:
    """`--disable-stdout-logs`, or a terminal that wrote too much to be kept."""
    return [], _in_rosout(lines)


def _both(lines: Lines) -> tuple[Lines, Lines]:
    """Printed, and logged besides."""
    shown, heard = _logged(lines)
    pairs = zip(lines, shown, strict=True)
    return [each for pair in pairs for each in pair], heard


def _in_rosout(lines: Lines) -> Lines:
    return [
        LogLine(arrival_ns=one.arrival_ns + LATER_NS, text=one.text, source="rosout")
        for one in lines
    ]


WAYS: dict[str, Callable[[Lines], tuple[Lines, Lines]]] = {
    "print": _printed,
    "get_logger": _logged,
    "get_logger, unheard": _logged_unheard,
    "get_logger, /rosout alone": _logged_unseen,
    "both": _both,
}
"""Name of a way to what it makes of printed lines: the terminal, and /rosout."""


def written(seen: ExperimentSeen, way: str) -> ExperimentSeen:
    """The same experiment, whose processes had written their printed lines in another way."""
    heard: Lines = []
    processes = {}
    for label, process in seen.processes.items():
        shown, more = WAYS[way](process.lines)
        processes[label] = process.model_copy(update={"lines": shown})
        heard += more
    return seen.model_copy(update={"processes": processes, "rosout": {"it": heard}})
