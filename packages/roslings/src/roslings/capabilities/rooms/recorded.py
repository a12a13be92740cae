"""A drive as evidence has it: what was near at each tick is reckoned from where the rover was."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from roslings.capabilities.rooms.record import (
    DriveClock,
    FloorSeen,
    RoomBump,
    RoomDriveSeen,
    RoomSleeper,
    RoomTick,
)
from roslings.capabilities.rooms.seeds import RoomToDrive
from roslings.lockstep import DriveTick, LockstepDrive
from roslings.lockstep.record import SleeperSeen
from roslings_rover.models.differential_drive import Body, Pose
from roslings_rover.models.rooms import SeededRoom, room_of
from roslings_rover.models.shape_arrays import Rays, apart_by_kind, distances
from roslings_rover.models.world import Circle

DECIMALS = 3
FIRST_RAY_RAD, LAST_RAY_RAD, RAYS = math.radians(30), math.radians(150), 41
"""What is on a side lies between these angles from ahead: a wall beside the rover, and its ends."""
BODY = Body()
ANGLES = np.linspace(FIRST_RAY_RAD, LAST_RAY_RAD, RAYS)
BOTH_SIDES = np.concatenate([ANGLES, -ANGLES])


def floor_of(seed: int) -> FloorSeen:
    """What stands in a room."""
    world = room_of(seed).world
    boxes, circles = apart_by_kind(world.obstacles)
    inside = world.room
    return FloorSeen(
        seed=seed,
        inside=(inside.west_m, inside.south_m, inside.east_m, inside.north_m),
        boxes=[(b.west_m, b.south_m, b.east_m, b.north_m) for b in boxes],
        circles=[(c.x_m, c.y_m, c.radius_m) for c in circles],
    )


def recorded(
    to_drive: RoomToDrive,
    drive: LockstepDrive,
    clock: DriveClock,
    sleepers: Sequence[SleeperSeen] = (),
) -> RoomDriveSeen:
    """The drive; `sleepers` were seen in lockstep, where it was not believed."""
    room = room_of(to_drive.seed)
    return RoomDriveSeen(
        seed=to_drive.seed,
        kind=room.kind,
        chosen=to_drive.chosen,
        side=to_drive.side,
        clock=clock,
        sleepers=[RoomSleeper(thread=each.thread, ticks=each.ticks) for each in sleepers],
        period_s=drive.period_s,
        ticks=[_tick(room, each) for each in drive.ticks],
        bumps=[
            RoomBump(
                time_s=_rounded(each.time_s),
                x_m=_rounded(each.x_m),
                y_m=_rounded(each.y_m),
                moving=each.moving,
            )
            for each in drive.bumps
        ],
        refused_commands=drive.refused_commands,
        stray=drive.stray,
        late_ticks=sum(each.late for each in drive.ticks),
        stall_s=_rounded(drive.stall_s),
    )


def _tick(room: SeededRoom, tick: DriveTick) -> RoomTick:
    pose = Pose(tick.x_m, tick.y_m, tick.heading_rad)
    moving = _moving(room, tick)
    left_m, right_m = _beside(room, pose)
    command = tick.command
    gaps_m = [each.gap(pose.x_m, pose.y_m) - BODY.radius_m for each in moving]
    standing_m = room.world.room_at(pose.x_m, pose.y_m) - BODY.radius_m
    nearest = min(zip(gaps_m, moving, strict=True), key=lambda each: each[0], default=None)
    ahead = pose.seen_from_here(nearest[1].x_m, nearest[1].y_m) if nearest else None
    return RoomTick(
        x_m=_rounded(pose.x_m),
        y_m=_rounded(pose.y_m),
        heading_rad=_rounded(pose.heading_rad),
        forward_m_s=_rounded(command.forward_m_s) if command else None,
        turn_rad_s=_rounded(command.turn_rad_s) if command else None,
        left_m=_rounded(left_m),
        right_m=_rounded(right_m),
        nearest_m=_rounded(min([standing_m, *gaps_m])),
        moving_m=_rounded(nearest[0]) if nearest else None,
        moving_ahead_m=_rounded(ahead[0]) if ahead else None,
        moving_left_m=_rounded(ahead[1]) if ahead else None,
    )


def _moving(room: SeededRoom, tick: DriveTick) -> Sequence[Circle]:
    return [
        Circle(*place, track.radius_m)
        for place, track in zip(tick.moving, room.tracks, strict=True)
    ]


def _beside(room: SeededRoom, pose: Pose) -> tuple[float, float]:
    """From the laser to the nearest thing that stands, on the left and on the right."""
    rays = Rays.towards(pose.x_m, pose.y_m, pose.heading_rad + BOTH_SIDES)
    far = distances(room.world, rays)
    return float(far[:RAYS].min()), float(far[RAYS:].min())


def _rounded(value: float) -> float:
    """To the millimetre; no negative zero."""
    return round(value, DECIMALS) + 0.0
