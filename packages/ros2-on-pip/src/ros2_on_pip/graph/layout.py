"""Places for the boxes and arrows of a directed graph, from left to right, in points.

Who wants it from top to bottom swaps widths and heights before, and x and y afterwards.

This is the layered way of Sugiyama, Tagawa and Toda (1981). Break the cycles. Give each box the
column that its longest path asks for. Lead long arrows through free rows. Order each column by the
barycentre of its neighbours. Then move boxes to the height of their neighbours.
"""

from __future__ import annotations

import bisect
import itertools
import math
from collections import defaultdict
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

Edge = tuple[str, str]
Columns = list[list[str]]
Neighbours = Mapping[str, Sequence[str]]

ROW_GAP = 20.0
COLUMN_GAP = 56.0
GAP_PER_ARROW = 4.0
PORT_GAP = 13.0
PART_GAP = 36.0
LANE_HEIGHT = 8.0
SWEEPS = 12


@dataclass(frozen=True)
class GraphBox:
    """One box, by its centre; `column` is 0 for a node (even columns), 1 for a topic."""

    width: float
    height: float
    column: int = 0
    x: float = 0.0
    y: float = 0.0


@dataclass(frozen=True)
class Route:
    """An arrow: its two boxes, and the points it goes through from one border to the other.

    Points are counted from 1. Between an odd point and the next even one it goes straight. From an
    even one to the next odd one it may bend.
    """

    source: str
    target: str
    points: tuple[tuple[float, float], ...]

    def moved(self, x: float, y: float) -> Route:
        """The same, shifted by `x` and `y`."""
        return replace(self, points=tuple((px + x, py + y) for px, py in self.points))


@dataclass(frozen=True)
class Layout:
    """Where everything stands; y grows downwards and all lies within width and height."""

    boxes: dict[str, GraphBox]
    routes: list[Route]
    width: float
    height: float

    def moved(self, x: float, y: float) -> Layout:
        """The same, shifted by `x` and `y`."""
        return Layout(
            {name: replace(box, x=box.x + x, y=box.y + y) for name, box in self.boxes.items()},
            [route.moved(x, y) for route in self.routes],
            self.width + x,
            self.height + y,
        )


def layout(boxes: Mapping[str, GraphBox], edges: Iterable[Edge], aspect: float = 1.4) -> Layout:
    """Places for `boxes` (name to size) and `edges` between them. No two boxes overlap.

    Parts that no edge connects are put together to about `aspect` (width by height).
    """
    links = sorted(set(edges))
    parts = [_part(names, boxes, links) for names in _connected(boxes, links)]
    return _packed(parts, aspect)


# Parts that no arrow connects


def _connected(boxes: Mapping[str, GraphBox], edges: Sequence[Edge]) -> list[list[str]]:
    near = _both_ways(edges)
    seen: set[str] = set()
    parts = []
    for name in sorted(boxes):
        if name not in seen:
            part = _reached(name, near)
            seen |= part
            parts.append(sorted(part))
    return parts


def _reached(start: str, near: Neighbours) -> set[str]:
    found, waiting = {start}, [start]
    while waiting:
        fresh = [name for name in near.get(waiting.pop(), ()) if name not in found]
        found.update(fresh)
        waiting.extend(fresh)
    return found


def _both_ways(edges: Iterable[Edge]) -> dict[str, list[str]]:
    near: dict[str, list[str]] = defaultdict(list)
    for source, target in edges:
        near[source].append(target)
        near[target].append(source)
    return near


def _packed(parts: Sequence[Layout], aspect: float) -> Layout:
    """Parts beside each other in rows, the big ones first."""
    area = sum((part.width + PART_GAP) * (part.height + PART_GAP) for part in parts)
    limit = max([math.sqrt(area * aspect), *(part.width for part in parts)], default=0.0)
    whole = Layout({}, [], 0.0, 0.0)
    x = y = row = 0.0
    for part in sorted(parts, key=lambda part: -len(part.boxes)):
        if x and x + part.width > limit:
            x, y, row = 0.0, y + row + PART_GAP, 0.0
        whole = _joined(whole, part.moved(x, y))
        x, row = x + part.width + PART_GAP, max(row, part.height)
    return whole


def _joined(whole: Layout, part: Layout) -> Layout:
    return Layout(
        whole.boxes | part.boxes,
        whole.routes + part.routes,
        max(whole.width, part.width),
        max(whole.height, part.height),
    )


# One part


def _part(names: Sequence[str], boxes: Mapping[str, GraphBox], edges: Sequence[Edge]) -> Layout:
    inside = set(names)
    links = [edge for edge in edges if edge[0] in inside]
    rightwards = _without_cycles(names, links)
    place = _columns_of(names, boxes, rightwards)
    chains = [_chain(number, edge, place) for number, edge in enumerate(rightwards)]
    sized = _with_lanes({name: boxes[name] for name in names}, chains)
    columns = _ordered(_in_columns(place, chains), chains)
    placed = _at_x(_at_y(sized, columns, chains), columns, chains)
    routes = _routes(links, rightwards, chains, placed, columns)
    return _trimmed({name: placed[name] for name in names}, routes)


def _without_cycles(names: Sequence[str], edges: Sequence[Edge]) -> list[Edge]:
    """`edges` in the same order, those that close a cycle turned round."""
    after: dict[str, list[str]] = defaultdict(list)
    for source, target in edges:
        after[source].append(target)
    incoming = {name: sum(target == name for _, target in edges) for name in names}
    starts = sorted(
        names, key=lambda name: (incoming[name] > 0, incoming[name] - len(after[name]), name)
    )
    back = _closing(starts, after)
    return [(edge[1], edge[0]) if edge in back else edge for edge in edges]


def _closing(starts: Sequence[str], after: Neighbours) -> set[Edge]:
    """The edges that lead back to a box on the way to them, found depth first."""
    back: set[Edge] = set()
    done: set[str] = set()
    for start in starts:
        way = {start: iter(after.get(start, ()))} if start not in done else {}
        while way:
            name = next(reversed(way))
            following = next(way[name], None)
            if following is None:
                done.add(name)
                del way[name]
            elif following in way:
                back.add((name, following))
            elif following not in done:
                way[following] = iter(after.get(following, ()))
    return back


def _columns_of(
    names: Sequence[str], boxes: Mapping[str, GraphBox], edges: Sequence[Edge]
) -> dict[str, int]:
    """Box to column: one more than the furthest box before it; nodes even, topics odd."""
    before: dict[str, list[str]] = defaultdict(list)
    after: dict[str, list[str]] = defaultdict(list)
    for source, target in edges:
        before[target].append(source)
        after[source].append(target)
    column: dict[str, int] = {}
    for name in _in_order(names, before, after):
        column[name] = max((column[near] + 1 for near in before[name]), default=boxes[name].column)
    for name in names:
        if not before[name] and after[name]:  # a start stands close to what it leads to
            column[name] = min(column[near] for near in after[name]) - 1
    return column


def _in_order(names: Sequence[str], before: Neighbours, after: Neighbours) -> list[str]:
    """Each name after all that lead to it."""
    missing = {name: len(before.get(name, ())) for name in names}
    order = [name for name in names if not missing[name]]
    for name in order:  # grows while it is gone through
        for following in after.get(name, ()):
            missing[following] -= 1
            if not missing[following]:
                order.append(following)
    return order


def _chain(number: int, edge: Edge, column: Mapping[str, int]) -> list[str]:
    """The edge as a way through each column; in a column between its ends it gets a lane."""
    source, target = edge
    lanes = [f"lane {number} {at}" for at in range(column[source] + 1, column[target])]
    return [source, *lanes, target]


def _in_columns(column: Mapping[str, int], chains: Sequence[Sequence[str]]) -> Columns:
    found: dict[int, list[str]] = defaultdict(list)
    for name in sorted(column):
        found[column[name]].append(name)
    for chain in chains:
        for step, lane in enumerate(chain[1:-1], start=1):
            found[column[chain[0]] + step].append(lane)
    return [found[at] for at in sorted(found)]


def _with_lanes(boxes: dict[str, GraphBox], chains: Sequence[Sequence[str]]) -> dict[str, GraphBox]:
    """Boxes as high as their arrows need, and the lanes."""
    leaving, coming = _degrees(chains)
    sized = {}
    for name, box in boxes.items():
        ports = max(leaving.get(name, 0), coming.get(name, 0))
        sized[name] = replace(box, height=max(box.height, (ports + 1) * PORT_GAP))
    for chain in chains:
        sized.update(dict.fromkeys(chain[1:-1], GraphBox(0.0, LANE_HEIGHT)))
    return sized


def _degrees(chains: Sequence[Sequence[str]]) -> tuple[dict[str, int], dict[str, int]]:
    leaving: dict[str, int] = defaultdict(int)
    coming: dict[str, int] = defaultdict(int)
    for chain in chains:
        leaving[chain[0]] += 1
        coming[chain[-1]] += 1
    return leaving, coming


def _steps(chains: Iterable[Sequence[str]]) -> list[Edge]:
    """All pairs of neighbours in the chains: edges from one column to the next."""
    return [step for chain in chains for step in itertools.pairwise(chain)]


def _sides(chains: Iterable[Sequence[str]]) -> tuple[Neighbours, Neighbours]:
    """Name to its neighbours on the left, and on the right."""
    left: dict[str, list[str]] = defaultdict(list)
    right: dict[str, list[str]] = defaultdict(list)
    for source, target in _steps(chains):
        left[target].append(source)
        right[source].append(target)
    return left, right


# The order in each column


def _ordered(columns: Columns, chains: Sequence[Sequence[str]]) -> Columns:
    """The order with the fewest crossings among those that the sweeps come by."""
    left, right = _sides(chains)
    best, fewest = columns, _crossings(columns, right)
    for sweep in range(SWEEPS):
        if not fewest:
            break
        columns = _swept(columns, left) if sweep % 2 == 0 else _swept(columns[::-1], right)[::-1]
        crossings = _crossings(columns, right)
        if crossings < fewest:
            best, fewest = columns, crossings
    return best


def _swept(columns: Columns, near: Neighbours) -> Columns:
    """Each column in the order of the mean place of its neighbours in the column before it."""
    result = columns[:1]
    for column in columns[1:]:
        place = {name: at for at, name in enumerate(result[-1])}
        result.append(_by_barycentre(column, place, near))
    return result


def _by_barycentre(column: list[str], place: Mapping[str, int], near: Neighbours) -> list[str]:
    def barycentre(at: int) -> float:
        places = [place[name] for name in near.get(column[at], ())]
        return sum(places) / len(places) if places else float(at)

    order = sorted(range(len(column)), key=barycentre)
    return [column[at] for at in order]


def _crossings(columns: Columns, right: Neighbours) -> int:
    return sum(
        _crossings_between(one, {name: at for at, name in enumerate(other)}, right)
        for one, other in itertools.pairwise(columns)
    )


def _crossings_between(column: list[str], place: Mapping[str, int], right: Neighbours) -> int:
    seen: list[int] = []
    crossings = 0
    for name in column:
        ends = sorted(place[near] for near in right.get(name, ()))
        crossings += sum(len(seen) - bisect.bisect_right(seen, end) for end in ends)
        for end in ends:
            bisect.insort(seen, end)
    return crossings


# Heights and widths


def _at_y(
    boxes: dict[str, GraphBox], columns: Columns, chains: Sequence[Sequence[str]]
) -> dict[str, GraphBox]:
    """Each box as close to the height of its neighbours as the order in its column allows."""
    left, right = _sides(chains)
    both = _both_ways(_steps(chains))
    y = {name: 0.0 for column in columns for name in column}
    for near, order in [(left, columns), (right, columns[::-1])] * 3 + [(both, columns)] * 4:
        for column in order:
            _settle(column, near, boxes, y)
    return {name: replace(box, y=y[name]) for name, box in boxes.items()}


def _settle(
    column: Sequence[str], near: Neighbours, boxes: Mapping[str, GraphBox], y: dict[str, float]
) -> None:
    wished = [_mean([y[name] for name in near.get(own, ())] or [y[own]]) for own in column]
    offsets = _offsets([boxes[name] for name in column])
    free = _rising([wish - offset for wish, offset in zip(wished, offsets, strict=True)])
    y.update(zip(column, (at + off for at, off in zip(free, offsets, strict=True)), strict=True))


def _mean(values: Sequence[float]) -> float:
    return sum(values) / len(values)


def _offsets(column: Sequence[GraphBox]) -> list[float]:
    """How far below the first box each one stands where they are as close as may be."""
    offsets = [0.0]
    for above, below in itertools.pairwise(column):
        gap = ROW_GAP if above.width and below.width else ROW_GAP / 2
        offsets.append(offsets[-1] + (above.height + below.height) / 2 + gap)
    return offsets


def _rising(values: Sequence[float]) -> list[float]:
    """The nearest values, by least squares, that never fall (pool adjacent violators)."""
    pools: list[tuple[float, int]] = []
    for value in values:
        mean, count = value, 1
        while pools and pools[-1][0] > mean:
            before, size = pools.pop()
            mean = (before * size + mean * count) / (size + count)
            count += size
        pools.append((mean, count))
    return [mean for mean, count in pools for _ in range(count)]


def _at_x(
    boxes: dict[str, GraphBox], columns: Columns, chains: Sequence[Sequence[str]]
) -> dict[str, GraphBox]:
    """Each box in the middle of its column; more arrows between two columns get more room."""
    _, right = _sides(chains)
    placed = {}
    start = 0.0
    for column in columns:
        width = max(boxes[name].width for name in column)
        placed.update({name: replace(boxes[name], x=start + width / 2) for name in column})
        arrows = sum(len(right.get(name, ())) for name in column)
        start += width + COLUMN_GAP + GAP_PER_ARROW * arrows
    return placed


# Arrows


def _routes(
    edges: Sequence[Edge],
    rightwards: Sequence[Edge],
    chains: Sequence[Sequence[str]],
    boxes: Mapping[str, GraphBox],
    columns: Columns,
) -> list[Route]:
    widths = {
        name: max(boxes[one].width for one in column) for column in columns for name in column
    }
    leaving = _ports(chains, boxes, ahead=True)
    coming = _ports(chains, boxes, ahead=False)
    routes = []
    for number, (edge, turned) in enumerate(zip(edges, rightwards, strict=True)):
        points = _points(chains[number], leaving[number], coming[number], boxes, widths)
        routes.append(Route(*edge, tuple(points if edge == turned else points[::-1])))
    return routes


def _ports(
    chains: Sequence[Sequence[str]], boxes: Mapping[str, GraphBox], *, ahead: bool
) -> list[float]:
    """For each chain the height at which it leaves its first box (or comes to its last)."""
    ends: dict[str, list[tuple[float, int]]] = defaultdict(list)
    for number, chain in enumerate(chains):
        own, near = (chain[0], chain[1]) if ahead else (chain[-1], chain[-2])
        ends[own].append((boxes[near].y, number))
    heights = [0.0] * len(chains)
    for own, neighbours in ends.items():
        for place, (_, number) in enumerate(sorted(neighbours)):
            heights[number] = boxes[own].y + (place - (len(neighbours) - 1) / 2) * PORT_GAP
    return heights


def _points(
    chain: Sequence[str],
    leaves_at: float,
    comes_at: float,
    boxes: Mapping[str, GraphBox],
    widths: Mapping[str, float],
) -> list[tuple[float, float]]:
    """From the first box's middle to the last one's, straight within a column."""
    first, last = boxes[chain[0]], boxes[chain[-1]]
    points = [(first.x, leaves_at), (first.x + widths[chain[0]] / 2, leaves_at)]
    for lane in chain[1:-1]:
        at, half = boxes[lane], widths[lane] / 2
        points += [(at.x - half, at.y), (at.x + half, at.y)]
    return [*points, (last.x - widths[chain[-1]] / 2, comes_at), (last.x, comes_at)]


def _trimmed(boxes: dict[str, GraphBox], routes: list[Route]) -> Layout:
    """All moved so that the topmost edge is 0."""
    heights = [y for route in routes for _, y in route.points]
    top = min([*(box.y - box.height / 2 for box in boxes.values()), *heights])
    bottom = max([*(box.y + box.height / 2 for box in boxes.values()), *heights])
    right = max(box.x + box.width / 2 for box in boxes.values())
    moved = Layout(boxes, routes, right, bottom).moved(0.0, -top)
    return replace(moved, height=bottom - top)
