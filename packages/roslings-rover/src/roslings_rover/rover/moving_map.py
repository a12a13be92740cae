"""The rover's map as one SVG in which it drives its way again; no script, and nothing to load.

It moves for at most five seconds and then stands where the rover is. What moves for longer must
have a button that stops it (WCAG 2.2, success criterion 2.2.2). A page that shows it as an `img`
offers the one that stands to whoever asks for less motion: browsers do not tell a picture.
"""

from __future__ import annotations

import colorsys
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import accumulate, pairwise

from roslings_rover.models.rooms import moving_in
from roslings_rover.models.world import Ball, Box, Circle, World
from roslings_rover.rover.picture import DRAWN, MOVING, OBSTACLE, PATH, ROVER, WALL
from roslings_rover.rover.rover import RoverMoment
from roslings_rover.rover.text_map import DrawnWalls

PX_PER_M = 50.0
MARGIN_M = 0.3
LEFT_PX, TOP_PX, BELOW_PX = 44.0, 34.0, 46.0
LONGEST_S = 5.0
LONGEST_REST_S = 0.5
"""A rest is not worth watching for longer."""
MOST_FRAMES = 120
DRAWN_LOOK = f'class="drawn" stroke="{DRAWN}" stroke-width="2.5" stroke-linecap="square"'
"""In the mark itself: most maps have none of them."""

STYLE = f"""
text {{ font: 13px system-ui, sans-serif; fill: #444; }}
.grid {{ stroke: #eee; }} .axis {{ stroke: #999; }}
.wall {{ fill: none; stroke: {WALL}; stroke-width: 3; }}
.obstacle {{ fill: {OBSTACLE}; stroke: {WALL}; }}
.way {{ fill: none; stroke: {PATH}; stroke-width: 2; }}
.place {{ fill: {PATH}; }}
.rover circle {{ fill: {ROVER}; }} .rover path {{ stroke: {ROVER}; stroke-width: 4; }}
"""


@dataclass(frozen=True)
class _Sheet:
    """Where metres lie on the picture; y grows upwards in the room and downwards here."""

    room: Box

    @property
    def size_px(self) -> tuple[float, float]:
        x, y = self.at(self.room.east_m + MARGIN_M, self.room.south_m - MARGIN_M)
        return x + 10, y + BELOW_PX

    def at(self, x_m: float, y_m: float) -> tuple[float, float]:
        return (
            round(LEFT_PX + (x_m - self.room.west_m + MARGIN_M) * PX_PER_M, 1),
            round(TOP_PX + (self.room.north_m + MARGIN_M - y_m) * PX_PER_M, 1),
        )

    def under(self, right: float, down: float) -> tuple[float, float]:
        """The other way round, of parts of the picture: 0 is its left or upper edge, 1 the other.

        Metres east and north in the room.
        """
        wide, high = self.size_px
        return (
            self.room.west_m - MARGIN_M + (right * wide - LEFT_PX) / PX_PER_M,
            self.room.north_m + MARGIN_M - (down * high - TOP_PX) / PX_PER_M,
        )


def place_under(world: World, right: float, down: float) -> tuple[float, float]:
    """Where in the room a point of the map lies, in metres (x, y).

    `right` and `down` are parts of the picture's width and height, from 0 to 1. So they hold at
    each size that it is shown in.
    """
    return _Sheet(world.room).under(right, down)


def moving_map(
    world: World,
    trail: Sequence[RoverMoment],
    radius_m: float,
    *,
    dots: bool = False,
    moves: bool = True,
    drawn: DrawnWalls | None = None,
) -> str:
    """An `svg` element: the room, the way from the first moment to the last, the rover at its end.

    `radius_m` is the rover's; `dots` marks each place of the trail; without `moves` the drive is
    over already. Walls that somebody has `drawn` are green. Raises ValueError without a moment.
    """
    if not trail:
        raise ValueError("a map needs one moment at least")
    sheet = _Sheet(world.room)
    wide, high = sheet.size_px
    return "".join(
        [
            f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {wide:g} {high:g}"'
            f' width="{wide:g}" height="{high:g}">',
            f"<style>{STYLE}{_motion(sheet, trail) if moves else ''}</style>",
            *_axes(sheet),
            *_room(sheet, world),
            *_drawn(sheet, drawn),
            *_way(sheet, trail, dots),
            _rover(sheet, trail[-1], radius_m),
            *_legend(world, drawn),
            "</svg>",
        ]
    )


def _axes(sheet: _Sheet) -> Iterator[str]:
    room = sheet.room
    bottom_px = sheet.at(0, room.south_m - MARGIN_M)[1]
    for x_m in _whole(room.west_m, room.east_m):
        (x, top), low = sheet.at(x_m, room.north_m), sheet.at(x_m, room.south_m)[1]
        yield f'<path class="grid" d="M{x} {top}V{low}"/>'
        yield f'<text x="{x}" y="{bottom_px + 16:g}" text-anchor="middle">{x_m}</text>'
    for y_m in _whole(room.south_m, room.north_m):
        (left, y), right = sheet.at(room.west_m, y_m), sheet.at(room.east_m, y_m)[0]
        yield f'<path class="grid" d="M{left} {y}H{right}"/>'
        yield f'<text x="{LEFT_PX - 6:g}" y="{y + 4:g}" text-anchor="end">{y_m}</text>'
    middle_x = sheet.at((room.west_m + room.east_m) / 2, 0)[0]
    middle_y = sheet.at(0, (room.south_m + room.north_m) / 2)[1]
    yield f'<text x="{middle_x}" y="{bottom_px + 36:g}" text-anchor="middle">x in m</text>'
    yield (
        f'<text transform="translate(14 {middle_y}) rotate(-90)" text-anchor="middle">y in m</text>'
    )


def _whole(low_m: float, high_m: float) -> range:
    return range(math.ceil(low_m), math.floor(high_m) + 1)


def _room(sheet: _Sheet, world: World) -> Iterator[str]:
    yield _box(sheet, world.room, "wall")
    for shape in world.obstacles:
        if isinstance(shape, Box):
            yield _box(sheet, shape, "obstacle")
        else:
            yield _disc(sheet, shape, 'class="obstacle"')
    for ball in world.balls:
        yield _disc(sheet, ball.shape, f'fill="{_colour(ball)}"')
    for thing in moving_in(world):
        yield _disc(sheet, thing, f'fill="{MOVING}" stroke="{WALL}"')


def _drawn(sheet: _Sheet, drawn: DrawnWalls | None) -> Iterator[str]:
    """A dot for each square: a line without length has the form of its ends."""
    if drawn:
        places = zip(drawn.x_m.tolist(), drawn.y_m.tolist(), strict=True)
        dots = (sheet.at(x_m, y_m) for x_m, y_m in places)
        yield f'<path {DRAWN_LOOK} d="{"".join(f"M{x:g} {y:g}h0" for x, y in dots)}"/>'


def _box(sheet: _Sheet, box: Box, kind: str) -> str:
    (left, top), (right, low) = sheet.at(box.west_m, box.north_m), sheet.at(box.east_m, box.south_m)
    return (
        f'<rect class="{kind}" x="{left}" y="{top}" width="{right - left:g}"'
        f' height="{low - top:g}"/>'
    )


def _disc(sheet: _Sheet, circle: Circle, look: str) -> str:
    x, y = sheet.at(circle.x_m, circle.y_m)
    return f'<circle {look} cx="{x}" cy="{y}" r="{circle.radius_m * PX_PER_M:g}"/>'


def _colour(ball: Ball) -> str:
    red, green, blue = colorsys.hsv_to_rgb(ball.hue / 180, 0.9, 0.9)
    return f"#{round(red * 255):02x}{round(green * 255):02x}{round(blue * 255):02x}"


def _way(sheet: _Sheet, trail: Sequence[RoverMoment], dots: bool) -> Iterator[str]:
    places = [sheet.at(each.pose.x_m, each.pose.y_m) for each in trail]
    line = " ".join(f"{x:g},{y:g}" for x, y in places)
    yield f'<polyline class="way" pathLength="1" points="{line}"/>'
    for x, y in places if dots else places[:1]:
        yield f'<circle class="place" cx="{x}" cy="{y}" r="{2.4 if dots else 4}"/>'
    if dots:
        yield f'<circle class="place" cx="{places[0][0]}" cy="{places[0][1]}" r="5"/>'


def _rover(sheet: _Sheet, last: RoverMoment, radius_m: float) -> str:
    (x, y), radius = sheet.at(last.pose.x_m, last.pose.y_m), radius_m * PX_PER_M
    turn = -math.degrees(last.pose.heading_rad)
    return (
        f'<g class="rover" transform="translate({x} {y}) rotate({turn:.1f})">'
        f'<circle r="{radius:g}"/><path d="M0 0H{2 * radius:g}"/></g>'
    )


def _legend(world: World, drawn: DrawnWalls | None) -> Iterator[str]:
    marks = [
        ('<path class="way" d="M0 -4H20"/>', "path"),
        ('<circle class="place" cx="10" cy="-4" r="4"/>', "start"),
        ('<g class="rover" style="animation:none"><circle cx="10" cy="-4" r="6"/></g>', "rover"),
    ]
    if world.balls:
        ball = _colour(world.balls[0])
        marks.append((f'<circle cx="10" cy="-4" r="5" fill="{ball}"/>', "ball"))
    if moving_in(world):
        marks.append((f'<circle cx="10" cy="-4" r="6" fill="{MOVING}"/>', "moves"))
    if drawn:
        marks.append((f'<path {DRAWN_LOOK} d="M4 -4H16"/>', "drawn"))
    for number, (mark, word) in enumerate(marks):
        x = LEFT_PX + number * 84
        yield f'<g transform="translate({x:g} 22)">{mark}<text x="27">{word}</text></g>'


@dataclass(frozen=True)
class _Frame:
    """Where the rover is when so much of the showing and of the way is over (0 to 1)."""

    time: float
    way: float
    moment: RoverMoment
    heading_rad: float
    """Without the jump from pi to -pi, which would turn the rover once around."""


def _motion(sheet: _Sheet, trail: Sequence[RoverMoment]) -> str:
    """The animation's rules; none where nothing moved."""
    frames = _frames(trail)
    if not frames:
        return ""
    drive = "".join(f"{each.time:.2%}{{transform:{_placed(sheet, each)}}}" for each in frames)
    way = "".join(f"{each.time:.2%}{{stroke-dashoffset:{1 - each.way:.4f}}}" for each in frames)
    seconds = f"{shown_s(trail):.2f}s linear both"
    return (
        "@media (prefers-reduced-motion: no-preference) {"
        f"@keyframes drive{{{drive}}}@keyframes way{{{way}}}"
        f".rover{{animation:drive {seconds}}}"
        f"polyline.way{{stroke-dasharray:1;animation:way {seconds}}}}}"
    )


def _placed(sheet: _Sheet, frame: _Frame) -> str:
    x, y = sheet.at(frame.moment.pose.x_m, frame.moment.pose.y_m)
    return f"translate({x:g}px,{y:g}px) rotate({-math.degrees(frame.heading_rad):.1f}deg)"


def shown_s(trail: Sequence[RoverMoment]) -> float:
    """How long the picture moves: as long as the rover did, without its rests; at most 5 s."""
    return min(LONGEST_S, sum(_steps_s(trail)))


def _steps_s(trail: Sequence[RoverMoment]) -> list[float]:
    return [min(b.time_s - a.time_s, LONGEST_REST_S) for a, b in pairwise(trail)]


def _frames(trail: Sequence[RoverMoment]) -> list[_Frame]:
    if len({each.pose for each in trail}) < 2:
        return []
    times_s = [0.0, *accumulate(_steps_s(trail))]
    ways_m = [0.0, *accumulate(_far_m(a, b) for a, b in pairwise(trail))]
    headings = _unwound([each.pose.heading_rad for each in trail])
    if times_s[-1] <= 0:
        return []
    way_m = ways_m[-1] or 1.0
    return [
        _Frame(times_s[i] / times_s[-1], ways_m[i] / way_m, trail[i], headings[i])
        for i in _few(len(trail))
    ]


def _far_m(one: RoverMoment, two: RoverMoment) -> float:
    return math.hypot(two.pose.x_m - one.pose.x_m, two.pose.y_m - one.pose.y_m)


def _unwound(angles_rad: Sequence[float]) -> list[float]:
    turns = (math.remainder(b - a, math.tau) for a, b in pairwise(angles_rad))
    return list(accumulate(turns, initial=angles_rad[0]))


def _few(count: int) -> list[int]:
    """At most so many indexes, the first and the last among them."""
    step = max(1, math.ceil((count - 1) / (MOST_FRAMES - 1)))
    return [*range(0, count - 1, step), count - 1]
