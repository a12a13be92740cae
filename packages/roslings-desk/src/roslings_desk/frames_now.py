"""The frames as they are now: of what was heard on /tf and /tf_static, that which still holds.

A program that looks frames up remembers 10 s. Here a step that moves counts for some seconds, and
who has ceased is named: a tree that is only remembered looks alive.
"""

from __future__ import annotations

import math
from collections import deque
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from ros2_on_pip.frames_heard import NANOSECONDS, FrameHeard, FramesHeard
from ros2_on_pip.frames_shown import about
from roslings_rover.rover.frames import TF, TF_STATIC

TF_MESSAGE = "tf2_msgs/msg/TFMessage"
LATELY_S = 5.0
"""Rates and parents are those of so long."""
CEASED_S = 3.0
"""Nothing that moves is said less often."""
FORGOTTEN_S = 60.0
MOST_STEPS = 5_000
"""Of the last seconds; at more than a thousand a second the rate is that of a shorter time."""
MOST_FRAMES = 300
"""What comes beyond these is left out; no robot has so many."""
OFF_S = 2.0
"""A stamp that is so far from this computer's clock finds nothing where others ask for now."""


@dataclass(frozen=True)
class HeardStep:
    """One step, and when it was heard, by the monotonic clock."""

    came_s: float
    transform: Any

    @property
    def child(self) -> str:
        """The frame that it tells of."""
        return str(self.transform.child_frame_id).removeprefix("/")

    @property
    def parent(self) -> str:
        """The frame in which it is told."""
        return str(self.transform.header.frame_id).removeprefix("/")


@dataclass(frozen=True)
class FrameRow:
    """One frame of the tree, as it is shown."""

    name: str
    depth: int
    """How many frames are above it."""
    age: str = ""
    """Rate and age, or `static`; empty for a root."""
    translation: str = ""
    yaw: str = ""
    said_by: str = ""


class FramesNow:
    """Filled by what comes; asked again and again."""

    def __init__(self) -> None:
        self._lately: deque[HeardStep] = deque(maxlen=MOST_STEPS)
        self._last: dict[str, HeardStep] = {}
        """The last step on /tf of each frame."""
        self._fixed: dict[tuple[str, str], HeardStep] = {}
        self._order: dict[str, None] = {}
        """Frames in the order in which they were told of first."""

    def take(self, message: Any, came_s: float, fixed: bool) -> None:
        """A message of /tf, or of /tf_static."""
        for transform in message.transforms:
            step = HeardStep(came_s, transform)
            if step.child not in self._order and len(self._order) >= MOST_FRAMES:
                continue
            self._order.setdefault(step.child)
            if fixed:
                self._fixed[step.child, step.parent] = step
            else:
                self._last[step.child] = step
                self._lately.append(step)

    def forget(self, now_s: float) -> None:
        """What has long been over."""
        while self._lately and now_s - self._lately[0].came_s > LATELY_S:
            self._lately.popleft()
        for name, step in list(self._last.items()):
            if now_s - step.came_s > FORGOTTEN_S:
                del self._last[name]
        fixed = {child for child, _ in self._fixed}
        self._order = {name: None for name in self._order if name in self._last or name in fixed}

    def heard(self, now_ns: int) -> FramesHeard:
        """What holds now: each step of the last seconds, and the last one of who has ceased."""
        found = FramesHeard(lambda: now_ns)
        for step in self._fixed.values():
            found.set_transform_static(step.transform, "")
        lately = {step.child for step in self._lately}
        for step in [*(s for n, s in self._last.items() if n not in lately), *self._lately]:
            found.set_transform(step.transform, "")
        found.frames = {name: found.frames[name] for name in self._order if name in found.frames}
        return found

    def transform_of(self, name: str, parent: str) -> Any:
        """The newest step to a frame."""
        step = self._last.get(name) or self._fixed[name, parent]
        return step.transform.transform

    def ceased(self, now_s: float) -> dict[str, float]:
        """The frames that moved and of which nothing comes any more, and for how many seconds."""
        silent = {name: self.silent_s(name, now_s) for name in self._last}
        return {name: silent_s for name, silent_s in silent.items() if silent_s > CEASED_S}

    def silent_s(self, name: str, now_s: float) -> float:
        """So long nothing has come of a frame that moves."""
        return now_s - self._last[name].came_s


@dataclass(frozen=True)
class FramesLook:
    """One look at all frames."""

    now: FramesNow
    said_by: dict[str, Sequence[str]]
    """The nodes that publish on /tf, and on /tf_static."""
    now_s: float
    now_ns: int
    """Of the clock by which stamps are made."""

    @cached_property
    def heard(self) -> FramesHeard:
        """All that holds now."""
        return self.now.heard(self.now_ns)

    @cached_property
    def ceased(self) -> dict[str, float]:
        """Who is silent, and for how many seconds."""
        return self.now.ceased(self.now_s)

    def rows(self) -> Iterator[FrameRow]:
        """Each tree from its root down; what goes round in a loop comes last."""
        for root in self.heard.roots:
            yield FrameRow(root, 0)
            yield from self._below(root, 1)
        for name in self.heard.in_loops:
            yield self._row(self.heard.frames[name], 1)

    def _below(self, parent: str, depth: int) -> Iterator[FrameRow]:
        for frame in self.heard.children(parent):
            yield self._row(frame, depth)
            yield from self._below(frame.name, depth + 1)

    def _row(self, frame: FrameHeard, depth: int) -> FrameRow:
        """A message does not say who sent it; the graph knows who could have."""
        step = self.now.transform_of(frame.name, frame.last_parent)
        place, topic = step.translation, TF if frame.moves else TF_STATIC
        return FrameRow(
            frame.name,
            depth,
            self._age(frame),
            f"{place.x:.3f}, {place.y:.3f}, {place.z:.3f}",
            f"{math.degrees(yaw_of(step.rotation)):.1f}",
            " or ".join(self.said_by.get(topic, ())) or "nobody any more",
        )

    def _age(self, frame: FrameHeard) -> str:
        silent_s = self.ceased.get(frame.name)
        return f"ceased {silent_s:.0f} s ago" if silent_s else about(frame, self.now_ns)

    def faults(self) -> Iterator[str]:
        """What does not fit together, what has ceased, and whose clock is another.

        A sentence each, without numbers that change: it is read aloud when it is another one.
        """
        yield from self.heard.faults()
        for name in self.ceased:
            yield f"'{name}' has ceased: nothing of it comes on /tf. Does its node still run?"
        if self._nobody_keeps_what_stands:
            yield (
                "Nobody publishes /tf_static any more: who comes now does not hear of its frames."
                " Let its node run on."
            )
        for frame in self.heard.frames.values():
            if frame.moves and frame.name not in self.ceased and (side := self._off(frame)):
                yield (
                    f"The stamps of '{frame.name}' are {side} this computer's clock."
                    " Its age shows how far."
                )

    @property
    def _nobody_keeps_what_stands(self) -> bool:
        stand = any(frame.stands for frame in self.heard.frames.values())
        return stand and not self.said_by.get(TF_STATIC)

    def _off(self, frame: FrameHeard) -> str:
        """On which side of the clock its stamps are; empty where they are near it."""
        age_s = (self.now_ns - frame.newest_ns) / NANOSECONDS
        off_s = age_s - self.now.silent_s(frame.name, self.now_s)
        if abs(off_s) <= OFF_S:
            return ""
        return "behind" if off_s > 0 else "ahead of"


def yaw_of(turn: Any) -> float:
    """The turn about the upright axis, in rad."""
    return math.atan2(
        2 * (turn.w * turn.z + turn.x * turn.y), 1 - 2 * (turn.y * turn.y + turn.z * turn.z)
    )
