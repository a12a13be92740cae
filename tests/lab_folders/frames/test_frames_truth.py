"""The truth that the lab "frames" judges by: drives, points on walls, and cells of a map.

Each mistake of a beginner is made here by hand, and must be told from the others.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from geometry_msgs.msg import Quaternion, TransformStamped
from numpy.typing import NDArray

from graders.frames.act import body_seen, step_seen
from graders.frames.cells import measured, truth_of
from graders.frames.drive import (
    FREE_M,
    NO_DISTANCES,
    ODOMETRY_EVERY_S,
    Drive,
    LaserMount,
    Numbers,
    Odometry,
    Scan,
    drive_in,
)
from graders.frames.places import mistake_in, off_the_walls_m, points_of
from graders.frames.record import MapSeen, MapSlip, WayWrong
from roslings_rover.models.differential_drive import Pose

SEEDS = (1, 2, 3)
MOUNT = LaserMount(0.12, -0.07, 1.9)
CELL_M, CELLS, CORNER_M = 0.05, 240, -6.0
KNOWN = ("standing", "moving")


@pytest.fixture(params=SEEDS, name="drive", scope="module")
def a_drive(request: pytest.FixtureRequest) -> Drive:
    """In one of three rooms, with the laser beside the middle."""
    return drive_in(request.param, MOUNT)


def turning(drive: Drive) -> list[Scan]:
    """Scans of the fastest turn, where the rover has left its first place."""
    return [scan for scan in drive.scans if abs(scan.turn_rad_s) == 2.0]


# --- steps -----------------------------------------------------------------------------------


def step(x_m: float = 1.0, z_m: float = 0.0, turn: Quaternion | None = None) -> TransformStamped:
    """One that a node says of a rover that is at (1, 0), half a radian to the left."""
    told = TransformStamped()
    told.transform.translation.x, told.transform.translation.z = x_m, z_m
    told.transform.rotation = turn or Quaternion(z=math.sin(0.25), w=math.cos(0.25))
    return told


TRUTH = Pose(1.0, 0.0, 0.5)


@pytest.mark.parametrize(
    ("turn", "off_rad"),
    [
        (Quaternion(z=math.sin(0.25), w=math.cos(0.25)), 0.0),
        (Quaternion(z=-math.sin(0.25), w=-math.cos(0.25)), 0.0),
        (Quaternion(z=math.sin(0.5), w=math.cos(0.5)), 0.5),
        (Quaternion(x=1.0, w=0.0), math.pi),
    ],
    ids=["right", "the same rotation", "half a radian more", "on its roof"],
)
def test_a_turn_is_off_by_the_angle_of_the_whole_rotation(turn: Quaternion, off_rad: float) -> None:
    """Also where it is about another axis."""
    assert body_seen(step(turn=turn), 1, TRUTH).off_rad == pytest.approx(off_rad, abs=1e-3)


def test_a_rover_above_the_floor_is_elsewhere() -> None:
    """As far as one that is beside its place."""
    assert body_seen(step(z_m=0.2), 1, TRUTH).off_m == pytest.approx(0.2)
    assert body_seen(step(), 1, TRUTH).off_m == 0.0


@pytest.mark.parametrize("value", [math.nan, math.inf, -math.inf])
def test_numbers_that_are_none_are_kept_as_such(value: float) -> None:
    """No distance is counted with them: a comparison with NaN would hold for anything."""
    for told in (step(x_m=value), step(z_m=value), step(turn=Quaternion(w=value))):
        assert not step_seen("tf", told).is_finite
        body = body_seen(told, 1, TRUTH)
        assert not body.is_finite
        assert math.isfinite(body.off_m + body.off_rad)


# --- drives ------------------------------------------------------------------------------------


def test_the_same_seed_is_the_same_drive(drive: Drive) -> None:
    """So evidence can be judged again."""
    again = drive_in(SEEDS[0], MOUNT)
    assert again.room == drive_in(SEEDS[0], MOUNT).room
    assert np.array_equal(
        again.scans[-1].ranges, drive_in(SEEDS[0], MOUNT).scans[-1].ranges, equal_nan=True
    )


def test_a_distance_is_at_each_limit_of_the_laser(drive: Drive) -> None:
    """In a scan of which the place can be known, and none is beyond."""
    least_m, most_m = drive.limits_m
    known = [scan for scan in drive.scans if scan.part in KNOWN]
    found = np.concatenate([scan.ranges[scan.is_distance] for scan in known])
    assert least_m in found
    assert most_m in found
    assert ((least_m <= found) & (found <= most_m)).all()


def test_the_rover_touches_nothing(drive: Drive) -> None:
    """Its laser is never inside of a wall."""
    for scan in drive.scans:
        body = drive.body_at(scan.at_s)
        assert drive.room.world.room_at(body.x_m, body.y_m) > FREE_M - 0.1
        assert drive.room.world.room_at(scan.laser.x_m, scan.laser.y_m) > 0.1


def test_a_scan_lies_between_two_odometries(drive: Drive) -> None:
    """Some come before the second of them, some after it; some are beyond all odometry."""
    odometry = [each.at_s for each in drive.odometry]
    for scan in drive.scans:
        assert min(abs(scan.at_s - at_s) for at_s in odometry) > 0.01
    told = drive.told
    early = late = 0
    for place, each in enumerate(told):
        if isinstance(each, Scan) and each.part in KNOWN:
            before = [said.at_s for said in told[:place] if isinstance(said, Odometry)]
            early += before[-1] < each.at_s
            late += before[-1] > each.at_s
    assert min(early, late) > 10
    assert {scan.part for scan in drive.scans} == {"before", "after", *KNOWN}


def test_odometry_is_steady(drive: Drive) -> None:
    """20 times a second, and it begins at the origin."""
    odometry = drive.odometry
    steps = np.diff([each.at_s for each in odometry])
    assert np.allclose(steps, ODOMETRY_EVERY_S)
    assert odometry[0].body == Pose()


def test_what_is_no_distance_is_in_each_scan(drive: Drive) -> None:
    """NaN, both infinities, too near and too far."""
    for scan in drive.scans:
        assert (~scan.is_distance).sum() >= len(NO_DISTANCES)
        assert np.isnan(scan.ranges).any()
        assert (scan.ranges == 30.0).any()
        assert (scan.ranges == 0.0).any()


# --- points on walls ---------------------------------------------------------------------------


def test_right_points_are_on_walls(drive: Drive) -> None:
    """As near as the laser measures."""
    for scan in drive.scans:
        points = points_of(drive, scan, scan.laser)
        assert off_the_walls_m(drive, points) < 0.008
        assert mistake_in(drive, scan, points) == ""


def laser_at(drive: Drive, scan: Scan, way: WayWrong) -> tuple[Pose, float | None]:
    """Where a beginner takes the laser to be, and the angle of the first beam."""
    body = drive.body_at(scan.at_s)
    x_m, y_m = scan.laser.seen_from_here(0.0, 0.0)
    places: dict[WayWrong, Pose] = {
        "beam_angles": scan.laser,
        "mount": body,
        "heading": Pose(scan.laser.x_m, scan.laser.y_m),
        "inverse": Pose(x_m, y_m, -scan.laser.heading_rad),
        "laser_frame": Pose(),
        "other_time": drive.mount.on(drive.body_at(scan.at_s - 0.06)),
    }
    return places[way], 0.0 if way == "beam_angles" else None


@pytest.mark.parametrize(
    "way", ["beam_angles", "mount", "heading", "inverse", "laser_frame", "other_time"]
)
def test_each_mistake_is_told(drive: Drive, way: WayWrong) -> None:
    """In most scans while the rover turns, and never as another one in more than a few."""
    told = [
        mistake_in(drive, scan, points_of(drive, scan, *laser_at(drive, scan, way)))
        for scan in turning(drive)
    ]
    assert told.count(way) > 0.6 * len(told), told


def test_wrong_points_are_off(drive: Drive) -> None:
    """A twentieth of a second is seen while it turns fast."""
    off_m = [
        off_the_walls_m(
            drive, points_of(drive, scan, drive.mount.on(drive.body_at(scan.at_s - 0.05)))
        )
        for scan in turning(drive)
    ]
    assert sorted(off_m)[len(off_m) // 2] > 0.03


# --- the map -----------------------------------------------------------------------------------


def cells_of(points: Numbers, cut: bool = False) -> tuple[NDArray[Any], NDArray[Any]]:
    """Rows and columns; `cut` as int() does it, on both sides of 0."""
    if cut:
        found = np.trunc(points / CELL_M) + CELLS // 2
    else:
        found = np.floor((points - CORNER_M) / CELL_M)
    whole = found.astype(int)
    return whole[:, 1], whole[:, 0]


def drawn(drive: Drive, cut: bool = False) -> NDArray[np.int8]:
    """The map of a drive, as a student draws it."""
    grid = np.full((CELLS, CELLS), -1, np.int8)
    for scan in drive.scans:
        if scan.part not in KNOWN:
            continue
        points = points_of(drive, scan, scan.laser)
        start = np.array([scan.laser.x_m, scan.laser.y_m])
        for part in np.arange(0.0, 1.0, 0.006):
            rows, columns = cells_of(start + part * (points - start), cut)
            grid[rows, columns] = np.maximum(grid[rows, columns], 0)
        grid[cells_of(points, cut)] = 100
    return grid


def seen_of(drive: Drive, grid: NDArray[np.int8], corner_m: float = CORNER_M) -> MapSeen:
    """What is measured of it."""
    plain = MapSeen(
        frame="odom",
        cell_m=CELL_M,
        width=CELLS,
        height=CELLS,
        cells=grid.size,
        x_m=corner_m,
        y_m=CORNER_M,
        yaw_rad=0.0,
        values=[-1, 0, 100],
    )
    found, shown = measured(drive, plain, grid.ravel())
    assert "#" in shown or not (grid == 100).any()
    return found


def test_a_right_map_is_right(drive: Drive) -> None:
    """All of each kind, nearly."""
    seen = seen_of(drive, drawn(drive))
    assert min(seen.walls, seen.true_walls, seen.free, seen.unknown) > 0.97
    assert seen.like == ""


@pytest.mark.parametrize("slip", ["rows_and_columns", "cut_towards_zero", "elsewhere"])
def test_each_slip_of_a_map_is_told(drive: Drive, slip: MapSlip) -> None:
    """Its walls are elsewhere, and the reason is named."""
    grid = drawn(drive, cut=slip == "cut_towards_zero")
    if slip == "rows_and_columns":
        grid = grid.T
    seen = seen_of(drive, grid, CORNER_M + (CELL_M if slip == "elsewhere" else 0.0))
    assert seen.walls < 0.9
    assert seen.like == slip


def test_an_empty_map_shows_nothing(drive: Drive) -> None:
    """Whatever all its cells say."""
    for value, part in ((0, "free"), (-1, "unknown")):
        seen = seen_of(drive, np.full((CELLS, CELLS), value, np.int8))
        assert seen.walls == 0.0
        assert getattr(seen, part) == 1.0


def test_a_small_map_is_judged_by_what_it_has(drive: Drive) -> None:
    """What lies outside of it is unknown."""
    grid = drawn(drive)[100:140, 100:140]
    plain = MapSeen(
        frame="odom",
        cell_m=CELL_M,
        width=40,
        height=40,
        cells=1600,
        x_m=-1.0,
        y_m=-1.0,
        yaw_rad=0.0,
        values=[-1, 0, 100],
    )
    seen, _ = measured(drive, plain, grid.ravel())
    assert seen.walls < 0.8
    assert seen.unknown == 1.0


def test_what_does_not_fit_is_not_looked_at(drive: Drive) -> None:
    """Cells that nobody can count are told by another check."""
    plain = MapSeen(
        frame="odom",
        cell_m=math.inf,
        width=2,
        height=2,
        cells=3,
        x_m=0.0,
        y_m=0.0,
        yaw_rad=0.0,
        values=[0],
    )
    assert measured(drive, plain, np.zeros(3, np.int8)) == (plain, "")


def test_the_kinds_of_cells_are_apart(drive: Drive) -> None:
    """And there are enough of each to judge by."""
    truth = truth_of(drive, CELL_M)
    assert not (truth.hit & truth.through).any()
    assert not (truth.hit & truth.never).any()
    assert not (truth.through & truth.never).any()
    assert truth.hit.sum() > 100
    assert truth.through.sum() > 500
