"""What a hand-in did that is not ordinary: in words and numbers, and no accusation.

A mistake can do all of it: a loop that starts processes, a list that grows, a print too many.
"""

from __future__ import annotations

from collections.abc import Iterator

from roslings.evidence import BuildSeen, Evidence, NotOrdinary, ProcessSeen

BOUNDS = {
    "pids": "wanted more processes and threads than a sandbox has",
    "memory": "wanted more memory than a sandbox has",
    "files": "wanted more files than a sandbox has",
    "output": "printed without end",
    "cpu_s": "wanted more time of the processor than a sandbox has",
}
OF_A_BUILD = ("The build was ended:", "The build did not end within")
"""So begins the last line of its output where it was we who ended it."""


def unusual(evidence: Evidence) -> tuple[str, ...]:
    """A line for each thing, with the number of runs that did it."""
    told: dict[str, int] = {}
    for line in (*_of_build(evidence.build), *_of_runs(evidence)):
        told[line] = told.get(line, 0) + 1
    return tuple(line if times == 1 else f"{line} ({times} times)" for line, times in told.items())


def _of_build(seen: BuildSeen | None) -> Iterator[str]:
    if seen:
        yield from _of_any("The build", seen)
    if seen and not seen.succeeded and seen.output and seen.output[-1].startswith(OF_A_BUILD):
        yield seen.output[-1]


def _of_runs(evidence: Evidence) -> Iterator[str]:
    for run in evidence.runs:
        for process in run.processes.values():
            yield from _of_process(process)


def _of_process(seen: ProcessSeen) -> Iterator[str]:
    yield from (f"{seen.executable} {BOUNDS[bound]}" for bound in seen.bounds_met)
    yield from _of_any(seen.executable, seen)
    if seen.left_behind:
        what = "a process" if seen.left_behind == 1 else f"{seen.left_behind} processes"
        yield f"{seen.executable} ended, and left {what} running"


def _of_any(name: str, seen: NotOrdinary) -> Iterator[str]:
    if seen.filled_its_disk:
        yield f"{name} filled the disk that a sandbox has"
    if seen.refused_calls:
        calls = ", ".join(f"{call} ({count})" for call, count in sorted(seen.refused_calls.items()))
        yield f"{name} made calls that no lab needs, and they were refused: {calls}"
    if seen.most_busy:
        yield (
            f"{name} kept up to {seen.most_busy} threads busy at once,"
            " so it was put behind all others"
        )
