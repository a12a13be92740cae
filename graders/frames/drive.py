"""A drive that is made before anybody hears of it: where the rover is when, and what it measures.

Nothing here starts anything. All is judged by stamps, so the drive may be told at any speed.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from graders.frames.record import Part
from roslings_rover.models.differential_drive import Motion, Pose, moved, wrapped
from roslings_rover.models.drives.chance import Chance
from roslings_rover.models.rooms import SEEDS, SeededRoom, room_of
from roslings_rover.models.shape_arrays import Rays, distances

Numbers = NDArray[np.floating[Any]]

ODOMETRY_EVERY_S = 0.05
SCAN_EVERY_S = 0.2
FREE_M = 0.35
"""So far from everything the middle of the rover stays: its laser may sit beside it."""

SILENT_S = 0.6
"""At the beginning and at the end, scans come and no odometry does."""

FASTEST_RAD_S = 2.0
RANGE_MIN_M, RANGE_MAX_M = 0.12, 4.0
NOISE_M = 0.005
BEAMS = 271
STEP_RAD = math.radians(1)
FIRST_BEAM_RAD = (-2.6, -2.0)
"""Nobody's beams begin straight ahead."""

NO_DISTANCES = (math.nan, math.inf, -math.inf, 0.0, 0.05, 4.3, 30.0, math.nan)
"""What a scan holds besides: nothing of it is a distance."""

OFF_STAMP_S = (0.02, 0.03)
"""A scan lies in the middle between two messages of odometry: neither of them is near enough."""

LATE_S = 0.07
"""Every other scan comes after the odometry of a later time."""


@dataclass(frozen=True)
class LaserMount:
    """Where a laser sits on its rover."""

    x_m: float = 0.0
    y_m: float = 0.0
    yaw_rad: float = 0.0

    def on(self, body: Pose) -> Pose:
        """Where it is in the room."""
        return Pose(*body.ahead(self.x_m, self.y_m), wrapped(body.heading_rad + self.yaw_rad))


@dataclass(frozen=True)
class Stretch:
    """A part of a drive with one motion."""

    motion: Motion
    seconds: float


@dataclass(frozen=True)
class Odometry:
    """Where the rover is at a time of the drive."""

    at_s: float
    body: Pose


@dataclass(frozen=True)
class Scan:
    """What the laser measures at a time of the drive."""

    at_s: float
    comes_s: float
    """When it is told."""
    laser: Pose
    """Where the laser really is."""
    turn_rad_s: float
    part: Part
    ranges: Numbers

    @property
    def is_distance(self) -> NDArray[np.bool_]:
        """Which of the ranges are distances; what is none compares with nothing."""
        with np.errstate(invalid="ignore"):
            return (self.ranges >= RANGE_MIN_M) & (self.ranges <= RANGE_MAX_M)


@dataclass(frozen=True)
class Drive:
    """All that a node is told, in the order in which it is told."""

    room: SeededRoom
    mount: LaserMount
    first_beam_rad: float
    way: tuple[Stretch, ...]
    scans: tuple[Scan, ...] = field(default=())

    @property
    def limits_m(self) -> tuple[float, float]:
        """The smallest and the largest distance of which a node can know the place.

        The laser says that these are its limits: who leaves out a limit itself misses a point.
        """
        known = [each for each in self.scans if each.part in ("standing", "moving")]
        found = np.concatenate([each.ranges[each.is_distance] for each in known])
        return float(found.min()), float(found.max())

    @property
    def ends_s(self) -> float:
        """When the last scan has come."""
        return sum(each.seconds for each in self.way)

    def body_at(self, at_s: float) -> Pose:
        """Where the rover is then; before the first and after the last moment it stands."""
        pose = Pose()
        for stretch in self.way:
            if at_s <= 0:
                break
            pose = moved(pose, stretch.motion, min(at_s, stretch.seconds))
            at_s -= stretch.seconds
        return pose

    def motion_at(self, at_s: float) -> Motion:
        """How it moves then."""
        for stretch in self.way:
            if at_s < stretch.seconds:
                return stretch.motion
            at_s -= stretch.seconds
        return Motion()

    @property
    def odometry(self) -> list[Odometry]:
        """20 times a second, but not at the beginning and not at the end."""
        first, last = round(SILENT_S / ODOMETRY_EVERY_S), round(self.ends_s / ODOMETRY_EVERY_S)
        count = range(first, last - first + 1)
        return [Odometry(n * ODOMETRY_EVERY_S, self.body_at(n * ODOMETRY_EVERY_S)) for n in count]

    @property
    def told(self) -> list[Odometry | Scan]:
        """One after the other."""
        return sorted([*self.odometry, *self.scans], key=_comes_s)

    @property
    def pauses_s(self) -> list[float]:
        """Before each of them."""
        comes_s = [_comes_s(each) for each in self.told]
        return [later - one for one, later in pairwise([0.0, *comes_s])]


def _comes_s(told: Odometry | Scan) -> float:
    return told.comes_s if isinstance(told, Scan) else told.at_s


def drive_in(seed: int, mount: LaserMount) -> Drive:
    """One that nobody knows, in a room where its way is free."""
    chance = Chance(f"frames 1: {seed}")
    while True:
        room = room_of(int(chance.between(0, 1) * (SEEDS - 1)))
        drive = Drive(room, mount, chance.between(*FIRST_BEAM_RAD), _way(chance))
        if _is_free(drive):
            return _with_scans(drive, chance)


def _way(chance: Chance) -> tuple[Stretch, ...]:
    """Stand, drive straight, on a curve, turn fast on the spot, turn back, stand.

    Each stretch is a whole number of odometry's periods long.
    """
    side = chance.pick((-1.0, 1.0))
    return (
        Stretch(Motion(), SILENT_S + 0.8),
        Stretch(Motion(0.3), 1.0),
        Stretch(Motion(0.25, side * 0.9), 1.0),
        Stretch(Motion(0.0, side * FASTEST_RAD_S), 1.6),
        Stretch(Motion(0.0, -side * 0.75 * FASTEST_RAD_S), 1.0),
        Stretch(Motion(), 0.8 + SILENT_S),
    )


def _is_free(drive: Drive) -> bool:
    world = drive.room.world
    places = (drive.body_at(n * SCAN_EVERY_S) for n in range(round(drive.ends_s / SCAN_EVERY_S)))
    return all(world.room_at(pose.x_m, pose.y_m) >= FREE_M for pose in places)


def _with_scans(drive: Drive, chance: Chance) -> Drive:
    return Drive(
        drive.room, drive.mount, drive.first_beam_rad, drive.way, tuple(_scans(drive, chance))
    )


def _scans(drive: Drive, chance: Chance) -> Iterator[Scan]:
    for number in range(round(drive.ends_s / SCAN_EVERY_S)):
        at_s = number * SCAN_EVERY_S + chance.between(*OFF_STAMP_S)
        laser, motion = drive.mount.on(drive.body_at(at_s)), drive.motion_at(at_s)
        yield Scan(
            at_s=at_s,
            comes_s=at_s + (LATE_S if number % 2 else 0.0),
            laser=laser,
            turn_rad_s=motion.turn_rad_s,
            part=_part(drive, at_s, motion),
            ranges=_ranges(drive, laser, chance),
        )


def _part(drive: Drive, at_s: float, motion: Motion) -> Part:
    told = drive.odometry
    if at_s < told[0].at_s:
        return "before"
    if at_s > told[-1].at_s:
        return "after"
    return "moving" if motion != Motion() else "standing"


def beams_rad(drive: Drive) -> Numbers:
    """The angle of each beam, as the laser has it."""
    return drive.first_beam_rad + np.arange(BEAMS) * STEP_RAD


def _ranges(drive: Drive, laser: Pose, chance: Chance) -> Numbers:
    """As a message holds them, in 32 bits."""
    rays = Rays.towards(laser.x_m, laser.y_m, laser.heading_rad + beams_rad(drive))
    noise = np.array([sum(chance.between(-1, 1) for _ in range(4)) for _ in range(BEAMS)])
    ranges = distances(drive.room.world, rays) + noise * NOISE_M * math.sqrt(3) / 2
    ranges[ranges > RANGE_MAX_M] = math.inf
    for number, none in zip(_spoilt(chance), NO_DISTANCES, strict=True):
        ranges[number] = none
    return ranges.astype(np.float32).astype(float)


def _spoilt(chance: Chance) -> Sequence[int]:
    return chance.shuffled(range(BEAMS))[: len(NO_DISTANCES)]
