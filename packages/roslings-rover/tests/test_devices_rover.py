"""The rover's model: how it moves, what it hits, what it sees."""

from __future__ import annotations

import math
from itertools import pairwise
from pathlib import Path

import pytest

from roslings_rover.models.differential_drive import moved, wrapped
from roslings_rover.rover import Ball, Body, Box, Circle, Motion, Pose, Rover, Wheels, World
from roslings_rover.rover.picture import save
from roslings_rover.rover.sensors import RangeSensor, Scanner, by_rep_117

EMPTY = World(room=Box(-50, -50, 50, 50))
QUICK = Body(motor_lag_s=1e-6)


def drive(rover: Rover, motion: Motion, seconds: float, dt_s: float = 0.02) -> Rover:
    """Drive so for a while."""
    rover.drive(motion)
    for _ in range(round(seconds / dt_s)):
        rover.step(dt_s)
    return rover


def test_a_quarter_of_a_circle_ends_where_geometry_says() -> None:
    """Radius v / w = 1 m: from (0, 0) to (1, 1), looking north."""
    rover = drive(Rover(EMPTY, body=QUICK), Motion(0.3, 0.3), math.pi / 2 / 0.3, dt_s=0.0001)
    assert rover.pose.x_m == pytest.approx(1.0, abs=1e-3)
    assert rover.pose.y_m == pytest.approx(1.0, abs=1e-3)
    assert rover.pose.heading_rad == pytest.approx(math.pi / 2, abs=1e-3)
    assert rover.way_m == pytest.approx(math.pi / 2, abs=1e-3)


def test_straight_on_and_on_the_spot() -> None:
    """The two ends of every arc."""
    straight = drive(Rover(EMPTY, body=QUICK), Motion(0.4, 0.0), 5.0)
    assert (straight.pose.x_m, straight.pose.y_m) == (pytest.approx(2.0), 0.0)
    turned = drive(Rover(EMPTY, body=QUICK), Motion(0.0, -1.0), 2.0)
    assert turned.pose == Pose(0.0, 0.0, pytest.approx(-2.0))


@pytest.mark.parametrize("motion", [Motion(0.2, 0.0), Motion(-0.1, 1.0), Motion(0.0, -2.0)])
def test_wheels_and_motion_are_inverse(motion: Motion) -> None:
    """Body to wheels and back."""
    back = Body().motion_of(Body().wheels_for(motion))
    assert back.forward_m_s == pytest.approx(motion.forward_m_s)
    assert back.turn_rad_s == pytest.approx(motion.turn_rad_s)


def test_too_fast_is_slowed_without_leaving_the_curve() -> None:
    """Both wheels alike, so that the radius stays."""
    body = Body()
    wheels = body.wheels_for(Motion(10.0, 5.0))
    assert max(wheels.left_rad_s, wheels.right_rad_s) == pytest.approx(body.fastest_wheel_rad_s)
    motion = body.motion_of(wheels)
    assert motion.forward_m_s / motion.turn_rad_s == pytest.approx(2.0)


def test_a_motor_needs_its_time() -> None:
    """63 % after one lag, whatever the steps."""
    body = Body()
    once = body.follow(Wheels(), Wheels(10, 10), body.motor_lag_s).left_rad_s
    assert once == pytest.approx(10 * (1 - 1 / math.e))
    often = Wheels()
    for _ in range(100):
        often = body.follow(often, Wheels(10, 10), body.motor_lag_s / 100)
    assert often.left_rad_s == pytest.approx(once)


def test_the_length_of_a_step_does_not_matter() -> None:
    """100 steps of 20 ms or 2 of 1 s."""
    fine = drive(Rover(EMPTY), Motion(0.4, 0.7), 2.0, 0.02).pose
    coarse = drive(Rover(EMPTY), Motion(0.4, 0.7), 2.0, 1.0).pose
    assert fine.x_m == pytest.approx(coarse.x_m, abs=1e-6)
    assert fine.y_m == pytest.approx(coarse.y_m, abs=1e-6)


def test_it_stops_at_a_wall_and_can_leave_it() -> None:
    """Its rim touches, its odometry stands still, and it backs off."""
    world = World(room=Box(-5, -5, 5, 5), obstacles=(Box(1, -1, 2, 1),))
    rover = drive(Rover(world), Motion(0.5, 0.0), 5.0)
    assert rover.touches
    assert rover.pose.x_m == pytest.approx(1 - rover.body.radius_m, abs=0.01)
    assert rover.motion.forward_m_s == pytest.approx(0.0)
    drive(rover, Motion(-0.5, 0.0), 1.0)
    assert not rover.touches
    assert rover.pose.x_m < 0.6


@pytest.mark.parametrize("motion", [Motion(math.nan, 0.0), Motion(0.0, math.inf)])
def test_a_speed_that_is_no_number_is_refused(motion: Motion) -> None:
    """And the rover goes on as it was told before."""
    rover = Rover(EMPTY)
    rover.drive(Motion(0.1, 0.0))
    before = rover.wanted
    with pytest.raises(ValueError, match="finite"):
        rover.drive(motion)
    assert rover.wanted == before


@pytest.mark.parametrize("dt_s", [-0.1, math.nan])
def test_time_does_not_go_back(dt_s: float) -> None:
    """Nor does it become no number."""
    with pytest.raises(ValueError, match="no step"):
        Rover(EMPTY).step(dt_s)


def test_the_same_seed_sees_the_same() -> None:
    """And another seed something else."""
    assert Rover(seed=1).scan() == Rover(seed=1).scan()
    assert Rover(seed=1).scan() != Rover(seed=2).scan()


@pytest.mark.parametrize(
    ("shape", "distance_m"),
    [(Circle(3, 0, 1), 2.0), (Box(2, -1, 3, 1), 2.0), (Circle(3, 1.5, 1), 50.0)],
)
def test_a_ray_ends_at_the_first_thing(shape: Circle | Box, distance_m: float) -> None:
    """A disc, a box, and past a disc to the wall."""
    world = World(room=Box(-50, -50, 50, 50), obstacles=(shape,))
    assert world.distance(0, 0, 0.0) == pytest.approx(distance_m)
    assert world.distance(0, 0, math.pi) == pytest.approx(50.0)


def test_the_range_sensor_has_a_cone() -> None:
    """A thin pole beside the axis is seen within the cone, and not beyond it."""
    from random import Random

    sensor = RangeSensor(noise_m=0.0)
    near = World(room=Box(-50, -50, 50, 50), obstacles=(Circle(2.1, 0.2, 0.06),))
    past = World(room=Box(-50, -50, 50, 50), obstacles=(Circle(2.1, 0.6, 0.06),))
    assert sensor.read(near, Pose(), Random(0)).range_m == pytest.approx(1.95, abs=0.03)
    assert sensor.read(past, Pose(), Random(0)).range_m == math.inf


def test_infinities_are_those_of_rep_117() -> None:
    """Too near, within, too far."""
    assert by_rep_117(0.01, 0.02, 4.0) == -math.inf
    assert by_rep_117(1.0, 0.02, 4.0) == 1.0
    assert by_rep_117(4.1, 0.02, 4.0) == math.inf


def test_the_scan_turns_counter_clockwise_from_ahead() -> None:
    """A rover that looks north has the west wall at its left."""
    from random import Random

    world = World(room=Box(-1, -2, 3, 4))
    scan = Scanner(noise_m=0.0).read(world, Pose(0, 0, math.pi / 2), Random(0))
    ahead, left, behind, right = scan[0], scan[90], scan[180], scan[270]
    assert (ahead, left, behind, right) == pytest.approx((4.0, 1.0, 2.0, 3.0))


def test_a_ball_ahead_is_in_the_middle_and_grows() -> None:
    """Left in the world is left in the picture."""
    far = Rover(World(EMPTY.room, balls=(Ball(3.08, 0.0),))).see()[0]
    near = Rover(World(EMPTY.room, balls=(Ball(1.08, 0.0),))).see()[0]
    left = Rover(World(EMPTY.room, balls=(Ball(3.08, 0.5),))).see()[0]
    assert far.u_px == pytest.approx(319.5)
    assert near.radius_px == pytest.approx(3 * far.radius_px)
    assert near.v_px > far.v_px > 239.5  # it lies on the floor, below the camera
    assert left.u_px < far.u_px


def test_a_ball_behind_or_hidden_is_not_seen() -> None:
    """By the rover's back, or by a box."""
    assert Rover(World(EMPTY.room, balls=(Ball(-2.0, 0.0),))).see() == []
    hidden = World(EMPTY.room, obstacles=(Box(1, -1, 1.2, 1),), balls=(Ball(2.0, 0.0),))
    assert Rover(hidden).see() == []


def test_the_course_room_leaves_start_and_goal_free() -> None:
    """The labs drive from (0, 0) to (3, 5), and the first ball is in sight."""
    rover = Rover()
    for place in ((0, 0), (3, 5)):
        assert rover.world.room_at(*place) > 3 * rover.body.radius_m
    assert len(rover.see()) == 1


def test_angles_wrap_to_one_turn() -> None:
    """Half a turn is +pi, from either side."""
    assert wrapped(3 * math.pi) == pytest.approx(math.pi)
    assert wrapped(-math.pi) == pytest.approx(math.pi)
    assert moved(Pose(0, 0, 3.0), Motion(0, 1.0), 1.0).heading_rad == pytest.approx(
        4.0 - 2 * math.pi
    )


def test_the_path_is_drawn(tmp_path: Path) -> None:
    """A picture of the map, with more than one colour on it."""
    from PIL import Image

    rover = drive(Rover(), Motion(0.5, 0.3), 8.0)
    assert all(math.dist((a.x_m, a.y_m), (b.x_m, b.y_m)) > 0.0 for a, b in pairwise(rover.path))
    save(rover, tmp_path / "path.png")
    with Image.open(tmp_path / "path.png") as picture:
        assert picture.size == (700, 650)
        colours = picture.convert("RGB").getcolors(1 << 20)
        assert colours is not None and len(colours) > 50
