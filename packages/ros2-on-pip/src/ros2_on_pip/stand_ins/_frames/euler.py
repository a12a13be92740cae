"""Euler angles: three turns in a row, about axes that stand or that turn with the frame.

A sequence is written as in `tf_transformations`. `sxyz` turns about the standing axes x, y, z, in
this order (roll, pitch, yaw). `rzyx` turns about the rotating axes z, y, x. There are 24.
"""

from __future__ import annotations

import math
from itertools import product as choices

from ros2_on_pip.stand_ins._frames.motion import NO_ROTATION, Matrix, Quaternion, matrix, product

Angles = tuple[float, float, float]

SEQUENCES = tuple(
    f"{kind}{a}{b}{c}" for kind in "sr" for a, b, c in choices("xyz", repeat=3) if a != b != c
)
LOCKED = 4 * 2.220446049250313e-16
"""Where the sine or cosine of the middle angle is smaller, the first and the last turn are about
the same axis. Their sum is known, and neither of them: one is said to be 0."""


class NoSuchSequence(ValueError):
    """The name of a sequence of axes that there is not."""

    def __init__(self, axes: object) -> None:
        super().__init__(f"{axes!r} is no sequence of axes. There is: {', '.join(SEQUENCES)}")


def from_euler(angles: Angles, axes: str = "sxyz") -> Quaternion:
    """The rotation of three angles in rad. Raises NoSuchSequence."""
    about, turned = _rotating(axes, angles)
    rotation = NO_ROTATION
    for axis, angle in zip(about, turned, strict=True):
        part = [0.0, 0.0, 0.0, math.cos(angle / 2)]
        part[axis] = math.sin(angle / 2)
        rotation = product(rotation, (part[0], part[1], part[2], part[3]))
    return rotation


def to_euler(q: Quaternion, axes: str = "sxyz") -> Angles:
    """The angles in rad of the unit quaternion q. Raises NoSuchSequence."""
    return matrix_to_euler(matrix(q), axes)


def matrix_to_euler(rows: Matrix, axes: str = "sxyz") -> Angles:
    """The angles in rad of a rotation's matrix. Raises NoSuchSequence."""
    (i, j, last), _ = _rotating(axes, (0.0, 0.0, 0.0))
    k = 3 - i - j
    first_middle_last = (_proper if last == i else _three_axes)(rows, i, j, k)
    # In the order x, z, y axes are left-handed: angles count the other way there.
    sign = 1.0 if (j - i) % 3 == 1 else -1.0
    first, middle, end = (sign * angle for angle in first_middle_last)
    return _as_asked(axes, (first, middle, end))


def _three_axes(rows: Matrix, i: int, j: int, k: int) -> Angles:
    """Of three turns about three axes: the last is what the others leave, also near a lock."""
    cosine = math.hypot(rows[i][i], rows[i][j])
    middle = math.atan2(rows[i][k], cosine)
    first = math.atan2(-rows[j][k], rows[k][k]) if cosine > LOCKED else 0.0
    c, s = math.cos(first), math.sin(first)
    return (
        first,
        middle,
        math.atan2(c * rows[j][i] + s * rows[k][i], c * rows[j][j] + s * rows[k][j]),
    )


def _proper(rows: Matrix, i: int, j: int, k: int) -> Angles:
    """Of three turns, the last about the axis of the first."""
    sine = math.hypot(rows[i][j], rows[i][k])
    middle = math.atan2(sine, rows[i][i])
    first = math.atan2(rows[j][i], -rows[k][i]) if sine > LOCKED else 0.0
    c, s = math.cos(first), math.sin(first)
    return (
        first,
        middle,
        math.atan2(-c * rows[j][k] - s * rows[k][k], c * rows[j][j] + s * rows[k][j]),
    )


def _rotating(axes: str, angles: Angles) -> tuple[tuple[int, ...], Angles]:
    """The same turns about rotating axes: about standing ones they come in the other order."""
    if axes not in SEQUENCES:
        raise NoSuchSequence(axes)
    numbers = tuple("xyz".index(axis) for axis in axes[1:])
    return (numbers[::-1] if axes[0] == "s" else numbers), _as_asked(axes, angles)


def _as_asked(axes: str, angles: Angles) -> Angles:
    first, middle, last = angles
    return (last, middle, first) if axes[0] == "s" else angles
