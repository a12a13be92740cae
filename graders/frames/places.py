"""Where points on walls lie, and which mistake puts them there."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from graders.frames.drive import Drive, LaserMount, Numbers, Scan, beams_rad
from graders.frames.record import WayWrong
from roslings_rover.models.differential_drive import Pose
from roslings_rover.models.shape_arrays import gaps

LOOKED_AT = 40
"""Points of a message, when a mistake is looked for."""

EXPLAINS_M = 0.02
"""So near lie the points that a mistake predicts."""

OTHER_TIMES_S = [n * 0.01 for n in range(-45, 46) if n]


def points_of(
    drive: Drive, scan: Scan, laser: Pose, first_beam_rad: float | None = None
) -> Numbers:
    """The points of a scan, x and y, for a laser at this place; one row each."""
    angles = beams_rad(drive)
    if first_beam_rad is not None:
        angles = angles + (first_beam_rad - drive.first_beam_rad)
    ranges, angles = scan.ranges[scan.is_distance], angles[scan.is_distance] + laser.heading_rad
    return np.column_stack(
        (laser.x_m + ranges * np.cos(angles), laser.y_m + ranges * np.sin(angles))
    )


def off_the_walls_m(drive: Drive, points: Numbers) -> float:
    """How far they are from what is nearest, in the mean."""
    x_m, y_m = points[:, 0], points[:, 1]
    room = drive.room.world.room
    to_room = np.minimum.reduce(
        [x_m - room.west_m, room.east_m - x_m, y_m - room.south_m, room.north_m - y_m]
    )
    nearest = np.minimum(np.abs(to_room), np.abs(gaps(drive.room.world.shapes, x_m, y_m)))
    return float(nearest.mean())


def mistake_in(drive: Drive, scan: Scan, points: Numbers) -> WayWrong:
    """The mistake that explains where these points of the scan lie; empty where none does."""
    some = points[:: max(1, len(points) // LOOKED_AT)]
    right_m = _apart_m(some, points_of(drive, scan, scan.laser))
    best: tuple[float, WayWrong] = (min(EXPLAINS_M, right_m / 2), "")
    for way, predicted in _ways(drive, scan):
        best = min(best, (_apart_m(some, predicted), way))
    return best[1]


def _apart_m(points: Numbers, predicted: Numbers) -> float:
    """How far each is from the nearest predicted one, in the mean."""
    apart = points[:, None, :] - predicted[None, :, :]
    return float(np.hypot(apart[..., 0], apart[..., 1]).min(axis=1).mean())


def _ways(drive: Drive, scan: Scan) -> Iterator[tuple[WayWrong, Numbers]]:
    body = drive.body_at(scan.at_s)
    yield "beam_angles", points_of(drive, scan, scan.laser, first_beam_rad=0.0)
    yield "mount", points_of(drive, scan, body)
    for guess in (
        LaserMount(drive.mount.x_m, drive.mount.y_m),
        LaserMount(yaw_rad=drive.mount.yaw_rad),
    ):
        yield "mount", points_of(drive, scan, guess.on(body))
    unturned = Pose(scan.laser.x_m, scan.laser.y_m)
    yield "heading", points_of(drive, scan, unturned)
    yield "heading", points_of(drive, scan, drive.mount.on(Pose(body.x_m, body.y_m)))
    yield "laser_frame", points_of(drive, scan, Pose())
    yield "inverse", points_of(drive, scan, _inverse(scan.laser))
    for off_s in OTHER_TIMES_S:
        other = drive.mount.on(drive.body_at(scan.at_s + off_s))
        yield "other_time", points_of(drive, scan, other)


def _inverse(pose: Pose) -> Pose:
    """Where the room's origin is for who stands there."""
    x_m, y_m = pose.seen_from_here(0.0, 0.0)
    return Pose(x_m, y_m, -pose.heading_rad)
