"""Experiments run side by side, each in a thread of its own, as soon as what they ask for is there.

A node mostly waits, and so does who watches it: side by side they take as long as the longest.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from types import TracebackType

from roslings.course.grader import Experiment
from roslings.evidence import ExperimentSeen

MOST_AT_ONCE = 8
"""Waiting costs little, but each has nodes, and those take memory."""

Runs = Sequence[ExperimentSeen]
"""All runs of one experiment; the one to be believed comes last."""


class Alongside:
    """A context manager, whose end waits for what was begun, or calls it off after an error."""

    def __init__(
        self,
        run: Callable[[Experiment, int, Runs], Runs],
        call_off: Callable[[], None],
        at_once: int = MOST_AT_ONCE,
    ) -> None:
        """`run` runs an experiment, given what it asks for; `call_off` makes all runs end soon."""
        self._run, self._call_off = run, call_off
        self._pool = ThreadPoolExecutor(at_once, thread_name_prefix="experiment")
        self._begun: dict[str, Future[Runs]] = {}

    def __enter__(self) -> Alongside:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if error is not None:
            self._call_off()
        self._pool.shutdown(wait=True, cancel_futures=error is not None)

    def begin(self, each: Experiment, number: int) -> None:
        """Run an experiment when those whose evidence it asks for, begun before, have ended."""
        asked = [self._begun[name] for name in each.needs]
        self._begun[each.name] = self._pool.submit(self._run_after, asked, each, number)

    def _run_after(self, asked: Sequence[Future[Runs]], each: Experiment, number: int) -> Runs:
        """In a thread. They were begun before, so they have threads: nobody waits for ever."""
        return self._run(each, number, [future.result()[-1] for future in asked])

    def runs_of(self, each: Experiment) -> Runs:
        """The runs of an experiment that was begun, at their end. Raises what went wrong there."""
        return self._begun[each.name].result()
