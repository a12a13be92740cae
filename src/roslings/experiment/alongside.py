"""Experiments that mostly wait run beside the others, each in a thread of its own."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from types import TracebackType

from roslings.evidence import ExperimentSeen
from roslings.experiment.declare import Experiment

MOST_AT_ONCE = 2
"""Waiting costs little, but what wakes up must find a processor."""


class Alongside:
    """A context manager, whose end waits for what was begun, or calls it off after an error."""

    def __init__(
        self,
        run: Callable[[Experiment, int], Sequence[ExperimentSeen]],
        call_off: Callable[[], None],
    ) -> None:
        """`run` runs an experiment; `call_off` makes the runs of all threads end soon."""
        self._run, self._call_off = run, call_off
        self._pool = ThreadPoolExecutor(MOST_AT_ONCE, thread_name_prefix="alongside")
        self._begun: dict[str, Future[Sequence[ExperimentSeen]]] = {}

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
        """Run an experiment from now on; it can ask for no other's evidence."""
        self._begun[each.name] = self._pool.submit(self._run, each, number)

    def runs_of(self, each: Experiment) -> Sequence[ExperimentSeen] | None:
        """The runs of an experiment that was begun, at their end; else None."""
        future = self._begun.get(each.name)
        return future.result() if future else None
