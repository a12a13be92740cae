"""Several drives of one experiment side by side, in threads that end with it."""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from typing import TypeVar

from roslings.arena import kernel
from roslings.experiment import Scene
from roslings.lockstep import NoDrive

LONGEST_S = 3600.0
"""No drive comes near: each has a budget of its own."""
MOST = 4
LOOKS_AGAIN_S = 0.5
HEAVY = threading.BoundedSemaphore(max(1, kernel.cores() - 1))
"""In all experiments of a grading, for drives whose nodes keep a processor busy: side by side each
would hold the others up. One processor is left for the worlds."""
T = TypeVar("T")


class SideBySide:
    """A context manager. Leaving the block calls off what is not done."""

    def __init__(self, scene: Scene) -> None:
        self._scene = scene
        self.called_off = threading.Event()
        """Whoever drives looks at it again and again."""
        self._pool = ThreadPoolExecutor(MOST, thread_name_prefix="drive")

    def __enter__(self) -> SideBySide:
        return self

    def __exit__(self, *error: object) -> None:
        self.called_off.set()
        self._pool.shutdown(cancel_futures=True)

    def all(
        self, errands: Sequence[Callable[[], T]], turns: threading.Semaphore | None = None
    ) -> list[T]:
        """What comes of each, in their order; each takes a turn of these.

        Raises CalledOff where the measuring process is to end, and what went wrong in an errand.
        """
        free = turns or threading.Semaphore(MOST)

        def when_free(errand: Callable[[], T]) -> T:
            while not free.acquire(timeout=LOOKS_AGAIN_S):
                if self.called_off.is_set():
                    raise NoDrive("it was called off")
            try:
                return errand()
            finally:
                free.release()

        begun = [self._pool.submit(when_free, each) for each in errands]
        for each in begun:
            each.add_done_callback(lambda _: self._scene.probe.notify())
        self._scene.probe.until(lambda: all(each.done() for each in begun), LONGEST_S)
        return [each.result() for each in begun]
