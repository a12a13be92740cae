"""Rigid motions in plain floats: how one frame lies in another.

A vector is (x, y, z) in metres, a rotation the unit quaternion (x, y, z, w), in the order of ROS's
messages. Numpy is not used: for four numbers a call of it costs more than the sum.
"""

from __future__ import annotations

import math
from typing import NamedTuple

Vector = tuple[float, float, float]
Quaternion = tuple[float, float, float, float]
Matrix = tuple[Vector, Vector, Vector]
"""Row by row."""

NO_ROTATION: Quaternion = (0.0, 0.0, 0.0, 1.0)
NEARLY_EQUAL = 1.0 - 1e-9
"""Cosine of half the angle between two rotations from which on a straight line is taken for the
arc. The line is wrong by less than 1e-14 there, and the arc would divide by nearly nothing."""


class RigidTransform(NamedTuple):
    """Where a frame lies: it is turned, then shifted."""

    shift: Vector = (0.0, 0.0, 0.0)
    rotation: Quaternion = NO_ROTATION


def product(a: Quaternion, b: Quaternion) -> Quaternion:
    """The rotation b, and after it a."""
    ax, ay, az, aw = a
    bx, by, bz, bw = b
    return (
        aw * bx + ax * bw + ay * bz - az * by,
        aw * by - ax * bz + ay * bw + az * bx,
        aw * bz + ax * by - ay * bx + az * bw,
        aw * bw - ax * bx - ay * by - az * bz,
    )


def conjugate(q: Quaternion) -> Quaternion:
    """The rotation back."""
    x, y, z, w = q
    return -x, -y, -z, w


def normalized(q: Quaternion) -> Quaternion:
    """The unit quaternion of the same direction; no rotation where all numbers are 0."""
    length = math.hypot(*q)
    if not length:
        return NO_ROTATION
    x, y, z, w = q
    return x / length, y / length, z / length, w / length


def rotate(q: Quaternion, vector: Vector) -> Vector:
    """The vector, turned by the unit quaternion q: v + 2w (q x v) + 2 q x (q x v)."""
    x, y, z, w = q
    vx, vy, vz = vector
    tx = 2.0 * (y * vz - z * vy)
    ty = 2.0 * (z * vx - x * vz)
    tz = 2.0 * (x * vy - y * vx)
    return (
        vx + w * tx + y * tz - z * ty,
        vy + w * ty + z * tx - x * tz,
        vz + w * tz + x * ty - y * tx,
    )


def apply(motion: RigidTransform, point: Vector) -> Vector:
    """A point of the moved frame, in the frame that it lies in."""
    x, y, z = rotate(motion.rotation, point)
    sx, sy, sz = motion.shift
    return x + sx, y + sy, z + sz


def compose(outer: RigidTransform, inner: RigidTransform) -> RigidTransform:
    """Where `inner` lies, which is told in the frame of `outer`, for those outside of it."""
    return RigidTransform(apply(outer, inner.shift), product(outer.rotation, inner.rotation))


def inverse(motion: RigidTransform) -> RigidTransform:
    """Where the outer frame lies in the moved one."""
    back = conjugate(motion.rotation)
    x, y, z = rotate(back, motion.shift)
    return RigidTransform((-x, -y, -z), back)


def between(a: RigidTransform, b: RigidTransform, part: float) -> RigidTransform:
    """On the way from a (part 0) to b (part 1): shifts on a line, rotations on the shorter arc."""
    (ax, ay, az), (bx, by, bz) = a.shift, b.shift
    shift = ax + (bx - ax) * part, ay + (by - ay) * part, az + (bz - az) * part
    return RigidTransform(shift, slerp(a.rotation, b.rotation, part))


def slerp(a: Quaternion, b: Quaternion, part: float) -> Quaternion:
    """On the shorter arc from a to b, at equal speed."""
    (ax, ay, az, aw), (bx, by, bz, bw) = a, b
    cosine = ax * bx + ay * by + az * bz + aw * bw
    sign = 1.0 if cosine >= 0.0 else -1.0  # q and -q are the same rotation
    of_a, of_b = _weights(min(abs(cosine), 1.0), part)
    of_b *= sign
    return normalized(
        (
            ax * of_a + bx * of_b,
            ay * of_a + by * of_b,
            az * of_a + bz * of_b,
            aw * of_a + bw * of_b,
        )
    )


def _weights(cosine: float, part: float) -> tuple[float, float]:
    if cosine > NEARLY_EQUAL:
        return 1.0 - part, part
    angle = math.acos(cosine)
    whole = math.sin(angle)
    return math.sin((1.0 - part) * angle) / whole, math.sin(part * angle) / whole


def matrix(q: Quaternion) -> Matrix:
    """The same rotation as a matrix: its columns are the axes of the turned frame."""
    x, y, z, w = q
    return (
        (1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)),
        (2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)),
        (2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)),
    )


def from_matrix(rows: Matrix) -> Quaternion:
    """The unit quaternion of a rotation's matrix, with w >= 0.

    Of four ways to the same numbers, the one is gone that divides by the largest of them.
    """
    (xx, xy, xz), (yx, yy, yz), (zx, zy, zz) = rows
    ways = {
        1 + xx - yy - zz: (1 + xx - yy - zz, yx + xy, zx + xz, zy - yz),
        1 - xx + yy - zz: (yx + xy, 1 - xx + yy - zz, zy + yz, xz - zx),
        1 - xx - yy + zz: (zx + xz, zy + yz, 1 - xx - yy + zz, yx - xy),
        1 + xx + yy + zz: (zy - yz, xz - zx, yx - xy, 1 + xx + yy + zz),
    }
    q = normalized(ways[max(ways)])
    return q if q[3] >= 0.0 else (-q[0], -q[1], -q[2], -q[3])
