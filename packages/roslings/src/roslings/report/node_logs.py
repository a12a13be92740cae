"""What the nodes of one experiment wrote, line by line, with the time of each."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass

from roslings.evidence import ExperimentSeen, LogLine
from roslings.report.log_lines import without_colour

ROSOUT = "rosout"


@dataclass(frozen=True)
class NodeLog:
    """One log: an executable's terminal, or what all nodes wrote to /rosout."""

    origin: str
    """The executable, or `rosout`."""
    text: str
    lines: int


def logs_of(seen: ExperimentSeen) -> list[NodeLog]:
    """The logs that hold something, those of the terminals first.

    Times are seconds since the experiment's first process was started.
    """
    start_ns = _start_ns(seen)
    terminals = ((name, [("", line) for line in p.lines]) for name, p in seen.processes.items())
    logs = [_log(name, lines, start_ns) for name, lines in terminals if lines]
    heard = [(f"[{name}] ", line) for name, lines in seen.rosout.items() for line in lines]
    heard.sort(key=lambda pair: pair[1].arrival_ns)
    return [*logs, _log(ROSOUT, heard, start_ns)] if heard else logs


def _start_ns(seen: ExperimentSeen) -> int:
    starts = [process.started_ns for process in seen.processes.values()]
    return min([*starts, *_arrivals(seen)], default=0)


def _arrivals(seen: ExperimentSeen) -> Iterator[int]:
    return (line.arrival_ns for lines in seen.rosout.values() for line in lines[:1])


def _log(origin: str, lines: Iterable[tuple[str, LogLine]], start_ns: int) -> NodeLog:
    written = [
        f"{(line.arrival_ns - start_ns) / 1e9:8.3f}  {before}{without_colour(line.text)}\n"
        for before, line in lines
    ]
    return NodeLog(origin, "".join(written), len(written))
