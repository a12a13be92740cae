"""Where something went, on the floor, as SVG: one line each for what is true and what was told."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from ros2_on_pip.language import said
from ros2_on_pip.markup import Markup, joined, tag
from roslings.capabilities.robot.record import RobotSeen, WaySeen
from roslings.evidence import Evidence, ExperimentSeen, MessageSeen
from roslings.report.html.timeline_svg import in_experiment

ODOMETRY = "nav_msgs/msg/Odometry"
MOST_POINTS = 400
WIDEST, HIGHEST = 640.0, 420.0
MARGIN = 46.0
LEAST_M = 0.5
"""A way shorter than this is not blown up to fill the paper."""

KINDS = ("true", "told")
DASHED = {"told": "7 5"}
ABOUT_TICKS = 5
NICE = (1.0, 2.0, 5.0)

Point = tuple[float, float]


def ways_of(seen: ExperimentSeen) -> list[WaySeen]:
    """The ways that were kept, and those that the nodes told as odometry.

    Where nobody knows the true way, nothing is drawn: a lone line proves nothing.
    """
    if not seen.part(RobotSeen).ways:
        return []
    told = [
        WaySeen(name=name, points_m=points)
        for name, topic in seen.topics.items()
        if topic.type == ODOMETRY and (points := _told(topic.messages))
    ]
    return [_thinned(way) for way in (*seen.part(RobotSeen).ways, *told) if way.points_m]


def _told(messages: Sequence[MessageSeen]) -> list[Point]:
    return [point for message in messages if (point := _place(message.content))]


def _place(content: object) -> Point | None:
    """x and y of an Odometry message; None where they are not there or no numbers."""
    try:
        at = content["pose"]["pose"]["position"]  # type: ignore[index]
        x, y = float(at["x"]), float(at["y"])
    except (TypeError, KeyError, ValueError):
        return None
    return (x, y) if math.isfinite(x) and math.isfinite(y) else None


def _thinned(way: WaySeen) -> WaySeen:
    """No more points than can be seen; the last one is always there."""
    points = [p for p in way.points_m if all(map(math.isfinite, p))]
    every = -(-len(points) // MOST_POINTS) or 1
    return way.model_copy(update={"points_m": [*points[:-1:every], *points[-1:]]})


def way_picture(ways: Sequence[WaySeen]) -> Markup:
    """The picture, for at least one way with a point."""
    floor = _floor([point for way in ways for point in way.points_m])
    return tag(
        "svg",
        *_grid(floor),
        *(
            part
            for kind, way in zip(_kinds(ways), ways, strict=True)
            for part in _line(way, floor, kind)
        ),
        role="img",
        aria_label=describe(ways),
        viewBox=f"0 0 {floor.width:.0f} {floor.height:.0f}",
        width=floor.width,
        height=floor.height,
        class_="way",
    )


def describe(ways: Sequence[WaySeen]) -> str:
    """The picture in sentences: its text alternative."""
    long = "{name}: {length_m:.2f} m long, ends at {end}."
    sentences = [
        said(
            "page.way.long",
            long,
            name=_sentence(_name(way)),
            length_m=_length_m(way),
            end=_end(way),
        )
        for way in ways
    ]
    if len(ways) > 1:
        off_m = math.dist(ways[0].points_m[-1], ways[1].points_m[-1])
        apart = "At the end the two are {off_m:.2f} m apart."
        sentences.append(said("page.way.apart", apart, off_m=off_m))
    return " ".join(sentences)


def legend(ways: Sequence[WaySeen]) -> Markup:
    """Which line is which."""
    return tag("ul", *map(_key, _kinds(ways), ways), class_="legend")


def _key(kind: str, way: WaySeen) -> Markup:
    line = tag(
        "line", x1=0.0, x2=28.0, y1=6.0, y2=6.0, class_=kind, stroke_dasharray=DASHED.get(kind)
    )
    mark = tag("svg", line, viewBox="0 0 28 12", width=28.0, height=12.0, aria_hidden="true")
    return tag("li", mark, joined(" ", _name(way)))


def _kinds(ways: Sequence[WaySeen]) -> list[str]:
    return [KINDS[min(number, 1)] for number in range(len(ways))]


def _name(way: WaySeen) -> str:
    if way.name.startswith("/"):
        return said("page.way.told", "what {topic} told", topic=way.name)
    return way.name


def _sentence(words: str) -> str:
    return words[0].upper() + words[1:]


def _length_m(way: WaySeen) -> float:
    return sum(map(math.dist, way.points_m, way.points_m[1:]))


def _end(way: WaySeen) -> str:
    x, y = (round(value, 2) + 0.0 for value in way.points_m[-1])
    return f"x {x:.2f} m, y {y:.2f} m"


@dataclass(frozen=True)
class _Floor:
    """A piece of the floor, and where its points stand on the paper: x to the right, y up."""

    left_m: float
    bottom_m: float
    right_m: float
    top_m: float

    @property
    def scale(self) -> float:
        """Pixels a metre, the same in both directions."""
        return min(
            (WIDEST - 2 * MARGIN) / (self.right_m - self.left_m),
            (HIGHEST - 2 * MARGIN) / (self.top_m - self.bottom_m),
        )

    @property
    def width(self) -> float:
        return (self.right_m - self.left_m) * self.scale + 2 * MARGIN

    @property
    def height(self) -> float:
        return (self.top_m - self.bottom_m) * self.scale + 2 * MARGIN

    def at(self, point: Point) -> Point:
        """Where a point stands."""
        x = MARGIN + (point[0] - self.left_m) * self.scale
        return x, self.height - MARGIN - (point[1] - self.bottom_m) * self.scale


def _floor(points: Sequence[Point]) -> _Floor:
    """All of the points, with some room around them."""
    (left, right), (bottom, top) = (_span([point[axis] for point in points]) for axis in (0, 1))
    return _Floor(left, bottom, right, top)


def _span(values: Sequence[float]) -> tuple[float, float]:
    low, high = min(values), max(values)
    room = max(0.06 * (high - low), (LEAST_M - (high - low)) / 2, 0.05)
    return low - room, high + room


def _grid(floor: _Floor) -> Iterator[Markup]:
    step = _step(max(floor.right_m - floor.left_m, floor.top_m - floor.bottom_m))
    foot, side = floor.height - MARGIN, MARGIN
    for value in _ticks(floor.left_m, floor.right_m, step):
        x, _ = floor.at((value, floor.bottom_m))
        yield tag("line", x1=x, x2=x, y1=MARGIN, y2=foot, class_="grid")
        yield _text(f"{value:g}", x, foot + 18, "middle")
    for value in _ticks(floor.bottom_m, floor.top_m, step):
        _, y = floor.at((floor.left_m, value))
        yield tag("line", x1=side, x2=floor.width - MARGIN, y1=y, y2=y, class_="grid")
        yield _text(f"{value:g}", side - 8, y + 4, "end")
    yield _text("x (m)", floor.width - MARGIN, foot + 36, "end")
    yield _text("y (m)", 4.0, MARGIN - 16, "start")


def _step(span_m: float) -> float:
    power = 10.0 ** math.floor(math.log10(span_m / ABOUT_TICKS))
    return next((power * n for n in NICE if power * n >= span_m / ABOUT_TICKS), power * 10)


def _ticks(low: float, high: float, step: float) -> Iterator[float]:
    first = math.ceil(low / step)
    return (round(n * step, 6) + 0.0 for n in range(first, math.floor(high / step) + 1))


def _line(way: WaySeen, floor: _Floor, kind: str) -> Iterator[Markup]:
    """The way, a ring where it begins, a dot where it ends."""
    points = [floor.at(point) for point in way.points_m]
    path = "M" + "L".join(f"{x:.1f} {y:.1f}" for x, y in points)
    yield tag("path", d=path, class_=kind, stroke_dasharray=DASHED.get(kind))
    yield _dot(points[0], 5.0, f"{kind} start")
    yield _dot(points[-1], 5.0, f"{kind} end")


def _dot(point: Point, radius: float, kind: str) -> Markup:
    return tag("ellipse", cx=point[0], cy=point[1], rx=radius, ry=radius, class_=kind)


def _text(text: str, x: float, y: float, anchor: str) -> Markup:
    return tag("text", text, x=float(x), y=float(y), text_anchor=anchor)


def ways(evidence: Evidence) -> Iterator[Markup]:
    """For each drive, where it really went and where the nodes said it went."""
    figures = [_ways(seen) for seen in evidence.experiments.values() if ways_of(seen)]
    if figures:
        words = "A ring is where a line begins, a dot is where it ends."
        note = tag("p", said("page.way.about", words), class_="about")
        title = said("page.way", "The way that it went")
        yield tag("section", tag("h2", title), note, *figures)


def _ways(seen: ExperimentSeen) -> Markup:
    found = ways_of(seen)
    heading = tag("h3", in_experiment(seen.name))
    caption = tag("figcaption", describe(found))
    return tag("figure", heading, way_picture(found), legend(found), caption)
