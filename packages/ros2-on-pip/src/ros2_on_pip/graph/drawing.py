"""The ROS graph as SVG, at the places that the PNG has too: no matplotlib is needed."""

from __future__ import annotations

import unicodedata
from collections.abc import Iterator, Mapping

from ros2_on_pip.graph.labels import Label, edges_of, labels_of
from ros2_on_pip.graph.layout import GraphBox
from ros2_on_pip.graph.line import WARNING, TextLine
from ros2_on_pip.graph.plan import Arrow, GraphLayout, plan_down, plan_of
from ros2_on_pip.graph.seen import Graph
from ros2_on_pip.graph.shape import GraphShape, shape_of
from ros2_on_pip.graph.words import sentences_of
from ros2_on_pip.language import said
from ros2_on_pip.markup import Markup, joined, tag

MARGIN = 8.0
SCALE = 1.3
CELL = 0.61
"""Width of a letter in a monospaced font, as a part of its height: at most, of the usual ones."""
NARROW = 330.0
SHADOW = 5.0
STYLE = """
.graph text { fill: var(--ink); }
.graph .bold { font-weight: 700; } .graph .warn { fill: var(--bad); }
.node { fill: var(--node); stroke: var(--node-edge); stroke-width: 1.4; }
.doubled { stroke: var(--bad); }
.topic { fill: var(--topic); stroke: var(--topic-edge); stroke-width: 1.4; }
.arrow { fill: none; stroke: var(--arrow); stroke-width: 1.4; } .head { fill: var(--arrow); }
"""
"""How a page shows it, whose style has these variables."""


class MonospacedRuler:
    """Widths of lines of text where every letter is equally wide, and East Asian ones twice."""

    def width(self, line: TextLine) -> float:
        """Points that the line takes."""
        return sum(map(_cells, line.text)) * CELL * line.size


def _cells(sign: str) -> int:
    if unicodedata.combining(sign):
        return 0
    return 2 if unicodedata.east_asian_width(sign) in "WF" else 1


def graph_svg(graph: Graph) -> Markup:
    """The graph from left to right, as an `svg` element alone."""
    return shape_svg(shape_of(graph))


def shape_svg(shape: GraphShape) -> Markup:
    """The same of what is left of a graph."""
    labels = labels_of(shape)
    ruler = MonospacedRuler()
    boxes = {key: label.box(ruler) for key, label in labels.items()}
    return _drawing(plan_of(boxes, edges_of(shape)), labels, sentences_of(shape))


def graph_pictures(graph: Graph) -> Markup:
    """The graph from left to right; for narrow screens, where that is wide, also downwards."""
    ruler = MonospacedRuler()
    shape = shape_of(graph)
    labels = labels_of(shape)
    boxes = {key: label.box(ruler) for key, label in labels.items()}
    edges = edges_of(shape)
    words = sentences_of(shape)
    across = plan_of(boxes, edges)
    if across.width <= NARROW / SCALE:
        return _picture(across, labels, words, None)
    down = plan_down(boxes, edges)
    return joined(_picture(across, labels, words, "wide"), _picture(down, labels, words, "narrow"))


def _picture(
    plan: GraphLayout, labels: Mapping[str, Label], words: str, screen: str | None
) -> Markup:
    drawing = _drawing(plan, labels, words)
    return tag(
        "div",
        drawing,
        class_=" ".join(filter(None, ("scroll", screen))),
        tabindex="0",
        role="group",
        aria_label=said("graph.scroll", "the graph, to scroll"),
    )


def _drawing(plan: GraphLayout, labels: Mapping[str, Label], words: str) -> Markup:
    width, height = plan.width + 2 * MARGIN, plan.height + 2 * MARGIN
    return tag(
        "svg",
        *_parts(plan.moved(MARGIN, MARGIN), labels),
        role="img",
        aria_label=words,
        viewBox=f"0 0 {width:.0f} {height:.0f}",
        width=width * SCALE,
        height=height * SCALE,
        class_="graph",
    )


def _parts(plan: GraphLayout, labels: Mapping[str, Label]) -> Iterator[Markup]:
    for arrow in plan.arrows:
        yield from _arrow(arrow)
    for key, box in plan.boxes.items():
        yield from _box(box, labels[key])
        yield from _lines(box, labels[key])


def _arrow(arrow: Arrow) -> Iterator[Markup]:
    (x, y), (x2, y2), *rest = arrow.line
    path = [f"M{x:.1f} {y:.1f}L{x2:.1f} {y2:.1f}"]
    for first in range(0, len(rest), 4):
        numbers = [f"{px:.1f} {py:.1f}" for px, py in rest[first : first + 4]]
        path.append(f"C{' '.join(numbers[:3])}L{numbers[3]}")
    yield tag("path", d="".join(path), class_="arrow")
    head = "L".join(f"{px:.1f} {py:.1f}" for px, py in arrow.head)
    yield tag("path", d=f"M{head}z", class_="head")


def _box(box: GraphBox, label: Label) -> Iterator[Markup]:
    if not label.round:
        yield tag(
            "rect",
            x=box.x - box.width / 2,
            y=box.y - box.height / 2,
            width=box.width,
            height=box.height,
            rx=2.0,
            class_="topic",
        )
        return
    if label.doubled:
        yield _ellipse(box, SHADOW, "node doubled")
    yield _ellipse(box, 0.0, "node doubled" if label.doubled else "node")


def _ellipse(box: GraphBox, shift: float, kind: str) -> Markup:
    return tag(
        "ellipse",
        cx=box.x + shift,
        cy=box.y + shift,
        rx=box.width / 2,
        ry=box.height / 2,
        class_=kind,
    )


def _lines(box: GraphBox, label: Label) -> Iterator[Markup]:
    top = box.y - label.height / 2
    for line in label.lines:
        yield tag(
            "text",
            line.text,
            x=box.x,
            y=top + line.size,
            text_anchor="middle",
            font_size=line.size,
            class_=_kind(line),
        )
        top += line.height


def _kind(line: TextLine) -> str | None:
    kinds = ["warn"] * (line.colour == WARNING) + ["bold"] * line.bold
    return " ".join(kinds) or None
