"""Frames by other hands: transforms3d's matrices, and trees that are made by chance."""

from __future__ import annotations

import math
import random
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, TypeVar

import numpy
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from transforms3d import affines, quaternions

from ros2_on_pip.stand_ins._frames.history import ParentTransform
from ros2_on_pip.stand_ins._frames.motion import (
    Quaternion,
    RigidTransform,
    Vector,
    matrix,
    normalized,
)
from ros2_on_pip.stand_ins._frames.tree import FrameTree

Array = Any
Test = TypeVar("Test", bound=Callable[..., None])
SECOND_NS = 1_000_000_000
BEGIN_NS = 1_700_000_000 * SECOND_NS
KEPT_NS = 10 * SECOND_NS
ROOT = "world"

NUMBERS = st.floats(-1.0, 1.0, allow_nan=False)
SHIFTS = st.tuples(NUMBERS, NUMBERS, NUMBERS)
TURNS = (
    st.tuples(NUMBERS, NUMBERS, NUMBERS, NUMBERS)
    .filter(lambda q: math.hypot(*q) > 0.1)
    .map(normalized)
)
MOTIONS = st.builds(RigidTransform, SHIFTS, TURNS)
"""Of any rotation, and no more than a metre."""


def holds_for(*values: st.SearchStrategy[Any]) -> Callable[[Test], Test]:
    """The test must pass for all values; how long that takes says nothing on a busy machine."""

    def mark(test: Test) -> Test:
        patient = settings(
            deadline=None, database=None, suppress_health_check=[HealthCheck.too_slow]
        )
        marked: Test = patient(given(*values)(test))
        return marked

    return mark


def w_first(q: Quaternion) -> tuple[float, float, float, float]:
    """In the order of transforms3d."""
    return q[3], q[0], q[1], q[2]


def by_transforms3d(motion: RigidTransform) -> Array:
    """As 4 by 4."""
    turn = quaternions.quat2mat(w_first(motion.rotation))
    return affines.compose(motion.shift, turn, numpy.ones(3))


def as_matrix(motion: RigidTransform) -> Array:
    """Ours, as 4 by 4."""
    made = numpy.identity(4)
    made[:3, :3], made[:3, 3] = matrix(motion.rotation), motion.shift
    return made


def between_by_transforms3d(a: RigidTransform, b: RigidTransform, part: float) -> Array:
    """On the shorter arc, by the axis and the angle between the two.

    The angle by atan2: transforms3d takes it from a cosine, which tells small ones to 1e-8 only.
    """
    first, second = w_first(a.rotation), w_first(b.rotation)
    turn = quaternions.qmult(quaternions.qinverse(first), second)
    turn = turn if turn[0] >= 0 else -turn
    sine = float(numpy.linalg.norm(turn[1:]))
    axis = turn[1:] / sine if sine else numpy.array([1.0, 0.0, 0.0])
    step = quaternions.axangle2quat(axis, 2 * math.atan2(sine, turn[0]) * part, is_normalized=True)
    rotation = quaternions.qmult(first, step)
    shift = numpy.array(a.shift) * (1 - part) + numpy.array(b.shift) * part
    return affines.compose(shift, quaternions.quat2mat(rotation), numpy.ones(3))


def any_turn(chance: random.Random) -> Quaternion:
    """Each as likely as the others."""
    return normalized(
        (
            chance.gauss(0, 1),
            chance.gauss(0, 1),
            chance.gauss(0, 1),
            chance.gauss(0, 1),
        )
    )


def any_motion(chance: random.Random) -> RigidTransform:
    """Within ten metres."""
    shift: Vector = (chance.uniform(-10, 10), chance.uniform(-10, 10), chance.uniform(-10, 10))
    return RigidTransform(shift, any_turn(chance))


@dataclass
class RandomTree:
    """A tree of frames, in ours and as the numbers that it was made of."""

    chance: random.Random
    tree: FrameTree = field(default_factory=lambda: FrameTree(KEPT_NS))
    said: dict[str, tuple[str, dict[int, RigidTransform]]] = field(default_factory=dict)
    """Of each frame its parent, and where it was when; at the time 0 where it never moves."""
    first_ns: int = BEGIN_NS
    last_ns: int = BEGIN_NS + SECOND_NS

    def grow(self, frames: int) -> RandomTree:
        """So many frames below the root; a third of them never move."""
        for number in range(frames):
            parent = self.chance.choice([ROOT, *self.said])
            if self.chance.random() < 1 / 3:
                self._stand(f"f{number}", parent)
            else:
                self._move(f"f{number}", parent)
        return self

    def _stand(self, frame: str, parent: str) -> None:
        motion = any_motion(self.chance)
        self.said[frame] = parent, {0: motion}
        self.tree.set_static(frame, ParentTransform(parent, motion))

    def _move(self, frame: str, parent: str) -> None:
        middle = self.chance.sample(
            range(self.first_ns + 1, self.last_ns), self.chance.randint(0, 4)
        )
        times_ns = [self.first_ns, self.last_ns, *middle]
        self.chance.shuffle(times_ns)  # messages may come in any order
        motions = {time_ns: any_motion(self.chance) for time_ns in times_ns}
        self.said[frame] = parent, motions
        for time_ns, motion in motions.items():
            assert self.tree.set_moving(frame, time_ns, ParentTransform(parent, motion))

    def in_root(self, frame: str, time_ns: int) -> Array:
        """Where the frame lies in the root, by transforms3d."""
        if frame == ROOT:
            return numpy.identity(4)
        parent, motions = self.said[frame]
        return self.in_root(parent, time_ns) @ self._in_parent(motions, time_ns)

    def _in_parent(self, motions: dict[int, RigidTransform], time_ns: int) -> Array:
        if known := motions.get(time_ns) or motions.get(0):
            return by_transforms3d(known)
        before = max(each for each in motions if each < time_ns)
        after = min(each for each in motions if each > time_ns)
        part = (time_ns - before) / (after - before)
        return between_by_transforms3d(motions[before], motions[after], part)

    def asked(self) -> tuple[str, str, int]:
        """A target, a source and a time that are known."""
        target, source = self.chance.choices([ROOT, *self.said], k=2)
        return target, source, self.chance.randint(self.first_ns, self.last_ns)


def worst_error(seed: int, trees: int) -> float:
    """The largest difference between a number of ours and the reference, over random trees."""
    chance = random.Random(seed)
    worst = 0.0
    for _ in range(trees):
        made = RandomTree(chance).grow(chance.randint(1, 8))
        target, source, time_ns = made.asked()
        ours = as_matrix(made.tree.look_up(target, source, time_ns)[0])
        theirs = numpy.linalg.inv(made.in_root(target, time_ns)) @ made.in_root(source, time_ns)
        worst = max(worst, float(numpy.abs(ours - theirs).max()))
    return worst
