"""Quaternions, Euler angles and matrices, with the names of `tf_transformations`.

A quaternion is four numbers in the order x, y, z, w. A matrix is a numpy array of 4 by 4: it turns
and shifts. Angles are in rad. `axes` names one of 24 sequences: `sxyz` is roll, pitch, yaw.
"""

from __future__ import annotations

import math
import random
from collections.abc import Sequence
from typing import Any, NoReturn

import numpy

from ros2_on_pip.stand_ins._frames import euler, motion
from ros2_on_pip.stand_ins._frames.motion import Matrix, Quaternion, Vector

Numbers = Sequence[float]
"""A list, a tuple or an array."""
Array = Any
"""A numpy array."""


def quaternion_from_euler(ai: float, aj: float, ak: float, axes: str = "sxyz") -> Quaternion:
    """Of roll, pitch and yaw. Raises ValueError for a sequence that there is not."""
    return euler.from_euler((ai, aj, ak), axes)


def euler_from_quaternion(quaternion: Numbers, axes: str = "sxyz") -> euler.Angles:
    """Roll, pitch and yaw. Raises ValueError for a sequence that there is not."""
    return euler.to_euler(motion.normalized(_quaternion(quaternion)), axes)


def quaternion_multiply(quaternion1: Numbers, quaternion0: Numbers) -> Quaternion:
    """The rotation `quaternion0`, and after it `quaternion1`."""
    return motion.product(_quaternion(quaternion1), _quaternion(quaternion0))


def quaternion_conjugate(quaternion: Numbers) -> Array:
    """Of a unit quaternion: the rotation back."""
    return numpy.array(motion.conjugate(_quaternion(quaternion)))


def quaternion_inverse(quaternion: Numbers) -> Array:
    """What makes (0, 0, 0, 1) of it. Raises ValueError for four zeros."""
    squared = sum(value * value for value in _quaternion(quaternion))
    if not squared:
        raise ValueError("the quaternion (0, 0, 0, 0) has no inverse; no rotation is (0, 0, 0, 1)")
    return quaternion_conjugate(quaternion) / squared


def quaternion_about_axis(angle: float, axis: Numbers) -> Quaternion:
    """A turn by `angle` about an axis of any length. Raises ValueError for an axis of zeros."""
    x, y, z = unit_vector(axis)[:3].tolist()
    sine = math.sin(angle / 2)
    return x * sine, y * sine, z * sine, math.cos(angle / 2)


def quaternion_slerp(
    quat0: Numbers, quat1: Numbers, fraction: float, spin: int = 0, shortestpath: bool = True
) -> Array:
    """On the shorter arc from `quat0` (fraction 0) to `quat1` (1).

    Raises NotImplementedError where another arc is asked for.
    """
    if spin or not shortestpath:
        raise NotImplementedError("only the shorter arc without spin is here")
    a, b = (motion.normalized(_quaternion(each)) for each in (quat0, quat1))
    return numpy.array(motion.slerp(a, b, fraction))


def quaternion_matrix(quaternion: Numbers) -> Array:
    """The same rotation, as 4 by 4."""
    return _matrix(motion.matrix(motion.normalized(_quaternion(quaternion))))


def quaternion_from_matrix(matrix: Array) -> Quaternion:
    """Of a matrix's rotation; w is not negative."""
    return motion.from_matrix(_rotation(matrix))


def euler_matrix(ai: float, aj: float, ak: float, axes: str = "sxyz") -> Array:
    """A rotation as 4 by 4. Raises ValueError for a sequence that there is not."""
    return quaternion_matrix(quaternion_from_euler(ai, aj, ak, axes))


def euler_from_matrix(matrix: Array, axes: str = "sxyz") -> euler.Angles:
    """Of a matrix's rotation. Raises ValueError for a sequence that there is not."""
    return euler.matrix_to_euler(_rotation(matrix), axes)


def rotation_matrix(angle: float, direction: Numbers, point: Numbers | None = None) -> Array:
    """A turn about an axis through `point`, the origin by default."""
    made = quaternion_matrix(quaternion_about_axis(angle, direction))
    if point is not None:
        through = numpy.array(point[:3], dtype=float)
        made[:3, 3] = through - made[:3, :3] @ through
    return made


def identity_matrix() -> Array:
    """Nothing moves."""
    return numpy.identity(4)


def translation_matrix(direction: Numbers) -> Array:
    """A shift as 4 by 4."""
    made = numpy.identity(4)
    made[:3, 3] = direction[:3]
    return made


def translation_from_matrix(matrix: Array) -> Array:
    """A matrix's shift."""
    return numpy.array(matrix, dtype=float)[:3, 3].copy()


def compose_matrix(*, angles: Numbers | None = None, translate: Numbers | None = None) -> Array:
    """Roll, pitch and yaw, then a shift. Scale, shear and perspective are not here."""
    roll, pitch, yaw = (0.0, 0.0, 0.0) if angles is None else angles
    made = euler_matrix(roll, pitch, yaw)
    made[:3, 3] = (0.0, 0.0, 0.0) if translate is None else translate
    return made


def concatenate_matrices(*matrices: Array) -> Array:
    """The product: the last one acts first."""
    made = numpy.identity(4)
    for each in matrices:
        made = made @ numpy.array(each, dtype=float)
    return made


def inverse_matrix(matrix: Array) -> Array:
    """The way back."""
    return numpy.linalg.inv(numpy.array(matrix, dtype=float))


def is_same_transform(matrix0: Array, matrix1: Array) -> bool:
    """Whether both move each point to the same place."""
    first, second = (numpy.array(each, dtype=float) for each in (matrix0, matrix1))
    return bool(numpy.allclose(first / first[3, 3], second / second[3, 3]))


def vector_norm(data: Numbers) -> float:
    """The length of a vector."""
    return float(math.hypot(*data))


def unit_vector(data: Numbers) -> Array:
    """The vector of length 1 in the same direction. Raises ValueError for zeros."""
    length = vector_norm(data)
    if not length:
        raise ValueError("a vector of zeros has no direction")
    return numpy.array(data, dtype=float) / length


def random_vector(size: int) -> Array:
    """Numbers from 0 to 1."""
    return numpy.array([random.random() for _ in range(size)])


def random_quaternion(rand: Numbers | None = None) -> Array:
    """A rotation of which each is as likely as the others; `rand` are three numbers from 0 to 1."""
    part, first, second = random_vector(3) if rand is None else rand
    a, b = math.sqrt(1.0 - part), math.sqrt(part)
    s, t = math.tau * first, math.tau * second
    return numpy.array((math.sin(s) * a, math.cos(s) * a, math.sin(t) * b, math.cos(t) * b))


def random_rotation_matrix(rand: Numbers | None = None) -> Array:
    """A random rotation as 4 by 4."""
    return quaternion_matrix(random_quaternion(rand))


def _quaternion(numbers: Numbers) -> Quaternion:
    """Of four numbers; numpy's become Python's. Raises ValueError for others than four."""
    x, y, z, w = map(float, numbers)
    return x, y, z, w


def _matrix(rows: Matrix) -> Array:
    made = numpy.identity(4)
    made[:3, :3] = rows
    return made


def _rotation(matrix: Array) -> Matrix:
    """The rows of a matrix of 3 by 3 or 4 by 4."""
    first, second, third = (_row(row) for row in numpy.array(matrix, dtype=float)[:3, :3].tolist())
    return first, second, third


def _row(numbers: Sequence[float]) -> Vector:
    x, y, z = numbers
    return x, y, z


_ABSENT = (
    "Arcball",
    "arcball_constrain_to_axis",
    "arcball_map_to_sphere",
    "arcball_nearest_axis",
    "clip_matrix",
    "decompose_matrix",
    "orthogonalization_matrix",
    "projection_from_matrix",
    "projection_matrix",
    "reflection_from_matrix",
    "reflection_matrix",
    "rotation_from_matrix",
    "scale_from_matrix",
    "scale_matrix",
    "shear_from_matrix",
    "shear_matrix",
    "superimposition_matrix",
)
"""What the real package has beside: scale, shear, mirrors and perspective move no frame."""


def __getattr__(name: str) -> NoReturn:
    if name in _ABSENT:
        raise ImportError(
            f"tf_transformations.{name} is not here. The real package needs Ubuntu 24.04: sudo apt"
            " install ros-jazzy-tf-transformations. What it stands on has it too:"
            " pip install transforms3d"
        )
    raise AttributeError(f"module 'tf_transformations' has no attribute {name!r}")
