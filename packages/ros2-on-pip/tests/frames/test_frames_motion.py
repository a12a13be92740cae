"""Rigid motions: what must hold of each, and the same by transforms3d."""

from __future__ import annotations

import math

import numpy
import pytest
from frame_reference import (
    MOTIONS,
    SHIFTS,
    TURNS,
    as_matrix,
    between_by_transforms3d,
    by_transforms3d,
    holds_for,
)
from hypothesis import strategies as st
from transforms3d import euler as reference_euler

from ros2_on_pip.stand_ins._frames import euler
from ros2_on_pip.stand_ins._frames.motion import (
    NO_ROTATION,
    Quaternion,
    RigidTransform,
    Vector,
    apply,
    between,
    compose,
    conjugate,
    from_matrix,
    inverse,
    matrix,
    normalized,
    product,
    rotate,
    slerp,
)

CLOSE = 1e-12
ANGLES = st.floats(-3.0, 3.0, allow_nan=False)
PARTS = st.floats(0.0, 1.0)


def same_rotation(a: Quaternion, b: Quaternion) -> bool:
    """q and -q turn alike."""
    return abs(abs(sum(x * y for x, y in zip(a, b, strict=True))) - 1.0) < CLOSE


@holds_for(MOTIONS, MOTIONS)
def test_composing_is_the_product_of_matrices(a: RigidTransform, b: RigidTransform) -> None:
    """As transforms3d's."""
    product_of_both = by_transforms3d(a) @ by_transforms3d(b)
    assert numpy.abs(as_matrix(compose(a, b)) - product_of_both).max() < CLOSE


@holds_for(MOTIONS, SHIFTS)
def test_there_and_back(motion: RigidTransform, point: Vector) -> None:
    """The inverse undoes it, from both sides."""
    assert apply(inverse(motion), apply(motion, point)) == pytest.approx(point, abs=CLOSE)
    assert apply(motion, apply(inverse(motion), point)) == pytest.approx(point, abs=CLOSE)


@holds_for(MOTIONS, MOTIONS, MOTIONS)
def test_the_order_of_composing_does_not_matter(
    a: RigidTransform, b: RigidTransform, c: RigidTransform
) -> None:
    """(a b) c is a (b c): a tree may be climbed from any side."""
    left, right = compose(compose(a, b), c), compose(a, compose(b, c))
    assert left.shift == pytest.approx(right.shift, abs=CLOSE)
    assert left.rotation == pytest.approx(right.rotation, abs=CLOSE)


@holds_for(TURNS, SHIFTS)
def test_a_turn_keeps_lengths(q: Quaternion, vector: Vector) -> None:
    """And the turn back undoes it."""
    assert math.hypot(*rotate(q, vector)) == pytest.approx(math.hypot(*vector), abs=CLOSE)
    assert rotate(conjugate(q), rotate(q, vector)) == pytest.approx(vector, abs=CLOSE)


@holds_for(TURNS, TURNS)
def test_the_product_turns_by_the_second_first(a: Quaternion, b: Quaternion) -> None:
    """As matrices do."""
    both = numpy.array(matrix(a)) @ numpy.array(matrix(b))
    assert numpy.abs(numpy.array(matrix(product(a, b))) - both).max() < CLOSE


@holds_for(TURNS)
def test_a_matrix_has_the_rotation_in_it(q: Quaternion) -> None:
    """Whichever of its numbers is the largest."""
    found = from_matrix(matrix(q))
    assert same_rotation(found, q)
    assert found[3] >= 0.0


@holds_for(MOTIONS, MOTIONS, PARTS)
def test_between_two_is_the_shorter_arc_at_equal_speed(
    a: RigidTransform, b: RigidTransform, part: float
) -> None:
    """As transforms3d's by axis and angle; near half a turn both arcs are as long."""
    half = abs(sum(x * y for x, y in zip(a.rotation, b.rotation, strict=True)))
    if half > 1e-3:
        ours = as_matrix(between(a, b, part))
        assert numpy.abs(ours - between_by_transforms3d(a, b, part)).max() < 1e-9


@holds_for(MOTIONS, MOTIONS)
def test_the_ends_of_the_way(a: RigidTransform, b: RigidTransform) -> None:
    """Part 0 is the first, part 1 the second."""
    for part, end in ((0.0, a), (1.0, b)):
        found = between(a, b, part)
        assert found.shift == pytest.approx(end.shift, abs=CLOSE)
        assert same_rotation(found.rotation, end.rotation)


@holds_for(TURNS, st.floats(-1e-4, 1e-4), PARTS)
def test_between_two_that_are_nearly_equal(q: Quaternion, angle: float, part: float) -> None:
    """On both sides of where a line is taken for the arc."""
    other = product(q, (0.0, 0.0, math.sin(angle / 2), math.cos(angle / 2)))
    wanted = product(q, (0.0, 0.0, math.sin(angle * part / 2), math.cos(angle * part / 2)))
    assert slerp(q, other, part) == pytest.approx(wanted, abs=1e-11)


def test_half_of_a_quarter_turn() -> None:
    """One that is known by heart; the sign of a quaternion changes nothing."""
    quarter = (0.0, 0.0, math.sin(math.pi / 4), math.cos(math.pi / 4))
    eighth = (0.0, 0.0, math.sin(math.pi / 8), math.cos(math.pi / 8))
    assert slerp(NO_ROTATION, quarter, 0.5) == pytest.approx(eighth)
    negative = (-quarter[0], -quarter[1], -quarter[2], -quarter[3])
    assert slerp(NO_ROTATION, negative, 0.5) == pytest.approx(eighth)


def test_zeros_are_no_rotation() -> None:
    """A message whose quaternion nobody has filled in."""
    assert normalized((0.0, 0.0, 0.0, 0.0)) == NO_ROTATION


@pytest.mark.parametrize("axes", euler.SEQUENCES)
@holds_for(ANGLES, ANGLES, ANGLES)
def test_euler_angles_as_transforms3d(axes: str, a: float, b: float, c: float) -> None:
    """To a quaternion, and back to angles of the same rotation."""
    q = euler.from_euler((a, b, c), axes)
    w, x, y, z = reference_euler.euler2quat(a, b, c, axes)
    assert same_rotation(q, (x, y, z, w))
    assert same_rotation(euler.from_euler(euler.to_euler(q, axes), axes), q)


@pytest.mark.parametrize("axes", euler.SEQUENCES)
def test_euler_angles_where_two_axes_fall_together(axes: str) -> None:
    """The angles are not known then, or badly; the rotation is."""
    for middle in (0.0, math.pi / 2, -math.pi / 2, math.pi):
        for off in (0.0, 1e-16, 1e-15, 1e-12, -1e-12, 1e-9):
            q = euler.from_euler((0.3, middle + off, 0.4), axes)
            assert same_rotation(euler.from_euler(euler.to_euler(q, axes), axes), q)


@pytest.mark.parametrize("axes", ["xyz", "sxxy", "sxyw", "", "SXYZ"])
def test_a_sequence_that_there_is_not(axes: str) -> None:
    """It is named, and so are those that there are."""
    with pytest.raises(ValueError, match=r"is no sequence of axes\. There is: sxyx, sxyz"):
        euler.from_euler((0.0, 0.0, 0.0), axes)
