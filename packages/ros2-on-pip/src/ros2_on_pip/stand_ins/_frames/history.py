"""Where one frame lay in its parent, over the time that is kept."""

from __future__ import annotations

from bisect import bisect_left, bisect_right
from dataclasses import dataclass, field
from typing import NamedTuple

from ros2_on_pip.stand_ins._frames.errors import FUTURE, ONE_TIME, PAST, seconds
from ros2_on_pip.stand_ins._frames.motion import RigidTransform, between

LATEST = 0
"""The time that asks for the newest there is."""


class ParentTransform(NamedTuple):
    """From a frame to its parent, at one moment."""

    parent: str
    motion: RigidTransform


class NotKnown(Exception):
    """Nothing is known of that time; the text is geometry2's, and empty after a `clear`."""


@dataclass
class Static:
    """A frame that never moves: the last word counts, for all times."""

    step: ParentTransform
    newest_ns: int = LATEST
    oldest_ns: int = LATEST
    length: int = 1

    @property
    def newest(self) -> ParentTransform:
        """The step; it holds for ever."""
        return self.step

    def at(self, time_ns: int) -> ParentTransform:
        """The same at each time."""
        return self.step

    def clear(self) -> None:
        """What never moves is not forgotten where time jumps."""


@dataclass
class Moving:
    """A frame that moves; between two moments it is taken to move evenly."""

    keep_ns: int
    _times_ns: list[int] = field(default_factory=list)
    """Ascending, each once, beside `_steps`."""
    _steps: list[ParentTransform] = field(default_factory=list)

    @property
    def newest_ns(self) -> int:
        """The last moment that is known; 0 where there is none."""
        return self._times_ns[-1] if self._times_ns else LATEST

    @property
    def oldest_ns(self) -> int:
        """The first moment that is known; 0 where there is none."""
        return self._times_ns[0] if self._times_ns else LATEST

    @property
    def length(self) -> int:
        """How many moments are known."""
        return len(self._times_ns)

    @property
    def newest(self) -> ParentTransform | None:
        """The last that is known."""
        return self._steps[-1] if self._steps else None

    def insert(self, time_ns: int, step: ParentTransform) -> bool:
        """Whether it is kept: what is older than all that is kept is not.

        Of two for the same moment the later counts.
        """
        if self._times_ns and time_ns < self.newest_ns - self.keep_ns:
            return False
        place = bisect_left(self._times_ns, time_ns)
        known = place < len(self._times_ns) and self._times_ns[place] == time_ns
        self._times_ns[place : place + known] = [time_ns]
        self._steps[place : place + known] = [step]
        self._forget_before(self.newest_ns - self.keep_ns)
        return True

    def _forget_before(self, time_ns: int) -> None:
        if self._times_ns[0] < time_ns:
            old = bisect_left(self._times_ns, time_ns)
            del self._times_ns[:old], self._steps[:old]

    def clear(self) -> None:
        """Forget all."""
        self._times_ns.clear()
        self._steps.clear()

    def at(self, time_ns: int) -> ParentTransform:
        """The step at that time, or the newest. Raises NotKnown."""
        times_ns, steps = self._times_ns, self._steps
        if time_ns == LATEST and steps:
            return steps[-1]
        after = bisect_right(times_ns, time_ns)
        if after and times_ns[after - 1] == time_ns:
            return steps[after - 1]
        if not 0 < after < len(times_ns):
            raise self._beyond(time_ns)
        older, newer = steps[after - 1], steps[after]
        if older.parent != newer.parent:
            return older
        start_ns = times_ns[after - 1]
        part = (time_ns - start_ns) / (times_ns[after] - start_ns)
        return ParentTransform(older.parent, between(older.motion, newer.motion, part))

    def _beyond(self, time_ns: int) -> NotKnown:
        if not self._times_ns:
            return NotKnown("")
        if len(self._times_ns) == 1:
            text, known_ns = ONE_TIME, self.newest_ns
        elif time_ns > self.newest_ns:
            text, known_ns = FUTURE, self.newest_ns
        else:
            text, known_ns = PAST, self.oldest_ns
        return NotKnown(text.format(asked=seconds(time_ns), known=seconds(known_ns)))


History = Static | Moving
