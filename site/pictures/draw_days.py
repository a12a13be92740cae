"""Draw the rover as it grows, a drawing a day: `python site/pictures/draw_days.py FOLDER`.

`days/DAY/pictures/rover.svg` shows what the day brings: on the left the rover with its parts so
far, on the right what the day's nodes do on it. Names are those of the cards of the day's labs.
"""

from __future__ import annotations

import math
import sys
from dataclasses import dataclass
from pathlib import Path

from rover import COLOURS, PARTS, ball, button, flag, floor, grown, laptop, placed, rover, waves
from sheet import AMBER, BLACK, GREEN, RED, Point, Sheet

MIDDLE = (190.0, 140.0)
HEIGHT = 280
LEFT = 392
"""Where the words begin."""


@dataclass(frozen=True)
class Row:
    """A node, or what is no node, and what it does."""

    name: str
    does: str
    is_node: bool = True


@dataclass(frozen=True)
class Shown:
    """What a day brings to the rover."""

    brings: str
    rows: tuple[Row, ...]


def _boxed(name: str, does: str) -> Row:
    return Row(name, does, is_node=False)


DAYS: dict[str, Shown] = {
    "01-install": Shown(
        "ROS on its computer",
        (
            Row("talker", "says a sentence, again and again"),
            Row("listener", "hears it, on this computer or another"),
        ),
    ),
    "02-nodes": Shown(
        "a voice", (Row("/minimal_publisher", "says how the rover is: /robot_status"),)
    ),
    "03-topics": Shown(
        "a sonar",
        (
            Row("/distance_sensor", "tells how far the next thing is"),
            Row("/distance_subscriber", "warns: says true on /obstacle"),
            Row("/talker", "says /chatter, and /listener hears it"),
        ),
    ),
    "04-services": Shown(
        "a limit for the motors",
        (
            Row("/motor_client", "asks for a limit: /set_max_speed"),
            Row("/motor_controller", "takes it, answers, and keeps to it"),
        ),
    ),
    "05-actions": Shown(
        "a pilot",
        (
            Row("/drive_client", "gives a goal, on /drive_to"),
            Row("/drive_server", "drives there, and tells how far it is"),
        ),
    ),
    "06-serial-bridge": Shown(
        "a cable to its motors",
        (
            Row("/serial_bridge", "hears /cmd_vel, and tells /odom"),
            _boxed("Arduino Mega", "turns the motors, counts the wheels"),
        ),
    ),
    "07-pi-camera": Shown(
        "eyes",
        (
            Row("/camera", "says /camera/image_raw"),
            Row("/ball_finder", "finds the ball in it, and says /ball"),
        ),
    ),
    "08-bring-up": Shown(
        "a start for two",
        (
            _boxed("ros2 launch", "starts all nodes of both rovers"),
            Row("/red/speed_limiter", "lets this rover drive 0.6 m/s"),
            Row("/blue/speed_limiter", "lets the other one drive 0.4 m/s"),
        ),
    ),
    "09-bags": Shown(
        "a black box",
        (
            _boxed("ros2 bag record", "keeps each message, and its time"),
            _boxed("black_box", "reads it, and tells what happened"),
        ),
    ),
    "10-qos": Shown(
        "a stop that reaches it",
        (
            Row("/e_stop_button", "says /e_stop, on the laptop"),
            Row("/guard", "lets /cmd_vel through, or stops"),
        ),
    ),
    "11-rooms": Shown(
        "a laser that sees all around",
        (
            Row("/wander", "hears /scan, and says /cmd_vel"),
            _boxed("a room", "nobody has seen it before"),
        ),
    ),
    "12-frames": Shown(
        "frames, and a map",
        (
            Row("/frames", "says /tf, and puts the walls into odom"),
            _boxed("/map", "where walls are, and where is none"),
        ),
    ),
}
"""In the order of the path."""


def drawing(day: str) -> Sheet:
    """Of one day."""
    number, shown = int(day[:2]), DAYS[day]
    rows = " ".join(f"{row.name}: {row.does}." for row in shown.rows)
    told = f"The rover from above, with all its parts so far. Day {number} brings {shown.brings}."
    sheet = Sheet(f"Day {number}: the rover gets {shown.brings}", f"{told} {rows}", HEIGHT)
    sheet.add(floor(14, 14, 352, HEIGHT - 28))
    sheet.add(*_around(number))
    sheet.add(placed(*MIDDLE, grown(number, COLOURS["red" if number == 8 else "rover"])))
    sheet.add(*_over(number))
    _mark(sheet, number)
    sheet.text((LEFT, 44), f"Day {number}", anchor="start", size=16, colour=GREEN, bold=True)
    sheet.text((LEFT + 76, 44), f"brings {shown.brings}", anchor="start", size=16)
    for place, row in enumerate(shown.rows):
        _row(sheet, 62 + 70 * place, row)
    return sheet


def _row(sheet: Sheet, top: float, row: Row) -> None:
    if row.is_node:
        wide = 9.2 * len(row.name) + 44
        sheet.node((LEFT + wide / 2, top + 18), row.name, wide)
    else:
        wide = 9.2 * len(row.name) + 24
        sheet.box((LEFT, top), (wide, 36), row.name, line=BLACK)
    sheet.text((LEFT + 6, top + 56), row.does, anchor="start", size=15, colour="#444")


def _around(day: int) -> list[str]:
    """What the day's part hears, sees or reaches."""
    x, y = MIDDLE
    return {
        2: [placed(x - 108, y - 76, waves(), turned=-135)],
        3: [placed(x + 96, y, f'<g transform="scale(2)">{waves()}</g>')],
        5: [
            f'<path d="M{x + 60:g} {y - 60:g}L330 54" fill="none" stroke="{COLOURS["says"]}"'
            ' stroke-width="4" stroke-dasharray="2 9" stroke-linecap="round"/>',
            placed(326, 70, flag()),
        ],
        7: [
            f'<path d="M{x + 66:g} {y:g}L366 {y - 74:g}V{y + 74:g}Z" fill="{AMBER}"'
            ' fill-opacity="0.18"/>',
            placed(328, y + 22, ball(16)),
        ],
        8: [placed(318, 230, rover(COLOURS["blue"], scale=1.5))],
        10: [
            placed(72, 226, f'<g transform="scale(0.7)">{laptop()}{button(17)}</g>'),
            f'<path d="M72 202C72 60 130 40 {x - 14:g} {y - 70:g}" fill="none" stroke="{AMBER}"'
            ' stroke-width="3" stroke-dasharray="6 6" marker-end="url(#a)"/>',
        ],
        11: [placed(x + 37, y, _beams(122))],
        12: [_axes((40, 240), 52, "odom")],
    }.get(day, [])


def _axes(middle: Point, length: float, name: str) -> str:
    """Of a frame: x to the right, y up, its name at the end of y."""
    (x, y), half = middle, length * 0.75
    ways = "".join(
        f'<path d="M{x:g} {y:g}{way}" stroke="{colour}" stroke-width="4" marker-end="url(#a)"/>'
        for way, colour in ((f"h{length:g}", RED), (f"v{-half:g}", GREEN))
    )
    return (
        f'{ways}<text x="{x + 12:g}" y="{y - half + 8:g}" font-size="16" fill="#111">{name}</text>'
    )


def _over(day: int) -> list[str]:
    """What lies over the rover."""
    x, y = MIDDLE
    return [_axes((x, y), 128, "base_link")] if day == 12 else []


def _beams(length: float) -> str:
    """Of a laser, one each 15 degrees."""
    ends = (
        (length * math.cos(angle), length * math.sin(angle))
        for angle in map(math.radians, range(0, 360, 15))
    )
    lines = "".join(f"M0 0L{x:.1f} {y:.1f}" for x, y in ends)
    return f'<path d="{lines}" stroke="{RED}" stroke-width="2" stroke-opacity="0.45"/>'


def _mark(sheet: Sheet, day: int) -> None:
    """A ring around the part of the day."""
    if day not in PARTS:
        return
    (dx, dy), (x, y) = PARTS[day][1], MIDDLE
    radius = {1: 44, 3: 24, 6: 36, 11: 20}.get(day, 28)
    sheet.add(
        f'<circle cx="{x + dx:g}" cy="{y + dy:g}" r="{radius}" fill="none" stroke="#e8793a"'
        ' stroke-width="4"/>'
    )


def main(folder: Path) -> None:
    """Write all of them: FOLDER/DAY/pictures/rover.svg."""
    for day in DAYS:
        file = folder / day / "pictures" / "rover.svg"
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(drawing(day).svg(), "utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
