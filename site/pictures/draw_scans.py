"""Draw how a rover sees and steers by its laser: `python site/pictures/draw_scans.py FOLDER`.

`days/11-rooms/pictures/` shows them. Curves and ways are those of the rover itself, which drives
here as the lesson's nodes let it drive, in the same rooms.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path

import draw_rooms
from rover import DARK, FLOOR, GREY, TEAL, placed, rover
from sheet import AMBER, BLACK, BLUE, GREEN, RED, Point, Sheet

from roslings_rover.models.differential_drive import Motion, Pose
from roslings_rover.models.rooms import room_of
from roslings_rover.rover.in_room import RoomRover
from roslings_rover.rover.quick_scanner import QuickScanner

SCAN_S, STEPS = 0.2, 10
"""From scan to scan, and the steps of the rover between them."""
WALL_AT_M, SPEED_M_S = 0.4, 0.3
GAINS = {"too small: 0.5": (0.5, AMBER), "right: 2": (2.0, GREEN), "too large: 12": (12.0, RED)}
WALL_GAIN, DAMPING = 2.0, 4.0
ROOMS = (1, 5, 7, 13, 16, 17, 35, 76, 125, 134)
"""All in which the lesson drives are among them."""
REACH = 180.0
"""Pixels of the beams of a cone."""


@dataclass(frozen=True)
class Moment:
    """What the rover was told after a scan, and where it was."""

    error: float
    pose: Pose


Decide = Callable[[list[float], list[float]], tuple[float, Motion]]
"""From a scan, and the errors so far, to the error and the command."""


def drive(room: int, decide: Decide, scans: int) -> list[Moment]:
    """Each scan's moment, of a rover whose laser has no noise."""
    driven = RoomRover(room_of(room))
    driven.scanner = QuickScanner(noise_m=0.0)
    moments: list[Moment] = []
    for _ in range(scans):
        error, motion = decide(driven.scan(), [each.error for each in moments])
        moments.append(Moment(error, driven.pose))
        driven.drive(motion)
        for _ in range(STEPS):
            driven.step(SCAN_S / STEPS)
    return moments


def facing(gain: float) -> Decide:
    """Turn to what is nearest; the error is in degrees."""

    def decide(scan: list[float], _: list[float]) -> tuple[float, Motion]:
        degrees = min(range(-179, 181), key=lambda each: scan[each])
        return degrees, Motion(0.0, gain * math.radians(degrees))

    return decide


def along_the_wall(damping: float) -> Decide:
    """Keep a wall on the left where it should be; the error is in metres."""

    def decide(scan: list[float], before: list[float]) -> tuple[float, Motion]:
        error = min(scan[60:121]) - WALL_AT_M
        change = (error - before[-1]) / SCAN_S if before else 0.0
        return error, Motion(SPEED_M_S, WALL_GAIN * error + damping * change)

    return decide


# --- one scan, and a cone ------------------------------------------------------------------------


def scan() -> Sheet:
    """Four beams of 360, with index and direction."""
    sheet = Sheet(
        "One scan: which beam points where",
        "The rover from above, its nose to the right, with four beams of 360. Index 0 is ahead, at"
        " 0 degrees. Index 90 is left, at 90 degrees. Index 180 is behind. Index 270 is right, at"
        " minus 90 degrees. Left is positive.",
        330,
    )
    middle: Point = (360.0, 165.0)
    sheet.add(placed(*middle, _fan(range(0, 360, 10), 108, GREY)))
    for degrees, colour in ((0, RED), (90, GREEN), (180, BLACK), (270, BLUE)):
        x, y = _end(degrees, 120)
        sheet.arrow(middle, (middle[0] + x, middle[1] + y), colour=colour)
    sheet.add(placed(*middle, rover(scale=1.6)))
    sheet.text((492, 160), "index 0: ahead, 0 degrees", anchor="start", colour=RED)
    sheet.text((360, 34), "index 90: left, 90 degrees", colour=GREEN)
    sheet.text((228, 160), "index 180: behind", anchor="end", colour=BLACK)
    sheet.text((360, 308), "index 270: right, -90 degrees (minus 90)", colour=BLUE)
    turn = 'd="M440 80A118 118 0 0 0 398 52" fill="none" marker-end="url(#a)"'
    sheet.add(f'<path {turn} stroke="{BLACK}" stroke-width="2.5"/>')
    sheet.text((452, 76), "left is positive", anchor="start")
    return sheet


def cone() -> Sheet:
    """A beam that goes past, and a cone that does not."""
    sheet = Sheet(
        "A single beam, and a cone",
        "The rover from above, twice. Above, a single beam goes past a box, and the rover would hit"
        " it. Below, a cone of 40 degrees hits the box.",
        330,
    )
    for top, wide in ((14.0, False), (170.0, True)):
        _beam_and_box(sheet, top, wide)
    return sheet


def _beam_and_box(sheet: Sheet, top: float, wide: bool) -> None:
    x, y = 110.0, top + 73
    sheet.add(
        f'<rect x="14" y="{top:g}" width="692" height="146" rx="10" fill="{FLOOR}"'
        f' stroke="{TEAL}" stroke-width="2"/>'
    )
    if wide:
        (x1, y1), (x2, y2) = _end(20, REACH), _end(-20, REACH)
        sheet.add(
            f'<path d="M{x:g} {y:g}L{x + x1:.1f} {y + y1:.1f}L{x + x2:.1f} {y + y2:.1f}Z"'
            f' fill="{RED}" fill-opacity="0.2"/>'
        )
        for degrees in range(-20, 21, 5):
            dx, dy = _end(degrees, REACH)
            sheet.wire((x, y), (x + dx, y + dy), colour=RED)
    else:
        sheet.arrow((x, y), (680.0, y), colour=RED)
        for side in (-32, 32):
            line = f'd="M{x:g} {y + side:g}H400" stroke="{DARK}" stroke-dasharray="4 6"'
            sheet.add(f'<path {line} stroke-width="2"/>')
    sheet.add(f'<rect x="250" y="{y - 58:g}" width="90" height="44" rx="4" fill="{DARK}"/>')
    sheet.add(placed(x, y, rover(scale=2.0)))
    told = "a cone of 40 degrees hits the box" if wide else "a single beam goes past the box"
    sheet.text((420, y - 34), told, anchor="start")


# --- curves --------------------------------------------------------------------------------------


def gains() -> Sheet:
    """The error after each scan, with three gains."""
    sheet = Sheet(
        "A gain too small, right, too large",
        "Three curves of the error over 3 seconds, from -90 degrees on. With a gain too small, 0.5,"
        " it falls slowly. With the right one, 2, it is at zero after one second. With one too"
        " large, 12, it swings around zero.",
        300,
    )
    left, zero, px_per_s, px_per_degree = 80.0, 190.0, 170.0, 1.5
    sheet.arrow((left, 30.0), (left, 28.0))
    sheet.wire((left, 28.0), (left, 270.0))
    sheet.arrow((left, zero), (left + 3.15 * px_per_s, zero))
    for seconds in (1, 2, 3):
        sheet.text((left + seconds * px_per_s, zero + 22), f"{seconds} s")
    sheet.text((left - 10, zero + 6), "0", anchor="end")
    sheet.text((left - 10, zero - 90 * px_per_degree + 6), "-90", anchor="end")
    sheet.text((left + 12, 28), "error in degrees", anchor="start")
    for row, (name, (gain, colour)) in enumerate(GAINS.items()):
        errors = [each.error for each in drive(16, facing(gain), 16)]
        at = [
            (left + number * SCAN_S * px_per_s, zero + error * px_per_degree)
            for number, error in enumerate(errors)
        ]
        _curve(sheet, at, colour)
        sheet.text((490, 46 + 24 * row), f"gain {name}", anchor="start", colour=colour)
    return sheet


def wall() -> Sheet:
    """The ways of two rovers along a wall."""
    sheet = Sheet(
        "Along a wall: with the error alone, and with its change",
        "The way of two rovers along a wall, from above. Both begin 0.6 m from it. With the error"
        " alone, the way swings: far too near, then too far. With error and change, it goes to"
        " 0.4 m and stays there.",
        330,
    )
    left, top, px_per_m = 60.0, 46.0, 260.0
    wall_m = room_wall_m()
    size = f'width="680" height="{top - 20:g}"'
    sheet.add(f'<rect x="20" y="20" {size} fill="{GREY}" stroke="{DARK}"/>')
    sheet.text((360, 39), "the wall, on the left of the rover")
    goal = top + WALL_AT_M * px_per_m
    line = f'd="M20 {goal:g}H700" stroke="{BLACK}" stroke-width="2" stroke-dasharray="3 7"'
    sheet.add(f"<path {line}/>")
    sheet.text((700, goal + 22), "0.4 m", anchor="end")
    for damping, colour in ((0.0, RED), (DAMPING, GREEN)):
        ways = [each.pose for each in drive(134, along_the_wall(damping), 40)]
        at = [(left + p.x_m * px_per_m, top + (wall_m - p.y_m) * px_per_m) for p in ways]
        _curve(sheet, at, colour)
    sheet.add(placed(left, top + wall_m * px_per_m, rover()))
    sheet.text((60, 306), "error alone: it swings", anchor="start", colour=RED)
    told = "error and change: it goes to 0.4 m, and stays"
    sheet.text((330, 306), told, anchor="start", colour=GREEN)
    return sheet


def room_wall_m() -> float:
    """How far the wall is from the start."""
    driven = RoomRover(room_of(134))
    driven.scanner = QuickScanner(noise_m=0.0)
    return driven.scan()[90]


def _curve(sheet: Sheet, at: list[Point], colour: str) -> None:
    sheet.wire(*((round(x, 1), round(y, 1)) for x, y in at), colour=colour)


# --- how late a stop is --------------------------------------------------------------------------


def stop() -> Sheet:
    """Where the rover is at each scan."""
    sheet = Sheet(
        "Between two scans the rover goes on",
        "A rover drives at 0.5 m/s, and a scan comes each 0.2 s: three scans are drawn. Between two"
        " scans it goes 0.1 m. One that comes late costs 0.1 m more.",
        250,
    )
    y, first, between = 130.0, 84.0, 226.0
    sheet.add(f'<rect x="664" y="20" width="40" height="210" fill="{GREY}" stroke="{DARK}"/>')
    sheet.text((654, 40), "a wall", anchor="end")
    told = (
        ("scan 1: free", BLACK),
        ("scan 2: too near, stop", RED),
        ("scan 3: it stands only here,", AMBER),
    )
    for number, (text, colour) in enumerate(told):
        x = first + number * between
        sheet.add(placed(x, y, rover(TEAL if number < 2 else "#b3382c", scale=1.4)))
        sheet.text((x, y - (68 if number == 2 else 46)), text, colour=colour)
    sheet.text((first + 2 * between, y - 46), "where scan 2 was late", colour=AMBER)
    for (a, b), label in zip(
        pairwise(first + n * between for n in range(3)), ("0.2 s: 0.1 m", "0.1 m more"), strict=True
    ):
        sheet.arrow((a, y + 56), (b, y + 56))
        sheet.text(((a + b) / 2, y + 80), label)
    sheet.text((first - 40, 232), "at 0.5 m/s", anchor="start")
    return sheet


def _end(degrees: float, length: float) -> Point:
    """Of a beam from 0, in pixels; y goes down."""
    angle = math.radians(degrees)
    return length * math.cos(angle), -length * math.sin(angle)


def _fan(degrees: range, length: float, colour: str) -> str:
    lines = "".join(f"M0 0L{x:.1f} {y:.1f}" for x, y in (_end(each, length) for each in degrees))
    return f'<path d="{lines}" stroke="{colour}" stroke-width="2"/>'


def drawings() -> Iterator[tuple[str, Sheet]]:
    """Each with the name of its file."""
    for drawn in (scan, cone, gains, wall, stop):
        yield drawn.__name__, drawn()
    yield "rooms", draw_rooms.sheet(ROOMS)


def main(folder: Path) -> None:
    """Write all of them."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, sheet in drawings():
        (folder / f"{name}.svg").write_text(sheet.svg(), "utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
