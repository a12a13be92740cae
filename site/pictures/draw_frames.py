"""Draw frames, their times, and the squares of a map: `python site/pictures/draw_frames.py FOLDER`.

`days/12-frames/pictures/` shows them.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator
from pathlib import Path

from rover import DARK, GREY, placed, rover
from sheet import AMBER, BLACK, BLUE, GREEN, RED, Point, Sheet

# --- one nail ------------------------------------------------------------------------------------

ORIGIN: Point = (96.0, 322.0)
PX_PER_M = 64.0
ROVER_AT_M, NAIL_AT_M = (1, 2), (1, 4)


def at(x_m: float, y_m: float) -> Point:
    """A place in the room, in pixels; the room's y goes up."""
    return ORIGIN[0] + x_m * PX_PER_M, ORIGIN[1] - y_m * PX_PER_M


def nail() -> Sheet:
    """One nail in a wall, and two pairs of numbers for it."""
    sheet = Sheet(
        "One nail, two pairs of numbers",
        "A room from above. Its axis x goes to the right, and y goes up. The rover stands at x 1,"
        " y 2, and is turned by 90 degrees to the left: its own x goes up, and its y to the left. A"
        " nail in the wall is 2 m ahead of it. For the rover, the nail is at x 2, y 0. In the room"
        " it is at x 1, y 4.",
        350,
    )
    (left, wall), (x, y) = at(-1, NAIL_AT_M[1]), at(*ROVER_AT_M)
    sheet.add(
        f'<rect x="{left:g}" y="{wall - 30:g}" width="384" height="30" fill="{GREY}"'
        f' stroke="{DARK}"/>'
    )
    sheet.text((330, wall - 9), "the wall")
    _grid_of_metres(sheet)
    _axes(sheet, ORIGIN, (at(4.5, 0), at(0, 3.8)), BLUE)
    sheet.add(placed(x, y, rover(scale=1.3), turned=-90))
    _axes(sheet, (x, y), ((x, y - 84), (x - 46, y)), RED)
    sheet.add(f'<path d="M{x:g} {y - 90:g}V{wall + 8:g}" {DASHED} stroke="{RED}"/>')
    sheet.dot(at(*NAIL_AT_M), BLACK)
    sheet.text((x + 12, wall + 24), "the nail", anchor="start")
    _told(sheet, 74, RED, ("for the rover:", "x 2, y 0"))
    _told(sheet, 164, BLUE, ("in the room:", "x 1, y 4"))
    sheet.text((452, 262), "the rover stands at x 1, y 2,", anchor="start")
    sheet.text((452, 286), "turned by 90 degrees", anchor="start")
    return sheet


DASHED = 'stroke-width="2.5" stroke-dasharray="3 6" fill="none"'


def _grid_of_metres(sheet: Sheet) -> None:
    lines = "".join(
        [f"M{at(x, 0)[0]:g} {at(x, 0)[1]:g}V{at(x, 4)[1]:g}" for x in range(1, 5)]
        + [f"M{at(0, y)[0]:g} {at(0, y)[1]:g}H{at(4.5, y)[0]:g}" for y in range(1, 4)]
    )
    sheet.add(f'<path d="{lines}" stroke="{GREY}" stroke-width="1"/>')
    for number in range(1, 5):
        sheet.text((at(number, 0)[0], ORIGIN[1] + 20), f"{number}", colour=BLUE)
    for number in range(1, 4):
        sheet.text((ORIGIN[0] - 14, at(0, number)[1] + 6), f"{number}", colour=BLUE)


def _axes(sheet: Sheet, middle: Point, ends: tuple[Point, Point], colour: str) -> None:
    """Arrows along x and y, with their names at the ends."""
    for end, name in zip(ends, "xy", strict=True):
        sheet.arrow(middle, end, colour=colour)
        to_the_side = end[0] - middle[0], end[1] - middle[1]
        shift = (0, -8) if to_the_side[0] else (-14, 8)
        sheet.text((end[0] + shift[0], end[1] + shift[1]), name, colour=colour, bold=True)


def _told(sheet: Sheet, top: float, colour: str, lines: tuple[str, str]) -> None:
    sheet.box((436, top), (250, 70), line=colour)
    sheet.text((452, top + 28), lines[0], anchor="start")
    sheet.text((452, top + 54), lines[1], anchor="start", bold=True, size=20, colour=colour)


# --- the tree ------------------------------------------------------------------------------------


def tree() -> Sheet:
    """The frames of a robot, each with its parent."""
    sheet = Sheet(
        "The tree of frames",
        "A tree. map is at the top. The parent of odom is map, the parent of base_link is odom."
        " Both move, on /tf. base_link is the parent of laser and camera_optical, which never move:"
        " they are on /tf_static. An arrow goes from each child to its parent.",
        344,
    )
    wide, high = 150.0, 44.0
    middles: dict[str, Point] = {
        "map": (220, 42),
        "odom": (220, 130),
        "base_link": (220, 218),
        "laser": (110, 306),
        "camera_optical": (330, 306),
    }
    for name, (x, y) in middles.items():
        line = GREEN if name in ("laser", "camera_optical") else BLUE
        sheet.box((x - wide / 2, y - high / 2), (wide, high), name, line=line)
    for child, parent in (
        ("odom", "map"),
        ("base_link", "odom"),
        ("laser", "base_link"),
        ("camera_optical", "base_link"),
    ):
        (x1, y1), (x2, y2) = middles[child], middles[parent]
        end = x2 + (x1 - x2) * 0.4
        sheet.arrow((x1, y1 - high / 2), (end, y2 + high / 2 + 2))
    told = (
        (92, "moves: a program that knows the room", BLUE),
        (180, "moves: the odometry", BLUE),
        (268, "never moves: /tf_static", GREEN),
    )
    for y, text, colour in told:
        sheet.text((408, y), text, anchor="start", colour=colour)
    sheet.text((408, 204), "both of them on /tf", anchor="start", colour=BLUE)
    sheet.text((408, 40), "the arrow: from a child to its parent", anchor="start")
    return sheet


# --- the two topics ------------------------------------------------------------------------------


def topics() -> Sheet:
    """What is kept for who comes late, and what is not."""
    sheet = Sheet(
        "What never moves, and what does",
        "Two topics over time, and a listener who comes late. On /tf_static one message was told"
        " once, is kept, and the listener gets it. On /tf a message comes 20 times a second."
        " Nothing is kept, and the listener gets the next one.",
        264,
    )
    late = 470.0
    sheet.add(f'<path d="M{late:g} 46V236" {DASHED} stroke="{RED}"/>')
    sheet.text((late, 32), "somebody comes late", colour=RED)
    for y, name, told in (
        (84, "/tf_static", "told once, and kept"),
        (178, "/tf", "20 times a second, and not kept"),
    ):
        sheet.text((24, y + 6), name, anchor="start", bold=True)
        sheet.arrow((122, y), (696, y))
        sheet.text((142, y + 40), told, anchor="start")
    sheet.dot((150, 84), GREEN)
    sheet.add(f'<path d="M150 76C190 50 400 50 {late - 6:g} 74" {DASHED} stroke="{GREEN}"/>')
    sheet.text((late + 14, 124), "gets it", anchor="start", colour=GREEN)
    for number in range(18):
        sheet.dot((150 + 30 * number, 178), AMBER if 150 + 30 * number < late else GREEN)
    sheet.text((late + 14, 218), "gets the next one", anchor="start", colour=GREEN)
    return sheet


# --- time ----------------------------------------------------------------------------------------


def time() -> Sheet:
    """A scan between two steps, and what is not known yet."""
    sheet = Sheet(
        "A scan between two steps",
        "A line of time. Steps of /tf come each 0.05 s. A scan was measured between two of them:"
        " interpolation. After the newest step, nothing is known yet, and there tf refuses:"
        " extrapolation. Now lies there, too.",
        270,
    )
    y, first, between, count = 140.0, 70.0, 80.0, 6
    newest = first + between * (count - 1)
    sheet.add(f'<rect x="{newest:g}" y="62" width="{694 - newest:g}" height="150" fill="#ffebe9"/>')
    sheet.arrow((30, y), (700, y))
    sheet.text((696, y + 24), "time", anchor="end")
    for number in range(count):
        sheet.dot((first + between * number, y), BLUE)
    sheet.text((first, y - 20), "steps of /tf, each 0.05 s", anchor="start", colour=BLUE)
    sheet.arrow((newest, 82), (newest, y - 10), colour=BLUE)
    sheet.text((newest - 8, 78), "the newest step", anchor="end", colour=BLUE)
    scan = first + between * 2.4
    sheet.arrow((scan, y + 66), (scan, y + 8), colour=GREEN)
    sheet.text((scan, y + 88), "the scan was measured here:", colour=GREEN)
    sheet.text((scan, y + 110), "interpolation", colour=GREEN, bold=True)
    sheet.text(((newest + 694) / 2, 52), "not known yet:", colour=RED)
    sheet.text(((newest + 694) / 2, 84), "extrapolation", colour=RED, bold=True)
    now = newest + 110
    sheet.arrow((now, y + 66), (now, y + 8), colour=RED)
    sheet.text((now, y + 88), "now", colour=RED)
    return sheet


# --- squares -------------------------------------------------------------------------------------

COLUMNS, ROWS, SQUARE_PX = 4, 3, 84.0
CORNER: Point = (96.0, 298.0)
OCCUPIED, UNKNOWN = (6,), (7, 10, 11)


def grid() -> Sheet:
    """A map of twelve squares, with their places in the list."""
    sheet = Sheet(
        "Row and column",
        "A grid of 3 rows with 4 squares each. Row 0 is at the bottom, column 0 at the left. In"
        " each square stands its index, from 0 to 11. Index 6 is in row 1, column 2: a wall, with"
        " the value 100. Three squares behind it are unknown, with -1 (minus 1). All others are"
        " free, with 0. The origin is the lower left corner of square 0.",
        344,
    )
    for index in range(COLUMNS * ROWS):
        _square(sheet, index)
    for column in range(COLUMNS):
        x = CORNER[0] + (column + 0.5) * SQUARE_PX
        sheet.text((x, CORNER[1] + 24), f"column {column}", colour=BLUE)
    for row in range(ROWS):
        y = CORNER[1] - (row + 0.5) * SQUARE_PX
        sheet.text((CORNER[0] - 10, y + 6), f"row {row}", anchor="end", colour=BLUE)
    sheet.dot(CORNER, RED)
    sheet.text((CORNER[0] - 12, CORNER[1] + 24), "origin", anchor="end", colour=RED)
    _legend(sheet)
    return sheet


LOOKS = {"100": ("#57606a", "#ffffff"), "0": ("#ffffff", "#111"), "-1": (GREY, "#111")}
"""Value of a square to its colour, and that of its number."""


def _value(index: int) -> str:
    return "100" if index in OCCUPIED else "-1" if index in UNKNOWN else "0"


def _square(sheet: Sheet, index: int) -> None:
    row, column = divmod(index, COLUMNS)
    x, y = CORNER[0] + column * SQUARE_PX, CORNER[1] - (row + 1) * SQUARE_PX
    inside, ink = LOOKS[_value(index)]
    sheet.add(
        f'<rect x="{x:g}" y="{y:g}" width="{SQUARE_PX:g}" height="{SQUARE_PX:g}" fill="{inside}"'
        f' stroke="{DARK}" stroke-width="2"/>'
    )
    sheet.text((x + SQUARE_PX / 2, y + SQUARE_PX / 2 + 7), f"{index}", size=20, colour=ink)


def _legend(sheet: Sheet) -> None:
    words = {"100": "a wall", "0": "free", "-1": "unknown"}
    for number, (value, (inside, _)) in enumerate(LOOKS.items()):
        y = 62.0 + 46 * number
        sheet.add(
            f'<rect x="466" y="{y - 22:g}" width="32" height="32" fill="{inside}" stroke="{DARK}"'
            ' stroke-width="2"/>'
        )
        sheet.text((512, y), f"{value}: {words[value]}", anchor="start")
    sheet.text((466, 222), "index = row * width + column", anchor="start")
    sheet.text((466, 250), "6 = 1 * 4 + 2", anchor="start", bold=True)


def drawings() -> Iterator[tuple[str, Sheet]]:
    """Each with the name of its file."""
    for drawn in (nail, tree, topics, time, grid):
        yield drawn.__name__, drawn()


def main(folder: Path) -> None:
    """Write all of them."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, sheet in drawings():
        (folder / f"{name}.svg").write_text(sheet.svg(), "utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
