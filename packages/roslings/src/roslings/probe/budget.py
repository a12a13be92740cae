"""How many bytes are kept of what a package does, so that no package fills our memory.

All kinds of evidence share one budget: messages, log lines, the graph, what is asked of the
grader. What is counted is what it takes here, as an object and as JSON.
"""

from __future__ import annotations

import sys
from collections.abc import Iterable, Mapping
from dataclasses import fields, is_dataclass
from json.encoder import encode_basestring
from threading import Lock
from typing import Any

from pydantic import BaseModel

from roslings.evidence import DroppedSeen, Kind

MB = 1024 * 1024
EXPERIMENT_BYTES = 40 * MB
"""Of one experiment: 20,000 short texts take 15 MB, so do 2,000 messages of odometry."""

GRADING_BYTES = 128 * MB
"""Of all experiments of one grading, and of their runs that were made again."""

LARGE_BYTES = 64 * MB
"""Of one experiment, on the way into its bag: messages too large for the evidence."""

TRACKED_BYTES = 16
"""What Python's collector puts before each object that holds others."""

MARKS = 4
"""JSON's quotes, colon and comma beside a name."""


class ByteBudget:
    """So many bytes, taken by several threads; what is taken of it is taken of `whole`, too."""

    def __init__(self, most_bytes: int, whole: ByteBudget | None = None) -> None:
        self._whole = whole
        self._lock = Lock()
        self.left = most_bytes

    def take(self, size: int) -> bool:
        """Take `size` bytes, where as much is left."""
        with self._lock:
            fits = size <= self.left and (self._whole is None or self._whole.take(size))
            self.left -= size if fits else 0
        return fits

    def give_back(self, size: int) -> None:
        """What was taken is not needed any more."""
        with self._lock:
            self.left += size
        if self._whole is not None:
            self._whole.give_back(size)


class Share:
    """What one topic or one log may keep: some bytes of its own, then from what all share.

    So no flood silences the others. What once found no room keeps out all that comes after it: what
    is kept is the beginning, without a gap.
    """

    def __init__(self, shared: ByteBudget, own_bytes: int) -> None:
        self._shared = shared
        self._own_left = own_bytes if shared.take(own_bytes) else 0
        self.full = False

    def take(self, size: int) -> bool:
        """Take `size` bytes, where there is room and nothing was refused before."""
        if self.full:
            return False
        if size <= self._own_left:
            self._own_left -= size
            return True
        self.full = not self._shared.take(size)
        return not self.full

    def give_back(self, size: int) -> None:
        """What was taken is not needed any more."""
        self._shared.give_back(size)

    def close(self) -> None:
        """Nothing more will come."""
        self._shared.give_back(self._own_left)
        self._own_left = 0
        self.full = True


class Store:
    """What the evidence of one experiment may keep, and what found no room in it."""

    def __init__(self, whole: ByteBudget | None = None, large_bytes: int = 0) -> None:
        """`large_bytes` are for messages too large to be read, which are kept for a bag alone.

        Half of what is left of the whole stays for the experiments after this one.
        """
        most_bytes = EXPERIMENT_BYTES if whole is None else min(EXPERIMENT_BYTES, whole.left // 2)
        self.budget = ByteBudget(most_bytes, whole)
        self.large = ByteBudget(large_bytes)
        self._dropped: dict[Kind, DroppedSeen] = {}
        self._shares: list[Share] = []

    def share(self, own_bytes: int) -> Share:
        """A part of it for one topic or one log."""
        self._shares.append(share := Share(self.budget, own_bytes))
        return share

    def keeps(self, kind: Kind, record: Any) -> bool:
        """Whether there is room for a record; where there is none, that is noted."""
        size = size_of(record)
        if self.budget.take(size):
            return True
        self.drop(kind, 1, size)
        return False

    def drop(self, kind: Kind, count: int, size: int = 0) -> None:
        """Note what is not kept."""
        dropped = self._dropped.setdefault(kind, DroppedSeen(kind=kind))
        dropped.count += count
        dropped.bytes += size

    def dropped(self, kind: Kind) -> int:
        """How many of a kind found no room so far."""
        return self._dropped[kind].count if kind in self._dropped else 0

    def close(self) -> list[DroppedSeen]:
        """Nothing more will come: what was dropped."""
        for share in self._shares:
            share.close()
        return [each for each in self._dropped.values() if each.count]


def size_of(value: Any) -> int:
    """The bytes of a value of the evidence with all that it holds: in memory, and as JSON."""
    if isinstance(value, str):
        return sys.getsizeof(value) + len(encode_basestring(value))
    names, parts = _parts_of(value)
    size = sys.getsizeof(value) + TRACKED_BYTES
    return size + sum(len(name) + MARKS for name in names) + sum(map(size_of, parts))


def _parts_of(value: Any) -> tuple[Iterable[str], Iterable[Any]]:
    """What a value holds: the names, which only JSON repeats, and the values behind them."""
    if isinstance(value, BaseModel):
        return value.__dict__, (*value.__dict__.values(), value.__pydantic_fields_set__)
    if isinstance(value, Mapping):
        return value, value.values()
    if is_dataclass(value):
        names = [each.name for each in fields(value)]
        return names, [getattr(value, name) for name in names]
    if isinstance(value, list | tuple):
        return (), value
    return (), ()
