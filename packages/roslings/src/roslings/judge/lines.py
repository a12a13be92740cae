"""What a process wrote, each line once, whichever way it was written.

A line of get_logger() goes to the terminal and to /rosout. Who prints its lines, who logs them, and
who does both has written the same. All that looks for lines, or counts them, asks here.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator

from roslings.evidence import ExperimentSeen, LogLine, ProcessSeen
from roslings.seen.exits import without_interrupt


def written_by(seen: ProcessSeen, experiment: ExperimentSeen) -> list[LogLine]:
    """Its terminal, and what stands in /rosout alone; no traceback that our Ctrl-C made."""
    return [*without_interrupt(seen), *_in_rosout_alone(seen, experiment)]


def _in_rosout_alone(seen: ProcessSeen, experiment: ExperimentSeen) -> Iterator[LogLine]:
    """What no terminal shows: one shows the lines of its own process, another one those of others.

    Of what was logged before it began, nothing is its own.
    """
    others = (each for each in experiment.processes.values() if each is not seen)
    shown = Counter(line.plain for each in (seen, *others) for line in each.lines)
    for line in (line for log in experiment.rosout.values() for line in log):
        for text in line.text.splitlines():
            if shown[text]:
                shown[text] -= 1
            elif line.arrival_ns >= seen.started_ns:
                yield LogLine(arrival_ns=line.arrival_ns, text=text, source="rosout")


def texts_of(lines: Iterable[LogLine]) -> Iterator[str]:
    """Without a logger's decorations. What is printed, and logged besides, is one."""
    every = [line for line in lines if line.text.strip()]
    printed = Counter(line.plain for line in every if not line.is_logged)
    for line in every:
        if line.is_logged and printed[line.plain]:
            printed[line.plain] -= 1
        else:
            yield line.plain


def times(lines: Iterable[LogLine]) -> int:
    """How often they were written, all together. A line may be printed, and logged besides."""
    return max(Counter(line.is_logged for line in lines).values(), default=0)
