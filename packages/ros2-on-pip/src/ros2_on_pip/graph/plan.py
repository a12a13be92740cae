"""The finished places of boxes and arrows, from left to right or from top to bottom; in points."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

from ros2_on_pip.graph.layout import Edge, GraphBox, Layout, Route, layout

ASPECT = 1.4  # width by height of what fits a screen or a page well
WIDE = 900.0  # what is no wider than this is read from left to right
HEAD_LENGTH, HEAD_HALF = 8.0, 4.0
Point = tuple[float, float]


@dataclass(frozen=True)
class Arrow:
    """A line and its head.

    The line starts at the first point and goes straight to the second one. After that come four
    points each time. They are two controls and the end of a bend (a cubic Bezier curve), and the
    end of a straight piece.
    """

    line: tuple[Point, ...]
    head: tuple[Point, Point, Point]

    def moved(self, x: float, y: float) -> Arrow:
        """The same, shifted by `x` and `y`."""
        tip, one, other = ((px + x, py + y) for px, py in self.head)
        return Arrow(tuple((px + x, py + y) for px, py in self.line), (tip, one, other))

    def turned(self) -> Arrow:
        """The same with x and y swapped."""
        tip, one, other = ((y, x) for x, y in self.head)
        return Arrow(tuple((y, x) for x, y in self.line), (tip, one, other))


@dataclass(frozen=True)
class GraphLayout:
    """Boxes by name, arrows, and the size of it all; y grows downwards."""

    boxes: dict[str, GraphBox]
    arrows: list[Arrow]
    width: float
    height: float

    def moved(self, x: float, y: float) -> GraphLayout:
        """The same, shifted by `x` and `y`."""
        boxes = {name: replace(box, x=box.x + x, y=box.y + y) for name, box in self.boxes.items()}
        return replace(self, boxes=boxes, arrows=[arrow.moved(x, y) for arrow in self.arrows])

    def turned(self) -> GraphLayout:
        """The same with x and y swapped."""
        arrows = [arrow.turned() for arrow in self.arrows]
        return GraphLayout(_turned(self.boxes), arrows, self.height, self.width)


def plan_of(boxes: Mapping[str, GraphBox], edges: Iterable[Edge]) -> GraphLayout:
    """From left to right; from top to bottom where that would be too wide to be read."""
    links = list(edges)
    across = _plan(layout(boxes, links, ASPECT))
    if across.width <= WIDE:
        return across
    down = plan_down(boxes, links)
    return min(across, down, key=lambda plan: max(plan.width / ASPECT, plan.height))


def plan_down(boxes: Mapping[str, GraphBox], edges: Iterable[Edge]) -> GraphLayout:
    """From top to bottom, for a sheet that is narrow."""
    return _plan(layout(_turned(boxes), edges, 1 / ASPECT)).turned()


def _turned(boxes: Mapping[str, GraphBox]) -> dict[str, GraphBox]:
    return {
        name: replace(box, width=box.height, height=box.width, x=box.y, y=box.x)
        for name, box in boxes.items()
    }


def _plan(found: Layout) -> GraphLayout:
    arrows = [_arrow(route, found.boxes) for route in found.routes]
    return GraphLayout(found.boxes, arrows, found.width, found.height)


def _arrow(route: Route, boxes: Mapping[str, GraphBox]) -> Arrow:
    first, *between, last = route.points
    to_right = first[0] < last[0]
    start = _border(boxes[route.source], first[1], right=to_right)
    tip = _border(boxes[route.target], last[1], right=not to_right)
    neck = (tip[0] - HEAD_LENGTH if to_right else tip[0] + HEAD_LENGTH, tip[1])
    head = (tip, (neck[0], neck[1] - HEAD_HALF), (neck[0], neck[1] + HEAD_HALF))
    return Arrow(tuple(_line([start, *between, neck])), head)


def _border(box: GraphBox, y: float, *, right: bool) -> Point:
    """The point of the box's border at height `y`: a node is an ellipse, a topic a rectangle."""
    reach = box.width / 2
    if box.column == 0:
        reach *= math.sqrt(max(0.0, 1 - ((y - box.y) / (box.height / 2)) ** 2))
    return (box.x + (reach if right else -reach), y)


def _line(points: Sequence[Point]) -> list[Point]:
    """A Route's points with the controls of its bends, which start and end level."""
    line = [points[0]]
    for number, (here, there) in enumerate(itertools.pairwise(points)):
        if number % 2:
            middle = (here[0] + there[0]) / 2
            line += [(middle, here[1]), (middle, there[1])]
        line.append(there)
    return line
