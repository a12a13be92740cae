"""What was said of frames: who says a step how often, and what does not fit together."""

from __future__ import annotations

from collections import Counter, deque
from dataclasses import dataclass, field
from typing import Any

NANOSECONDS = 1_000_000_000
KEPT = 1000
"""Of the delays of one frame, as many as tf2_monitor keeps."""


@dataclass
class FrameHeard:
    """One frame, as it was told of."""

    name: str
    parents: Counter[str] = field(default_factory=Counter)
    """How often each was said to be its parent; more than one is a fault."""
    moves: bool = False
    """It was told of on /tf."""
    stands: bool = False
    """It was told of on /tf_static."""
    oldest_ns: int = 0
    newest_ns: int = 0
    """The first and the last stamp of /tf."""
    delays_s: deque[float] = field(default_factory=lambda: deque(maxlen=KEPT))
    """From a stamp to when it was heard."""
    last_parent: str = ""

    @property
    def rate_hz(self) -> float | None:
        """Of its stamps; None where it does not move, or was told of once."""
        said, length_ns = self.parents.total(), self.newest_ns - self.oldest_ns
        return (said - 1) * NANOSECONDS / length_ns if self.moves and length_ns > 0 else None


@dataclass
class FramesHeard:
    """All frames. A TransformListener fills it, as it would a Buffer."""

    now_ns: Any
    """Asked for the time when something is heard."""
    frames: dict[str, FrameHeard] = field(default_factory=dict)

    def set_transform(self, transform: Any, authority: str) -> None:
        """One step on /tf."""
        stamp = transform.header.stamp
        at_ns = stamp.sec * NANOSECONDS + stamp.nanosec
        heard = self._of(transform)
        heard.oldest_ns = min(heard.oldest_ns, at_ns) if heard.moves else at_ns
        heard.newest_ns = max(heard.newest_ns, at_ns)
        heard.moves = True
        heard.delays_s.append((self.now_ns() - at_ns) / NANOSECONDS)

    def set_transform_static(self, transform: Any, authority: str) -> None:
        """One step on /tf_static."""
        self._of(transform).stands = True

    def _of(self, transform: Any) -> FrameHeard:
        child = transform.child_frame_id.removeprefix("/")
        parent = transform.header.frame_id.removeprefix("/")
        heard = self.frames.setdefault(child, FrameHeard(child))
        heard.parents[parent] += 1
        heard.last_parent = parent
        return heard

    @property
    def roots(self) -> list[str]:
        """The frames that have no parent, in the order in which they were told of."""
        parents = (heard.last_parent for heard in self.frames.values())
        return list(dict.fromkeys(name for name in parents if name not in self.frames))

    def children(self, parent: str) -> list[FrameHeard]:
        """Of one frame."""
        return [heard for heard in self.frames.values() if heard.last_parent == parent]

    @property
    def in_loops(self) -> list[str]:
        """Frames that no root is above."""
        reached, new = set[str](), self.roots
        while new:
            reached.update(new)
            new = [heard.name for parent in new for heard in self.children(parent)]
        return [name for name in self.frames if name not in reached]

    def faults(self) -> list[str]:
        """What does not fit together, a sentence each."""
        several = [heard for heard in self.frames.values() if len(heard.parents) > 1]
        told = [
            f"{_quoted(heard.name)} has several parents: {_all(heard.parents)}."
            " Two nodes say where it is: end one of them."
            for heard in several
        ]
        told += [
            f"{_quoted(heard.name)} comes on /tf and on /tf_static. A frame moves, or it does not."
            for heard in self.frames.values()
            if heard.moves and heard.stands
        ]
        if len(self.roots) > 1:
            told.append(
                f"These are {len(self.roots)} trees, with the roots {_all(self.roots)}."
                " Nothing leads from one to another: a step between them is missing."
            )
        if loop := self.in_loops:
            told.append(
                f"These frames go round in a loop: {_all(loop)}. One of them must be the root."
            )
        return told


def _quoted(name: str) -> str:
    return f"'{name}'"


def _all(names: Any) -> str:
    return ", ".join(_quoted(name) for name in names)
