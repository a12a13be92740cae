"""Nodes that spin in the background, while the cell goes on."""

from __future__ import annotations

import ctypes
import threading
from typing import Any

from roslings_learn.notebook.errors import SessionEnded

END_WITHIN_S = 2.0
"""A callback that takes longer than this when the session ends is cut short."""


class CutShort(BaseException):
    """Raised inside a callback that does not end by itself. No `except Exception` takes it."""


class Spinning:
    """An executor in a thread of its own, and the first error of a callback.

    Must be stopped by `stop`; nothing is left of it then.
    """

    def __init__(self, context: Any, threads: int = 1) -> None:
        from rclpy.executors import MultiThreadedExecutor, SingleThreadedExecutor
        from rclpy.task import Future

        self._context = context
        self._executor = (
            MultiThreadedExecutor(threads, context=context)
            if threads > 1
            else SingleThreadedExecutor(context=context)
        )
        self._end = Future()
        self._error: BaseException | None = None
        self._ended = False
        self._thread = threading.Thread(target=self._run, name="roslings session", daemon=True)
        self._thread.start()

    def add(self, node: Any) -> None:
        """Spin this node too. Raises SessionEnded."""
        if self._ended:
            raise SessionEnded
        self._executor.add_node(node)

    def check(self) -> None:
        """Raise what a callback raised, once, or SessionEnded where nothing spins any more."""
        error = self.take_error()
        if error is not None:
            raise error
        if self._ended or not self._context.ok():
            raise SessionEnded

    def take_error(self) -> BaseException | None:
        """The first error of a callback. It is told once."""
        error, self._error = self._error, None
        return error

    def stop(self) -> bool:
        """End the thread; whether it could be ended."""
        self._end.set_result(None)  # wakes the executor at once
        ended = _ended(self._thread) and all([_ended(worker) for worker in self._workers()])
        if ended:
            self._drop_what_waits()
            self._executor.shutdown()
        return ended

    def _drop_what_waits(self) -> None:
        """End the callbacks that no thread came to; Python warns of each that is only forgotten."""
        for task, *_ in getattr(self._executor, "_tasks", ()):
            task.cancel()

    def _workers(self) -> list[threading.Thread]:
        """The threads of a MultiThreadedExecutor; rclpy has no public way to end them."""
        pool = getattr(self._executor, "_executor", None)
        if pool is None:
            return []
        pool.shutdown(wait=False, cancel_futures=True)
        return list(pool._threads)

    def _run(self) -> None:
        from rclpy.executors import ExternalShutdownException, ShutdownException

        try:
            self._executor.spin_until_future_complete(self._end)
        except (ExternalShutdownException, ShutdownException, CutShort):
            pass  # rclpy.shutdown() in a callback ends the nodes, as it does in a program
        except BaseException as error:
            self._error = error if self._context.ok() else None
        finally:
            self._ended = True


class SpinThreads:
    """All that spins in a session: the shared executor, and those of nodes with threads of theirs.

    Must be stopped by `stop`; nothing is left of it then.
    """

    def __init__(self, context: Any) -> None:
        self._context = context
        self._all = [Spinning(context)]

    def add(self, node: Any, threads: int | None = None) -> None:
        """Spin this node too; with `threads`, by an executor of its own. Raises SessionEnded."""
        if threads is not None:
            self._all.append(Spinning(self._context, threads))
        spinning = self._all[0] if threads is None else self._all[-1]
        spinning.add(node)

    def check(self) -> None:
        """Raise what a callback raised, once, or SessionEnded where nothing spins any more."""
        for spinning in self._all:
            spinning.check()

    def take_error(self) -> BaseException | None:
        """The first error of a callback. It is told once."""
        return next((error for each in self._all if (error := each.take_error())), None)

    def stop(self) -> bool:
        """End all; whether all could be ended."""
        return all([spinning.stop() for spinning in self._all])


def _ended(thread: threading.Thread) -> bool:
    """Whether it ended, by itself or cut short."""
    thread.join(END_WITHIN_S)
    if thread.is_alive():
        _cut_short(thread)
    return not thread.is_alive()


def _cut_short(thread: threading.Thread) -> None:
    """End a callback that loops or waits in Python. One that waits in C ends when C returns."""
    thread_id = ctypes.c_ulong(thread.ident or 0)
    ctypes.pythonapi.PyThreadState_SetAsyncExc(thread_id, ctypes.py_object(CutShort))
    thread.join(END_WITHIN_S)
