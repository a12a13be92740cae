"""What stands in the boxes of the graph's picture, and which box leads to which."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Protocol

from ros2_on_pip.graph.layout import Edge, GraphBox
from ros2_on_pip.graph.line import INK, WARNING, TextLine
from ros2_on_pip.graph.shape import GraphShape, NodeShape, TopicShape
from ros2_on_pip.language import said
from ros2_on_pip.safe_text import harmless, wrapped

LONGEST_NAME = 30
SMALL = 9.0


class Ruler(Protocol):
    """Knows how wide a line of text is in its own font."""

    def width(self, line: TextLine) -> float:
        """Points that the line takes from left to right."""


@dataclass(frozen=True)
class Label:
    """The lines in one box: an ellipse for a node, doubled for several; a rectangle for a topic."""

    lines: tuple[TextLine, ...]
    round: bool = False
    doubled: bool = False

    @property
    def height(self) -> float:
        """Points from the top of the first line to the bottom of the last."""
        return sum(line.height for line in self.lines)

    def box(self, ruler: Ruler) -> GraphBox:
        """The size that holds the lines."""
        width = max(ruler.width(line) for line in self.lines)
        if self.round:
            # An ellipse w by h holds a text a by b where (a/w)^2 + (b/h)^2 <= 1.
            return GraphBox(width * 1.25 + 16, self.height * 1.85, 0)
        return GraphBox(width + 22, self.height + 12, 1)


def labels_of(shape: GraphShape) -> dict[str, Label]:
    """Box's key to its label."""
    return {
        **{_node_key(node.name): _node_label(node) for node in shape.nodes},
        **{_topic_key(topic.name): _topic_label(topic) for topic in shape.topics},
    }


def edges_of(shape: GraphShape) -> list[Edge]:
    """Arrows between the keys of `labels_of`: from publisher to topic, from topic to subscriber."""
    return [
        *((_node_key(n), _topic_key(t.name)) for t in shape.topics for n in t.publishers),
        *((_topic_key(t.name), _node_key(n)) for t in shape.topics for n in t.subscribers),
    ]


def _node_key(name: str) -> str:
    return f"node {name}"


def _topic_key(name: str) -> str:
    return f"topic {name}"


def _node_label(node: NodeShape) -> Label:
    doubled = node.count > 1
    words = said("graph.label.again", "{count} nodes of this name", count=node.count)
    again = [words] if doubled else []
    return Label((*_name_lines(node.name), *_warnings(again)), round=True, doubled=doubled)


def _topic_label(topic: TopicShape) -> Label:
    count = len(topic.types)
    words = said("graph.label.types", "{count} types that do not match:", count=count)
    mixed = [words] if count > 1 else []
    return Label((*_name_lines(topic.name), *_warnings(mixed), *_type_lines(topic.types)))


def _name_lines(name: str) -> list[TextLine]:
    return [TextLine(part, colour=INK, bold=True) for part in wrapped(harmless(name), LONGEST_NAME)]


def _type_lines(types: Iterable[str]) -> list[TextLine]:
    parts = (part for kind in types for part in wrapped(harmless(kind), LONGEST_NAME))
    return [TextLine(part, SMALL) for part in parts]


def _warnings(texts: Iterable[str]) -> list[TextLine]:
    return [TextLine(text, SMALL, WARNING, bold=True) for text in texts]
