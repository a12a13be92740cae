"""Prints figures of rooms from seeds; asserts nothing.

    .venv/bin/python tests/bench/rooms.py [ROUNDS]

Both scanners and both cameras take turns, ROUNDS times (50 without it); told is the middle one of
each, in seconds of the processor, and the ratio: that says more than times on a busy computer.
"""

from __future__ import annotations

import random
import sys
import time
from collections.abc import Callable
from statistics import median

from roslings_rover.camera import SyntheticCamera
from roslings_rover.camera.room_camera import RoomCamera
from roslings_rover.models.differential_drive import Motion, Pose
from roslings_rover.models.rooms import room_of
from roslings_rover.models.world import Box, World
from roslings_rover.rover.in_room import RoomRover
from roslings_rover.rover.quick_scanner import QuickScanner
from roslings_rover.rover.sensors import Scanner

BOXES, ROOMS, DRIVE_S, TICK_S, SCAN_EVERY = 30, 300, 60.0, 0.05, 4


def in_turns(rounds: int, *works: Callable[[], object]) -> list[float]:
    """The middle time of each, in milliseconds."""
    found: list[list[float]] = [[] for _ in works]
    for _ in range(rounds):
        for work, times in zip(works, found, strict=True):
            began_s = time.process_time()
            work()
            times.append((time.process_time() - began_s) * 1000)
    return [median(times) for times in found]


def boxes() -> World:
    """A square with so many of them."""
    chance = random.Random(1)
    corners = [(chance.uniform(-4.5, 4.0), chance.uniform(-4.5, 4.0)) for _ in range(BOXES)]
    shapes = tuple(Box(x, y, x + 0.4, y + 0.3) for x, y in corners)
    return World(Box(-5.0, -5.0, 5.0, 5.0), shapes)


def scans(rounds: int) -> None:
    """One turn of each scanner."""
    world, pose, chance = boxes(), Pose(0.1, 0.2, 0.3), random.Random(0)
    plain, quick = Scanner(), QuickScanner()
    old_ms, new_ms = in_turns(
        rounds,
        lambda: plain.read(world, pose, chance),
        lambda: quick.read(world, pose, chance),
    )
    print(
        f"a scan of {plain.rays} rays among {BOXES} boxes: one by one {old_ms:.2f} ms,"
        f" by arrays {new_ms:.2f} ms: {old_ms / new_ms:.0f} times as fast"
    )


def pictures(rounds: int) -> None:
    """One picture of each camera."""
    rover = RoomRover(room_of(2))
    usual, room = SyntheticCamera(rover.camera_model), RoomCamera(rover.camera_model)
    usual_ms, room_ms = in_turns(rounds, lambda: usual.look(rover), lambda: room.look(rover))
    print(f"a picture: one backdrop {usual_ms:.1f} ms, the room {room_ms:.1f} ms")


def rooms() -> None:
    """Rooms made, and one driven in."""
    began_s = time.process_time()
    for seed in range(ROOMS):
        room_of(seed)
    each_ms = (time.process_time() - began_s) * 1000 / ROOMS
    rover, began_s = RoomRover(room_of(2)), time.process_time()
    for number in range(round(DRIVE_S / TICK_S)):
        rover.drive(Motion(0.3, 0.5))
        rover.step(TICK_S)
        if number % SCAN_EVERY == 0:
            rover.scan()
    took_s = time.process_time() - began_s
    print(
        f"a room made: {each_ms:.2f} ms; {DRIVE_S:g} s in one, with scans at"
        f" {1 / TICK_S / SCAN_EVERY:g} Hz: {took_s:.2f} s"
    )


def main(rounds: int) -> None:
    """All figures."""
    scans(rounds)
    pictures(rounds)
    rooms()


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 50)
