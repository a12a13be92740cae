"""Draws that are the same on every computer, and in every version of Python."""

from __future__ import annotations

import random
from collections.abc import Sequence
from typing import TypeVar

T = TypeVar("T")


class Chance:
    """Draws from a seed.

    Of Python's generator only `random()` is promised to stay as it is, so all else is made of it.
    """

    def __init__(self, seed: str) -> None:
        self._random = random.Random(seed)

    def between(self, low: float, high: float) -> float:
        """A number from `low` to `high`."""
        return low + (high - low) * self._random.random()

    def around(self, middle: float, off: float) -> float:
        """A number that is at most `off` away from `middle`."""
        return self.between(middle - off, middle + off)

    def pick(self, things: Sequence[T]) -> T:
        """One of them."""
        return things[int(self._random.random() * len(things))]

    def shuffled(self, things: Sequence[T]) -> list[T]:
        """All of them, in any order."""
        drawn = [(self._random.random(), number) for number in range(len(things))]
        return [things[number] for _, number in sorted(drawn)]
