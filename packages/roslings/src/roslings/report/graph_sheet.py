"""The sheet that the graph is drawn on: title, boxes, arrows, legend. Lengths in points.

Imports matplotlib; `graph_picture` imports this module only when it draws.
"""

from __future__ import annotations

import math

from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.patches import Ellipse, PathPatch, Polygon, Rectangle
from matplotlib.path import Path as Curve

from ros2_on_pip.graph.labels import SMALL, Label, edges_of, labels_of
from ros2_on_pip.graph.layout import GraphBox
from ros2_on_pip.graph.line import WARNING, TextLine
from ros2_on_pip.graph.plan import HEAD_HALF, HEAD_LENGTH, Arrow, Point, plan_of
from ros2_on_pip.graph.shape import GraphShape
from ros2_on_pip.graph.words import NEXT, NOTHING
from ros2_on_pip.language import said
from ros2_on_pip.safe_text import harmless, wrapped
from roslings.report.lettering import Lettering
from roslings_rover.palette import colour_of

MARGIN = 24.0
LEAST_WIDTH = 340.0
TITLE_SIZE = 14.0
TITLE_WIDTH = 620.0
LEGEND_HEIGHT = 20.0
SHADOW = 5.0

GROUND, ARROW = colour_of("ground"), colour_of("arrow")
NODE_FILL, NODE_EDGE = colour_of("node"), colour_of("node-edge")
TOPIC_FILL, TOPIC_EDGE = colour_of("topic"), colour_of("topic-edge")


class GraphSheet:
    """All that is to be drawn, measured; `width` and `height` are the sheet's size."""

    def __init__(self, shape: GraphShape, title: str | None) -> None:
        self._lettering = Lettering()
        self._labels = labels_of(shape)
        boxes = {key: label.box(self._lettering) for key, label in self._labels.items()}
        self._plan = plan_of(boxes, edges_of(shape))
        self._title = self._title_lines(title) if title else []
        self._words = [] if boxes else [TextLine(str(NOTHING), bold=True), TextLine(str(NEXT))]
        widest = max(map(self._lettering.width, [*self._title, *self._words]), default=0.0)
        self.width = max(self._plan.width, widest, LEAST_WIDTH - 2 * MARGIN) + 2 * MARGIN
        self._top = MARGIN + sum(line.height for line in self._title) + (10 if title else 0)
        self._foot = self._top + max(self._plan.height, 60.0) + MARGIN
        self.height = self._foot + LEGEND_HEIGHT + MARGIN / 2

    def _title_lines(self, title: str) -> list[TextLine]:
        def measure(text: str) -> int:
            return math.ceil(self._lettering.width(TextLine(text, TITLE_SIZE, bold=True)))

        parts = wrapped(" ".join(harmless(title).split()), int(TITLE_WIDTH), measure)
        return [TextLine(part, TITLE_SIZE, bold=True) for part in parts]

    def draw(self, figure: Figure) -> None:
        """Draw all of it; the figure has the sheet's size."""
        figure.set_facecolor(GROUND)
        axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
        axes.set_axis_off()
        axes.set_xlim(0, self.width)
        axes.set_ylim(self.height, 0)
        self._draw_title(axes)
        if self._words:
            self._draw_words(axes)
        else:
            self._draw_graph(axes)
            _draw_legend(axes, self._lettering, self._foot + LEGEND_HEIGHT / 2)

    def _draw_title(self, axes: Axes) -> None:
        top = MARGIN
        for line in self._title:
            top = self._lettering.write(axes, line, self.width / 2, top)

    def _draw_words(self, axes: Axes) -> None:
        top = (self._top + self.height - MARGIN) / 2 - 14
        for line in self._words:
            top = self._lettering.write(axes, line, self.width / 2, top)

    def _draw_graph(self, axes: Axes) -> None:
        left = (self.width - self._plan.width) / 2
        spare = (self._foot - MARGIN - self._top - self._plan.height) / 2
        plan = self._plan.moved(left, self._top + spare)
        for arrow in plan.arrows:
            _draw_arrow(axes, arrow)
        for key, box in plan.boxes.items():
            _draw_box(axes, box, self._labels[key])
            self._letter(axes, box, self._labels[key])

    def _letter(self, axes: Axes, box: GraphBox, label: Label) -> None:
        top = box.y - label.height / 2
        for line in label.lines:
            top = self._lettering.write(axes, line, box.x, top)


def _draw_box(axes: Axes, box: GraphBox, label: Label) -> None:
    if not label.round:
        corner = (box.x - box.width / 2, box.y - box.height / 2)
        patch = Rectangle(corner, box.width, box.height, fc=TOPIC_FILL, ec=TOPIC_EDGE, lw=1.4)
        axes.add_patch(patch)
        return
    if label.doubled:
        _draw_ellipse(axes, (box.x + SHADOW, box.y + SHADOW), box, WARNING)
    _draw_ellipse(axes, (box.x, box.y), box, WARNING if label.doubled else NODE_EDGE)


def _draw_ellipse(axes: Axes, centre: Point, box: GraphBox, edge: str) -> None:
    axes.add_patch(Ellipse(centre, box.width, box.height, fc=NODE_FILL, ec=edge, lw=1.4))


def _draw_arrow(axes: Axes, arrow: Arrow) -> None:
    bends = (len(arrow.line) - 2) // 4
    codes = [Curve.MOVETO, Curve.LINETO, *[*[Curve.CURVE4] * 3, Curve.LINETO] * bends]
    line = PathPatch(Curve(arrow.line, codes), fc="none", ec=ARROW, lw=1.3, zorder=0.5)
    axes.add_patch(line)
    axes.add_patch(Polygon(arrow.head, closed=True, fc=ARROW, ec="none", zorder=0.5))


def _draw_legend(axes: Axes, lettering: Lettering, y: float) -> None:
    top = y - SMALL * 0.65
    node, topic = Label((), round=True), Label(())
    _draw_box(axes, GraphBox(30, 14, x=MARGIN + 15, y=y), node)
    lettering.write(
        axes, TextLine(said("graph.legend.node", "node"), SMALL), MARGIN + 36, top, "left"
    )
    _draw_box(axes, GraphBox(28, 13, x=MARGIN + 96, y=y), topic)
    lettering.write(
        axes, TextLine(said("graph.legend.topic", "topic"), SMALL), MARGIN + 116, top, "left"
    )
    tip = (MARGIN + 192, y)
    head = (tip, (tip[0] - HEAD_LENGTH, y - HEAD_HALF), (tip[0] - HEAD_LENGTH, y + HEAD_HALF))
    _draw_arrow(axes, Arrow(((MARGIN + 162, y), (tip[0] - HEAD_LENGTH, y)), head))
    words = said("graph.legend.arrow", "messages go this way")
    lettering.write(axes, TextLine(words, SMALL), MARGIN + 198, top, "left")
