"""The buffer of a node: it can wait for what is not known yet."""

from __future__ import annotations

import time as clocks
from collections.abc import Callable
from threading import Condition
from typing import Any

from rclpy.clock import JumpThreshold
from rclpy.duration import Duration
from rclpy.task import Future

from ros2_on_pip.stand_ins._frames.buffer_core import BufferCore, duration_ns
from ros2_on_pip.stand_ins._frames.errors import NANOSECONDS, TransformException

from .buffer_interface import NO_WAIT, BufferInterface

Question = Callable[[], tuple[bool, str]]
Answer = Callable[[], Any]
LONGEST_NAP_S = 0.5
"""Ctrl-C is heard between two naps."""


class Buffer(BufferCore, BufferInterface):
    """All frames that were heard of in the last seconds, to be looked up."""

    def __init__(self, cache_time: Any = None, node: Any = None) -> None:
        """Steps older than `cache_time` are forgotten, 10 s by default.

        Where the clock of `node` jumps back, all that moves is forgotten.
        """
        BufferCore.__init__(self, cache_time)
        BufferInterface.__init__(self)
        self._news = Condition()
        self._waiting: list[tuple[Future, Question, Answer]] = []
        if node is not None:
            self._forget_when_time_jumps(node.get_clock())

    def _forget_when_time_jumps(self, clock: Any) -> None:
        back = JumpThreshold(
            min_forward=None, min_backward=Duration(seconds=-1), on_clock_change=True
        )
        self.jump_handle = clock.create_jump_callback(back, post_callback=lambda _: self.clear())

    # --- told ---

    def set_transform(self, transform: Any, authority: str) -> None:
        """One step at its own time; who waits for it is told."""
        super().set_transform(transform, authority)
        self._tell()

    def set_transform_static(self, transform: Any, authority: str) -> None:
        """One step that never moves; who waits for it is told."""
        super().set_transform_static(transform, authority)
        self._tell()

    def _tell(self) -> None:
        with self._news:
            self._news.notify_all()
            # Who is told may ask for the next one at once, which goes into the new list.
            waiting, self._waiting = self._waiting, []
            self._waiting += [each for each in waiting if not _answered(*each)]

    # --- asked ---

    def lookup_transform(
        self, target_frame: str, source_frame: str, time: Any, timeout: Any = NO_WAIT
    ) -> Any:
        """Where the source lies in the target, as a TransformStamped: what takes numbers of the
        source to numbers of the target. The time 0 asks for the newest. Waits until `timeout`.

        Raises a TransformException, and TypeError where `time` is none.
        """
        self.can_transform(target_frame, source_frame, time, timeout)
        return self.lookup_transform_core(target_frame, source_frame, time)

    def lookup_transform_full(
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
        timeout: Any = NO_WAIT,
    ) -> Any:
        """The same, from one time to another: `fixed_frame` does not move between them.

        Raises a TransformException, and TypeError where a time is none.
        """
        asked = target_frame, target_time, source_frame, source_time, fixed_frame
        self.can_transform_full(*asked, timeout)
        return self.lookup_transform_full_core(*asked)

    async def lookup_transform_async(self, target_frame: str, source_frame: str, time: Any) -> Any:
        """The same, to be awaited: other callbacks run meanwhile. Raises a TransformException."""
        await self.wait_for_transform_async(target_frame, source_frame, time)
        return self.lookup_transform_core(target_frame, source_frame, time)

    async def lookup_transform_full_async(
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
    ) -> Any:
        """The same, from one time to another. Raises a TransformException."""
        asked = target_frame, target_time, source_frame, source_time, fixed_frame
        await self.wait_for_transform_full_async(*asked)
        return self.lookup_transform_full_core(*asked)

    def can_transform(
        self,
        target_frame: str,
        source_frame: str,
        time: Any,
        timeout: Any = NO_WAIT,
        return_debug_tuple: bool = False,
    ) -> Any:
        """Whether it can be looked up, at the latest after `timeout`; why not, if asked for."""
        found = self._asked(
            lambda: self.can_transform_core(target_frame, source_frame, time), timeout
        )
        return found if return_debug_tuple else found[0]

    def can_transform_full(
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
        timeout: Any = NO_WAIT,
        return_debug_tuple: bool = False,
    ) -> Any:
        """Whether it can be looked up, at the latest after `timeout`; why not, if asked for."""
        asked = target_frame, target_time, source_frame, source_time, fixed_frame
        found = self._asked(lambda: self.can_transform_full_core(*asked), timeout)
        return found if return_debug_tuple else found[0]

    def _asked(self, question: Question, timeout: Any) -> tuple[bool, str]:
        """The answer, as soon as it is yes; no later than `timeout`, by the computer's clock."""
        end_s = clocks.monotonic() + duration_ns(timeout) / NANOSECONDS
        with self._news:
            while not (found := question())[0] and (left_s := end_s - clocks.monotonic()) > 0:
                self._news.wait(min(left_s, LONGEST_NAP_S))
        return found

    def wait_for_transform_async(self, target_frame: str, source_frame: str, time: Any) -> Future:
        """A future of the transform: it is done as soon as that can be looked up."""
        return self._promised(
            lambda: self.can_transform_core(target_frame, source_frame, time),
            lambda: self.lookup_transform_core(target_frame, source_frame, time),
        )

    def wait_for_transform_full_async(
        self,
        target_frame: str,
        target_time: Any,
        source_frame: str,
        source_time: Any,
        fixed_frame: str,
    ) -> Future:
        """A future of the transform from one time to another."""
        asked = target_frame, target_time, source_frame, source_time, fixed_frame
        return self._promised(
            lambda: self.can_transform_full_core(*asked),
            lambda: self.lookup_transform_full_core(*asked),
        )

    def _promised(self, question: Question, answer: Answer) -> Future:
        future = Future()
        with self._news:
            if not _answered(future, question, answer):
                self._waiting.append((future, question, answer))
        return future


def _answered(future: Future, question: Question, answer: Answer) -> bool:
    """Whether nobody need ask again: it is done now, or nobody wants it any more."""
    if future.done() or future.cancelled():
        return True
    if not question()[0]:
        return False
    try:
        future.set_result(answer())
    except TransformException as error:  # forgotten between the two
        future.set_exception(error)
    return True
