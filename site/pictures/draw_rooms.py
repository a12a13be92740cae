"""Draw ten rooms from their seeds: `python site/pictures/draw_rooms.py FILE.svg`.

The page of the rover shows it as `reference/pictures/rooms.svg`.
"""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from rover import DARK, FLOOR, GREY, TEAL, placed, rover
from sheet import AMBER, PALE, WIDTH, Point, Sheet

from roslings_rover.models.rooms import IN_WORDS, SeededRoom, Track, room_of
from roslings_rover.models.world import Box, Circle

SEEDS = (0, 1, 2, 3, 5, 7, 13, 14, 15, 16)
"""All kinds are among them."""
COLUMNS = 2
TILE: Point = (WIDTH / COLUMNS, 292.0)
MARGIN_PX, LABEL_PX, LEGEND_PX = 20.0, 30.0, 52.0
TITLE = "Ten rooms, each from its seed"
ROVER_SCALE = 0.4


@dataclass(frozen=True)
class Tile:
    """Where one room lies on the sheet; y grows upwards in the room and downwards here."""

    room: Box
    left_px: float
    top_px: float
    px_per_m: float

    def at(self, x_m: float, y_m: float) -> Point:
        """A place of the room, in pixels."""
        return (
            round(self.left_px + (x_m - self.room.west_m) * self.px_per_m, 1),
            round(self.top_px + (self.room.north_m - y_m) * self.px_per_m, 1),
        )


def tile(room: SeededRoom, number: int) -> Tile:
    """As large as its place allows, in the middle of it."""
    inside = room.world.room
    wide_m, high_m = inside.east_m - inside.west_m, inside.north_m - inside.south_m
    wide_px, high_px = TILE[0] - 2 * MARGIN_PX, TILE[1] - LABEL_PX - MARGIN_PX
    px_per_m = min(wide_px / wide_m, high_px / high_m)
    column, row = number % COLUMNS, number // COLUMNS
    return Tile(
        inside,
        column * TILE[0] + (TILE[0] - wide_m * px_per_m) / 2,
        LEGEND_PX + row * TILE[1] + LABEL_PX + (high_px - high_m * px_per_m) / 2,
        px_per_m,
    )


def sheet(seeds: Sequence[int] = SEEDS) -> Sheet:
    """All of them, and what the signs mean."""
    rooms = [room_of(seed) for seed in seeds]
    found = Sheet(TITLE, _told(rooms), round(LEGEND_PX + TILE[1] * len(rooms) / COLUMNS + 10))
    _legend(found)
    for number, room in enumerate(rooms):
        column, row = number % COLUMNS, number // COLUMNS
        label: Point = ((column + 0.5) * TILE[0], LEGEND_PX + row * TILE[1] + 21)
        found.text(label, f"Room {room.seed}: {IN_WORDS[room.kind]}")
        found.add(*_drawn(room, tile(room, number)))
    return found


def _told(rooms: list[SeededRoom]) -> str:
    """For those who cannot see it."""
    each = (f"Room {room.seed}: {IN_WORDS[room.kind]}, {_things(room)}" for room in rooms)
    return f"Ten rooms from above, and in each the rover at its start. {'. '.join(each)}."


def _things(room: SeededRoom) -> str:
    moving = "1 thing moves" if len(room.tracks) == 1 else f"{len(room.tracks)} things move"
    return f"{len(room.world.obstacles)} boxes and walls, {moving}"


def _legend(found: Sheet) -> None:
    found.add(placed(40, 30, rover(scale=ROVER_SCALE)))
    found.text((62, 35), "the rover at its start", anchor="start")
    found.add(f'<circle cx="270" cy="30" r="8" {MOVING}/>', f'<path d="M270 30H318" {WAY}/>')
    found.text((328, 35), "what moves, at home, and its way", anchor="start")


MOVING = f'fill="{PALE[AMBER]}" stroke="{AMBER}" stroke-width="2.5"'
WAY = f'stroke="{AMBER}" stroke-width="2" stroke-dasharray="2 4"'


def _drawn(room: SeededRoom, on: Tile) -> Iterator[str]:
    yield _box(on, room.world.room, f'fill="{FLOOR}" stroke="{TEAL}" stroke-width="3"')
    for shape in room.world.obstacles:
        yield _shape(on, shape, f'fill="{GREY}" stroke="{DARK}"')
    for track in room.tracks:
        yield from _track(on, track)
    yield placed(*on.at(0.0, 0.0), rover(scale=ROVER_SCALE))


def _track(on: Tile, track: Track) -> Iterator[str]:
    (x1, y1), (x2, y2) = on.at(*track.home), on.at(*track.turn)
    yield f'<path class="track" d="M{x1:g} {y1:g}L{x2:g} {y2:g}" {WAY}/>'
    yield _shape(on, track.at(0.0), MOVING)


def _shape(on: Tile, shape: Circle | Box, look: str) -> str:
    if isinstance(shape, Box):
        return _box(on, shape, look)
    x, y = on.at(shape.x_m, shape.y_m)
    return f'<circle cx="{x:g}" cy="{y:g}" r="{shape.radius_m * on.px_per_m:.1f}" {look}/>'


def _box(on: Tile, box: Box, look: str) -> str:
    (left, top), (right, low) = on.at(box.west_m, box.north_m), on.at(box.east_m, box.south_m)
    return (
        f'<rect x="{left:g}" y="{top:g}" width="{right - left:.1f}" height="{low - top:.1f}"'
        f" {look}/>"
    )


def main(picture: Path) -> None:
    """Write it."""
    picture.write_text(sheet().svg(), "utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
