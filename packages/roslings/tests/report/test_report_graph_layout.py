"""The places of boxes and arrows: nothing on top of anything else, for graphs of all sizes."""

from __future__ import annotations

import itertools
import random

import pytest
import written_graphs as written

from ros2_on_pip.graph.layout import Edge, GraphBox, layout
from ros2_on_pip.graph.plan import GraphLayout, plan_of

EPSILON = 1e-6


def random_graph(seed: int, nodes: int, topics: int) -> tuple[dict[str, GraphBox], list[Edge]]:
    """Boxes of random sizes; each topic has up to 3 publishers and subscribers."""
    choose = random.Random(seed)
    names = [f"node {number}" for number in range(nodes)]
    boxes = {name: GraphBox(choose.uniform(40, 200), choose.uniform(25, 60), 0) for name in names}
    edges = []
    for number in range(topics):
        topic = f"topic {number}"
        boxes[topic] = GraphBox(choose.uniform(60, 220), choose.uniform(30, 70), 1)
        edges += [(choose.choice(names), topic) for _ in range(choose.randint(0, 3))]
        edges += [(topic, choose.choice(names)) for _ in range(choose.randint(0, 3))]
    return boxes, edges


def overlap(one: GraphBox, other: GraphBox) -> bool:
    """Whether two boxes share a point of their inside."""
    return (
        abs(one.x - other.x) < (one.width + other.width) / 2 - EPSILON
        and abs(one.y - other.y) < (one.height + other.height) / 2 - EPSILON
    )


def points_on(plan_line: tuple[tuple[float, float], ...]) -> list[tuple[float, float]]:
    """Points along an arrow's line, the bends included."""
    found = list(plan_line[:2])
    for at in range(1, len(plan_line) - 1, 4):
        a, b, c, d = plan_line[at : at + 4]
        for step in range(1, 21):
            t = step / 20
            weights = ((1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t**2 * (1 - t), t**3)
            found.append(
                (
                    sum(w * p[0] for w, p in zip(weights, (a, b, c, d), strict=True)),
                    sum(w * p[1] for w, p in zip(weights, (a, b, c, d), strict=True)),
                )
            )
        found.append(plan_line[at + 4])
    return found


def check(plan: GraphLayout) -> None:
    """No box on another, no arrow across a box, everything inside."""
    for one, other in itertools.combinations(plan.boxes.values(), 2):
        assert not overlap(one, other)
    for box in plan.boxes.values():
        assert box.x - box.width / 2 >= -EPSILON
        assert box.x + box.width / 2 <= plan.width + EPSILON
        assert box.y - box.height / 2 >= -EPSILON
        assert box.y + box.height / 2 <= plan.height + EPSILON
    for arrow in plan.arrows:
        for x, y in points_on(arrow.line):
            assert -EPSILON <= x <= plan.width + EPSILON
            assert -EPSILON <= y <= plan.height + EPSILON
            assert sum(inside(box, x, y) for box in plan.boxes.values()) == 0


def inside(box: GraphBox, x: float, y: float) -> bool:
    """Whether the point lies within the box's drawn shape."""
    dx, dy = (x - box.x) / (box.width / 2), (y - box.y) / (box.height / 2)
    if box.column == 0:
        return dx**2 + dy**2 < 1 - 1e-4
    return max(abs(dx), abs(dy)) < 1 - 1e-4


@pytest.mark.parametrize("seed", range(40))
def test_nothing_overlaps(seed: int) -> None:
    """Random graphs with loops, from one node and no topic to 15 nodes and 25 topics."""
    boxes, edges = random_graph(seed, nodes=1 + seed % 15, topics=seed * 25 // 39)
    plan = plan_of(boxes, edges)
    assert set(plan.boxes) == set(boxes)
    assert len(plan.arrows) == len(set(edges))
    check(plan)


def test_a_big_graph_is_laid_out() -> None:
    """A hundred nodes do not take for ever, nor overlap."""
    plan = plan_of(*random_graph(1, nodes=100, topics=60))
    assert len(plan.boxes) == 160
    check(plan)


def test_a_chain_goes_from_left_to_right() -> None:
    """Talker, topic, listener on one line."""
    boxes = {"t": GraphBox(60, 30, 0), "c": GraphBox(90, 40, 1), "l": GraphBox(60, 30, 0)}
    found = layout(boxes, [("t", "c"), ("c", "l")]).boxes
    assert found["t"].x < found["c"].x < found["l"].x
    assert found["t"].y == pytest.approx(found["c"].y) == pytest.approx(found["l"].y)


def test_a_crossing_is_undone() -> None:
    """Two pairs whose names would cross."""
    boxes = {name: GraphBox(50, 30, 0) for name in "abyz"} | {
        "p": GraphBox(50, 30, 1),
        "q": GraphBox(50, 30, 1),
    }
    edges = [("a", "q"), ("b", "p"), ("q", "y"), ("p", "z"), ("a", "p")]
    found = layout(boxes, edges).boxes
    assert (found["p"].y < found["q"].y) == (found["z"].y < found["y"].y)
    assert (found["p"].y < found["q"].y) == (found["b"].y < found["a"].y)


def test_arrows_of_a_loop_point_the_right_way() -> None:
    """Controller to robot and back: the arrow home leads from right to left."""
    boxes = {name: GraphBox(50, 30, 0) for name in ("controller", "robot")}
    boxes |= {name: GraphBox(50, 30, 1) for name in ("cmd", "odom")}
    edges = [("controller", "cmd"), ("cmd", "robot"), ("robot", "odom"), ("odom", "controller")]
    found = layout(boxes, edges)
    ways = {(route.source, route.target): route.points for route in found.routes}
    assert set(ways) == set(edges)
    rightwards = [ways[edge][0][0] < ways[edge][-1][0] for edge in edges]
    assert sorted(rightwards) == [False, True, True, True]
    for (source, target), points in ways.items():
        assert points[0][0] == found.boxes[source].x
        assert points[-1][0] == found.boxes[target].x


def test_a_node_that_hears_itself_has_two_arrows() -> None:
    """One there and one back, not on top of each other."""
    found = layout({"n": GraphBox(50, 30, 0), "t": GraphBox(50, 30, 1)}, [("n", "t"), ("t", "n")])
    there, back = found.routes
    assert there.points[0][1] != back.points[-1][1]


def test_a_long_chain_goes_down_the_page() -> None:
    """What would be far too wide is turned; a short chain is not."""
    boxes = {f"n{at}": GraphBox(150, 30, at % 2) for at in range(12)}
    edges = [(f"n{at}", f"n{at + 1}") for at in range(11)]
    long, short = plan_of(boxes, edges), plan_of(dict(list(boxes.items())[:3]), edges[:2])
    assert long.height > long.width
    assert short.width > short.height
    check(long)


def test_an_empty_graph_has_no_size() -> None:
    """And is no crash."""
    assert layout({}, []).width == 0
    assert written.empty().nodes == []
